//! The energy balance that a run found: emitted = absorbed + escaped.
//!
//! d = Σ emitted − Σ absorbed − Σ escaped is 0 where light is neither lost nor made. Its error comes from the replicates of all
//! accounts together, and d is held against 0 by Student's t.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d | what is missing | W or lm |
//! | t = d/se | distance from 0, R − 1 degrees of freedom | 1 |

use super::{Measurements, PointRecord, ROUNDING, Reading, SensorRecord};
use crate::estimation::{Estimate, student};
use crate::sensor::{Readout, Term};

/// A balance that holds is taken for one that does not once in so many runs.
const FALSE_ALARM: f64 = 1e-3;

/// Emitted, absorbed and escaped flux, in one unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// Name of the quantity.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// The accounts of each side.
    pub accounts: Vec<(Term, Vec<Reading>)>,
    /// The sum of each side.
    pub totals: Vec<(Term, Estimate)>,
    /// Emitted − absorbed − escaped.
    pub missing: Estimate,
    /// Probability that chance alone makes as much missing, or more, of either sign.
    pub chance: f64,
}

impl Balance {
    /// Whether emitted = absorbed + escaped, as far as sampling errors let one tell; of balances that hold one in a thousand is told
    /// not to.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.missing.std_error.is_finite() && self.chance >= FALSE_ALARM
    }
}

impl Measurements {
    /// The energy balance in each quantity that was read; none unless [it was asked for](crate::scene::energy_balance).
    #[must_use]
    pub fn balances(&self) -> Vec<Balance> {
        let Some(sides) = self.sides() else {
            return vec![];
        };
        let quantities = sides[0].quantities.iter();
        quantities
            .map(|quantity| self.balance(sides, quantity))
            .collect()
    }

    /// Whether an energy balance was asked for.
    pub(super) fn is_balance(&self) -> bool {
        self.sides().is_some()
    }

    fn sides(&self) -> Option<[&SensorRecord; 3]> {
        let [emitted, absorbed, escaped] = Term::ALL.map(|term| self.side(term));
        Some([emitted?, absorbed?, escaped?])
    }

    fn side(&self, term: Term) -> Option<&SensorRecord> {
        let is_side = |sensor: &&SensorRecord| {
            let mut points = sensor.points.iter();
            sensor.name == term.name() && points.all(|point| point.about.is_some())
        };
        self.sensors.iter().find(is_side)
    }

    fn balance(&self, sides: [&SensorRecord; 3], quantity: &Readout) -> Balance {
        let readings = |side: &SensorRecord| -> Vec<_> {
            let points = side.points.iter();
            points
                .map(|point| self.reading(side, point, quantity))
                .collect()
        };
        let all = sides.map(|side| &side.points[..]).concat();
        let given = sides[0].points.len();
        let sign = |point| if point < given { 1.0 } else { -1.0 };
        let named = || Term::ALL.into_iter().zip(sides);
        let total = |side: &SensorRecord| self.sum(&side.points, quantity, |_| 1.0);
        let totals: Vec<_> = named().map(|(term, side)| (term, total(side))).collect();
        let missing = self.sum(&all, quantity, sign);
        let missing = missing.widened(ROUNDING * totals[0].1.value);
        Balance {
            quantity: quantity.name.clone(),
            unit: quantity.unit.clone(),
            accounts: named().map(|(term, side)| (term, readings(side))).collect(),
            totals,
            chance: chance(&missing, degrees(&all)),
            missing,
        }
    }

    fn sum(
        &self,
        points: &[PointRecord],
        quantity: &Readout,
        sign: impl Fn(usize) -> f64,
    ) -> Estimate {
        let resampled = self.resampled(points, |_, lane| quantity.weights[lane]);
        resampled.estimate(self.confidence, |values| {
            let values = values.iter().enumerate();
            values.fold(0.0, |sum, (point, value)| sum + sign(point) * value)
        })
    }
}

/// Replicates less one.
fn degrees(points: &[PointRecord]) -> u32 {
    let sampled = points.iter().filter_map(|point| point.replicates.as_ref());
    let replicates = sampled.map(|replicates| replicates.samples().len()).min();
    replicates.map_or(1, |replicates| replicates.saturating_sub(1).max(1) as u32)
}

fn chance(missing: &Estimate, degrees: u32) -> f64 {
    if missing.value == 0.0 {
        return 1.0;
    }
    1.0 - student::two_sided_probability(missing.value / missing.std_error, degrees)
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::Synthetic;
    use super::*;

    fn side(term: Term, mut run: Measurements) -> SensorRecord {
        let mut sensor = run.sensors.remove(0);
        sensor.name = term.name().into();
        let points = sensor.points.iter_mut();
        points.for_each(|point| point.about = Some(format!("surface {}", point.index)));
        sensor
    }

    /// 10 lx are emitted, 7 absorbed by two surfaces and 3 escape, less what is lost: each 5 % off in every replicate.
    fn run(seed: u64, lost: f64) -> Measurements {
        let mut run = Synthetic::new(&["lamp"], &[[10.0]]).closed();
        let absorbed = Synthetic::new(&["lamp"], &[[4.0], [3.0]]).sampled(2 * seed, 0.05);
        let escaped = Synthetic::new(&["lamp"], &[[3.0 - lost]]).sampled(2 * seed + 1, 0.05);
        run.sensors = vec![
            side(Term::Emitted, run.clone()),
            side(Term::Absorbed, absorbed),
            side(Term::Escaped, escaped),
        ];
        run
    }

    #[test]
    fn other_sensors_make_no_balance() {
        let mut run = Synthetic::new(&["lamp"], &[[10.0]]).closed();
        assert!(run.balances().is_empty());
        run.sensors[0].name = Term::Emitted.name().into();
        assert!(run.balances().is_empty());
    }

    /// Of 2 000 intervals that hold with probability .95, 1 850 to 1 945 hold but for a probability of 2e-6; of as many balances 2 are
    /// refused in the mean, and more than 12 with a probability of 2e-7.
    #[test]
    fn what_is_missing_is_known_by_its_interval() {
        let (mut held, mut refused) = (0, 0);
        for seed in 0..2000 {
            let balance = run(seed, 0.0).balances().remove(0);
            let [low, high] = balance.missing.interval.unwrap();
            held += usize::from(low <= 0.0 && 0.0 <= high);
            refused += usize::from(!balance.holds());
        }
        assert!((1850..=1945).contains(&held), "{held}");
        assert!(refused <= 12, "{refused}");
    }

    /// 1 lx is missing where 10 are known to .05 √(4² + 3² + 3²)/√16 = .07.
    #[test]
    fn a_loss_is_noticed() {
        for seed in 0..50 {
            let balance = run(seed, 1.0).balances().remove(0);
            assert!(!balance.holds(), "{:?}", balance.missing);
            assert!((balance.missing.value - 1.0).abs() < 0.5);
        }
    }

    #[test]
    fn sums_are_those_of_the_accounts() {
        let balance = run(1, 0.0).balances().remove(0);
        for ((term, total), (of, accounts)) in balance.totals.iter().zip(&balance.accounts) {
            let sum: f64 = accounts.iter().map(|one| one.estimate.value).sum();
            assert_eq!(term, of);
            assert!((sum - total.value).abs() < 1e-12);
        }
        let [emitted, absorbed, escaped] = [0, 1, 2].map(|term| balance.totals[term].1);
        let missing = emitted.value - absorbed.value - escaped.value;
        assert!((balance.missing.value - missing).abs() < 1e-12);
        assert_eq!(balance.accounts[1].1[1].sensor, "absorbed: surface 1");
    }
}
