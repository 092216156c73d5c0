use super::builder::DEPTH;
use super::*;
use crate::brdf::measured::MeasuredError;
use crate::sampling::testing::independent;
use std::f64::consts::PI;

/// Leaves of four sizes with values that follow no symmetry.
fn uneven(rank: Rank) -> TensorTree {
    let mut builder = TreeBuilder::new(rank);
    let children = 1 << rank.axes();
    builder.branch().unwrap();
    for child in 0..children {
        match child % 3 {
            0 => builder.grid(&[0.1 + child as f32]).unwrap(),
            1 => {
                let values: Vec<_> = (0..children).map(|k| (k * k % 7) as f32 * 0.3).collect();
                builder.grid(&values).unwrap();
            }
            _ => {
                let values: Vec<_> = (0..children * children).map(|k| (k % 11) as f32).collect();
                builder.grid(&values).unwrap();
            }
        }
    }
    builder.build().unwrap()
}

fn trees() -> [TensorTree; 4] {
    let [three, four] = [Rank::Three, Rank::Four].map(uneven);
    let reversed = [three.reversed(), four.reversed()];
    let [a, b] = reversed;
    [three, four, a, b]
}

const POINTS: [DiscPoint; 4] = [[0.31, 0.42], [-0.7, 0.1], [0.05, -0.93], [-0.2, -0.21]];

/// Mean of a function over the disc, times its area, from points that fill it evenly; off by the cells that leaves cut: 4e-3.
fn quadrature(f: impl Fn(DiscPoint) -> f64) -> f64 {
    let cells = 256;
    let at = |k: usize| (k as f64 + 0.5) / cells as f64;
    let point = |k: usize| disc::to_disc([at(k % cells), at(k / cells)]);
    let sum: f64 = (0..cells * cells).map(|k| f(point(k))).sum();
    PI * sum / (cells * cells) as f64
}

#[test]
fn totals_are_the_integrals_of_the_value() {
    for tree in trees() {
        for fixed in POINTS {
            let over_incidence = quadrature(|point| tree.value(fixed, point));
            let over_scattering = quadrature(|point| tree.value(point, fixed));
            let (total, hemispherical) = (tree.total(fixed), tree.hemispherical_at(fixed));
            assert!(
                (total / over_incidence - 1.0).abs() < 4e-3,
                "{total} {over_incidence}"
            );
            assert!((hemispherical / over_scattering - 1.0).abs() < 4e-3);
        }
    }
}

/// Sums made once against those over the leaves that a slice meets; at radii ½ and ¾ boxes begin.
#[test]
fn sums_made_once_are_those_over_the_leaves() {
    let mut single = TreeBuilder::new(Rank::Three);
    single.grid(&[0.25]).unwrap();
    let single = single.build().unwrap();
    for tree in trees()
        .into_iter()
        .chain([single.clone(), single.reversed()])
    {
        let on_borders = [[0.5, 0.0], [0.0, -0.75], [0.0, 0.0], [-1.0, 0.0]];
        let points = independent(9, 200)
            .map(disc::to_disc)
            .chain(on_borders)
            .chain(POINTS);
        for point in points {
            let walked = tree.integral(tree.slice_at_scattering(point));
            assert!(
                (tree.total(point) / walked - 1.0).abs() < 1e-13,
                "{point:?}"
            );
        }
    }
}

#[test]
fn samples_lie_where_the_value_is_not_zero() {
    for tree in trees() {
        for fixed in POINTS {
            let total = tree.total(fixed);
            for u in independent(6, 1024) {
                let point = tree.sample(fixed, total, u).unwrap();
                assert!(tree.value(fixed, point) > 0.0, "{fixed:?} {u:?}");
            }
        }
    }
}

/// The mean of a smooth function under the samples, against the integral: six standard errors of 4096 samples.
#[test]
fn samples_follow_the_value() {
    for tree in trees() {
        for fixed in POINTS {
            let total = tree.total(fixed);
            let test = |[x, y]: DiscPoint| 1.0 + x * x * y + 0.5 * x - 0.3 * y;
            let expected = quadrature(|point| tree.value(fixed, point) * test(point)) / total;
            let drawn = independent(5, 4096).map(|u| tree.sample(fixed, total, u).unwrap());
            let mean = drawn.map(test).sum::<f64>() / 4096.0;
            assert!((mean - expected).abs() < 0.06, "{mean} {expected}");
        }
    }
}

/// At 30°, where boxes of rank 3 begin and end, the value meets those that the total is the sum of, at any azimuth.
#[test]
fn borders_belong_to_the_same_boxes_all_around() {
    let mut builder = TreeBuilder::new(Rank::Three);
    let values: Vec<_> = (0..64).map(|k| (k % 16) as f32).collect();
    builder.grid(&values).unwrap();
    let tree = builder.build().unwrap();
    for azimuth in [0.0, 0.6, 2.0, -1.3] {
        let fixed = [0.5 * libm::cos(azimuth), 0.5 * libm::sin(azimuth)];
        let integral = quadrature(|point| tree.value(fixed, point));
        assert!(
            (tree.total(fixed) / integral - 1.0).abs() < 4e-3,
            "{azimuth}"
        );
    }
}

#[test]
fn an_isotropic_tree_does_not_see_the_azimuth() {
    let tree = uneven(Rank::Three);
    for azimuth in [0.4, 1.9, -2.2] {
        let [a, b] = [POINTS[0], POINTS[1]].map(|point| turned(point, azimuth));
        assert_eq!(tree.value(a, b), tree.value(POINTS[0], POINTS[1]));
    }
}

/// Two equal directions of the file of Radiance's test: { 28 … } grids are read with the last axis fastest.
#[test]
fn a_grid_has_its_last_axis_fastest() {
    let mut builder = TreeBuilder::new(Rank::Three);
    builder
        .grid(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
        .unwrap();
    let tree = builder.build().unwrap();
    // Incidence at (1 − sinθ)/2 < ½: the first four; scattering in the quarter x < 0, y > 0 of the square.
    assert_eq!(tree.value([-0.5, 0.5], [0.5, 0.0]), 1.0);
    assert_eq!(tree.resolution(), 0.5);
    assert_eq!(tree.leaves(), 8);
}

#[test]
fn broken_trees_are_refused() {
    let mut builder = TreeBuilder::new(Rank::Four);
    assert_eq!(
        builder.grid(&[1.0; 8]),
        Err(MeasuredError::Grid { found: 8 })
    );
    let mut builder = TreeBuilder::new(Rank::Three);
    assert_eq!(builder.clone().build(), Err(MeasuredError::TreeIncomplete));
    for _ in 0..DEPTH {
        builder.branch().unwrap();
    }
    assert_eq!(
        builder.branch(),
        Err(MeasuredError::TreeDepth { most: DEPTH })
    );
    let mut builder = TreeBuilder::new(Rank::Three);
    builder.grid(&[1.0]).unwrap();
    assert_eq!(builder.branch(), Err(MeasuredError::TreeComplete));
}
