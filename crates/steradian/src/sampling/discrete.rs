//! Choosing one of several things with given probabilities.
//!
//! The uniform number that chooses is stretched over the chosen interval and returned, so one dimension serves the choice and what
//! follows. Sampling by the cumulative sums (and not by an alias table) is monotonic, which keeps the stratification of a net.

/// Probabilities in proportion to weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Discrete {
    /// Upper ends of the intervals of [0, 1); the last is 1.
    ends: Vec<f64>,
    /// By k = ⌊un⌋, a place among the ends from which few steps lead to that of u (H. Chen & Y. Asau 1974, *On generating random variates from an empirical
    /// distribution*: in the mean no more than one).
    guide: Vec<u32>,
}

/// What was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Index of the chosen thing.
    pub index: usize,
    /// Its probability.
    pub probability: f64,
    /// A uniform number in [0, 1) that is independent of the choice.
    pub remapped: f32,
}

const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

impl Discrete {
    /// Probabilities in proportion to `weights`; none if a weight is negative or not finite, or if all are zero.
    ///
    /// ```
    /// use steradian::sampling::discrete::Discrete;
    ///
    /// let lamps = Discrete::new(&[1.0, 3.0]).unwrap();
    /// assert_eq!(lamps.probability(1), 0.75);
    /// let choice = lamps.choose(0.625);
    /// assert_eq!((choice.index, choice.remapped), (1, 0.5));
    /// ```
    #[must_use]
    pub fn new(weights: &[f64]) -> Option<Self> {
        let total: f64 = weights.iter().sum();
        if !(total > 0.0 && total.is_finite() && weights.iter().all(|&weight| weight >= 0.0)) {
            return None;
        }
        let mut sum = 0.0;
        let mut ends: Vec<f64> = weights
            .iter()
            .map(|weight| {
                sum += weight;
                sum / total
            })
            .collect();
        // Rounding must not leave a gap below 1 nor give the zero weights at the end a sliver.
        let last = weights.iter().rposition(|&weight| weight > 0.0)?;
        ends[last..].fill(1.0);
        let guide = guide(&ends);
        Some(Self { ends, guide })
    }

    /// Number of things to choose from.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Always false: there is something to choose.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Probability of the thing at `index`.
    ///
    /// # Panics
    /// If there is no such thing.
    #[must_use]
    pub fn probability(&self, index: usize) -> f64 {
        self.ends[index] - self.start(index)
    }

    /// Chooses by a uniform number `u` in [0, 1).
    #[must_use]
    pub fn choose(&self, u: f32) -> Choice {
        let place = f64::from(u);
        let index = self.find(place).min(self.len() - 1);
        let probability = self.probability(index);
        let remapped = ((place - self.start(index)) / probability) as f32;
        Choice {
            index,
            probability,
            remapped: remapped.min(BELOW_ONE),
        }
    }

    /// The number of ends that are not above a place.
    fn find(&self, place: f64) -> usize {
        let k = (place * self.len() as f64) as usize;
        let mut index = self.guide[k.min(self.len() - 1)] as usize;
        while index > 0 && self.ends[index - 1] > place {
            index -= 1;
        }
        while index < self.len() && self.ends[index] <= place {
            index += 1;
        }
        index
    }

    fn start(&self, index: usize) -> f64 {
        if index == 0 {
            0.0
        } else {
            self.ends[index - 1]
        }
    }
}

/// The number of ends that are not above k/n, by k.
fn guide(ends: &[f64]) -> Vec<u32> {
    let count = ends.len();
    let mut index = 0;
    let at = |k: usize| {
        let place = k as f64 / count as f64;
        while index < count && ends[index] <= place {
            index += 1;
        }
        index as u32
    };
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_thing_is_chosen_as_often_as_it_should() {
        let weights = [0.0, 2.0, 1.0, 0.0, 5.0, 0.0];
        let table = Discrete::new(&weights).unwrap();
        let (mut counts, mut means) = ([0.0; 6], [0.0; 6]);
        let steps = 8000;
        for step in 0..steps {
            let choice = table.choose((step as f32 + 0.5) / steps as f32);
            counts[choice.index] += 1.0;
            means[choice.index] += f64::from(choice.remapped);
        }
        for (index, weight) in weights.into_iter().enumerate() {
            // The ends of the intervals fall between two steps.
            assert_eq!(counts[index], weight * 1000.0);
            assert!((table.probability(index) - weight / 8.0).abs() < 1e-15);
            assert!(weight == 0.0 || (means[index] / counts[index] - 0.5).abs() < 1e-4);
        }
    }

    #[test]
    fn the_ends_of_the_interval_are_safe() {
        let table = Discrete::new(&[0.1, 0.2, 0.3, 0.0]).unwrap();
        assert_eq!(table.choose(BELOW_ONE).index, 2);
        assert!(table.choose(BELOW_ONE).remapped < 1.0);
        assert_eq!(table.choose(0.0).index, 0);
        assert_eq!(Discrete::new(&[0.0, 1.0]).unwrap().choose(0.0).index, 1);
    }

    /// Where weights differ by many orders and ends lie on numbers that choose, the guide leads to what a search among all ends finds.
    #[test]
    fn the_guide_leads_to_the_place() {
        for count in [1, 2, 3, 64, 1000] {
            let weight = |k: usize| match k % 5 {
                0 => 0.0,
                1 => 1e-12,
                _ => 0.5_f64.powi((k % 37) as i32),
            };
            let weights: Vec<_> = (0..count).map(|k| weight(k + 2)).collect();
            let even = Discrete::new(&vec![1.0; count]).unwrap();
            for table in [Discrete::new(&weights).unwrap(), even] {
                for k in 0..1 << 14 {
                    let place = f64::from(k) * 0.5_f64.powi(14);
                    let searched = table.ends.partition_point(|&end| end <= place);
                    assert_eq!(table.find(place), searched, "{count} {place}");
                }
            }
        }
    }

    #[test]
    fn weights_that_are_no_probabilities_are_refused() {
        for weights in [
            &[][..],
            &[0.0, 0.0],
            &[1.0, -0.5],
            &[f64::NAN],
            &[f64::INFINITY, 1.0],
        ] {
            assert_eq!(Discrete::new(weights), None);
        }
    }
}
