use steradian::estimation::*;
use steradian::geometry::*;
use steradian::quantity::*;
use steradian::scene::description::*;
use steradian::scene::*;
use steradian::transport::*;
fn main() {
    let v = Vector::new;
    let mut d = SceneDescription::default();
    d.materials.push(MaterialDescription {
        name: "g".into(),
        model: MaterialModel::Lambertian {
            reflectance: LaneValues::Uniform(0.5),
        },
    });
    let which = std::env::args().nth(1).unwrap_or_default();
    let shape = |geometry, emission: Option<f64>, material: Option<&str>| ShapeDescription {
        name: Some("s".into()),
        geometry,
        material: material.map(String::from),
        transform: Transform::IDENTITY,
        repeat: None,
        emission: emission.map(|l| EmissionDescription {
            amount: EmissionAmount::Radiance(Amount::Radiant(
                Radiance::from_watts_per_square_metre_steradian(l),
            )),
            spectrum: None,
            two_sided: false,
            group: None,
        }),
    };
    let light = |kind| LightDescription {
        name: None,
        group: None,
        spectrum: None,
        repeat: None,
        kind,
    };
    if which == "furnace" {
        d.materials[0].model = MaterialModel::Lambertian {
            reflectance: LaneValues::Uniform(0.98),
        };
        d.shapes.push(shape(
            GeometryDescription::Box {
                min: Point::ORIGIN,
                max: Point::new(1., 2., 3.),
                inside: true,
                faces: vec![],
                openings: vec![],
            },
            Some(1.0),
            Some("g"),
        ));
        d.sensors.push(SensorDescription {
            name: "p".into(),
            response: None,
            kind: SensorKind::Irradiance(Receivers::Points(vec![
                (Point::new(0.5, 0.5, 0.0), v(0., 0., 1.)),
                (Point::new(0.5, 0.5, 0.5), v(1., 0., 1.)),
            ])),
        });
        d.sensors.push(SensorDescription {
            name: "r".into(),
            response: None,
            kind: SensorKind::Radiance {
                rays: vec![(Point::new(0.5, 0.5, 0.1), v(0., 0.3, 1.))],
            },
        });
    } else {
        d.shapes.push(shape(
            GeometryDescription::Rectangle {
                origin: Point::new(-5., -5., 0.),
                edges: [v(10., 0., 0.), v(0., 10., 0.)],
            },
            None,
            Some("g"),
        ));
        if which == "sphere" {
            d.shapes.push(shape(
                GeometryDescription::Sphere {
                    center: Point::new(0., 0., 1.),
                    radius: 0.05,
                    inside: false,
                    ports: vec![],
                },
                Some(100. / (std::f64::consts::PI * 0.0025)),
                None,
            ));
        } else if which == "dir" {
            d.lights.push(light(LightKind::Directional {
                direction: v(0., 0., -1.),
                irradiance: Amount::Radiant(Irradiance::from_watts_per_square_metre(100.)),
            }));
        } else {
            d.lights.push(light(LightKind::Point {
                position: Point::new(0., 0., 1.),
                power: PointPower::Intensity(Amount::Radiant(Intensity::from_watts_per_steradian(
                    100.,
                ))),
            }));
        }
        d.sensors.push(SensorDescription {
            name: "p".into(),
            response: None,
            kind: SensorKind::Irradiance(Receivers::Points(vec![
                (Point::ORIGIN, v(0., 0., 1.)),
                (Point::new(1., 0., 0.), v(0., 0., 1.)),
            ])),
        });
        d.sensors.push(SensorDescription {
            name: "f".into(),
            response: None,
            kind: SensorKind::Flux {
                of: FluxOf::Incident,
                surface: FluxSurface::Virtual {
                    transform: Transform::IDENTITY,
                    geometry: GeometryDescription::Rectangle {
                        origin: Point::new(-1., -1., 0.),
                        edges: [v(2., 0., 0.), v(0., 2., 0.)],
                    },
                },
            },
        });
    }
    let scene = match Scene::new(&d) {
        Ok(s) => s,
        Err(e) => {
            for p in e {
                eprintln!("{p}");
            }
            return;
        }
    };
    let options = MeasureOptions::default();
    let t = std::time::Instant::now();
    let m = measure(&scene, &options, &mut Silent).unwrap();
    for r in m.readings() {
        println!(
            "{} {} {} {:.6} ± {:.2e} {} {:?} n={} {:?}",
            r.sensor,
            r.index,
            r.quantity,
            r.estimate.value,
            r.estimate.std_error,
            r.unit,
            r.estimate.interval,
            r.samples,
            r.sits_on
        );
    }
    eprintln!("{:?}", t.elapsed());
}
