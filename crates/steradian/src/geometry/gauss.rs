//! Gauss–Legendre quadrature, ∫₋₁¹ f(x) dx ≈ Σ wᵢ f(xᵢ), exact for polynomials of degree 2n − 1.
//!
//! The nodes are the roots of Legendre's polynomial Pₙ, wᵢ = 2/((1 − xᵢ²) Pₙ′(xᵢ)²); Newton's method finds them while
//! the program is compiled.
//!
//! How many nodes are enough is known beforehand where the singularities of f are known. If f is analytic inside the
//! ellipse with foci ±1 and half axes that add up to ϱ, and |f| ≤ M there, the error is at most
//! (64/15) M ϱ⁻²ⁿ/(1 − ϱ⁻²) (Trefethen, *Approximation Theory and Approximation Practice*, 2013, theorem 19.3).

/// The most nodes of a rule.
pub(crate) const MAX_ORDER: usize = 16;

type Rules = [[(f64, f64); MAX_ORDER]; MAX_ORDER + 1];

static RULES: Rules = rules();

/// Nodes and weights of the rule of this order, 1 … [`MAX_ORDER`], for the interval from −1 to 1.
pub(crate) fn rule(order: usize) -> &'static [(f64, f64)] {
    &RULES[order][..order]
}

/// ∫ f over an interval.
pub(crate) fn integrate(order: usize, [from, to]: [f64; 2], mut f: impl FnMut(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let sum: f64 = rule(order)
        .iter()
        .map(|&(node, weight)| weight * f(middle + half * node))
        .sum();
    half * sum
}

/// The least order for which ϱ⁻²ⁿ is not above `tolerance`, if there is one up to [`MAX_ORDER`].
pub(crate) fn order_for(rho: f64, tolerance: f64) -> Option<usize> {
    let shrinkage = 1.0 / (rho * rho);
    let mut remainder = 1.0;
    (1..=MAX_ORDER).find(|_| {
        remainder *= shrinkage;
        remainder <= tolerance
    })
}

/// ϱ of the ellipse through the point `re` + i `im`.
pub(crate) fn ellipse_through(re: f64, im: f64) -> f64 {
    let to_focus = |focus: f64| ((re - focus) * (re - focus) + im * im).sqrt();
    let half_axis = (0.5 * (to_focus(1.0) + to_focus(-1.0))).max(1.0);
    half_axis + (half_axis * half_axis - 1.0).sqrt()
}

const fn rules() -> Rules {
    let mut rules = [[(0.0, 0.0); MAX_ORDER]; MAX_ORDER + 1];
    let mut order = 1;
    while order <= MAX_ORDER {
        let mut index = 0;
        while index < order {
            rules[order][index] = node_and_weight(order, index);
            index += 1;
        }
        order += 1;
    }
    rules
}

/// The lower half of the nodes mirrors the upper half, so that rules are symmetric to the last bit.
const fn node_and_weight(order: usize, index: usize) -> (f64, f64) {
    if 2 * index >= order {
        let (node, weight) = node_and_weight(order, order - 1 - index);
        return (-node, weight);
    }
    if 2 * index + 1 == order {
        let slope = legendre(order, 0.0).1;
        return (0.0, 2.0 / (slope * slope));
    }
    let angle = std::f64::consts::PI * (index as f64 + 0.75) / (order as f64 + 0.5);
    let mut x = -cosine(angle);
    let mut step = 0;
    while step < 8 {
        let (value, slope) = legendre(order, x);
        x -= value / slope;
        step += 1;
    }
    let slope = legendre(order, x).1;
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// Pₙ and Pₙ′ by the recurrence (k + 1) Pₖ₊₁ = (2k + 1) x Pₖ − k Pₖ₋₁.
const fn legendre(order: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    let mut k = 1;
    while k < order {
        let degree = k as f64;
        let next = ((2.0 * degree + 1.0) * x * value - degree * before) / (degree + 1.0);
        (before, value) = (value, next);
        k += 1;
    }
    (value, order as f64 * (x * value - before) / (x * x - 1.0))
}

/// For angles up to a right angle, to some digits: the first guess of Newton's method.
const fn cosine(angle: f64) -> f64 {
    let square = angle * angle;
    1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;

    #[test]
    fn powers_are_exact_up_to_twice_the_order() {
        for order in 1..=MAX_ORDER {
            for power in 0..2 * order as i32 {
                let found = integrate(order, [0.0, 1.0], |x| x.powi(power));
                let expected = 1.0 / f64::from(power + 1);
                assert!(
                    close(found, expected, 4.0 * f64::EPSILON),
                    "{order} {power} {found}"
                );
            }
        }
    }

    #[test]
    fn the_error_keeps_its_bound() {
        // 1/(x − 2) has its pole on the ellipse with ϱ = 2 + √3; on the one with 3/4 of that it is at most 2.
        let rho = ellipse_through(2.0, 0.0);
        assert!(close(rho, 2.0 + 3.0_f64.sqrt(), 1e-15));
        for order in 2..12 {
            let found = integrate(order, [-1.0, 1.0], |x| 1.0 / (2.0 - x));
            let bound = 64.0 / 15.0 * 2.0 * (0.75 * rho).powi(-2 * order as i32);
            assert!(close(found, libm::log(3.0), 1.2 * bound), "{order}");
        }
        assert_eq!(order_for(10.0, 1e-15), Some(8));
        assert_eq!(order_for(1.5, 1e-15), None);
    }
}
