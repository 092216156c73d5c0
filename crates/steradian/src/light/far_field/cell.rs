//! Integrals over one cell of a table, and their inverses.

/// The cell that holds `x` and where in it, 0 to 1; `None` outside of the nodes.
pub(super) fn locate(nodes: &[f64], x: f64) -> Option<(usize, f64)> {
    let last = nodes.len() - 1;
    if !(nodes[0]..=nodes[last]).contains(&x) {
        return None;
    }
    let cell = nodes.partition_point(|&node| node <= x);
    let cell = cell.saturating_sub(1).min(last - 1);
    Some((cell, (x - nodes[cell]) / (nodes[cell + 1] - nodes[cell])))
}

/// How many of 0 … count − 1 fulfil what holds up to one of them only.
pub(super) fn partition_point(count: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = (low + high) / 2;
        if holds(middle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}

/// ∫ (a + b (θ − from)) sinθ dθ between two angles.
pub(super) fn integral([a, b]: [f64; 2], from: f64, to: f64) -> f64 {
    let middle = 0.5 * (from + to);
    let half = 0.5 * (to - from);
    // cos from − cos to and sin to − sin from, without cancellation.
    let (fall, rise) = (
        2.0 * libm::sin(middle) * libm::sin(half),
        2.0 * libm::cos(middle) * libm::sin(half),
    );
    a * fall + b * (rise - (to - from) * libm::cos(to))
}

/// t in 0 … 1 with ∫₀ᵗ (a + (b − a) x) dx = share · (a + b)/2.
pub(super) fn invert_linear([a, b]: [f64; 2], share: f64) -> f64 {
    let target = share * (a + b);
    let root = (a * a + (b - a) * target).max(0.0).sqrt();
    let t = if a + root > 0.0 {
        target / (a + root)
    } else {
        share
    };
    t.clamp(0.0, 1.0)
}

/// The angle up to which [`integral`] has this value: Newton's method between brackets.
pub(super) fn invert_polar(line: [f64; 2], [from, to]: [f64; 2], target: f64) -> f64 {
    let (mut low, mut high) = (from, to);
    let mut theta = 0.5 * (from + to);
    for _ in 0..64 {
        let error = integral(line, from, theta) - target;
        if error > 0.0 {
            high = theta;
        } else {
            low = theta;
        }
        let slope = (line[0] + line[1] * (theta - from)) * libm::sin(theta);
        let newton = theta - error / slope;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - theta).abs() <= f64::EPSILON * to {
            return next;
        }
        theta = next;
    }
    theta
}
