//! The map of Shirley and Chiu between the unit disc and the unit square: concentric squares become circles, and areas keep
//! their ratio (π to 1). Source: P. Shirley, K. Chiu, Journal of Graphics Tools 2 (1997) 45.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::basis::DiscPoint;

/// The point of the square, in 0 … 1.
pub(super) fn to_square([x, y]: DiscPoint) -> [f64; 2] {
    polar_to_square((x * x + y * y).sqrt(), libm::atan2(y, x))
}

/// The point of the square for a point of the disc by its radius and azimuth, −2π … 2π.
pub(super) fn polar_to_square(radius: f64, azimuth: f64) -> [f64; 2] {
    let (sector, within) = sector(azimuth);
    let [a, b] = on_ring(sector, radius, within / FRAC_PI_4 * radius);
    [0.5 * (a + 1.0), 0.5 * (b + 1.0)]
}

/// The point of the disc.
pub(super) fn to_disc([s, t]: [f64; 2]) -> DiscPoint {
    let (a, b) = (2.0 * s - 1.0, 2.0 * t - 1.0);
    let wide = a.abs() > b.abs();
    let (radius, across) = if wide { (a, b) } else { (b, a) };
    if radius == 0.0 {
        return [0.0, 0.0];
    }
    let angle = FRAC_PI_4 * across / radius;
    let azimuth = if wide { angle } else { FRAC_PI_2 - angle };
    [radius * libm::cos(azimuth), radius * libm::sin(azimuth)]
}

/// One of the quarters around azimuths 0, π/2, π, −π/2, and the angle from its middle, −π/4 … π/4.
fn sector(azimuth: f64) -> (usize, f64) {
    let quarter = (azimuth / FRAC_PI_2).round();
    let within = azimuth - quarter * FRAC_PI_2;
    ((quarter + 4.0) as usize % 4, within)
}

/// The point of the square's ring of this radius, `along` counted counterclockwise from the middle of a side.
fn on_ring(sector: usize, radius: f64, along: f64) -> [f64; 2] {
    match sector {
        0 => [radius, along],
        1 => [-along, radius],
        2 => [-radius, -along],
        _ => [along, -radius],
    }
}

/// The azimuths at which the circle of this radius passes a box of the square −1 … 1, as intervals: one a side at most.
pub(super) fn azimuths_within(
    low: [f64; 2],
    high: [f64; 2],
    radius: f64,
) -> impl Iterator<Item = [f64; 2]> {
    let one = move |sector: usize| {
        let across = sector % 2;
        let [near, far] = match sector < 2 {
            true => [low[across], high[across]],
            false => [-high[across], -low[across]],
        };
        if !(near <= radius && radius < far) {
            return None;
        }
        // As in `on_ring`: along the first and the last side the other coordinate grows.
        let turn = if across == sector / 2 { 1.0 } else { -1.0 };
        let ends = [low[1 - across] * turn, high[1 - across] * turn];
        let from = ends[0].min(ends[1]).max(-radius) / radius;
        let to = ends[0].max(ends[1]).min(radius) / radius;
        let middle = sector as f64 * FRAC_PI_2;
        (from < to).then_some([middle + FRAC_PI_4 * from, middle + FRAC_PI_4 * to])
    };
    (0..4).filter_map(one)
}

/// Area of the disc over that of the square.
pub(super) const AREA: f64 = PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::testing::independent;

    #[test]
    fn the_map_and_its_inverse_undo_each_other() {
        for point in independent(1, 1000) {
            let back = to_square(to_disc(point));
            assert!(
                (0..2).all(|k| (back[k] - point[k]).abs() < 1e-14),
                "{point:?}"
            );
        }
        assert_eq!(to_square([1.0, 0.0]), [1.0, 0.5]);
        assert_eq!(to_square([0.0, -1.0]), [0.5, 0.0]);
        assert_eq!(to_disc([0.5, 0.5]), [0.0, 0.0]);
    }

    /// A ring is cut by all boxes of a grid into intervals that fill the circle, each in its box.
    #[test]
    fn the_boxes_of_a_grid_share_the_circle() {
        for radius in [0.01, 0.3, 0.77, 0.999] {
            let mut covered = 0.0;
            for cell in 0..64 {
                let low = [cell % 8, cell / 8].map(|k| f64::from(k) / 4.0 - 1.0);
                let high = low.map(|x| x + 0.25);
                for [from, to] in azimuths_within(low, high, radius) {
                    covered += to - from;
                    let middle = 0.5 * (from + to);
                    let point = [radius * libm::cos(middle), radius * libm::sin(middle)];
                    let square = to_square(point).map(|s| 2.0 * s - 1.0);
                    assert!((0..2).all(|k| low[k] <= square[k] && square[k] < high[k]));
                }
            }
            assert!((covered - 2.0 * PI).abs() < 1e-13, "{radius}: {covered}");
        }
    }
}
