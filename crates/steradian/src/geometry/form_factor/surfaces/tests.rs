//! Pairs of surfaces against their reverse, and closed forms against the quadrature.

use super::quadrature::mean_factor;
use super::*;
use crate::geometry::testing::close;

fn polygon(corners: &[[f64; 3]]) -> Surface {
    Surface::Polygon(
        Polygon::new(
            corners.iter().map(|&corner| corner.into()).collect(),
            vec![],
        )
        .unwrap(),
    )
}

fn disc(center: [f64; 3], normal: [f64; 3], radius: f64) -> Surface {
    Surface::Disc {
        center: center.into(),
        normal: Direction::new(normal.into()).unwrap(),
        radius: Length::from_metres(radius),
    }
}

fn sphere(center: [f64; 3], radius: f64) -> Surface {
    Surface::Sphere {
        center: center.into(),
        radius: Length::from_metres(radius),
    }
}

fn surfaces() -> [Surface; 5] {
    [
        polygon(&[
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ]),
        disc([0.3, 0.2, 2.0], [0.1, 0.3, -1.0], 0.7),
        sphere([1.2, 0.5, 1.0], 0.4),
        disc([-0.8, 0.5, 0.7], [1.0, 0.1, 0.2], 0.4),
        sphere([1.2, 3.0, 0.1], 0.5),
    ]
}

#[test]
fn all_pairs_are_reciprocal_within_their_errors() {
    for from in &surfaces() {
        for to in surfaces().iter().filter(|&to| to != from) {
            let (forth, back) = (
                between(from, to, 1e-6).unwrap(),
                between(to, from, 1e-6).unwrap(),
            );
            let ratio = to.area() / from.area();
            let allowed = forth.error + back.error * ratio + 1e-14;
            assert!(
                close(forth.value, back.value * ratio, allowed),
                "{from:?} {to:?} {forth:?} {back:?}"
            );
            assert!(
                forth.error <= 1e-6 * forth.value,
                "{from:?} {to:?} {forth:?}"
            );
        }
    }
}

#[test]
fn closed_forms_agree_with_the_quadrature() {
    let far_sphere = sphere([0.4, 0.3, 3.0], 0.5);
    let coaxial = [
        disc([0.0; 3], [0.0, 0.0, 1.0], 1.0),
        disc([0.0, 0.0, 1.5], [0.0, 0.0, -1.0], 0.6),
    ];
    let [floor, tilted, ..] = surfaces();
    for (from, to) in [
        (&far_sphere, &floor),
        (&far_sphere, &coaxial[0]),
        (&coaxial[0], &coaxial[1]),
        (&floor, &far_sphere),
    ] {
        let (closed, sum) = (
            between(from, to, 1e-9).unwrap(),
            mean_factor(from, to, 1e-9),
        );
        assert_eq!(closed.error, 0.0);
        assert!(
            close(closed.value, sum.value, sum.error),
            "{from:?} {to:?} {closed:?} {sum:?}"
        );
    }
    assert!(between(&tilted, &floor, 1e-9).unwrap().error > 0.0);
}

#[test]
fn both_sides_of_a_wall_that_cuts_the_view() {
    let wall = disc([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 1.0);
    let ball = sphere([0.0, 2.0, 0.0], 0.9);
    let front = between(&ball, &wall, 1e-7).unwrap();
    let back = between(&ball, &wall.back().unwrap(), 1e-7).unwrap();
    assert!(close(front.value, back.value, front.error + back.error));
    assert!(front.value > 0.0 && ball.back().is_none());
}

#[test]
fn what_intersects_or_has_no_size_is_refused() {
    let [floor, ..] = surfaces();
    let error = |from: &Surface, to: &Surface| between(from, to, 1e-6).unwrap_err().to_string();
    for ball in [sphere([1.0, 0.5, 0.3], 0.4), sphere([-0.2, 0.5, 0.0], 0.4)] {
        assert_eq!(
            error(&ball, &floor),
            "the sphere intersects the other surface"
        );
        assert_eq!(
            error(&floor, &ball),
            "the sphere intersects the other surface"
        );
    }
    assert!(between(&sphere([-0.5, 0.5, 0.0], 0.4), &floor, 1e-6).is_ok());
    assert!(
        error(&sphere([0.0; 3], 1.0), &sphere([1.0; 3], 1.0)).contains("distance of the centres")
    );
    assert!(
        error(&disc([0.0; 3], [0.0, 0.0, 1.0], -1.0), &floor)
            .contains("radius of the disc is -1 m")
    );
}
