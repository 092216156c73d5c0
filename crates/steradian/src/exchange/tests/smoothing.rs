//! Reciprocity and closure imposed.

use super::*;
use crate::exchange::smoothing::smooth;

fn estimated(to: u32, value: f64, std_error: f64) -> Entry {
    Entry::estimated(
        to,
        Uncertain {
            value,
            std_error,
            degrees: 15.0,
        },
    )
}

fn row(from: usize, entries: Vec<Entry>) -> Row {
    let mut sum = IndependentSum::default();
    entries
        .iter()
        .for_each(|entry| sum.add(entry.factor(), 1.0));
    Row {
        from,
        entries,
        sum: sum.total(),
        rest: None,
        samples: 16,
        converged: true,
    }
}

/// Three surfaces of 1 m², the pair 0–1 four times as uncertain in variance. The sums of rows 0 and 1 lack .03, that of row 2 nothing:
/// λ₀ = λ₁ by symmetry, and 4(2λ₀) + (λ₀ + λ₂) = .03, 2(λ₀ + λ₂) = 0, so λ₀ = .03/8 and all goes to 0–1.
#[test]
fn three_surfaces_by_hand() {
    let mut rows = vec![
        row(0, vec![estimated(1, 0.47, 2.0), estimated(2, 0.5, 1.0)]),
        row(1, vec![estimated(0, 0.47, 2.0), estimated(2, 0.5, 1.0)]),
        row(2, vec![estimated(0, 0.5, 1.0), estimated(1, 0.5, 1.0)]),
    ];
    let report = smooth(&mut rows, &[1.0; 3]);
    assert!((rows[0].entries[0].value - 0.5).abs() < 1e-12);
    assert!((rows[2].entries[0].value - 0.5).abs() < 1e-12);
    assert_eq!((report.factors, report.zeroed), (3, 0));
    assert!((report.greatest_deviation - 0.015).abs() < 1e-12 && report.residual < 1e-12);
}

/// Nothing becomes negative, and what is exact stays.
#[test]
fn a_factor_that_would_be_negative_is_zero() {
    let mut rows = vec![
        row(0, vec![Entry::exact(1, 0.9), estimated(2, 0.2, 0.01)]),
        row(
            1,
            vec![
                Entry::exact(0, 0.9),
                estimated(1, 0.001, 0.1),
                estimated(2, 0.2, 0.01),
            ],
        ),
        row(
            2,
            vec![
                estimated(0, 0.2, 0.01),
                estimated(1, 0.2, 0.01),
                estimated(2, 0.7, 0.1),
            ],
        ),
    ];
    let report = smooth(&mut rows, &[1.0; 3]);
    assert_eq!(
        (rows[0].entries[0].value, rows[1].entries[0].value),
        (0.9, 0.9)
    );
    assert!((rows[0].entries[1].value - 0.1).abs() < 1e-10);
    assert!(
        rows.iter()
            .flat_map(|row| &row.entries)
            .all(|entry| entry.value >= 0.0)
    );
    assert!(report.residual < 1e-10 && report.zeroed <= 1, "{report:?}");
}

/// The room with a block: closed and reciprocal afterwards, and changed by no more than the errors explain.
#[test]
fn an_obstructed_room() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
        ("block", cuboid([0.5, 0.5, 0.2], [1.2, 1.5, 1.1], false)),
    ]);
    let facets = Facets::new(&room, Sides::Front).unwrap();
    let areas: Vec<f64> = facets.list().iter().map(|facet| facet.area).collect();
    for technique in [Technique::Pairs, Technique::Rays] {
        let (mut rows, _) = rows(
            &room,
            Grouping::Face,
            technique,
            Stopping::at_samples(1 << 14),
        );
        let report = smooth(&mut rows, &areas);
        assert!(report.residual < 1e-10, "{report:?}");
        assert!(
            report.rms_deviation < 1.5 && report.greatest_deviation < 6.0,
            "{report:?}"
        );
        for row in &rows {
            for entry in &row.entries {
                let back = rows[entry.to as usize].factor_to(row.from).value;
                let difference = entry.value * areas[row.from] - back * areas[entry.to as usize];
                assert!(difference.abs() < 1e-12);
            }
        }
    }
}
