//! Densities on the unit square that are bilinear between grid points, and their maps from uniform numbers.
//!
//! Rows are chosen by their integral, then places within the row; both are quadratic equations, solved in closed form, and so are
//! the inverses. Slices of a table are mixed: densities and cumulative sums are linear in the weights, so a mixture of slices is
//! sampled as exactly as a slice. Source: J. Dupuy, W. Jakob, *An adaptive parameterization for efficient material acquisition and
//! rendering* (SIGGRAPH Asia 2018), §4.2.

use super::MeasuredError;

/// Slices of a table with their weights, which add up to 1.
pub(super) type Mixture = [(usize, f64); 4];

/// Functions on the unit square by their values at the points of a grid, slice after slice.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheets {
    size: [usize; 2],
    values: Vec<f32>,
}

impl Sheets {
    /// From the number of points along x and y and the values, x fastest.
    ///
    /// # Errors
    /// If a grid has less than two points along an axis, the last slice is not complete, or a value is negative or not finite.
    pub fn new(size: [usize; 2], values: Vec<f32>) -> Result<Self, MeasuredError> {
        let points = size[0].saturating_mul(size[1]);
        if size.contains(&0) || size.contains(&1) || values.is_empty() {
            return Err(MeasuredError::Empty);
        }
        if !values.len().is_multiple_of(points) {
            let (needed, found) = (values.len().next_multiple_of(points), values.len());
            return Err(MeasuredError::Count { needed, found });
        }
        super::check_values(&values)?;
        Ok(Self { size, values })
    }

    /// How many there are.
    pub fn slices(&self) -> usize {
        self.values.len() / self.points()
    }

    fn points(&self) -> usize {
        self.size[0] * self.size[1]
    }

    fn slice(&self, slice: usize) -> &[f32] {
        &self.values[slice * self.points()..(slice + 1) * self.points()]
    }

    fn mixed(&self, mixture: &Mixture, point: usize) -> f64 {
        let term = |&(slice, weight): &(usize, f64)| {
            weight * f64::from(self.values[slice * self.points() + point])
        };
        mixture.iter().map(term).sum()
    }

    /// The value at a place of the square.
    pub(super) fn at(&self, mixture: &Mixture, place: [f64; 2]) -> f64 {
        let [(x, s), (y, t)] = [0, 1].map(|axis| cell(place[axis], self.size[axis]));
        let along = |y: usize| {
            let first = y * self.size[0] + x;
            lerp(
                self.mixed(mixture, first),
                self.mixed(mixture, first + 1),
                s,
            )
        };
        lerp(along(y), along(y + 1), t)
    }
}

/// Densities on the unit square with their cumulative sums.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Warp {
    /// Densities.
    sheets: Sheets,
    /// Integral of each row from its start to each point.
    along: Vec<f64>,
    /// Integral from the first row to each row.
    across: Vec<f64>,
}

impl Warp {
    /// Scales every slice to an integral of 1; one of zeros becomes uniform.
    pub fn new(mut sheets: Sheets) -> Self {
        let (mut along, mut across) = (vec![], vec![]);
        for slice in 0..sheets.slices() {
            let (_, total) = integrals(sheets.slice(slice), sheets.size);
            let points = sheets.points();
            let values = &mut sheets.values[slice * points..(slice + 1) * points];
            if total > 0.0 {
                values
                    .iter_mut()
                    .for_each(|value| *value = (f64::from(*value) / total) as f32);
            } else {
                values.fill(1.0);
            }
            let (rows, total) = integrals(values, sheets.size);
            let height = sheets.size[1];
            let row_total = |y: usize| rows[(y + 1) * sheets.size[0] - 1];
            let mut sum = 0.0;
            across.push(0.0);
            for y in 1..height {
                sum += 0.5 * (row_total(y - 1) + row_total(y)) / (height - 1) as f64;
                across.push(sum / total);
            }
            along.extend(rows);
        }
        Self {
            sheets,
            along,
            across,
        }
    }

    /// The density at a place.
    pub fn density(&self, mixture: &Mixture, place: [f64; 2]) -> f64 {
        self.sheets.at(mixture, place)
    }

    /// The place of a pair of uniform numbers.
    pub fn sample(&self, mixture: &Mixture, u: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.sheets.size;
        let y = search(height, u[1], |y| self.rows_before(mixture, y));
        let [r0, r1] = [y, y + 1].map(|y| self.row_total(mixture, y));
        let t = solve(
            r0,
            r1,
            (u[1] - self.rows_before(mixture, y)) * (height - 1) as f64,
        );
        let wanted = u[0] * lerp(r0, r1, t);
        let before = |x: usize| self.row_before(mixture, x, y, t);
        let x = search(width, wanted, before);
        let [c0, c1] = [x, x + 1].map(|x| self.between_rows(mixture, x, y, t));
        let s = solve(c0, c1, (wanted - before(x)) * (width - 1) as f64);
        [
            (x as f64 + s) / (width - 1) as f64,
            (y as f64 + t) / (height - 1) as f64,
        ]
    }

    /// The uniform numbers of a place.
    pub fn invert(&self, mixture: &Mixture, place: [f64; 2]) -> [f64; 2] {
        let [width, height] = self.sheets.size;
        let [(x, s), (y, t)] = [(place[0], width), (place[1], height)].map(|(at, n)| cell(at, n));
        let [r0, r1] = [y, y + 1].map(|y| self.row_total(mixture, y));
        let v = self.rows_before(mixture, y) + area(r0, r1, t) / (height - 1) as f64;
        let row = lerp(r0, r1, t);
        let [c0, c1] = [x, x + 1].map(|x| self.between_rows(mixture, x, y, t));
        let part = self.row_before(mixture, x, y, t) + area(c0, c1, s) / (width - 1) as f64;
        let u = if row > 0.0 { part / row } else { 0.0 };
        [u.clamp(0.0, 1.0), v.clamp(0.0, 1.0)]
    }

    fn between_rows(&self, mixture: &Mixture, x: usize, y: usize, t: f64) -> f64 {
        let width = self.sheets.size[0];
        let [low, high] = [y, y + 1].map(|y| self.sheets.mixed(mixture, y * width + x));
        lerp(low, high, t)
    }

    fn row_before(&self, mixture: &Mixture, x: usize, y: usize, t: f64) -> f64 {
        let [low, high] = [y, y + 1].map(|y| self.row_sum(mixture, x, y));
        lerp(low, high, t)
    }

    fn row_sum(&self, mixture: &Mixture, x: usize, y: usize) -> f64 {
        let [width, height] = self.sheets.size;
        let at = |slice: usize| self.along[(slice * height + y) * width + x];
        mixture
            .iter()
            .map(|&(slice, weight)| weight * at(slice))
            .sum()
    }

    fn row_total(&self, mixture: &Mixture, y: usize) -> f64 {
        self.row_sum(mixture, self.sheets.size[0] - 1, y)
    }

    fn rows_before(&self, mixture: &Mixture, y: usize) -> f64 {
        let at = |slice: usize| self.across[slice * self.sheets.size[1] + y];
        mixture
            .iter()
            .map(|&(slice, weight)| weight * at(slice))
            .sum()
    }
}

/// Integrals of every row up to each of its points, and of the whole.
fn integrals(values: &[f32], [width, height]: [usize; 2]) -> (Vec<f64>, f64) {
    let mut sums = Vec::with_capacity(values.len());
    let mut total = 0.0;
    for (y, row) in values.chunks(width).enumerate() {
        let mut sum = 0.0;
        sums.push(0.0);
        for pair in row.windows(2) {
            sum += 0.5 * (f64::from(pair[0]) + f64::from(pair[1])) / (width - 1) as f64;
            sums.push(sum);
        }
        let share = if y == 0 || y + 1 == height { 0.5 } else { 1.0 };
        total += share * sum / (height - 1) as f64;
    }
    (sums, total)
}

/// The last cell that begins at or before `wanted`.
fn search(points: usize, wanted: f64, before: impl Fn(usize) -> f64) -> usize {
    let (mut low, mut high) = (0, points - 1);
    while high - low > 1 {
        let middle = (low + high) / 2;
        match before(middle) <= wanted {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

/// The cell of a place, and the part of it that is passed.
fn cell(place: f64, points: usize) -> (usize, f64) {
    let scaled = place.clamp(0.0, 1.0) * (points - 1) as f64;
    let cell = (scaled as usize).min(points - 2);
    (cell, scaled - cell as f64)
}

/// ∫₀ᵗ (a + (b − a) s) ds.
fn area(a: f64, b: f64, t: f64) -> f64 {
    t * (a + 0.5 * (b - a) * t)
}

/// The t of 0 … 1 with `area(a, b, t) = area`.
fn solve(a: f64, b: f64, area: f64) -> f64 {
    let area = area.max(0.0);
    let root = (a * a + 2.0 * (b - a) * area).max(0.0).sqrt();
    match a + root > 0.0 {
        true => (2.0 * area / (a + root)).min(1.0),
        false => 0.0,
    }
}

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + t * (b - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::testing::independent;

    const SIZE: [usize; 2] = [5, 4];

    fn sheets() -> Sheets {
        let value = |k: usize| (k * k * 7 % 23) as f32 * if k < 20 { 1.0 } else { 0.1 };
        Sheets::new(SIZE, (0..60).map(value).collect()).unwrap()
    }

    const MIXTURE: Mixture = [(0, 0.5), (1, 0.3), (2, 0.2), (0, 0.0)];

    #[test]
    fn a_map_and_its_inverse_undo_each_other() {
        let warp = Warp::new(sheets());
        for u in independent(1, 1000) {
            let place = warp.sample(&MIXTURE, u);
            let back = warp.invert(&MIXTURE, place);
            assert!(
                (0..2).all(|k| (back[k] - u[k]).abs() < 1e-6),
                "{u:?} {place:?} {back:?}"
            );
        }
    }

    /// The determinant of the inverse map, by central differences away from the grid's lines, is the density.
    #[test]
    fn the_density_is_that_of_the_map() {
        let warp = Warp::new(sheets());
        let h = 1e-5;
        for place in [[0.1, 0.1], [0.33, 0.52], [0.8, 0.9], [0.61, 0.2]] {
            let moved = |axis: usize, by: f64| {
                let mut moved = place;
                moved[axis] += by;
                warp.invert(&MIXTURE, moved)
            };
            let slope =
                |axis: usize, k: usize| (moved(axis, h)[k] - moved(axis, -h)[k]) / (2.0 * h);
            let determinant = slope(0, 0) * slope(1, 1) - slope(0, 1) * slope(1, 0);
            let density = warp.density(&MIXTURE, place);
            assert!(
                (determinant / density - 1.0).abs() < 1e-4,
                "{determinant} {density}"
            );
        }
    }

    /// Four values 0 0 1 1 over the square: density 2y, so that v = y².
    #[test]
    fn a_ramp_has_its_closed_form() {
        let ramp = Sheets::new([2, 2], vec![0.0, 0.0, 1.0, 1.0]).unwrap();
        let (warp, only) = (Warp::new(ramp), [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
        let place = warp.sample(&only, [0.3, 0.25]);
        assert!((place[0] - 0.3).abs() < 1e-12 && (place[1] - 0.5).abs() < 1e-12);
        assert!((warp.density(&only, place) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn grids_without_cells_are_refused() {
        assert_eq!(Sheets::new([1, 4], vec![0.0; 4]), Err(MeasuredError::Empty));
        let (needed, found) = (8, 5);
        assert_eq!(
            Sheets::new([2, 2], vec![0.0; 5]),
            Err(MeasuredError::Count { needed, found })
        );
        assert!(Sheets::new([2, 2], vec![-1.0; 4]).is_err());
        let black = Warp::new(Sheets::new([2, 2], vec![0.0; 4]).unwrap());
        assert_eq!(
            black.density(&[(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)], [0.5; 2]),
            1.0
        );
    }
}
