use super::*;
use crate::estimation::Method;
use crate::measurement::synthetic::Synthetic;

/// Lamp, window and night light at four points, in lx.
const TRUTH: [[f64; 3]; 4] = [
    [100.0, 400.0, 10.0],
    [200.0, 300.0, 10.0],
    [400.0, 100.0, 10.0],
    [300.0, 200.0, 10.0],
];
const GROUPS: [&str; 3] = ["lamp", "window", "night"];

fn target(of: TargetOf, relation: Relation, value: f64) -> Target {
    Target {
        sensor: "desk".into(),
        quantity: 0,
        of,
        relation,
        value,
    }
}

fn equal(of: TargetOf, value: f64) -> Target {
    target(of, Relation::Equal, value)
}

fn vary(group: &str) -> Vary {
    Vary {
        group: group.into(),
        bounds: [0.0, 1.0],
    }
}

fn closed() -> Measurements {
    Synthetic::new(&GROUPS, &TRUTH).closed()
}

fn values(solution: &Solution) -> Vec<f64> {
    let factors = solution.factors.iter();
    factors.map(|factor| factor.factor.value).collect()
}

fn assert_solved(targets: &[Target], groups: &[&str], expected: &[f64]) {
    let groups: Vec<Vary> = groups.iter().map(|group| vary(group)).collect();
    let solution = closed().solve(targets, &groups).unwrap();
    for (found, expected) in values(&solution).iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{targets:?}: {found}");
    }
    assert!(
        solution.targets.iter().all(|target| target.met),
        "{solution:?}"
    );
    let exact = |estimate: &Estimate| estimate.method == Method::ClosedForm;
    assert!(solution.factors.iter().all(|factor| exact(&factor.factor)));
}

/// Means are 250, 250 and 10 lx.
#[test]
fn one_target_is_one_equation() {
    assert_solved(&[equal(TargetOf::Mean, 385.0)], &["lamp"], &[0.5]);
    assert_solved(&[equal(TargetOf::Point(2), 350.0)], &["lamp"], &[0.6]);
}

#[test]
fn two_targets_are_two_equations() {
    // 400 x + 100 y = 140 and 100 x + 400 y = 260.
    let targets = [
        equal(TargetOf::Point(2), 150.0),
        equal(TargetOf::Point(0), 270.0),
    ];
    assert_solved(&targets, &["lamp", "window"], &[0.2, 0.6]);
}

/// With lamp x and all of the window: 410 + 100 x, 310 + 200 x, 110 + 400 x, 210 + 300 x; the least is the third up to x = 1.
#[test]
fn extremes_are_those_of_the_point_that_is_one() {
    assert_solved(&[equal(TargetOf::Min, 310.0)], &["lamp"], &[0.5]);
    assert_solved(&[equal(TargetOf::Max, 460.0)], &["lamp"], &[0.5]);
    // With the window y and all of the lamp the least is 110 + 400 y until 210 + 300 y … 410 + 100 y meet it at y = 1.
    assert_solved(&[equal(TargetOf::Min, 270.0)], &["window"], &[0.4]);
}

#[test]
fn an_inequality_counts_where_it_would_be_broken() {
    let mean = equal(TargetOf::Mean, 385.0);
    let floor = |value| target(TargetOf::Min, Relation::AtLeast, value);
    // Mean 385 needs x = .5, where the least is 310: a lower floor has no say.
    assert_solved(&[mean, floor(300.0)], &["lamp"], &[0.5]);
    assert_solved(&[floor(350.0)], &["lamp"], &[0.6]);
    let ceiling = target(TargetOf::Max, Relation::AtMost, 10.0 + 400.0);
    assert_eq!(
        closed().solve(&[ceiling], &[vary("lamp"), vary("window")]),
        Err(SolveError::Undetermined { factors: 2 })
    );
}

#[test]
fn what_cannot_be_met_is_told_with_the_bound() {
    let solution = closed()
        .solve(&[equal(TargetOf::Mean, 900.0)], &[vary("lamp")])
        .unwrap();
    let [found] = &solution.factors[..] else {
        unreachable!()
    };
    assert_eq!((found.factor.value, found.held_at), (1.0, Some(1.0)));
    assert!(!solution.targets[0].met);
    assert!((solution.targets[0].reading.value - 510.0).abs() < 1e-9);
    let twice = Vary {
        bounds: [0.0, 3.0],
        ..vary("lamp")
    };
    let solution = closed()
        .solve(&[equal(TargetOf::Mean, 900.0)], &[twice])
        .unwrap();
    assert!((solution.factors[0].factor.value - 2.56).abs() < 1e-12);
}

#[test]
fn questions_without_an_answer_are_refused() {
    let run = closed();
    let mean = || equal(TargetOf::Mean, 385.0);
    let two = [vary("lamp"), vary("window")];
    assert_eq!(
        run.solve(&[mean()], &two),
        Err(SolveError::Undetermined { factors: 2 })
    );
    assert_eq!(
        run.solve(&[mean()], &[vary("sun")]),
        Err(SolveError::UnknownGroup("sun".into()))
    );
    let elsewhere = Target {
        sensor: "floor".into(),
        ..mean()
    };
    assert_eq!(
        run.solve(&[elsewhere], &two),
        Err(SolveError::UnknownSensor("floor".into()))
    );
    let missing = run
        .solve(&[equal(TargetOf::Point(4), 1.0)], &two)
        .unwrap_err();
    assert_eq!(
        missing.to_string(),
        "sensor `desk` has no such point; the last one is 3"
    );
    let dark = Synthetic::new(&["a", "b"], &[[1.0, 0.0]]).closed();
    let target = equal(TargetOf::Mean, 2.0);
    assert_eq!(
        dark.solve(&[target], &[vary("b")]),
        Err(SolveError::NoInfluence("b".into()))
    );
}

#[test]
fn targets_that_contradict_each_other_are_told() {
    // No point is below the least.
    let targets = [
        equal(TargetOf::Min, 310.0),
        equal(TargetOf::Point(0), 270.0),
    ];
    let answer = closed().solve(&targets, &[vary("lamp"), vary("window")]);
    assert_eq!(answer, Err(SolveError::Unsettled));
}

/// Schedules and dimming are part of what the factors multiply.
#[test]
fn factors_come_on_top_of_dimming() {
    let mut run = closed();
    run.dimming = run.dimming.clone().relit("lamp", 0.5, &run.groups).unwrap();
    let solution = run
        .solve(&[equal(TargetOf::Mean, 322.5)], &[vary("lamp")])
        .unwrap();
    assert!((values(&solution)[0] - 0.5).abs() < 1e-12);
}

/// Of 1 000 intervals that hold with probability .95, 910 to 983 hold but for a probability of 1e-7.
#[test]
fn intervals_of_factors_hold_the_truth() {
    let targets = [
        equal(TargetOf::Min, 310.0),
        equal(TargetOf::Point(0), 330.0),
    ];
    // 100 x + 400 y = 320 at point 0, and at the third, which has the least, 400 x + 100 y = 300.
    let truth = closed()
        .solve(&targets, &[vary("lamp"), vary("window")])
        .unwrap();
    for (found, expected) in values(&truth).iter().zip([0.88 / 1.5, 0.98 / 1.5]) {
        assert!((found - expected).abs() < 1e-12, "{found}");
    }
    let mut held = [0; 2];
    for seed in 0..1000 {
        let run = Synthetic::new(&GROUPS, &TRUTH).sampled(seed, 0.01);
        let solution = run
            .solve(&targets, &[vary("lamp"), vary("window")])
            .unwrap();
        for (held, (found, truth)) in held
            .iter_mut()
            .zip(solution.factors.iter().zip(&truth.factors))
        {
            let [low, high] = found.factor.interval.unwrap();
            *held += usize::from((low..=high).contains(&truth.factor.value));
        }
    }
    assert!(
        held.iter().all(|held| (910..=983).contains(held)),
        "{held:?}"
    );
}
