use steradian::estimation::*;
use steradian::geometry::*;
use steradian::quantity::*;
use steradian::scene::description::*;
use steradian::scene::*;
use steradian::transport::*;
pub fn cornell(res: u32) -> SceneDescription {
    let v = Vector::new;
    let p = Point::new;
    let mut d = SceneDescription {
        spectrum: SpectrumMode::Rgb,
        ..Default::default()
    };
    for (n, c) in [
        ("white", [0.885809, 0.698859, 0.666422]),
        ("green", [0.105421, 0.37798, 0.076425]),
        ("red", [0.570068, 0.0430135, 0.0443706]),
    ] {
        d.materials.push(MaterialDescription {
            name: n.into(),
            model: MaterialModel::Lambertian {
                reflectance: LaneValues::Rgb(c),
            },
        });
    }
    let quad = |o: Point, a: Vector, b: Vector, m: &str| ShapeDescription {
        name: None,
        geometry: GeometryDescription::Rectangle {
            origin: o,
            edges: [a, b],
        },
        material: Some(m.into()),
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    };
    // mitsuba y-up coordinates used directly
    d.shapes.push(quad(
        p(-1., -1., 1.),
        v(2., 0., 0.),
        v(0., 0., -2.),
        "white",
    )); // floor
    d.shapes
        .push(quad(p(-1., 1., -1.), v(2., 0., 0.), v(0., 0., 2.), "white")); // ceiling
    d.shapes.push(quad(
        p(-1., -1., -1.),
        v(2., 0., 0.),
        v(0., 2., 0.),
        "white",
    )); // back
    d.shapes
        .push(quad(p(1., -1., -1.), v(0., 0., 2.), v(0., 2., 0.), "green"));
    d.shapes
        .push(quad(p(-1., -1., -1.), v(0., 0., 2.), v(0., 2., 0.), "red"));
    let boxd = |t: Transform| ShapeDescription {
        name: None,
        geometry: GeometryDescription::Box {
            min: p(-1., -1., -1.),
            max: p(1., 1., 1.),
            inside: false,
            faces: vec![],
            openings: vec![],
        },
        material: Some("white".into()),
        transform: t,
        repeat: None,
        emission: None,
    };
    let rot = |a: f64| Transform::rotate(Direction::Y, Angle::from_degrees(a), Point::ORIGIN);
    d.shapes.push(boxd(
        Transform::scale(0.3)
            .then(rot(-17.))
            .then(Transform::translate(v(0.335, -0.7, 0.38))),
    ));
    d.shapes.push(boxd(
        Transform::scale_axes([0.3, 0.61, 0.3])
            .then(rot(18.25))
            .then(Transform::translate(v(-0.33, -0.4, -0.28))),
    ));
    let mut l = quad(
        p(-0.23, 0.99, -0.18),
        v(0.46, 0., 0.),
        v(0., 0., 0.38),
        "white",
    );
    let y = 0.2126 * 18.387 + 0.7152 * 13.9873 + 0.0722 * 6.75357;
    l.emission = Some(EmissionDescription {
        amount: EmissionAmount::Radiance(Amount::Radiant(
            Radiance::from_watts_per_square_metre_steradian(y),
        )),
        spectrum: Some(LaneValues::Rgb([18.387, 13.9873, 6.75357])),
        two_sided: false,
        group: None,
    });
    d.shapes.push(l);
    d.sensors.push(SensorDescription {
        name: "camera".into(),
        response: None,
        kind: SensorKind::Camera(CameraDescription {
            position: p(0., 0., 3.9),
            look_at: Point::ORIGIN,
            up: v(0., 1., 0.),
            fov: Angle::from_degrees(39.3077),
            resolution: [res, res],
        }),
    });
    d
}
fn main() {
    let spp: u64 = std::env::args().nth(1).map_or(64, |s| s.parse().unwrap());
    let threads: usize = std::env::args().nth(2).map_or(1, |s| s.parse().unwrap());
    let out = std::env::args().nth(3);
    let scene = match Scene::new(&cornell(256)) {
        Ok(s) => s,
        Err(e) => {
            for p in e {
                eprintln!("{p}");
            }
            return;
        }
    };
    let mut o = RenderOptions {
        max_depth: Some(8),
        ..Default::default()
    };
    o.plan.threads = threads;
    o.plan.stop = Stopping::at_samples(spp);
    for seed in 0..2 {
        o.plan.seed = seed;
        let t = std::time::Instant::now();
        let pic = render(&scene, 0, &o, &mut Silent).unwrap();
        let s = t.elapsed().as_secs_f64();
        println!(
            "{:.3}s {:.3} Mpaths/s mean {:?}",
            s,
            256. * 256. * spp as f64 / s / 1e6,
            pic.exposure.values().iter().fold([0.; 3], |a, v| [
                a[0] + v[0] / 65536.,
                a[1] + v[1] / 65536.,
                a[2] + v[2] / 65536.
            ])
        );
        if let Some(f) = &out {
            let mut b = vec![];
            for v in pic.exposure.values() {
                for c in 0..3 {
                    b.extend_from_slice(&v[c].to_le_bytes());
                }
            }
            std::fs::write(format!("{f}.{seed}"), b).unwrap();
        }
    }
}
