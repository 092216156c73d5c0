//! Wavelengths of a path: four of them, stratified, drawn from a density that follows what is emitted and what is read.
//!
//! A path carries the spectral radiance L_λ at four wavelengths. With the cumulative density P of p(λ) and one uniform
//! number u they are λ_k = P⁻¹((u + k)/4), k = 0 … 3, and a reading ∫ R(λ) L_λ dλ is estimated without bias by
//!
//! ¼ Σ_k R(λ_k) L_λk / p(λ_k).
//!
//! The density is p = .9 · (response × power) + .1 · uniform, constant within each cell of the run's [`Grid`], so that
//! R·L/p is bounded by ten times the range times the greatest R·L, whatever the density misses.
//!
//! Curves are read from the grid too: a cell of half a nanometre holds a straight line through the curve's values at its
//! quarter points. Tables of whole or half nanometres, jumps at their ends included, are read exactly; a curve of
//! second derivative f″ is off by at most f″·h²/8, h = .5 nm.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | λ | wavelength | nm |
//! | p | density | 1/nm |
//! | R | response of a channel | 1, lm/W, … |
//! | L_λ | spectral radiance | W/(m² sr nm) |
//!
//! Source: A. Wilkie et al., *Hero wavelength spectral sampling* (EGSR 2014), for the stratified wavelengths of one path.

use super::Curve;

/// Greatest width of a cell in nm.
const CELL: f64 = 0.5;
/// Part of the density that is uniform.
const UNIFORM: f64 = 0.1;
/// Wavelengths of a path.
const LANES: usize = 4;

/// The run's range of wavelengths, divided into equal cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    low: f64,
    high: f64,
    cells: usize,
}

impl Grid {
    /// Cells of half a nanometre or a little less; the range must not be empty.
    pub fn new([low, high]: [f64; 2]) -> Self {
        let cells = ((high - low) / CELL).ceil().max(1.0) as usize;
        Self { low, high, cells }
    }

    /// First and last wavelength in nm.
    pub fn range(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    fn width(&self) -> f64 {
        (self.high - self.low) / self.cells as f64
    }

    /// The wavelength in nm at a place: the number of a cell and the part of it that is passed.
    pub fn wavelength(&self, place: f64) -> f64 {
        self.low + place * self.width()
    }

    /// Place of a wavelength in nm: cells from the start of the range.
    pub fn place(&self, wavelength: f64) -> f64 {
        (wavelength - self.low) / self.width()
    }

    /// The middles of all cells, four at a time: what is summed with their weights is the integral by the midpoint rule.
    pub fn middles(&self) -> impl Iterator<Item = Wavelengths> + use<> {
        let (cells, width) = (self.cells, self.width() as f32);
        (0..cells.div_ceil(LANES)).map(move |group| {
            let cell = |lane: usize| group * LANES + lane;
            let weight = |lane| if cell(lane) < cells { width } else { 0.0 };
            Wavelengths {
                places: std::array::from_fn(|lane| cell(lane).min(cells - 1) as f32 + 0.5),
                weights: std::array::from_fn(weight),
            }
        })
    }

    /// The curve as straight lines in the cells.
    pub fn bake(&self, curve: &Curve) -> BakedCurve {
        let quarter = |cell: usize, part: f64| curve.at(self.wavelength(cell as f64 + part));
        let line = |cell| {
            let (a, b) = (quarter(cell, 0.25), quarter(cell, 0.75));
            [(1.5 * a - 0.5 * b) as f32, (2.0 * (b - a)) as f32]
        };
        BakedCurve((0..self.cells).map(line).collect())
    }
}

/// A curve on a [`Grid`].
#[derive(Clone, Debug, PartialEq)]
pub struct BakedCurve(Vec<[f32; 2]>);

impl BakedCurve {
    /// The value at a place of the grid.
    #[inline(always)]
    pub fn at(&self, place: f32) -> f32 {
        let cell = (place as usize).min(self.0.len() - 1);
        let [start, rise] = self.0[cell];
        start + rise * (place - cell as f32)
    }
}

/// Wavelengths of one path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wavelengths {
    /// Places in the grid.
    pub places: [f32; LANES],
    /// 1/(4p) in nm: what each lane counts.
    pub weights: [f32; LANES],
}

/// The density from which a sensor's wavelengths are drawn.
#[derive(Clone, Debug)]
pub struct WavelengthDensity {
    width: f64,
    /// Probability up to the end of each cell.
    cumulative: Vec<f64>,
}

impl WavelengthDensity {
    /// .9 of the density follows `weight` (per nm, in any unit, not negative), .1 is uniform.
    pub fn new(grid: &Grid, weight: impl Fn(f64) -> f64) -> Self {
        let at = |cell: usize| weight(grid.wavelength(cell as f64 + 0.5)).max(0.0);
        let weights: Vec<f64> = (0..grid.cells).map(at).collect();
        let total: f64 = weights.iter().sum();
        let even = 1.0 / grid.cells as f64;
        let part = |weight: &f64| match total > 0.0 {
            true => (1.0 - UNIFORM) * weight / total + UNIFORM * even,
            false => even,
        };
        let mut sum = 0.0;
        let cumulative = weights.iter().map(|weight| {
            sum += part(weight);
            sum
        });
        Self {
            cumulative: cumulative.collect(),
            width: grid.width(),
        }
    }

    /// The four wavelengths of a uniform number.
    pub fn sample(&self, u: f32) -> Wavelengths {
        let drawn: [_; LANES] = std::array::from_fn(|k| self.draw(k, f64::from(u)));
        Wavelengths {
            places: drawn.map(|(place, _)| place),
            weights: drawn.map(|(_, weight)| weight),
        }
    }

    fn draw(&self, stratum: usize, u: f64) -> (f32, f32) {
        let last = self.cumulative.len() - 1;
        let wanted = (stratum as f64 + u) / LANES as f64 * self.cumulative[last];
        let cell = self
            .cumulative
            .partition_point(|sum| *sum <= wanted)
            .min(last);
        let before = if cell == 0 {
            0.0
        } else {
            self.cumulative[cell - 1]
        };
        let probability = self.cumulative[cell] - before;
        let within = ((wanted - before) / probability).clamp(0.0, 1.0);
        let density = probability / (self.width * self.cumulative[last]);
        let place = (cell as f64 + within) as f32;
        (place, (1.0 / (LANES as f64 * density)) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Beyond, blackbody};

    fn lamp() -> Curve {
        let samples = vec![(400.0, 0.0), (500.0, 8.0), (600.0, 15.6), (700.0, 18.4)];
        Curve::new(samples, Beyond::Zero).unwrap()
    }

    #[test]
    fn tables_of_whole_nanometres_are_read_exactly() {
        let grid = Grid::new([360.0, 830.0]);
        let baked = grid.bake(&lamp());
        for step in 0..9400 {
            let place = f64::from(step) * 0.1;
            let wavelength = grid.wavelength(place);
            // At the jump itself either value is right.
            if (wavelength - 700.0).abs() > 1e-6 {
                let (found, exact) = (f64::from(baked.at(place as f32)), lamp().at(wavelength));
                assert!(
                    (found - exact).abs() < 2e-5,
                    "{wavelength}: {found} {exact}"
                );
            }
        }
    }

    /// f″ of a body of 2700 K is at most 1.1e-3 f at 360 nm.
    #[test]
    fn smooth_curves_are_read_within_the_stated_error() {
        let grid = Grid::new([360.0, 830.0]);
        let body = blackbody(2700.0, [360.0, 830.0], 0.05).unwrap();
        let baked = grid.bake(&body);
        for step in 0..9400 {
            let place = f64::from(step) * 0.1;
            let (found, exact) = (
                f64::from(baked.at(place as f32)),
                body.at(grid.wavelength(place)),
            );
            assert!((found / exact - 1.0).abs() < 1.1e-3 * 0.25 / 8.0 + 1e-5);
        }
    }

    /// The mean over u of ¼ Σ f/p is ∫ f dλ: the midpoint rule in u is exact within a cell up to its two ends.
    #[test]
    fn the_weights_integrate_every_function() {
        let grid = Grid::new([360.0, 830.0]);
        for density in [
            WavelengthDensity::new(&grid, |nm| lamp().at(nm)),
            WavelengthDensity::new(&grid, |_| 0.0),
        ] {
            let steps = 200_000;
            let mut sums = [0.0; 3];
            for step in 0..steps {
                let Wavelengths { places, weights } =
                    density.sample((step as f32 + 0.5) / steps as f32);
                for (place, weight) in places.into_iter().zip(weights) {
                    let nm = grid.wavelength(f64::from(place));
                    let values = [1.0, lamp().at(nm), (nm - 360.0) * (nm - 360.0)];
                    sums.iter_mut()
                        .zip(values)
                        .for_each(|(sum, x)| *sum += x * f64::from(weight));
                }
            }
            let means = sums.map(|sum| sum / f64::from(steps));
            let exact = [
                470.0,
                lamp().integral([360.0, 830.0]),
                470.0_f64.powi(3) / 3.0,
            ];
            for (mean, exact) in means.into_iter().zip(exact) {
                assert!((mean / exact - 1.0).abs() < 1e-4, "{mean} {exact}");
            }
        }
    }

    #[test]
    fn wavelengths_are_stratified() {
        let grid = Grid::new([400.0, 800.0]);
        let even = WavelengthDensity::new(&grid, |_| 1.0);
        let nm = even
            .sample(0.5)
            .places
            .map(|place| grid.wavelength(f64::from(place)));
        let expected = [450.0, 550.0, 650.0, 750.0];
        assert!(
            nm.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3),
            "{nm:?}"
        );
        assert!(
            even.sample(0.1)
                .weights
                .iter()
                .all(|w| (w - 100.0).abs() < 1e-3)
        );
    }
}
