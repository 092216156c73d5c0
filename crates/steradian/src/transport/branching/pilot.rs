//! How many branches: from the variances that a pilot finds.
//!
//! The pilot follows four branches of each stem, one after the other, some nets of stems for some pixels or points. With x_b the mean of a net's
//! branches b and x̄ that of all four, V_p is the variance of the x_b of a net, and
//!
//! V_c = Var(x̄) − V_p/4
//!
//! over the nets of one pixel or point. Both are taken relative to the squared value and added up over the pixels or points, 1 % of the squared mean
//! being added to the former. The nets of a usual run are longer by a factor f: what branches share is stratified in two dimensions, whose error falls
//! by another √f if edges cause it, and faster if not (Mitchell 1996), so V_c/√f is what counts.
//!
//! Costs are counted in rays, [two](STEM) of the stem, more if it has a path from a light, and R of a path: unlike times they are the same in every run.
//!
//! Source: D. Mitchell, *Consequences of stratified sampling in graphics* (SIGGRAPH 1996).

use super::{BRANCHES, Branches};

/// Tells the numbers of a pilot from those of the run.
pub(in super::super) const KEY: u64 = 0x7069_6c6f_7421;

const FLOOR: f64 = 0.01;

/// Cost of a stem in rays of a path: laying it out, and the film or the lights at a meter, are as much as its ray.
const STEM: f64 = 2.0;

/// More branches are taken where the product of variance and cost is lower by this factor: a pilot is noisy, and with branches there are fewer
/// samples to choose a number of.
const CLEARLY: f64 = 0.95;

/// As many branches as suit a pilot of so many stems, whose streams have so many nets each; the nets of a usual run are longer by a factor.
pub(in super::super) fn suited(
    threads: usize,
    (stems, nets): (usize, usize),
    longer: f64,
    follow: impl Fn(Branches) -> (Vec<f64>, Rays) + Sync,
) -> Branches {
    let (means, rays) = of_each_branch(threads, follow);
    let [path, beside] = rays.map(|rays| rays as f64 / (means.len() * stems) as f64);
    let costs = Costs {
        stem: STEM + beside,
        path: (path - 1.0).max(0.0),
    };
    Branches::all(Variances::of(&means, nets).best(&costs, longer))
}

/// The means of the nets of each branch, and the rays of all, a thread for each branch if there are several.
fn of_each_branch(
    threads: usize,
    follow: impl Fn(Branches) -> (Vec<f64>, Rays) + Sync,
) -> ([Vec<f64>; BRANCHES as usize], Rays) {
    let all = [0, 1, 2, 3].map(Branches::only);
    let found = if threads == 1 {
        all.map(&follow)
    } else {
        std::thread::scope(|scope| {
            let follow = &follow;
            let threads = all.map(|branch| scope.spawn(move || follow(branch)));
            threads.map(|thread| match thread.join() {
                Ok(found) => found,
                Err(panic) => std::panic::resume_unwind(panic),
            })
        })
    };
    let rays = [0, 1].map(|kind| found.iter().map(|(_, rays)| rays[kind]).sum());
    (found.map(|(means, _)| means), rays)
}

/// Of paths with their stems, and beside them.
pub(in super::super) type Rays = [u64; 2];

/// In rays, of what branches share and of each.
struct Costs {
    stem: f64,
    path: f64,
}

/// V_c and V_p, relative and of a net.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Variances {
    shared: f64,
    own: f64,
}

impl Variances {
    /// From the means of nets by branch, so many of each pixel or point.
    fn of(branches: &[Vec<f64>; BRANCHES as usize], nets: usize) -> Self {
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

    /// The number of branches, up to [`BRANCHES`], of the greatest efficiency, with nets that are longer than the pilot's by a factor.
    fn best(&self, costs: &Costs, longer: f64) -> u32 {
        let shared = self.shared.max(0.0) / longer.max(1.0).sqrt();
        let cost = |count: u32| {
            let k = f64::from(count);
            (shared + self.own / k) * (costs.stem + k * costs.path)
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
        let costs = Costs {
            stem: STEM,
            path: 2.0,
        };
        let best = |shared: f64, longer: f64| Variances { shared, own: 1.0 }.best(&costs, longer);
        assert_eq!(best(1.0, 1.0), 1);
        assert_eq!(best(0.0, 1.0), 4);
        assert_eq!([best(0.125, 1.0), best(0.5, 16.0)], [2, 2]);
        assert_eq!(Variances::default().best(&costs, 1.0), 1);
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
    fn branches_are_followed_alike_on_one_thread_and_on_several() {
        let follow = |branch: Branches| (vec![f64::from(branch.first)], [10, 1]);
        let expected = ([0.0, 1.0, 2.0, 3.0].map(|number| vec![number]), [40, 4]);
        for threads in [1, 2] {
            assert_eq!(of_each_branch(threads, follow), expected);
        }
    }
}
