//! The tree against its lights, each asked by itself.

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::bounds::Cone;
use super::*;
use crate::brdf::{Facets, Gloss, Slopes};
use crate::geometry::Direction;
use crate::sampling::block;
use crate::sampling::testing::{assert_proportional, independent};

/// Four uniform numbers of a light or place.
fn numbers(key: u64, index: u32) -> [f64; 4] {
    block::sample(key, index, 0).map(f64::from)
}

fn direction([u, v]: [f64; 2]) -> DVec3 {
    let z = 2.0 * u - 1.0;
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * v);
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

/// Lights without extent in a hall: points, flat emitters and spots of half a radian.
fn lights(key: u64, count: u32) -> Vec<Bounds> {
    let light = |index| {
        let [x, y, z, power] = numbers(key, index);
        let [u, v, ..] = numbers(key ^ 1, index);
        let axis = direction([u, v]);
        let cone = match index % 3 {
            0 => Cone::EVERYWHERE,
            1 => Cone::of_normal(axis),
            _ => Cone {
                axis,
                spread: 0.5,
                reach: 0.0,
            },
        };
        let point = DVec3::new(40.0 * x, 30.0 * y, 6.0 * z);
        Bounds::around([point], cone, 0.1 + power).unwrap()
    };
    (0..count).map(light).collect()
}

fn place(key: u64, index: u32) -> Receiving {
    let [x, y, z, side] = numbers(key, index);
    let [u, v, ..] = numbers(key ^ 2, index);
    let point = DVec3::new(50.0 * x - 5.0, 40.0 * y - 5.0, 10.0 * z - 2.0);
    let normal = direction([u, v]);
    Receiving {
        point: point.as_vec3(),
        normal: (side < 0.8).then_some(normal.as_vec3()),
        highlight: (side < 0.4).then(|| highlight(key, index, normal)),
    }
}

/// Seen from anywhere above; a third of the light at least is mirrored.
fn highlight(key: u64, index: u32, normal: DVec3) -> Highlight {
    let [u, v, width, share] = numbers(key ^ 4, index);
    let viewer = direction([u, v]);
    Highlight {
        viewer: (viewer * viewer.dot(normal).signum()).as_vec3(),
        normal: normal.as_vec3(),
        gloss: Gloss {
            alpha: (0.001 + width * width) as f32,
            share: (1.0_f64.min(share + 1.0 / 3.0)) as f32,
        },
    }
}

/// The same without a normal.
fn open(key: u64, index: u32) -> Receiving {
    Receiving {
        normal: None,
        highlight: None,
        ..place(key, index)
    }
}

/// Irradiance at a place by one of `lights`, whose light fills its bounds.
fn irradiance(light: &Bounds, at: &Receiving) -> f64 {
    let span = at.point.as_dvec3() - light.center();
    let way = span.normalize();
    let angle = libm::acos(light.cone.axis.dot(way).clamp(-1.0, 1.0));
    let beyond = (angle - light.cone.spread).max(0.0);
    let emitted = match beyond > light.cone.reach {
        true => 0.0,
        false => libm::cos(beyond),
    };
    let received = at
        .normal
        .map_or(1.0, |normal| -normal.as_dvec3().dot(way).min(0.0));
    light.intensity * emitted * received / span.length_squared()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Where every light shines everywhere, one is always drawn: n products of up to 30 factors are right to 30 n roundings of 2⁻⁵³.
    #[test]
    fn probabilities_sum_to_one(key: u64, count in 1..300_u32) {
        let everywhere = |bounds| Bounds { cone: Cone::EVERYWHERE, ..bounds };
        let tree = LightTree::new(lights(key, count).into_iter().map(everywhere)).unwrap();
        let at = open(key, 0);
        let sum: f64 = (0..count as usize).map(|light| tree.probability(&at, light)).sum();
        prop_assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }

    /// Whatever arrives can be drawn, and no more than all is.
    #[test]
    fn what_arrives_is_possible(key: u64, count in 2..300_u32) {
        let lights = lights(key, count);
        let tree = LightTree::new(lights.clone()).unwrap();
        for index in 0..8 {
            let at = place(key ^ 3, index);
            let probability = |light| tree.probability(&at, light);
            let sum: f64 = (0..lights.len()).map(probability).sum();
            prop_assert!(sum < 1.0 + 1e-12);
            for (number, light) in lights.iter().enumerate() {
                prop_assert!(irradiance(light, &at) == 0.0 || probability(number) > 0.0);
            }
        }
    }

    /// Drawing and asking agree to the last bit, and the number that is left is one again.
    #[test]
    fn a_drawn_light_has_its_probability(key: u64, count in 1..2000_u32, u in 0.0..1.0_f64) {
        let tree = LightTree::new(lights(key, count)).unwrap();
        let at = place(key, 1);
        if let Some(drawn) = tree.draw(&at, u) {
            prop_assert_eq!(drawn.probability.to_bits(), tree.probability(&at, drawn.light).to_bits());
            prop_assert!(drawn.probability > 0.0 && (0.0..1.0).contains(&drawn.u));
        }
    }
}

proptest! {
    /// A ball by itself, as blocks of places weigh it, is of the importance that it has beside the others of its node, to the last bit.
    #[test]
    fn balls_alone_have_the_importance_of_their_nodes(key: u64, count in 1..12_u32) {
        let tree = LightTree::new(lights(key, count)).unwrap();
        prop_assert_eq!(tree.few.is_empty(), tree.nodes.len() > FEW);
        for index in 0..8 {
            let at = place(key ^ 5, index);
            for (node, balls) in tree.nodes.iter().zip(&tree.few) {
                let importance = node.importance(&at).map(f32::to_bits);
                for (ball, expected) in balls.iter().zip(importance) {
                    if !ball.is_dark() {
                        prop_assert_eq!(ball.importance(&at).to_bits(), expected);
                    }
                }
            }
        }
    }
}

#[test]
fn of_many_nodes_no_balls_are_kept() {
    assert!(LightTree::new(lights(17, 100)).unwrap().few.is_empty());
}

/// 40 000 draws of 60 lights follow the probabilities; what draws nothing counts as a light of its own.
#[test]
fn draws_follow_the_probabilities() {
    let tree = LightTree::new(lights(5, 60)).unwrap();
    for index in 0..4 {
        let at = open(6, index);
        let probabilities: Vec<f64> = (0..60).map(|light| tree.probability(&at, light)).collect();
        let none = (1.0 - probabilities.iter().sum::<f64>()).max(0.0);
        // χ² wants some draws of each.
        let often = |share: f64| share > 2.5e-4;
        let mut counts = [0; 61];
        for [u, _] in independent(u64::from(index), 40_000) {
            counts[tree.draw(&at, u).map_or(60, |drawn| drawn.light)] += 1;
        }
        let shares = probabilities.into_iter().chain([none]);
        let cells = counts.into_iter().zip(shares);
        let (counts, shares): (Vec<u64>, Vec<f64>) = cells.filter(|(_, p)| often(*p)).unzip();
        assert!(counts.len() > 9, "{}", counts.len());
        assert_proportional(&counts, &shares);
    }
}

/// A number in its stratum leads to a light in that order: strata of u are strata of lights.
#[test]
fn what_is_left_of_the_number_is_uniform() {
    let tree = LightTree::new(lights(8, 200)).unwrap();
    let at = open(9, 0);
    let left = independent(10, 20_000).filter_map(|[u, _]| tree.draw(&at, u));
    let mut counts = [0; 32];
    left.for_each(|drawn| counts[(drawn.u * 32.0) as usize] += 1);
    assert_proportional(&counts, &[1.0; 32]);
}

/// Points around a metal's mirrored direction are chosen in proportion to ρ cosθ_i I/d² up to shadowing, which is left out: four
/// factors of single precision are right to some 10⁻⁶ of what their cancellation leaves of sinθ_h, here a hundredth.
#[test]
fn a_highlight_weighs_points_by_its_facets() {
    let facets = Facets::isotropic(Slopes::Ggx, 0.05).unwrap();
    let normal = DVec3::new(0.2, -0.1, 1.0).normalize();
    let viewer = DVec3::new(0.9, 0.3, 0.8).normalize();
    let mirrored = 2.0 * viewer.dot(normal) * normal - viewer;
    let away = |k: u32| mirrored + 0.05 * f64::from(k) * DVec3::new(0.3, 1.0, 0.2);
    let points: Vec<DVec3> = (0..4)
        .map(|k| away(k).normalize() * f64::from(2 + k))
        .collect();
    let light = |point: &DVec3| Bounds::around([*point], Cone::EVERYWHERE, 1.0).unwrap();
    let tree = LightTree::new(points.iter().map(light)).unwrap();
    let at = Receiving {
        point: Vec3::ZERO,
        normal: Some(normal.as_vec3()),
        highlight: Some(Highlight {
            viewer: viewer.as_vec3(),
            normal: normal.as_vec3(),
            gloss: Gloss {
                alpha: 0.05,
                share: 1.0,
            },
        }),
    };
    let expected = points.iter().map(|point| {
        let half = (viewer + point.normalize()).normalize();
        let cos = half.dot(normal);
        let sin = half.cross(normal).length();
        facets.density(Direction::from_polar(sin, cos, 0.0)) / point.length_squared()
    });
    let expected: Vec<f64> = expected.collect();
    let sum: f64 = expected.iter().sum();
    for (number, wanted) in expected.iter().enumerate() {
        let p = tree.probability(&at, number);
        assert!((p * sum / wanted - 1.0).abs() < 1e-3, "{number}: {p}");
    }
    assert!(expected[0] > 10.0 * expected[3] && expected[3] > 1e-3 * expected[0]);
}

/// Nothing is given to lights behind the receiver, nor to those that shine away from it.
#[test]
fn what_cannot_arrive_is_not_drawn() {
    let at = |height: f64, cone| {
        (0..20).map(move |k| {
            let point = DVec3::new(f64::from(k), 0.0, height);
            Bounds::around([point], cone, 1.0).unwrap()
        })
    };
    let down = Cone::of_normal(DVec3::NEG_Z);
    let up = Cone::of_normal(DVec3::Z);
    let all = at(3.0, down)
        .chain(at(-1.0, Cone::EVERYWHERE))
        .chain(at(4.0, up));
    let tree = LightTree::new(all).unwrap();
    let receiver = Receiving {
        point: Vec3::new(9.5, 0.0, 0.0),
        normal: Some(Vec3::Z),
        highlight: None,
    };
    let sum = |lights: std::ops::Range<usize>| -> f64 {
        lights.map(|light| tree.probability(&receiver, light)).sum()
    };
    assert!(sum(0..20) > 0.9);
    assert_eq!(sum(20..60), 0.0);
}

/// How far the choice is from E/p = constant, which needs a look at every light: of 1000 lights, a sample of the irradiance has a
/// standard deviation below its mean in most places, where by power it is several times the mean.
#[test]
fn importance_is_nearly_the_irradiance() {
    let everywhere = |bounds| Bounds {
        cone: Cone::EVERYWHERE,
        ..bounds
    };
    let lights: Vec<_> = lights(11, 1000).into_iter().map(everywhere).collect();
    let power: f64 = lights.iter().map(|light| light.intensity).sum();
    let tree = LightTree::new(lights.clone()).unwrap();
    let mut spreads: Vec<[f64; 2]> = (0..48)
        .filter_map(|index| {
            let at = place(12, index);
            let of = |p: &dyn Fn(usize) -> f64| {
                let terms = lights
                    .iter()
                    .map(|light| irradiance(light, &at))
                    .enumerate();
                let terms = terms.filter(|(_, e)| *e > 0.0);
                let [mean, square] = terms.fold([0.0; 2], |[mean, square], (number, e)| {
                    [mean + e, square + e * e / p(number)]
                });
                (mean > 0.0).then(|| (square / (mean * mean) - 1.0).sqrt())
            };
            let by_power = |number: usize| lights[number].intensity / power;
            Some([of(&|number| tree.probability(&at, number))?, of(&by_power)?])
        })
        .collect();
    spreads.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let n = spreads.len();
    let [median, by_power] = [
        spreads[n / 2][0],
        spreads.iter().map(|s| s[1]).sum::<f64>() / n as f64,
    ];
    assert!(median < 0.8 && by_power > 4.0, "{median} {by_power}");
}

/// The same lights make the same tree, and lights at one place a tree all the same.
#[test]
fn building_is_a_function_of_the_lights() {
    let many = || lights(13, 5000);
    assert_eq!(LightTree::new(many()), LightTree::new(many()));
    let one = lights(14, 1)[0];
    let tree = LightTree::new(vec![one; 1000]).unwrap();
    let at = open(15, 0);
    for light in [0, 499, 999] {
        assert!((tree.probability(&at, light) - 1e-3).abs() < 1e-9);
    }
    assert!(LightTree::new([]).is_none());
}

/// Every light is a leaf once; nodes and trails take the stated memory.
#[test]
fn a_tree_holds_every_light_once() {
    let everywhere = |bounds| Bounds {
        cone: Cone::EVERYWHERE,
        ..bounds
    };
    let tree = LightTree::new(lights(16, 777).into_iter().map(everywhere)).unwrap();
    let mut seen = [0; 777];
    for node in &tree.nodes {
        let lit = (0..WIDTH).filter(|k| node.importance(&open(1, 1))[*k] > 0.0);
        for k in lit {
            if let Below::Light(light) = node.below(k) {
                seen[light] += 1;
            }
        }
    }
    assert_eq!(seen, [1; 777]);
    assert!(tree.nodes.len() <= 777 / 2);
    assert_eq!(std::mem::size_of::<Node>(), 208);
}
