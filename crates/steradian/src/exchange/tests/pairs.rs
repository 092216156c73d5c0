//! Pair by pair.

use super::rays::{ADJACENT, OPPOSITE};
use super::*;

#[test]
fn a_cube_is_exact() {
    let cube = scene(vec![("cube", cuboid([0.0; 3], [1.0; 3], true))]);
    let stop = Stopping::at_rel_error(0.01);
    let (rows, summary) = rows(&cube, Grouping::Face, Technique::Pairs, stop);
    assert_eq!(
        (summary.estimates, summary.closed_forms, summary.samples),
        (0, 30, 0)
    );
    for row in &rows {
        assert!((row.sum.value - 1.0).abs() < 1e-12, "{row:?}");
        for entry in &row.entries {
            let expected = if entry.to as usize == row.from ^ 1 {
                OPPOSITE
            } else {
                ADJACENT
            };
            assert!((entry.value - expected).abs() < 1e-12);
        }
    }
}

/// A room with a block in it: every sum of a row is explained by its error.
#[test]
fn an_obstructed_room_is_closed_within_its_errors() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
        ("block", cuboid([0.5, 0.5, 0.2], [1.2, 1.5, 1.1], false)),
    ]);
    let stop = Stopping::at_rel_error(0.01);
    let (rows, summary) = rows(&room, Grouping::Face, Technique::Pairs, stop);
    assert!(summary.estimates > 0 && summary.closed_forms > 0 && summary.missed == 0);
    assert!(
        summary.closure.unwrap().is_explained(12),
        "{:?}",
        summary.closure
    );
    for row in &rows {
        assert!((row.sum.value - 1.0).abs() < 0.01, "{row:?}");
    }
    // A face of the block sees walls only, and nothing stands between: exact.
    assert!(rows[6..].iter().all(|row| row.sum.std_error == 0.0));
}

/// Both techniques, independent of each other, agree entry by entry.
#[test]
fn pairs_and_rays_agree() {
    let room = || {
        scene(vec![
            ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
            ("block", cuboid([0.5, 0.5, 0.2], [1.2, 1.5, 1.1], false)),
            ("ball", sphere([1.5, 2.0, 1.5], 0.1, false)),
        ])
    };
    let (pairs, _) = rows(
        &room(),
        Grouping::Face,
        Technique::Pairs,
        Stopping::at_rel_error(0.01),
    );
    let (rays, _) = rows(
        &room(),
        Grouping::Face,
        Technique::Rays,
        Stopping::at_samples(1 << 16),
    );
    for (one, other) in pairs.iter().zip(&rays) {
        for to in 0..pairs.len() {
            let mut difference = IndependentSum::default();
            difference.add(one.factor_to(to), 1.0);
            difference.add(other.factor_to(to), -1.0);
            // A false alarm in 13² comparisons: below 1e-5.
            assert!(
                difference.total().agrees_with(0.0, 2e-4, 5e-8),
                "{} -> {to}: {difference:?}",
                one.from
            );
        }
    }
}

/// Two squares with a screen that hides the one from the other but for nothing: not 0 ± 0.
#[test]
fn what_is_hidden_is_not_known_without_error() {
    let square = |z: f64, side: f64, up: bool| {
        let [a, b] = [[side, 0.0, 0.0], [0.0, side, 0.0]];
        GeometryDescription::Rectangle {
            origin: [0.5 - 0.5 * side, 0.5 - 0.5 * side, z].into(),
            edges: if up { [a, b] } else { [b, a] }.map(Vector::from),
        }
    };
    let hidden = scene(vec![
        ("floor", square(0.0, 1.0, true)),
        ("ceiling", square(1.0, 1.0, false)),
        ("screen", square(0.5, 1.2, true)),
    ]);
    let (rows, summary) = rows(
        &hidden,
        Grouping::Face,
        Technique::Pairs,
        Stopping::at_rel_error(0.05),
    );
    let found = rows[0].factor_to(1);
    assert_eq!((found.value, summary.unseen), (0.0, 2));
    assert!(found.std_error > 0.0 && found.std_error < 0.01);
    // The screen's front sees the ceiling, its back is no facet.
    assert!(rows[0].factor_to(2).value == 0.0 && rows[2].factor_to(1).std_error == 0.0);
}

#[test]
fn the_sum_over_groups_keeps_reciprocity_and_threads_do_not_matter() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
        ("block", cuboid([0.5, 0.5, 0.2], [1.2, 1.5, 1.1], false)),
        ("ball", sphere([1.5, 2.0, 1.5], 0.1, false)),
    ]);
    let facets = Facets::new(&room, Sides::Front).unwrap();
    let groups = Groups::new(&facets, Grouping::Object);
    let options = MatrixOptions {
        technique: Technique::Pairs,
        rest: true,
        instruction_set: InstructionSet::detect(),
    };
    let found = |threads| {
        let plan = Plan {
            stop: Stopping::at_rel_error(0.02),
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
    let rows = found(1);
    assert_eq!(rows, found(3));
    let exchange = |from: usize, to: usize| groups.areas()[from] * rows[from].factor_to(to).value;
    for (from, to) in [(0, 1), (0, 2), (1, 2)] {
        let difference = exchange(from, to) - exchange(to, from);
        assert!(difference.abs() <= 1e-12 * exchange(from, to));
    }
    for row in &rows {
        assert!(row.sum.agrees_with(1.0, 1e-6, 1e-6), "{row:?}");
    }
    assert_eq!(rows[0].rest.unwrap().sky.value, 0.0);
}

/// Two facets of a room with a block have the same factors, to the bit, whether or not the others take part.
#[test]
fn facets_that_do_not_take_part_still_stand_in_the_way() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
        ("block", cuboid([0.5, 0.5, 0.2], [1.2, 1.5, 1.1], false)),
    ]);
    let samples = Stopping::at_samples(1 << 12);
    let (all, _) = rows(&room, Grouping::Face, Technique::Rays, samples);
    let two = Facets::new(&room, Sides::Front).unwrap();
    let two = two.only(|index| index < 2).unwrap();
    assert_eq!(
        (two.name(0), two.name(1)),
        ("room/0".to_owned(), "room/1".to_owned())
    );
    let (found, _) = rows_of(
        &two,
        Grouping::Face,
        Technique::Rays,
        Stopping::at_samples(1 << 12),
    );
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].entries, [all[0].entries[0]]);
    assert!(two.only(|_| false).is_err());
}
