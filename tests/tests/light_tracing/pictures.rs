//! What is told of pictures: their bits, their intervals, what they lack, and their borders.

use steradian::estimation::film::merge_exposures;
use steradian_kernel::InstructionSet;
use steradian_tests::assert_agrees;

use super::glass::{IN_GLASS, glass_ball, lamp_in_glass};
use super::*;

/// A panorama closes in itself: the sphere below is as bright at its borders and poles as elsewhere.
#[test]
fn a_panorama_has_no_seam() {
    let mut scene = lamp_in_glass();
    scene.sensors[0].kind = SensorKind::Camera(CameraDescription {
        position: p(1.0, 0.0, 0.0),
        look_at: p(0.0, 0.0, 0.0),
        up: UP,
        projection: Projection::Panorama,
        resolution: [128, 64],
    });
    let seen = picture(&scene, &options(64, None)).exposure;
    for (column, row) in [(0, 0), (0, 1), (3, 0), (3, 1)] {
        let tile = seen.tile(column, row, &[1.0, 0.0, 0.0, 0.0], 0.95);
        assert_agrees("tile", &tile, IN_GLASS, 0.0);
    }
    // Of the pixels at the borders themselves the filter takes what lies beyond.
    let edge = (0..64).map(|row| seen.values()[128 * row][0]).sum::<f64>() / 64.0;
    assert!((edge / IN_GLASS - 1.0).abs() < 0.1, "{edge}");
}

/// Where no polished surface is in view, nothing is missing; where one is, its view of the lamp and of what the lamp is thrown on.
#[test]
fn what_is_missing_is_what_polished_surfaces_show() {
    let away = glass_ball(0.0, [0.5, 0.6, 0.0]);
    assert_eq!(
        picture(&away, &options(1, None)).unsampled,
        Vec::<String>::new()
    );
    let towards = picture(&glass_ball(0.0, [0.0, 0.0, 0.7]), &options(1, None));
    let [class] = &towards.unsampled[..] else {
        panic!("{:?}", towards.unsampled);
    };
    assert!(class.contains("as polished surfaces show it"), "{class}");
    let lamp = picture(&glass_ball(0.05, [0.0, 0.0, 0.7]), &options(1, None));
    assert_eq!(lamp.unsampled, Vec::<String>::new());
}

/// The same bits for any number of threads, any instruction set, and from shards.
#[test]
fn pictures_with_caustics_keep_their_bits() {
    let mut plan = options(32, None);
    plan.plan.replicates = 4;
    plan.plan.threads = 1;
    let scene = glass_ball(0.0, [0.0, 0.0, 0.7]);
    let alone = picture(&scene, &plan).exposure;
    for threads in [2, 5] {
        let mut many = plan.clone();
        many.plan.threads = threads;
        assert_eq!(alone, picture(&scene, &many).exposure, "{threads} threads");
    }
    for instruction_set in InstructionSet::available() {
        let other = RenderOptions {
            instruction_set,
            ..plan.clone()
        };
        assert_eq!(
            alone,
            picture(&scene, &other).exposure,
            "{instruction_set:?}"
        );
    }
    let shards = (1..=3).map(|part| {
        let mut options = plan.clone();
        options.plan.shard = Some((part, 3));
        picture(&scene, &options).exposure
    });
    assert_eq!(alone, merge_exposures(shards.collect()).unwrap());
}

/// Of 60 intervals that hold with probability .95, fewer than 48 hold with probability 5e-6; none of 60 is the error of the truth, whose
/// 95 % interval is a twentieth of theirs.
#[test]
fn intervals_hold() {
    let eye = camera([0.5, 0.0, 1.0], [0.5, 0.0, 0.0], pinhole(40.0));
    let scene = beside_a_mirror(point_light(p(0.0, 0.3, 0.9), intensity(5.0)), eye);
    let image = point_light(p(-2.0, 0.3, 0.9), intensity(5.0 * MIRROR));
    let truth = mean(&picture(
        &with_image(scene.clone(), image),
        &options(256, Some(3)),
    ));
    let holds = |seed: u64| {
        let mut options = options(16, Some(3));
        options.plan.seed = seed;
        options.plan.replicates = 4;
        let [low, high] = mean(&picture(&scene, &options)).interval.unwrap();
        usize::from((low..=high).contains(&truth.value))
    };
    let held: usize = (0..60).map(holds).sum();
    assert!(held >= 48, "{held} of 60");
}
