//! The options that name an object, and how they are read.

use std::path::PathBuf;

use clap::Args;
use steradian::geometry::{
    Bounds, Direction, Point, Polygon, PolygonError, SphericalPatch, Vector,
};
use steradian::quantity::{Angle, Length};
use steradian_io::files::{DiskFiles, Files};
use steradian_io::import;

use super::object::Object;
use crate::status::Failure;
use crate::values::{self, numbers, points};

const NO_OBJECT: &str = "name an object, such as --sphere 0,0,2,1: one of --sphere, --cap, --disc, --ellipse, --rectangle, \
    --triangle, --polygon, --spherical-polygon, --box, --mesh, --patch or --element";

/// Exactly one of these.
#[derive(Args, Debug)]
pub struct ObjectArguments {
    /// A sphere by its centre and radius
    #[arg(long, value_name = "CX,CY,CZ,R", value_parser = numbers::<4>, allow_hyphen_values = true, group = "what")]
    sphere: Option<[f64; 4]>,
    /// The cap of directions within this angle of the Z axis
    #[arg(long, value_name = "HALF_ANGLE", group = "what")]
    cap: Option<Angle>,
    /// A disc by its centre, normal and radius
    #[arg(long, value_name = "CX,CY,CZ,NX,NY,NZ,R", value_parser = numbers::<7>, allow_hyphen_values = true, group = "what")]
    disc: Option<[f64; 7]>,
    /// An ellipse by its centre and two half axes U and V; the outline is C + U cos t + V sin t
    #[arg(long, value_name = "CX,CY,CZ,UX,UY,UZ,VX,VY,VZ", value_parser = numbers::<9>, allow_hyphen_values = true, group = "what")]
    ellipse: Option<[f64; 9]>,
    /// A rectangle by its four corners, one after another
    #[arg(long, value_name = "X,Y,Z …", value_parser = points, allow_hyphen_values = true, group = "what")]
    rectangle: Option<Corners>,
    /// A triangle by its three corners
    #[arg(long, value_name = "X,Y,Z …", value_parser = points, allow_hyphen_values = true, group = "what")]
    triangle: Option<Corners>,
    /// A polygon by its corners, convex or not; if they lie in no plane, by the great circles between their directions
    #[arg(long, value_name = "X,Y,Z …", value_parser = points, allow_hyphen_values = true, group = "what")]
    polygon: Option<Corners>,
    /// The part of the sphere to the left of an outline of directions, counter-clockwise seen from outside; it may be more than half of the sphere
    #[arg(long, value_name = "X,Y,Z …", value_parser = points, allow_hyphen_values = true, group = "what")]
    spherical_polygon: Option<Corners>,
    /// A box along the axes by two opposite corners
    #[arg(long = "box", value_name = "X,Y,Z,X,Y,Z", value_parser = numbers::<6>, allow_hyphen_values = true, group = "what")]
    cuboid: Option<[f64; 6]>,
    /// A mesh (.obj, .ply, .stl, .gltf, .glb): in closed form from inside and if convex, else by rays
    #[arg(long, value_name = "FILE", group = "what")]
    mesh: Option<PathBuf>,
    /// The directions between two angles θ from the Z axis and two azimuths φ: 0:30deg,0:90deg
    #[arg(long, value_name = "θ1:θ2,φ1:φ2", value_parser = patch, group = "what")]
    patch: Option<SphericalPatch>,
}

/// Points of an outline.
pub type Corners = values::Points;

impl ObjectArguments {
    /// The object, or what is wrong with it.
    pub fn read(&self) -> Result<Object, Failure> {
        let finished = |object: Result<Object, String>| object.map_err(Failure::message);
        if let Some([x, y, z, radius]) = self.sphere {
            return finished(positive(radius).map(|radius| Object::Sphere {
                center: Point::new(x, y, z),
                radius,
            }));
        }
        if let Some(disc) = self.disc {
            return finished(self::disc(disc));
        }
        if let Some([x, y, z, ux, uy, uz, vx, vy, vz]) = self.ellipse {
            let half_axes = [Vector::new(ux, uy, uz), Vector::new(vx, vy, vz)];
            return Ok(Object::Ellipse {
                center: Point::new(x, y, z),
                half_axes,
            });
        }
        if let Some(corners) = &self.spherical_polygon {
            return finished(directions(&corners.0));
        }
        if let Some([x1, y1, z1, x2, y2, z2]) = self.cuboid {
            return Ok(Object::Box(Bounds::around([
                Point::new(x1, y1, z1),
                Point::new(x2, y2, z2),
            ])));
        }
        if let Some(path) = &self.mesh {
            return mesh(path);
        }
        match (self.cap, self.patch) {
            (Some(half_angle), _) => finished(cap(half_angle)),
            (_, Some(patch)) => Ok(Object::Patch(patch)),
            _ => finished(self.outline()),
        }
    }

    fn outline(&self) -> Result<Object, String> {
        if let Some(corners) = &self.rectangle {
            return rectangle(&corners.0);
        }
        if let Some(corners) = &self.triangle {
            if corners.0.len() != 3 {
                return Err(format!(
                    "a triangle has three corners, not {}",
                    corners.0.len()
                ));
            }
            return polygon(&corners.0);
        }
        let corners = self.polygon.as_ref().ok_or(NO_OBJECT)?;
        polygon(&corners.0)
    }
}

fn positive(radius: f64) -> Result<Length, String> {
    if radius > 0.0 {
        return Ok(Length::from_metres(radius));
    }
    Err(format!("a radius must be positive, not {radius}"))
}

fn disc([x, y, z, nx, ny, nz, radius]: [f64; 7]) -> Result<Object, String> {
    let normal = Direction::new(Vector::new(nx, ny, nz)).map_err(|error| error.to_string())?;
    Ok(Object::Disc {
        center: Point::new(x, y, z),
        normal,
        radius: positive(radius)?,
    })
}

fn cap(half_angle: Angle) -> Result<Object, String> {
    if (Angle::ZERO..=Angle::HALF_TURN).contains(&half_angle) {
        return Ok(Object::Cap(half_angle));
    }
    Err(format!(
        "the half angle of a cap is 0 to 180 deg, not {} deg",
        half_angle.to_degrees()
    ))
}

/// Four corners of which opposite sides are equal and neighbouring ones perpendicular.
fn rectangle(corners: &[Point]) -> Result<Object, String> {
    let &[a, b, c, d] = corners else {
        return Err(format!(
            "a rectangle has four corners, not {}",
            corners.len()
        ));
    };
    let (u, v) = (b - a, d - a);
    let size = u.length() + v.length();
    let is_right = u.dot(v).abs() <= 1e-9 * u.length() * v.length();
    if !is_right || (c - b - v).length() > 1e-9 * size {
        return Err("these corners make no rectangle; use --polygon for other outlines".to_owned());
    }
    polygon(corners)
}

fn polygon(corners: &[Point]) -> Result<Object, String> {
    match Polygon::new(corners.to_vec(), Vec::new()) {
        Ok(_) | Err(PolygonError::NotPlanar { .. }) => Ok(Object::Polygon(corners.to_vec())),
        Err(error) => Err(error.to_string()),
    }
}

fn directions(corners: &[Point]) -> Result<Object, String> {
    let directions: Result<Vec<Direction>, _> = corners
        .iter()
        .map(|corner| Direction::new(corner.to_vector()))
        .collect();
    Ok(Object::SphericalPolygon(
        directions.map_err(|error| error.to_string())?,
    ))
}

fn mesh(path: &std::path::Path) -> Result<Object, Failure> {
    let bytes = DiskFiles::default()
        .read(path)
        .map_err(|error| Failure::message(format!("{}: {error}", path.display())))?;
    let file = import::mesh(path, &bytes, &DiskFiles::default())
        .map_err(|error| Failure::message(format!("{}: {error}", path.display())))?;
    let meshes = file.parts.iter().map(|part| &part.mesh);
    let triangles: Vec<[Point; 3]> = meshes
        .flat_map(|mesh| {
            mesh.triangles
                .iter()
                .map(|triangle| triangle.map(|corner| mesh.vertices[corner as usize]))
        })
        .collect();
    Ok(Object::Mesh(triangles))
}

/// `0:30deg,0:90deg`.
fn patch(text: &str) -> Result<SphericalPatch, String> {
    let (theta, phi) = text
        .split_once(',')
        .ok_or("expected two ranges of angles such as 0:30deg,0:90deg")?;
    SphericalPatch::new(values::angles(theta)?, values::angles(phi)?)
        .map_err(|error| error.to_string())
}
