//! Grids of points: where, and how many by the rule of EN 12464-1.
//!
//! The number of points along each side is the least with which they are no further apart than
//! [`p`](Layout::greatest_spacing), their distance being that of the centres of equal cells. (Where the standard rounds
//! side/p to the nearest number, this may be one more.) A strip of [`border`](Receivers::Grid) is left out at each side
//! beforehand: 0.5 m at walls, says the standard.

use super::Fault;
use super::description::{GridCount, Receivers};
use crate::geometry::{Point, Vector};
use crate::sensor::{Layout, greatest_spacing};

/// Sides that are a whole number of spacings but for rounding have that number.
const ROUNDING: f64 = 1e-9;

/// How the points of a grid lie side by side; none for other receivers.
pub(super) fn layout_of(receivers: &Receivers) -> Result<Option<Layout>, Fault> {
    let Receivers::Grid {
        origin,
        edges,
        count,
        border,
        ..
    } = receivers
    else {
        return Ok(None);
    };
    let (origin, edges) = within(*origin, *edges, *border)?;
    let lengths = edges.map(Vector::length);
    let count = match count {
        GridCount::Given(count) => *count,
        GridCount::En12464 => lengths.map(|length| cells(length, greatest_spacing(lengths))),
    };
    Ok(Some(Layout {
        origin: origin.to_array(),
        edges: edges.map(Vector::to_array),
        count,
    }))
}

/// What a strip along each side leaves.
fn within(origin: Point, edges: [Vector; 2], border: f64) -> Result<(Point, [Vector; 2]), Fault> {
    if border == 0.0 {
        return Ok((origin, edges));
    }
    let shortest = edges
        .map(Vector::length)
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    if !(border > 0.0 && 2.0 * border < shortest) {
        let message = format!("a border of {border} m leaves nothing of a side of {shortest} m");
        return Err(("border", message));
    }
    let unit = edges.map(|edge| edge * (1.0 / edge.length()));
    let corner = origin + unit[0] * border + unit[1] * border;
    let shortened = [0, 1].map(|i: usize| edges[i] - unit[i] * (2.0 * border));
    Ok((corner, shortened))
}

fn cells(length: f64, spacing: f64) -> u32 {
    // A side that is not finite has no points, which is refused as such.
    (length / spacing - ROUNDING).ceil().max(1.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn grid(width: f64, depth: f64, border: f64) -> Result<Layout, Fault> {
        let receivers = Receivers::Grid {
            origin: Point::new(1.0, 2.0, 0.8),
            edges: [Vector::new(width, 0.0, 0.0), Vector::new(0.0, depth, 0.0)],
            count: GridCount::En12464,
            border,
            normal: None,
        };
        layout_of(&receivers).map(Option::unwrap)
    }

    /// The classroom of 9 m x 7 m with a strip of .5 m: 8 m x 6 m, p = .2 · 5^.90309 = .8555; 10 and 8 cells of .8 m and .75 m.
    #[test]
    fn a_border_is_left_out() {
        let layout = grid(9.0, 7.0, 0.5).unwrap();
        assert_eq!((layout.origin, layout.count), ([1.5, 2.5, 0.8], [10, 8]));
        assert_eq!(layout.edges, [[8.0, 0.0, 0.0], [0.0, 6.0, 0.0]]);
        assert!((layout.greatest_spacing() - 0.8555).abs() < 1e-4);
        assert_eq!(layout.centre(0), [1.9, 2.875, 0.8]);
    }

    #[test]
    fn a_border_that_leaves_nothing_is_refused() {
        for border in [-0.1, 3.5, f64::NAN] {
            assert_eq!(grid(9.0, 7.0, border).unwrap_err().0, "border");
        }
    }

    proptest! {
        #[test]
        fn points_are_no_further_apart_than_they_may_be(width in 0.1..200.0_f64, depth in 0.1..200.0_f64) {
            let layout = grid(width, depth, 0.0).unwrap();
            let most = layout.greatest_spacing();
            let spacing = layout.spacing();
            prop_assert!(spacing.iter().all(|spacing| *spacing <= most * (1.0 + 1e-8)));
            // One cell fewer would be too few, but where there is one.
            for (count, length) in layout.count.into_iter().zip([width, depth]) {
                prop_assert!(count == 1 || length / f64::from(count - 1) > most);
            }
        }
    }
}
