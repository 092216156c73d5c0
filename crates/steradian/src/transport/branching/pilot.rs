//! How many branches: from the variances that a pilot finds.
//!
//! The pilot follows four branches of each stem, one after the other, some nets of stems for some pixels or points. With x_b the mean of a net's
//! branches b and x̄ that of all four, V_p is the variance of the x_b of a net, and
//!
//! V_c = Var(x̄) − V_p/4
//!
//! over the nets of one pixel or point. Both are taken relative to the squared value and added up over the pixels or points, 1 % of the squared mean
//! being added to the former. The nets of a run are longer by a factor f: what branches share is stratified in two dimensions, whose error falls
//! by another √f if edges cause it, and faster if not (Mitchell 1996), so V_c/√f is what counts.
//!
//! Costs are counted in rays, [two](STEM) of the stem and R of a path: unlike times they are the same in every run.
//!
//! Source: D. Mitchell, *Consequences of stratified sampling in graphics* (SIGGRAPH 1996).

use super::BRANCHES;

/// A pilot is taken where it is at most this part of a run.
const LEAST_PART: u64 = 64;

const FLOOR: f64 = 0.01;

/// Cost of a stem in rays of a path: laying it out, and the film or the lights at a meter, are as much as its ray.
const STEM: f64 = 2.0;

/// More branches are taken where the product of variance and cost is lower by this factor: a pilot is noisy, and with branches there are fewer
/// samples to choose a number of.
const CLEARLY: f64 = 0.95;

/// Whether a run of so many samples, or as many as it takes, is worth a pilot of so many.
pub(in super::super) fn is_worth(samples: Option<u64>, pilot: usize) -> bool {
    samples.is_none_or(|samples| samples >= LEAST_PART * pilot as u64)
}

/// V_c and V_p, relative and of a net.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in super::super) struct Variances {
    shared: f64,
    own: f64,
}

impl Variances {
    /// From the means of nets by branch, so many of each pixel or point.
    pub fn of(branches: &[Vec<f64>; BRANCHES as usize], nets: usize) -> Self {
        let count = f64::from(BRANCHES);
        let net = |i: usize| mean_and_variance(branches.iter().map(|branch| branch[i]));
        let all: Vec<_> = (0..branches[0].len()).map(net).collect();
        let overall = mean_and_variance(all.iter().map(|(mean, _)| *mean)).0;
        let mut sum = Self::default();
        for group in all.chunks(nets) {
            let (value, variance) = mean_and_variance(group.iter().map(|(mean, _)| *mean));
            let own = group.iter().map(|(_, own)| own).sum::<f64>() / nets as f64;
            let scale = value * value + FLOOR * overall * overall;
            if scale > 0.0 {
                sum.own += own / scale;
                sum.shared += (variance - own / count) / scale;
            }
        }
        sum
    }

    /// The number of branches, up to [`BRANCHES`], of the greatest efficiency, with so many rays to a path and nets that are longer than the
    /// pilot's by a factor.
    pub fn best(&self, rays: f64, longer: f64) -> u32 {
        let shared = self.shared.max(0.0) / longer.max(1.0).sqrt();
        let cost = |count: u32| {
            let k = f64::from(count);
            (shared + self.own / k) * (STEM + k * rays)
        };
        let mut best = 1;
        while best < BRANCHES && cost(2 * best) < CLEARLY * cost(best) {
            best *= 2;
        }
        best
    }
}

fn mean_and_variance(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
    (mean, squares / (count - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With V_p = 1 and R = 2 the products for 1, 2 and 4 branches are 8, 9 and 12½ for V_c = 1; 4, 3 and 2½ for V_c = 0; 4½, 3¾ and 3¾ for V_c = ⅛,
    /// which is what ½ comes to in nets 16 times as long.
    #[test]
    fn the_best_number_by_hand() {
        let best = |shared: f64, longer: f64| Variances { shared, own: 1.0 }.best(2.0, longer);
        assert_eq!(best(1.0, 1.0), 1);
        assert_eq!(best(0.0, 1.0), 4);
        assert_eq!([best(0.125, 1.0), best(0.5, 16.0)], [2, 2]);
        assert_eq!(Variances::default().best(3.0, 1.0), 1);
    }

    /// Nets of mean 9 and 11, whose branches are all alike; and such of mean 10 whose branches are 10 ± 1, the variance 4/3 of each.
    #[test]
    fn variances_by_hand() {
        let alike = [
            vec![9.0, 11.0],
            vec![9.0, 11.0],
            vec![9.0, 11.0],
            vec![9.0, 11.0],
        ];
        let found = Variances::of(&alike, 2);
        assert!((found.shared - 2.0 / 101.0).abs() < 1e-15 && found.own == 0.0);
        let apart = [
            vec![9.0, 11.0],
            vec![11.0, 9.0],
            vec![9.0, 11.0],
            vec![11.0, 9.0],
        ];
        let found = Variances::of(&apart, 2);
        assert!((found.own - 4.0 / 3.0 / 101.0).abs() < 1e-15);
        assert!((found.shared + 1.0 / 3.0 / 101.0).abs() < 1e-15);
        assert_eq!(
            Variances::of(&apart.map(|_| vec![0.0; 2]), 2),
            Variances::default()
        );
    }

    #[test]
    fn short_runs_have_no_pilot() {
        assert!(is_worth(None, 1000) && is_worth(Some(64_000), 1000));
        assert!(!is_worth(Some(63_999), 1000));
    }
}
