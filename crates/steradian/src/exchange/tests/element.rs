//! Factors of surface elements.

use super::*;
use crate::geometry::{Direction, Point, configuration_factor};

fn row_of(scene: &Scene, element: Element, stop: Stopping) -> Row {
    let facets = Facets::new(scene, Sides::Front).unwrap();
    let groups = Groups::new(&facets, Grouping::Object);
    let plan = Plan {
        stop,
        ..Plan::default()
    };
    factors_of_element(&facets, &groups, element, &plan).unwrap()
}

const FLOOR: Element = Element {
    position: Point::new(1.0, 1.5, 0.0),
    normal: Direction::Z,
};

/// A ball over the element is estimated, as it is curved; the walls it hides in part too, and all add up to 1.
#[test]
fn a_ball_in_a_room_hides_what_is_behind_it() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
        ("ball", sphere([1.0, 1.5, 1.0], 0.4, false)),
    ]);
    let row = row_of(&room, FLOOR, Stopping::at_rel_error(0.01));
    assert_factor(&row, 1, 0.16);
    assert_factor(&row, 0, 0.84);
    assert!(row.converged && row.factor_to(1).std_error > 0.0);
    assert!(row.sum.agrees_with(1.0, 1e-9, 1e-6), "{:?}", row.sum);
}

/// What stands beside the way does not make a factor uncertain, what lies below the horizon has none.
#[test]
fn a_plate_in_full_view_is_exact_and_the_open_rest_is_sky() {
    let plate = |height: f64| cuboid([0.5, 1.0, height], [1.5, 2.0, height + 0.1], false);
    let open = scene(vec![("plate", plate(1.0)), ("sunken", plate(-1.0))]);
    let row = row_of(&open, FLOOR, Stopping::at_samples(1 << 14));
    let corners =
        [(0.5, 1.0), (1.5, 1.0), (1.5, 2.0), (0.5, 2.0)].map(|(x, y)| Point::new(x, y, 1.0));
    let expected = configuration_factor::of_polygon(FLOOR.position, FLOOR.normal, &corners);
    assert_eq!(row.entries.len(), 1);
    assert_eq!(row.entries[0].std_error, 0.0);
    assert!((row.factor_to(0).value - expected).abs() < 1e-15);
    let sky = row.rest.as_ref().unwrap().sky;
    assert!(sky.agrees_with(1.0 - expected, 1e-9, 1e-6), "{sky:?}");
}

#[test]
fn the_seed_decides_and_shards_are_refused() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0; 3], true)),
        ("ball", sphere([1.0; 3], 0.3, false)),
    ]);
    let run = || row_of(&room, FLOOR, Stopping::at_samples(1 << 12));
    assert_eq!(run(), run());
    let facets = Facets::new(&room, Sides::Front).unwrap();
    let groups = Groups::new(&facets, Grouping::Face);
    let plan = Plan {
        stop: Stopping {
            time: Some(std::time::Duration::from_secs(1)),
            ..Stopping::at_rel_error(0.1)
        },
        ..Plan::default()
    };
    assert!(factors_of_element(&facets, &groups, FLOOR, &plan).is_err());
}
