//! Reflectances for the many colours of a texture.
//!
//! Solving for a colour takes some 30 µs; interpolating between solved colours takes a thousandth of that. Two facts make
//! the coefficients c(rgb) smooth enough for a coarse grid:
//!
//! - *Symmetry.* As S(−x) = 1 − S(x), c(1 − rgb) = −c(rgb). The table holds colours with max + min ≤ 1; a brighter one is
//!   looked up as its complement.
//! - *Scale.* A grey g has c₂ = (g − ½)/√(g (1 − g)). So the table holds d = c √(m (1 − m)), where m is the mean of the
//!   channels: it is finite at black, and for greys d₂ = m − ½ is a straight line, which interpolation keeps.
//!
//! The grid is one cube for each channel that may be the largest: z is that channel, x and y the ratios of the others to
//! it, after Jakob & Hanika 2019, §4. Levels of z lie at 3t² − 2t³, t = 0, 1/31, …, 1.
//!
//! The colour of an interpolated reflectance differs from the one asked for, in the worst channel, by
//!
//! | colours | root mean square | 99 % | greatest |
//! |---|---|---|---|
//! | even in [0, 1]³ | 6·10⁻⁴ | 2·10⁻³ | 8·10⁻³, beside the primaries |
//! | even in [0, 0.02]³ or [0.95, 1]³ | 1.3·10⁻⁴ | 6·10⁻⁴ | 1.3·10⁻³ |
//! | grey | | | 10⁻⁶ |

use std::sync::LazyLock;

use super::upsampling::Sigmoid;

/// Nodes along an axis.
const RESOLUTION: usize = 32;
/// What stands for z = 0, where x and y have no meaning but d has a limit.
const DARKEST: f64 = 1e-4;
/// Coefficients of black.
const BLACK: [f32; 3] = [0.0, 0.0, -1e4];
/// The least m that is told from black.
const LEAST_MEAN: f32 = 1e-8;

/// Coefficients of [`Sigmoid`] by interpolation.
///
/// ```
/// use steradian::spectrum::{UpsamplingTable, sigmoid_at};
///
/// let table = UpsamplingTable::shared();
/// let grass = table.coefficients([0.1, 0.3, 0.05]);
/// assert!(sigmoid_at(grass, 540.0) > 0.3 && sigmoid_at(grass, 640.0) < 0.15);
/// assert!((sigmoid_at(table.coefficients([0.5; 3]), 640.0) - 0.5).abs() < 1e-6);
/// ```
#[derive(Clone, Debug)]
pub struct UpsamplingTable {
    /// d of every node; see [`index`].
    nodes: Vec<[f32; 3]>,
    /// z of the nodes.
    levels: [f32; RESOLUTION],
}

impl UpsamplingTable {
    /// The table, solved for when it is first asked for: a third of a second, 1.2 MB.
    pub fn shared() -> &'static Self {
        static TABLE: LazyLock<UpsamplingTable> = LazyLock::new(UpsamplingTable::new);
        &TABLE
    }

    fn new() -> Self {
        let mut nodes = vec![[0.0; 3]; 3 * RESOLUTION * RESOLUTION * RESOLUTION];
        for largest in 0..3 {
            for y in 0..RESOLUTION {
                for x in 0..RESOLUTION {
                    solve_column(&mut nodes, largest, [x, y]);
                }
            }
        }
        Self {
            nodes,
            levels: std::array::from_fn(|node| level(node) as f32),
        }
    }

    /// Coefficients for a colour in linear Rec.709 under D65, each channel between 0 and 1; black for what is no number.
    pub fn coefficients(&self, rgb: [f32; 3]) -> [f32; 3] {
        let [r, g, b] = rgb;
        if r.max(g).max(b) + r.min(g).min(b) > 1.0 {
            let complement = self.dark_coefficients(rgb.map(|channel| 1.0 - channel));
            return complement.map(|c| -c);
        }
        self.dark_coefficients(rgb)
    }

    /// Coefficients for a colour with max + min ≤ 1.
    fn dark_coefficients(&self, rgb: [f32; 3]) -> [f32; 3] {
        let largest = match rgb {
            [r, g, b] if r >= g && r >= b => 0,
            [_, g, b] if g >= b => 1,
            _ => 2,
        };
        let z = rgb[largest];
        if z.is_nan() || z <= 0.0 {
            return BLACK;
        }
        let [x, y] = [1, 2].map(|next| evenly(rgb[(largest + next) % 3] / z));
        let d = self.interpolate(largest, [x, y, self.among_levels(z)]);
        let mean = ((rgb[0] + rgb[1] + rgb[2]) / 3.0).max(LEAST_MEAN);
        let scale = 1.0 / (mean * (1.0 - mean)).sqrt();
        d.map(|d| d * scale)
    }

    /// The cell of z and the place in it.
    fn among_levels(&self, z: f32) -> (usize, f32) {
        let inner = &self.levels[1..RESOLUTION - 1];
        let cell = inner.partition_point(|level| *level <= z);
        let (low, high) = (self.levels[cell], self.levels[cell + 1]);
        (cell, ((z - low) / (high - low)).min(1.0))
    }

    /// Linear in x, y and z.
    fn interpolate(&self, largest: usize, [x, y, z]: [(usize, f32); 3]) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for corner in 0..8 {
            let [i, j, k] = [corner & 1, corner >> 1 & 1, corner >> 2];
            let weight = |upper: usize, t: f32| if upper == 1 { t } else { 1.0 - t };
            let weight = weight(i, x.1) * weight(j, y.1) * weight(k, z.1);
            let node = self.nodes[index(largest, [x.0 + i, y.0 + j], z.0 + k)];
            sum = std::array::from_fn(|i| sum[i] + weight * node[i]);
        }
        sum
    }
}

/// The cell of a ratio between 0 and 1 and the place in it.
fn evenly(ratio: f32) -> (usize, f32) {
    let place = ratio.clamp(0.0, 1.0) * (RESOLUTION - 1) as f32;
    let cell = (place as usize).min(RESOLUTION - 2);
    (cell, place - cell as f32)
}

fn index(largest: usize, [x, y]: [usize; 2], z: usize) -> usize {
    ((largest * RESOLUTION + y) * RESOLUTION + x) * RESOLUTION + z
}

fn ratio(node: usize) -> f64 {
    node as f64 / (RESOLUTION - 1) as f64
}

/// z of a node: closer together at both ends, where coefficients change fastest.
fn level(node: usize) -> f64 {
    let t = ratio(node);
    t * t * (3.0 - 2.0 * t)
}

fn colour(largest: usize, [x, y]: [usize; 2], z: usize) -> [f64; 3] {
    let z = level(z).max(DARKEST);
    let mut rgb = [z; 3];
    rgb[(largest + 1) % 3] = z * ratio(x);
    rgb[(largest + 2) % 3] = z * ratio(y);
    rgb
}

/// √(m (1 − m))
fn scale(rgb: [f64; 3]) -> f64 {
    let mean = (rgb[0] + rgb[1] + rgb[2]) / 3.0;
    (mean * (1.0 - mean)).sqrt()
}

/// Solves for all z of one chromaticity, from the middle upwards and downwards, each from its neighbour's d.
fn solve_column(nodes: &mut [[f32; 3]], largest: usize, ratios: [usize; 2]) {
    let middle = RESOLUTION / 2;
    let rgb = colour(largest, ratios, middle);
    let start = Sigmoid::from_rgb(rgb).c.map(|c| c * scale(rgb));
    let mut solve = |z: usize, from: [f64; 3]| {
        let rgb = colour(largest, ratios, z);
        let guess = Sigmoid {
            c: from.map(|d| d / scale(rgb)),
        };
        let d = guess.towards(rgb).c.map(|c| c * scale(rgb));
        nodes[index(largest, ratios, z)] = d.map(|d| d as f32);
        d
    };
    let upwards = (middle..RESOLUTION).take_while(|&z| is_needed(ratios, z));
    upwards.fold(start, |d, z| solve(z, d));
    (0..middle).rev().fold(start, |d, z| solve(z, d));
}

/// Whether the lowest corner of the cells below this node has max + min ≤ 1.
fn is_needed([x, y]: [usize; 2], z: usize) -> bool {
    let lowest = |node: usize| ratio(node.saturating_sub(1));
    level(z.saturating_sub(1)) * (1.0 + lowest(x).min(lowest(y))) <= 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Distances, in the worst channel, of what comes back for 20 000 colours of a cube, in ascending order.
    fn errors(low: f64, high: f64) -> Vec<f64> {
        let table = UpsamplingTable::shared();
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            low + (high - low) * (state >> 40) as f64 / (1_u64 << 24) as f64
        };
        let mut errors: Vec<f64> = (0..20_000)
            .map(|_| {
                let rgb = [random(), random(), random()];
                let c = table.coefficients(rgb.map(|channel| channel as f32));
                let back = Sigmoid {
                    c: c.map(f64::from),
                }
                .to_rgb();
                let distances = back.iter().zip(rgb).map(|(a, b)| (a - b).abs());
                distances.fold(0.0, f64::max)
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        errors
    }

    fn root_mean_square(errors: &[f64]) -> f64 {
        (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
    }

    /// The bounds are those of the module's table, whose numbers are these very colours'.
    #[test]
    fn colours_come_back_as_documented() {
        let all = errors(0.0, 1.0);
        assert!(root_mean_square(&all) < 6e-4, "{}", root_mean_square(&all));
        assert!(
            all[19_800] < 2e-3 && all[19_999] < 8e-3,
            "{} {}",
            all[19_800],
            all[19_999]
        );
        for (low, high) in [(0.0, 0.02), (0.95, 1.0)] {
            let ends = errors(low, high);
            assert!(
                root_mean_square(&ends) < 1.4e-4,
                "{}",
                root_mean_square(&ends)
            );
            assert!(
                ends[19_800] < 6e-4 && ends[19_999] < 1.3e-3,
                "{} {}",
                ends[19_800],
                ends[19_999]
            );
        }
    }

    #[test]
    fn greys_are_flat_from_black_to_white() {
        let table = UpsamplingTable::shared();
        for percent in 0..=100_u8 {
            let grey = f32::from(percent) / 100.0;
            let [c0, c1, c2] = table.coefficients([grey; 3]);
            assert!(c0.abs() < 1e-5 && c1.abs() < 1e-5, "{grey}: {c0} {c1}");
            let value = Sigmoid {
                c: [0.0, 0.0, f64::from(c2)],
            }
            .at(555.0);
            assert!((value - f64::from(grey)).abs() < 1e-6, "{grey}: {value}");
        }
    }

    proptest! {
        #[test]
        fn any_numbers_are_looked_up(rgb in any::<[f32; 3]>()) {
            let c = UpsamplingTable::shared().coefficients(rgb);
            prop_assert!(c.iter().all(|c| !c.is_infinite() || rgb.iter().any(|x| x.abs() > 1.0)));
        }
    }
}
