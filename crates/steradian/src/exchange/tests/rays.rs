//! Rows by rays.

use super::*;
use crate::quantity::Angle;
use crate::scene::description::Port;

/// Faces of the unit cube: opposite .19982490, adjacent .20004378.
pub(super) const OPPOSITE: f64 = 0.199_824_895_698_387_2;
pub(super) const ADJACENT: f64 = 0.200_043_776_075_403_2;

#[test]
fn a_cube_is_closed_and_has_the_known_factors() {
    let cube = scene(vec![("cube", cuboid([0.0; 3], [1.0; 3], true))]);
    let stop = Stopping::at_samples(1 << 16);
    let (rows, summary) = rows(&cube, Grouping::Face, Technique::Rays, stop);
    assert_eq!((rows.len(), summary.complete, summary.missed), (6, true, 0));
    for row in &rows {
        assert_eq!((row.sum.value, row.sum.std_error), (1.0, 0.0));
        assert_factor(row, row.from ^ 1, OPPOSITE);
        for to in (0..6).filter(|to| to / 2 != row.from / 2) {
            assert_factor(row, to, ADJACENT);
        }
        assert_eq!(row.factor_to(row.from).value, 0.0);
    }
    assert!(summary.reciprocity.unwrap().is_explained(15));
}

#[test]
fn concentric_spheres() {
    let spheres = scene(vec![
        ("inner", sphere([0.0; 3], 1.0, false)),
        ("outer", sphere([0.0; 3], 2.0, true)),
    ]);
    let (rows, summary) = rows(
        &spheres,
        Grouping::Face,
        Technique::Rays,
        Stopping::at_rel_error(0.01),
    );
    assert_eq!(summary.missed, 0);
    assert_eq!(rows[0].factor_to(1).value, 1.0);
    assert_factor(&rows[1], 0, 0.25);
    assert_factor(&rows[1], 1, 0.75);
    assert_eq!(rows[1].sum.value, 1.0);
}

/// A sphere with a port of half angle 60° has F to itself of its share of the whole sphere, 3/4.
#[test]
fn a_sphere_with_a_port_sees_the_sky_through_it() {
    let port = Port {
        direction: Vector::new(0.0, 0.0, 1.0),
        half_angle: Angle::from_degrees(60.0),
    };
    let GeometryDescription::Sphere {
        center,
        radius,
        inside,
        ..
    } = sphere([0.0; 3], 1.0, true)
    else {
        unreachable!()
    };
    let open = GeometryDescription::Sphere {
        center,
        radius,
        inside,
        ports: vec![port],
    };
    let (rows, _) = rows(
        &scene(vec![("bowl", open)]),
        Grouping::Face,
        Technique::Rays,
        Stopping::at_samples(1 << 16),
    );
    assert_factor(&rows[0], 0, 0.75);
    let rest = rows[0].rest.unwrap();
    assert!(rest.sky.agrees_with(0.25, 1e-9, 1e-6), "{rest:?}");
    assert_eq!((rest.below.value, rest.other.value), (0.0, 0.0));
}

#[test]
fn groups_add_up_and_threads_do_not_matter() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 2.0, 2.0], true)),
        ("block", cuboid([0.5, 0.5, 0.1], [1.5, 1.5, 1.1], false)),
    ]);
    let stop = Stopping::at_samples(1 << 14);
    let (objects, _) = rows(&room, Grouping::Object, Technique::Rays, stop);
    assert_eq!(objects.len(), 2);
    assert!((objects[1].sum.value - 1.0).abs() < 1e-12 && objects[1].sum.std_error < 1e-12);
    let difference = 24.0 * objects[0].factor_to(1).value / (6.0 * objects[1].factor_to(0).value);
    assert!((difference - 1.0).abs() < 0.02, "{difference}");
    let facets = Facets::new(&room, Sides::Front).unwrap();
    let groups = Groups::new(&facets, Grouping::Face);
    let options = MatrixOptions {
        technique: Technique::Rays,
        rest: false,
        instruction_set: InstructionSet::Scalar,
    };
    let bits = |threads| {
        let plan = Plan {
            stop,
            threads,
            ..Plan::default()
        };
        let mut rows = Vec::new();
        matrix(&facets, &groups, &options, &plan, &mut Silent, &mut |row| {
            rows.push(row)
        })
        .unwrap();
        rows
    };
    assert_eq!(bits(1), bits(3));
}

#[test]
fn plans_that_a_matrix_cannot_follow() {
    let cube = scene(vec![("cube", cuboid([0.0; 3], [1.0; 3], true))]);
    let facets = Facets::new(&cube, Sides::Front).unwrap();
    let groups = Groups::new(&facets, Grouping::Face);
    let options = MatrixOptions {
        technique: Technique::Rays,
        rest: false,
        instruction_set: InstructionSet::detect(),
    };
    let plan = Plan {
        shard: Some((1, 2)),
        ..Plan::default()
    };
    let found = matrix(&facets, &groups, &options, &plan, &mut Silent, &mut |_| {});
    assert!(matches!(found, Err(ExchangeError::Plan(_))));
}
