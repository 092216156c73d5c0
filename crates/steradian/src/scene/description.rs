//! A scene as its author states it: plain, typed, editable, not yet validated.
//!
//! Readers of every file format produce a [`SceneDescription`]; [`Scene::new`](super::Scene::new) turns it into an
//! immutable, validated [`Scene`](super::Scene) or says everything that is wrong with it.

use std::sync::Arc;

pub use super::appearance::{
    Opacity, Pattern, Placement, Texture, Varying, absorption_of_attenuation,
};
pub use crate::brdf::{Shadowing, Slopes};
use crate::geometry::{Point, Transform, Vector};
use crate::light::{self, FarField};
pub use crate::material::{
    Bitmap, Interpolation, Media, Picture, PrincipledRecipe, RadianceKind, Recipe, Roughness,
    Scalar, Texels, Wrap,
};
use crate::quantity::{
    Amount, Angle, Exitance, Flux, Illuminance, Intensity, Irradiance, Length, Luminance,
    LuminousExitance, LuminousFlux, LuminousIntensity, Radiance,
};
pub use crate::sensor::{Bins, Fisheye, FluxOf, Projection, Response, Term};
pub use crate::spectrum::{Glass, LaneValues, Metal};
pub use crate::time::Schedule;

/// Everything a run needs to know about a scene.
#[derive(Clone, Debug, Default)]
pub struct SceneDescription {
    /// A title for reports.
    pub name: String,
    /// What the four lanes of a spectrum mean in this run.
    pub spectrum: SpectrumMode,
    /// Which quantities sensors report unless they say otherwise.
    pub response: Response,
    /// Luminous efficacy K in lm/W that links radiant and photometric quantities; `None` is the stated default.
    pub luminous_efficacy: Option<f64>,
    /// Materials by name.
    pub materials: Vec<MaterialDescription>,
    /// Shapes, in file order.
    pub shapes: Vec<ShapeDescription>,
    /// Lights that are not shapes, in file order.
    pub lights: Vec<LightDescription>,
    /// Sensors, in file order.
    pub sensors: Vec<SensorDescription>,
    /// What its reader approximated, for reports.
    pub warnings: Vec<String>,
}

/// What the lanes of a spectrum mean.
#[derive(Clone, Debug, PartialEq)]
pub enum SpectrumMode {
    /// Linear Rec.709 channels.
    Rgb,
    /// One to four named bands; `visible` is the band that carries light.
    Broadband {
        /// Names of the bands, in order.
        bands: Vec<String>,
    },
    /// Four wavelengths of each path.
    Spectral {
        /// First and last wavelength in nm, within 280 to 4000; 360 to 830 is what the eye sees.
        range: [f64; 2],
    },
}

impl Default for SpectrumMode {
    fn default() -> Self {
        Self::Broadband {
            bands: vec!["total".into()],
        }
    }
}

/// A named material.
#[derive(Clone, Debug)]
pub struct MaterialDescription {
    /// The name shapes refer to.
    pub name: String,
    /// How it reflects.
    pub model: MaterialModel,
    /// What part of the light it stops; `None` is all of it.
    pub opacity: Option<Opacity>,
    /// Absorption in 1/m on the sides of the surface.
    pub media: Media<LaneValues>,
    /// What turns its normals; `None` where it is as smooth as its shape.
    pub relief: Option<Relief>,
}

impl MaterialDescription {
    /// An opaque material.
    pub fn new(name: impl Into<String>, model: MaterialModel) -> Self {
        Self {
            name: name.into(),
            model,
            opacity: None,
            media: Media::default(),
            relief: None,
        }
    }
}

/// A picture that turns the normals of a surface without moving the surface. Its values are read as linear numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Relief {
    /// Normals, (x, y, z) = 2·(red, green, blue) − 1: x along u, y along v, z out of the front.
    Normals {
        /// The normals.
        picture: Texture,
        /// What x and y are multiplied by.
        scale: f64,
    },
    /// Heights over the front: the mean of red, green and blue, times a scale.
    Height {
        /// The heights.
        picture: Texture,
        /// The height of 1.
        scale: Length,
    },
}

/// The reflection models a description can name.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialModel {
    /// Lambertian reflection, ρ/π.
    Lambertian {
        /// Directional-hemispherical reflectance, 0 to 1.
        reflectance: Varying,
    },
    /// A perfect plane mirror of a given reflectance.
    Mirror {
        /// Specular reflectance, 0 to 1.
        reflectance: LaneValues,
    },
    /// A material for each side, by name.
    TwoSided {
        /// Material of the front side (the side the normal points to).
        front: String,
        /// Material of the back side.
        back: String,
    },
    /// Other materials side by side, too finely to be seen apart.
    Mixture {
        /// Their names: materials of one model each.
        of: Vec<String>,
        /// Their shares of the area; what is left is black.
        weights: Vec<f64>,
    },
    /// A named metal.
    Metal {
        /// Which.
        metal: Metal,
        /// None for a polished one.
        roughness: Option<Roughness>,
    },
    /// Any other model.
    Recipe(Recipe<Varying, Scalar>),
}

/// A shape with what it is made of and what it emits.
#[derive(Clone, Debug)]
pub struct ShapeDescription {
    /// The name sensors refer to.
    pub name: Option<String>,
    /// The geometry before `transform`.
    pub geometry: GeometryDescription,
    /// Material name; `None` is black.
    pub material: Option<String>,
    /// Applied to the geometry.
    pub transform: Transform,
    /// Copies at a fixed step.
    pub repeat: Option<Repeat>,
    /// What the surface emits.
    pub emission: Option<EmissionDescription>,
}

/// `count` copies, copy `i` moved by `i · step`, for each axis of the array.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeat {
    /// Copies along each axis of the array (at least one axis).
    pub count: Vec<u32>,
    /// The step of each axis, in metres.
    pub step: Vec<Vector>,
}

/// The kinds of geometry.
#[derive(Clone, Debug)]
pub enum GeometryDescription {
    /// `origin + s·edges[0] + t·edges[1]`, s and t in 0..1; the normal is `edges[0] × edges[1]`.
    Rectangle {
        /// A corner.
        origin: Point,
        /// The two edges that leave it (orthogonal, or a parallelogram).
        edges: [Vector; 2],
    },
    /// A planar polygon, counter-clockwise as seen from the front.
    Polygon {
        /// The outer boundary.
        vertices: Vec<Point>,
        /// Boundaries of holes.
        holes: Vec<Vec<Point>>,
    },
    /// A disc or annulus.
    Disc {
        /// The centre.
        center: Point,
        /// The front side's normal (any length).
        normal: Vector,
        /// Outer radius in metres.
        radius: f64,
        /// Inner radius in metres, 0 for a full disc.
        inner_radius: f64,
    },
    /// A sphere, possibly with circular openings.
    Sphere {
        /// The centre.
        center: Point,
        /// Radius in metres.
        radius: f64,
        /// The front side is the inside.
        inside: bool,
        /// Openings.
        ports: Vec<Port>,
    },
    /// An axis-aligned box.
    Box {
        /// The least corner.
        min: Point,
        /// The greatest corner.
        max: Point,
        /// The front sides face inwards (a room).
        inside: bool,
        /// Materials by face: `floor`, `ceiling`, `walls`, `x-`, `x+`, `y-`, `y+`, `z-`, `z+`; a later entry wins.
        faces: Vec<(String, String)>,
        /// Rectangular openings.
        openings: Vec<Opening>,
    },
    /// A triangle mesh.
    Mesh(Arc<MeshData>),
    /// The infinite plane z = `height`, front side up.
    Ground {
        /// Its height in metres.
        height: f64,
    },
}

impl GeometryDescription {
    /// What it is called in scene files.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Rectangle { .. } => "rectangle",
            Self::Polygon { .. } => "polygon",
            Self::Disc { .. } => "disc",
            Self::Sphere { .. } => "sphere",
            Self::Box { .. } => "box",
            Self::Mesh(_) => "mesh",
            Self::Ground { .. } => "ground",
        }
    }
}

/// Vertices and triangles of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshData {
    /// Vertices.
    pub vertices: Vec<Point>,
    /// Triples of vertex indices, counter-clockwise from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Texture coordinates of each vertex, (0, 0) at the lower left of a picture; empty when there are none.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// Linear Rec.709 and alpha of each vertex; empty when there are none.
    pub colors: Vec<[f32; 4]>,
    /// Unit normals of each vertex, in the coordinates of `vertices`; empty when there are none.
    pub normals: Vec<[f32; 3]>,
}

/// A circular opening in a sphere: the cap of `half_angle` around `direction`.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    /// From the centre towards the middle of the port (any length).
    pub direction: Vector,
    /// Half the angle that the port subtends at the centre.
    pub half_angle: Angle,
}

/// A rectangular opening in a face of a box, filled with `material` or empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// `x-`, `x+`, `y-`, `y+`, `z-` (floor) or `z+` (ceiling).
    pub face: String,
    /// u, v, width, height in metres from the face's least corner, u along the first remaining axis.
    pub rect: [f64; 4],
    /// Material of the filling; `None` is a hole.
    pub material: Option<String>,
}

/// What a surface emits: a Lambertian emitter.
#[derive(Clone, Debug, PartialEq)]
pub struct EmissionDescription {
    /// How much.
    pub amount: EmissionAmount,
    /// The shape of its spectrum; `None` is white.
    pub spectrum: Option<LaneValues>,
    /// How it varies over the surface: factors of `amount` (of its mean over the surface where that is a flux).
    pub textures: Vec<Texture>,
    /// Both sides emit; else only the front.
    pub two_sided: bool,
    /// Light group.
    pub group: Option<String>,
    /// How much of it there is in the course of time; `None` is always all.
    pub schedule: Option<Schedule>,
}

/// How much a surface emits; reflected light not counted.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum EmissionAmount {
    /// Radiance of each emitting side.
    Radiance(Amount<Radiance, Luminance>),
    /// Exitance of each emitting side.
    Exitance(Amount<Exitance, LuminousExitance>),
    /// Total flux of all emitting sides (and of each copy of a repeat).
    Flux(Amount<Flux, LuminousFlux>),
}

/// A light that is not a shape.
#[derive(Clone, Debug)]
pub struct LightDescription {
    /// A name for reports.
    pub name: Option<String>,
    /// Light group; `None` is `default`.
    pub group: Option<String>,
    /// The shape of its spectrum; `None` is white.
    pub spectrum: Option<LaneValues>,
    /// How much of it there is in the course of time; `None` is always all.
    pub schedule: Option<Schedule>,
    /// Copies at a fixed step (not for directional lights and environments).
    pub repeat: Option<Repeat>,
    /// What it is.
    pub kind: LightKind,
}

/// The kinds of lights.
#[derive(Clone, Debug)]
pub enum LightKind {
    /// Radiates the same intensity in all directions.
    Point {
        /// Where.
        position: Point,
        /// How much.
        power: PointPower,
    },
    /// Radiates into a cone.
    Spot {
        /// Where.
        position: Point,
        /// The axis (any length).
        direction: Vector,
        /// The shape of the beam.
        beam: SpotBeam,
        /// Peak intensity, or flux.
        power: PointPower,
    },
    /// Parallel light from infinitely far away.
    Directional {
        /// The way the light travels (any length).
        direction: Vector,
        /// On a plane that faces it.
        irradiance: Amount<Irradiance, Illuminance>,
    },
    /// Constant radiance from everywhere.
    Environment {
        /// The radiance.
        radiance: Amount<Radiance, Luminance>,
    },
    /// Radiance from everywhere that a picture tells.
    EnvironmentMap(EnvironmentDescription),
    /// The intensity of a table, from a point or from an opening.
    Luminaire(Box<LuminaireDescription>),
}

/// A picture of all directions, and how much light it stands for.
#[derive(Clone, Debug)]
pub struct EnvironmentDescription {
    /// All azimuths along its width, from overhead down along its height.
    pub picture: Arc<Bitmap>,
    /// The horizontal direction in which its middle is seen (any length).
    pub middle: Vector,
    /// How much light.
    pub amount: EnvironmentAmount,
}

/// How much light comes from a picture of all directions.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum EnvironmentAmount {
    /// What a 1 of the picture stands for.
    Unit(Amount<Radiance, Luminance>),
    /// On a horizontal plane that faces up, by all of it that is above the horizon.
    Irradiance(Amount<Irradiance, Illuminance>),
}

/// A luminaire: its table, where it is, how it is turned, and how much of its light there is.
#[derive(Clone, Debug)]
pub struct LuminaireDescription {
    /// The middle of its opening.
    pub position: Point,
    /// The way its light goes: γ = 0 (any length).
    pub aim: Vector,
    /// Towards its half plane C0, as far as this is across the aim (any length).
    pub c0: Vector,
    /// The table.
    pub far_field: Arc<FarField>,
    /// What a 1 of the table stands for.
    pub unit: Amount<Intensity, LuminousIntensity>,
    /// Where light leaves it.
    pub opening: light::Opening,
    /// Its flux before dimming and maintenance, to which the table is scaled; `None` is the flux of the table.
    pub flux: Option<Amount<Flux, LuminousFlux>>,
    /// Share of its flux that it gives, 0 to 1.
    pub dimming: f64,
    /// Share of this flux that is left as it ages, above 0 and up to 1.
    pub maintenance_factor: f64,
}

/// Intensity or total flux of a light without extent.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum PointPower {
    /// (Peak) intensity.
    Intensity(Amount<Intensity, LuminousIntensity>),
    /// Total flux.
    Flux(Amount<Flux, LuminousFlux>),
}

/// How a spot's intensity falls off with the angle from its axis.
#[derive(Copy, Clone, Debug, PartialEq)]
pub enum SpotBeam {
    /// Constant out to the cutoff (a half angle).
    Uniform {
        /// Half angle.
        cutoff: Angle,
    },
    /// cosⁿθ out to the cutoff.
    CosinePower {
        /// The exponent n.
        exponent: f64,
        /// Half angle, at most 90°.
        cutoff: Angle,
    },
    /// Constant to `inner`, then ((cosθ − cos cutoff)/(cos inner − cos cutoff))² (glTF KHR_lights_punctual).
    Smooth {
        /// Half angle of the constant part.
        inner: Angle,
        /// Half angle beyond which it is dark.
        cutoff: Angle,
    },
}

/// A sensor.
#[derive(Clone, Debug)]
pub struct SensorDescription {
    /// Its name; unique.
    pub name: String,
    /// Overrides the scene's response.
    pub response: Option<Response>,
    /// Reads intervals of wavelength, beside the response if one is stated here (only in `spectral`).
    pub bins: Option<Bins>,
    /// What it measures.
    pub kind: SensorKind,
}

/// The kinds of sensors.
#[derive(Clone, Debug)]
pub enum SensorKind {
    /// Irradiance (illuminance).
    Irradiance(Receivers),
    /// Flux through or from a surface.
    Flux {
        /// The surface.
        surface: FluxSurface,
        /// What is counted.
        of: FluxOf,
    },
    /// Radiance (luminance) along rays.
    Radiance {
        /// Origin and direction of each ray.
        rays: Vec<(Point, Vector)>,
    },
    /// Irradiance on a small sphere: ∫ L dω (fluence rate).
    ScalarIrradiance {
        /// Where.
        points: Vec<Point>,
    },
    /// Mean irradiance of the side of a small cylinder, or of the half of it that faces a direction.
    Cylindrical {
        /// Where; normals are the axes.
        receivers: Receivers,
        /// What the half of it faces; `None` is all of it.
        facing: Option<Vector>,
    },
    /// A picture.
    Camera(CameraDescription),
    /// A side of the [energy balance](crate::scene::energy_balance).
    Balance(Term),
}

impl SensorKind {
    /// A point of it; none for a sensor on a shape of the scene.
    pub(super) fn place(&self) -> Option<Point> {
        match self {
            Self::Irradiance(receivers) | Self::Cylindrical { receivers, .. } => receivers.place(),
            Self::Flux { surface, .. } => surface.place(),
            Self::Radiance { rays } => rays.first().map(|ray| ray.0),
            Self::ScalarIrradiance { points } => points.first().copied(),
            Self::Camera(camera) => Some(camera.position),
            Self::Balance(_) => None,
        }
    }
}

/// Points with normals.
#[derive(Clone, Debug)]
pub enum Receivers {
    /// Position and normal of each.
    Points(Vec<(Point, Vector)>),
    /// Cell centres of a grid.
    Grid {
        /// A corner.
        origin: Point,
        /// The two sides.
        edges: [Vector; 2],
        /// Cells along each.
        count: GridCount,
        /// Width of the strip at each side that is left out, in metres.
        border: f64,
        /// Normal; `None` is `edges[0] × edges[1]`.
        normal: Option<Vector>,
    },
    /// Points spread over a shape.
    Shape {
        /// Its name.
        shape: String,
        /// Front or back.
        side: Side,
        /// How many points.
        count: u32,
        /// Distance from the surface in metres.
        offset: f64,
    },
}

impl Receivers {
    fn place(&self) -> Option<Point> {
        match self {
            Self::Points(points) => points.first().map(|point| point.0),
            Self::Grid { origin, .. } => Some(*origin),
            Self::Shape { .. } => None,
        }
    }
}

/// How many points a grid has.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum GridCount {
    /// So many along each side.
    Given([u32; 2]),
    /// As EN 12464-1 wants them for the size of the area.
    En12464,
}

/// A side of a surface.
#[derive(Copy, Clone, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// The side the normal points to.
    #[default]
    Front,
    /// The other.
    Back,
}

/// The surface of a flux sensor.
#[derive(Clone, Debug)]
pub enum FluxSurface {
    /// A shape of the scene, by name, on one side.
    Shape {
        /// Its name.
        name: String,
        /// Which side.
        side: Side,
    },
    /// A surface that does not block light (a rectangle, polygon, disc or sphere), counted on its front.
    Virtual {
        /// The geometry.
        geometry: GeometryDescription,
        /// Applied to it.
        transform: Transform,
    },
}

impl FluxSurface {
    fn place(&self) -> Option<Point> {
        let Self::Virtual {
            geometry,
            transform,
        } = self
        else {
            return None;
        };
        let place = match geometry {
            GeometryDescription::Rectangle { origin, .. } => *origin,
            GeometryDescription::Polygon { vertices, .. } => *vertices.first()?,
            GeometryDescription::Disc { center, .. }
            | GeometryDescription::Sphere { center, .. } => *center,
            GeometryDescription::Box { min, .. } => *min,
            GeometryDescription::Mesh(mesh) => *mesh.vertices.first()?,
            GeometryDescription::Ground { .. } => return None,
        };
        Some(transform.point(place))
    }
}

/// A camera.
#[derive(Clone, Debug)]
pub struct CameraDescription {
    /// The eye: the middle of the lens, or of the plane from which an orthographic camera looks.
    pub position: Point,
    /// The point in the middle of the picture.
    pub look_at: Point,
    /// Up in the picture.
    pub up: Vector,
    /// How directions become places in the picture.
    pub projection: Projection,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
}
