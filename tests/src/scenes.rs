//! Scenes in a few words.

use steradian::brdf::{Shadowing, Slopes};
use steradian::geometry::{Point, Transform, Vector};
use steradian::material::{Recipe, Roughness, Scalar};
use steradian::quantity::{
    Amount, Angle, Exitance, Flux, Illuminance, Intensity, Irradiance, Luminance, LuminousFlux,
    LuminousIntensity, Radiance,
};
use steradian::scene::description::{
    EmissionAmount, EmissionDescription, FluxOf, FluxSurface, GeometryDescription, LaneValues,
    LightDescription, LightKind, MaterialDescription, MaterialModel, PointPower, Port, Receivers,
    SceneDescription, SensorDescription, SensorKind, ShapeDescription, Side, SpectrumMode,
    SpotBeam, Varying,
};

/// A point.
pub fn p(x: f64, y: f64, z: f64) -> Point {
    Point::new(x, y, z)
}

/// A vector.
pub fn v(x: f64, y: f64, z: f64) -> Vector {
    Vector::new(x, y, z)
}

/// Up.
pub const UP: Vector = Vector::new(0.0, 0.0, 1.0);
/// Down.
pub const DOWN: Vector = Vector::new(0.0, 0.0, -1.0);

/// One band that carries light, so that photometric quantities are allowed.
pub fn visible() -> SpectrumMode {
    SpectrumMode::Broadband {
        bands: vec!["visible".into()],
    }
}

/// A scene of these parts, without sensors.
pub fn scene(
    materials: impl Into<Vec<MaterialDescription>>,
    shapes: impl Into<Vec<ShapeDescription>>,
    lights: impl Into<Vec<LightDescription>>,
) -> SceneDescription {
    SceneDescription {
        materials: materials.into(),
        shapes: shapes.into(),
        lights: lights.into(),
        ..SceneDescription::default()
    }
}

/// A diffuse material.
pub fn lambertian(name: &str, reflectance: f64) -> MaterialDescription {
    let reflectance = LaneValues::Uniform(reflectance).into();
    MaterialDescription::new(name, MaterialModel::Lambertian { reflectance })
}

/// A diffuse material of a colour.
pub fn coloured(name: &str, reflectance: LaneValues) -> MaterialDescription {
    let reflectance = reflectance.into();
    MaterialDescription::new(name, MaterialModel::Lambertian { reflectance })
}

/// A mirror.
pub fn mirror(name: &str, reflectance: f64) -> MaterialDescription {
    let reflectance = LaneValues::Uniform(reflectance);
    MaterialDescription::new(name, MaterialModel::Mirror { reflectance })
}

/// A material of any other model.
pub fn modelled(name: &str, recipe: Recipe<Varying, Scalar>) -> MaterialDescription {
    MaterialDescription::new(name, MaterialModel::Recipe(recipe))
}

/// The same in all lanes.
pub fn even(value: f64) -> Varying {
    LaneValues::Uniform(value).into()
}

/// Facets of this roughness, single scattering or all of it.
pub fn rough(alpha: f64, multiple_scattering: bool) -> Roughness {
    Roughness {
        slopes: Slopes::Ggx,
        alpha: [alpha; 2],
        shadowing: Shadowing::HeightCorrelated,
        multiple_scattering,
    }
}

/// An interface to a medium of this index, behind the surface.
pub fn dielectric(ior: f64, roughness: Option<Roughness>) -> Recipe<Varying, Scalar> {
    Recipe::Dielectric {
        ior,
        exterior_ior: 1.0,
        roughness,
    }
}

/// A metal like gold in the red.
pub fn metal(roughness: Option<Roughness>) -> Recipe<Varying, Scalar> {
    Recipe::Conductor {
        eta: even(0.2),
        kappa: even(3.0),
        roughness,
    }
}

/// A pane of index 1.5.
pub fn pane(transmittance: f64) -> Recipe<Varying, Scalar> {
    pane_of(1.5, transmittance)
}

/// A pane of this index and transmittance of its inside.
pub fn pane_of(ior: f64, transmittance: f64) -> Recipe<Varying, Scalar> {
    Recipe::Pane {
        ior,
        transmittance: even(transmittance),
    }
}

fn shape(geometry: GeometryDescription) -> ShapeDescription {
    ShapeDescription {
        name: None,
        geometry,
        material: None,
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    }
}

/// A black rectangle whose normal is the product of its edges.
pub fn rectangle(origin: Point, edges: [Vector; 2]) -> ShapeDescription {
    shape(GeometryDescription::Rectangle { origin, edges })
}

/// A black square of this side in the plane z = `height`, centred on the z axis, its front up.
pub fn square(side: f64, height: f64) -> ShapeDescription {
    let half = 0.5 * side;
    rectangle(
        p(-half, -half, height),
        [v(side, 0.0, 0.0), v(0.0, side, 0.0)],
    )
}

/// The same with its front down.
pub fn square_facing_down(side: f64, height: f64) -> ShapeDescription {
    let half = 0.5 * side;
    rectangle(
        p(-half, -half, height),
        [v(0.0, side, 0.0), v(side, 0.0, 0.0)],
    )
}

/// A black polygon, counter-clockwise from its front.
pub fn polygon(vertices: Vec<Point>) -> ShapeDescription {
    shape(GeometryDescription::Polygon {
        vertices,
        holes: vec![],
    })
}

/// A black disc.
pub fn disc(center: Point, normal: Vector, radius: f64) -> ShapeDescription {
    shape(GeometryDescription::Disc {
        center,
        normal,
        radius,
        inner_radius: 0.0,
    })
}

/// A black ball.
pub fn ball(center: Point, radius: f64) -> ShapeDescription {
    shape(GeometryDescription::Sphere {
        center,
        radius,
        inside: false,
        ports: vec![],
    })
}

/// A black hollow sphere, seen from inside, with ports at (direction, half angle in degrees).
pub fn hollow_sphere(center: Point, radius: f64, ports: &[(Vector, f64)]) -> ShapeDescription {
    let port = |&(direction, degrees): &(Vector, f64)| Port {
        direction,
        half_angle: Angle::from_degrees(degrees),
    };
    shape(GeometryDescription::Sphere {
        center,
        radius,
        inside: true,
        ports: ports.iter().map(port).collect(),
    })
}

/// A black room from the origin to `max`, seen from inside.
pub fn room(max: Point) -> ShapeDescription {
    shape(GeometryDescription::Box {
        min: Point::ORIGIN,
        max,
        inside: true,
        faces: vec![],
        openings: vec![],
    })
}

/// The faces of a black room as rectangles: floor, ceiling, x−, x+, y−, y+.
pub fn room_faces(min: Point, max: Point) -> [ShapeDescription; 6] {
    let size = max - min;
    let (x, y, z) = (
        v(size.x, 0.0, 0.0),
        v(0.0, size.y, 0.0),
        v(0.0, 0.0, size.z),
    );
    [
        rectangle(min, [x, y]),
        rectangle(min + z, [y, x]),
        rectangle(min, [y, z]),
        rectangle(min + x, [z, y]),
        rectangle(min, [z, x]),
        rectangle(min + y, [x, z]),
    ]
}

/// A black box, seen from outside.
pub fn solid(min: Point, max: Point) -> ShapeDescription {
    shape(GeometryDescription::Box {
        min,
        max,
        inside: false,
        faces: vec![],
        openings: vec![],
    })
}

/// A black infinite plane.
pub fn ground(height: f64) -> ShapeDescription {
    shape(GeometryDescription::Ground { height })
}

/// What a shape is said to be.
pub trait Shaping: Sized {
    /// With this name.
    fn named(self, name: &str) -> Self;
    /// Of this material.
    fn made_of(self, material: &str) -> Self;
    /// Emitting from its front.
    fn emitting(self, amount: EmissionAmount) -> Self;
    /// Emitting from both sides.
    fn emitting_twice(self, amount: EmissionAmount) -> Self;
}

impl Shaping for ShapeDescription {
    fn named(self, name: &str) -> Self {
        Self {
            name: Some(name.into()),
            ..self
        }
    }

    fn made_of(self, material: &str) -> Self {
        Self {
            material: Some(material.into()),
            ..self
        }
    }

    fn emitting(self, amount: EmissionAmount) -> Self {
        let emission = EmissionDescription {
            amount,
            spectrum: None,
            textures: vec![],
            two_sided: false,
            group: None,
            schedule: None,
        };
        Self {
            emission: Some(emission),
            ..self
        }
    }

    fn emitting_twice(self, amount: EmissionAmount) -> Self {
        let mut shape = self.emitting(amount);
        if let Some(emission) = &mut shape.emission {
            emission.two_sided = true;
        }
        shape
    }
}

/// Radiance in W/(m² sr).
pub fn radiance(watts: f64) -> EmissionAmount {
    EmissionAmount::Radiance(Amount::Radiant(
        Radiance::from_watts_per_square_metre_steradian(watts),
    ))
}

/// Luminance in cd/m².
pub fn luminance(candelas: f64) -> EmissionAmount {
    EmissionAmount::Radiance(Amount::Photometric(
        Luminance::from_candelas_per_square_metre(candelas),
    ))
}

/// Exitance in W/m².
pub fn exitance(watts: f64) -> EmissionAmount {
    EmissionAmount::Exitance(Amount::Radiant(Exitance::from_watts_per_square_metre(
        watts,
    )))
}

/// Luminous flux of a surface in lm.
pub fn emitted_lumens(lumens: f64) -> EmissionAmount {
    EmissionAmount::Flux(Amount::Photometric(LuminousFlux::from_lumens(lumens)))
}

/// Intensity in W/sr.
pub fn intensity(watts: f64) -> PointPower {
    PointPower::Intensity(Amount::Radiant(Intensity::from_watts_per_steradian(watts)))
}

/// Luminous intensity in cd.
pub fn luminous_intensity(candelas: f64) -> PointPower {
    PointPower::Intensity(Amount::Photometric(LuminousIntensity::from_candelas(
        candelas,
    )))
}

/// Flux in W.
pub fn flux(watts: f64) -> PointPower {
    PointPower::Flux(Amount::Radiant(Flux::from_watts(watts)))
}

/// Luminous flux in lm.
pub fn luminous_flux(lumens: f64) -> PointPower {
    PointPower::Flux(Amount::Photometric(LuminousFlux::from_lumens(lumens)))
}

/// A light of this kind.
pub fn light(kind: LightKind) -> LightDescription {
    LightDescription {
        name: None,
        group: None,
        spectrum: None,
        schedule: None,
        repeat: None,
        kind,
    }
}

/// A point light.
pub fn point_light(position: Point, power: PointPower) -> LightDescription {
    light(LightKind::Point { position, power })
}

/// A spot light.
pub fn spot(
    position: Point,
    direction: Vector,
    beam: SpotBeam,
    power: PointPower,
) -> LightDescription {
    light(LightKind::Spot {
        position,
        direction,
        beam,
        power,
    })
}

/// A beam of cosⁿθ into a hemisphere.
pub fn cosine_beam(exponent: f64) -> SpotBeam {
    SpotBeam::CosinePower {
        exponent,
        cutoff: Angle::from_degrees(90.0),
    }
}

/// An even beam of this half angle.
pub fn even_beam(degrees: f64) -> SpotBeam {
    SpotBeam::Uniform {
        cutoff: Angle::from_degrees(degrees),
    }
}

/// Parallel light of so many W/m² on a plane that faces it.
pub fn directional(direction: Vector, watts: f64) -> LightDescription {
    light(LightKind::Directional {
        direction,
        irradiance: Amount::Radiant(Irradiance::from_watts_per_square_metre(watts)),
    })
}

/// Parallel light of so many lx on a plane that faces it.
pub fn directional_lux(direction: Vector, lux: f64) -> LightDescription {
    light(LightKind::Directional {
        direction,
        irradiance: Amount::Photometric(Illuminance::from_lux(lux)),
    })
}

/// Constant radiance from everywhere in W/(m² sr).
pub fn environment(watts: f64) -> LightDescription {
    light(LightKind::Environment {
        radiance: Amount::Radiant(Radiance::from_watts_per_square_metre_steradian(watts)),
    })
}

/// A sensor.
pub fn sensor(name: &str, kind: SensorKind) -> SensorDescription {
    SensorDescription {
        name: name.into(),
        response: None,
        bins: None,
        kind,
    }
}

/// Irradiance at points with normals.
pub fn irradiance_at(points: impl Into<Vec<(Point, Vector)>>) -> SensorKind {
    SensorKind::Irradiance(Receivers::Points(points.into()))
}

/// Scalar irradiance at a point.
pub fn scalar_irradiance_at(point: Point) -> SensorKind {
    SensorKind::ScalarIrradiance {
        points: vec![point],
    }
}

/// Radiance along a ray.
pub fn radiance_along(origin: Point, direction: Vector) -> SensorKind {
    SensorKind::Radiance {
        rays: vec![(origin, direction)],
    }
}

/// Flux that arrives at the front of a surface that blocks nothing.
pub fn flux_through(surface: ShapeDescription) -> SensorKind {
    SensorKind::Flux {
        surface: FluxSurface::Virtual {
            geometry: surface.geometry,
            transform: surface.transform,
        },
        of: FluxOf::Incident,
    }
}

/// Flux of a kind at the front of a named shape.
pub fn flux_of(shape: &str, of: FluxOf) -> SensorKind {
    let surface = FluxSurface::Shape {
        name: shape.into(),
        side: Side::Front,
    };
    SensorKind::Flux { surface, of }
}
