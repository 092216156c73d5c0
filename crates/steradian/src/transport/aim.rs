//! Aiming at an emitter: directions in proportion to what they contribute to a receiver.
//!
//! | receiver | facets | sphere seen from outside | weight of a sample |
//! |---|---|---|---|
//! | of irradiance, at surfaces and meters | projected solid angle | projected solid angle | Ω = ∫ cosθ dω = πF |
//! | of scalar irradiance | solid angle | cone | ω = ∫ dω |
//!
//! Of several facets one is chosen by its share. So every sample has the same weight, the integral over the whole emitter, which is at
//! most π (4π): an emitter in full view is estimated without variance, and no direction that is sampled otherwise need look for it.

use glam::Vec3;

use super::columns::Place;
use super::shaft::View;
use super::tables::{Emitter, EmitterShape, Facet, Outline, Tables};
use super::towards::{clearance, cone, on_sphere};
use crate::geometry::{Direction, Frame, Point, Vector};
use crate::sampling::projected_cap::ProjectedCap;
use crate::sampling::projected_polygon::{self, ProjectedPolygon};
use crate::sampling::spherical_rectangle::SphericalRectangle;
use crate::sampling::spherical_triangle::SphericalTriangle;
use crate::sampling::warp;

/// An emitter as a receiver samples it.
pub(super) struct Aim {
    frame: Frame,
    targets: Vec<Target>,
    /// Of the targets, in their order, and some to be used again.
    polygons: Vec<ProjectedPolygon>,
    total: f64,
    /// Rays go through the points of the emitter, and do not end before them.
    is_portal: bool,
}

/// A sampler, with the sum of the weights up to and including it.
struct Target {
    sampler: Sampler,
    sum: f64,
}

enum Sampler {
    /// The polygon of this number.
    Projected(usize, Plane),
    Rectangle(SphericalRectangle, Plane),
    Triangle(SphericalTriangle, Plane),
    Cap(ProjectedCap, Ball),
    Cone(f32, Ball),
}

/// The plane of a facet, from the receiver: its normal and its distance along it.
#[derive(Copy, Clone)]
struct Plane {
    normal: Vector,
    distance: f64,
    size: f64,
}

#[derive(Copy, Clone)]
struct Ball {
    center: Vec3,
    radius: f32,
}

/// Whether all directions to an emitter are sampled from a point by aiming at it: outside a sphere, or a few facets.
#[inline(always)]
pub(super) fn is_aimed_at(tables: &Tables<'_>, emitter: &Emitter, start: [f32; 3]) -> bool {
    match emitter.outline {
        Some(Outline::Facets(_)) => true,
        Some(Outline::Sphere { center, radius }) => {
            let axis = Vec3::from_array(tables.scene.surfaces().to_kernel(center))
                - Vec3::from_array(start);
            cone(axis, radius as f32, true).is_some()
        }
        Some(Outline::Disc(..)) | None => false,
    }
}

/// Memory for aiming, to be used again.
#[derive(Default)]
pub(super) struct Scratch {
    corners: Vec<Vector>,
    local: Vec<Vector>,
    polygon: projected_polygon::Scratch,
}

impl Default for Aim {
    fn default() -> Self {
        Self {
            frame: Frame::from_normal(Direction::Z),
            targets: vec![],
            polygons: vec![],
            total: 0.0,
            is_portal: false,
        }
    }
}

impl Aim {
    /// Turns to an emitter that [`is_aimed_at`] accepts, in the memory that it has.
    pub fn turn(
        &mut self,
        tables: &Tables<'_>,
        emitter: &Emitter,
        (place, spherical): (&Place, bool),
        scratch: &mut Scratch,
    ) {
        let normal = Direction::new(Vector::from(place.normal.map(f64::from)));
        let frame = Frame::from_normal(normal.unwrap_or(Direction::Z));
        self.frame = frame;
        self.targets.clear();
        self.total = 0.0;
        self.is_portal = matches!(emitter.shape, EmitterShape::Portal(_));
        let receiver = tables.scene.surfaces().origin() + Vector::from(place.point.map(f64::from));
        match &emitter.outline {
            Some(Outline::Facets(facets)) => {
                let clearance = if spherical {
                    0.0
                } else {
                    f64::from(place.clearance)
                };
                let view = View::new(receiver, (!spherical).then(|| frame.normal()), clearance);
                let seen = facets
                    .iter()
                    .filter(|facet| view.may_see(facet, emitter.two_sided));
                seen.for_each(|facet| self.at_facet(facet, (receiver, spherical), scratch));
            }
            Some(Outline::Sphere { center, radius }) => {
                let ball = Ball {
                    center: Vec3::from_array(tables.scene.surfaces().to_kernel(*center)),
                    radius: *radius as f32,
                };
                self.at_sphere(*center - receiver, *radius, ball, place, spherical);
            }
            Some(Outline::Disc(..)) | None => {}
        }
    }

    /// Gets ready for many samples.
    pub fn prepare(&mut self) {
        for target in &self.targets {
            if let Sampler::Projected(number, _) = target.sampler {
                self.polygons[number].tabulate();
            }
        }
    }

    /// What every sample contributes per unit of radiance; 0 if nothing is seen of the emitter.
    pub fn weight(&self) -> f64 {
        self.total
    }

    fn add(&mut self, sampler: Sampler, weight: f64) {
        self.total += weight;
        self.targets.push(Target {
            sampler,
            sum: self.total,
        });
    }

    fn at_facet(
        &mut self,
        facet: &Facet,
        (receiver, spherical): (Point, bool),
        scratch: &mut Scratch,
    ) {
        let Scratch { corners, .. } = scratch;
        corners.clear();
        corners.extend(facet.corners.iter().map(|corner| *corner - receiver));
        let size = (corners[2] - corners[0]).length();
        let plane = Plane {
            normal: facet.normal.to_vector(),
            distance: facet.normal.dot(corners[0]),
            size,
        };
        if spherical {
            self.at_facet_by_solid_angle(corners, plane);
        } else {
            self.at_facet_by_projected_solid_angle(plane, scratch);
        }
    }

    fn at_facet_by_projected_solid_angle(&mut self, plane: Plane, scratch: &mut Scratch) {
        let Scratch {
            corners,
            local,
            polygon: memory,
        } = scratch;
        let corners = corners.iter();
        local.clear();
        local.extend(corners.map(|corner| self.frame.vector_to_local(*corner)));
        // All targets before this one have a polygon.
        let number = self.targets.len();
        if number == self.polygons.len() {
            self.polygons.push(ProjectedPolygon::default());
        }
        let polygon = &mut self.polygons[number];
        if polygon.set(local, memory) {
            let weight = polygon.projected_solid_angle().to_steradians();
            self.add(Sampler::Projected(number, plane), weight);
        }
    }

    fn at_facet_by_solid_angle(&mut self, corners: &[Vector], plane: Plane) {
        let edges = [1, corners.len() - 1].map(|k| corners[k] - corners[0]);
        let rectangle = (corners.len() == 4).then(|| SphericalRectangle::new(corners[0], edges));
        if let Some(rectangle) = rectangle.flatten() {
            self.add(
                Sampler::Rectangle(rectangle, plane),
                rectangle.solid_angle().to_steradians(),
            );
            return;
        }
        for pair in corners[1..].windows(2) {
            if let Some(triangle) = SphericalTriangle::new([corners[0], pair[0], pair[1]]) {
                self.add(
                    Sampler::Triangle(triangle, plane),
                    triangle.solid_angle().to_steradians(),
                );
            }
        }
    }

    fn at_sphere(&mut self, axis: Vector, radius: f64, ball: Ball, place: &Place, spherical: bool) {
        if spherical {
            let axis = ball.center - Vec3::from_array(place.point);
            if let Some(one_minus_cos) = cone(axis, ball.radius, true) {
                self.add(
                    Sampler::Cone(one_minus_cos, ball),
                    1.0 / f64::from(warp::cone_density(one_minus_cos)),
                );
            }
        } else if let Some(cap) = ProjectedCap::new(self.frame.vector_to_local(axis), radius) {
            self.add(
                Sampler::Cap(cap, ball),
                cap.projected_solid_angle().to_steradians(),
            );
        }
    }

    /// End of a shadow ray from `place`.
    pub fn sample(&self, place: &Place, [u, v]: [f32; 2]) -> Option<Vec3> {
        let wanted = f64::from(u) * self.total;
        let index = self.targets.partition_point(|target| target.sum <= wanted);
        let index = index.min(self.targets.len().checked_sub(1)?);
        let before = if index == 0 {
            0.0
        } else {
            self.targets[index - 1].sum
        };
        let target = &self.targets[index];
        let rest = ((wanted - before) / (target.sum - before)).clamp(0.0, 1.0);
        let numbers = [rest, f64::from(v)];
        let vertex = Vec3::from_array(place.point);
        match &target.sampler {
            Sampler::Projected(number, plane) => {
                let direction = self.polygons[*number].sample(numbers);
                let direction = self.frame.to_world(direction);
                self.end(place, plane, direction.to_vector())
            }
            Sampler::Rectangle(rectangle, plane) => {
                self.end(place, plane, rectangle.sample(numbers))
            }
            Sampler::Triangle(triangle, plane) => {
                self.end(place, plane, triangle.sample(numbers).to_vector())
            }
            Sampler::Cap(cap, ball) => {
                let direction = self.frame.to_world(cap.sample(numbers));
                Some(on_sphere(
                    ball.center,
                    ball.radius,
                    vertex,
                    single(direction.to_vector()),
                ))
            }
            Sampler::Cone(one_minus_cos, ball) => {
                let axis = (ball.center - vertex).normalize();
                let local = warp::cone(rest as f32, v, *one_minus_cos);
                let direction = Vec3::from_array(super::scatter::to_world(axis.into(), local));
                Some(on_sphere(ball.center, ball.radius, vertex, direction))
            }
        }
    }

    /// Where a direction meets a plane, at lamps moved off it towards the receiver.
    fn end(&self, place: &Place, plane: &Plane, direction: Vector) -> Option<Vec3> {
        let span = plane.span(direction)?;
        Some(match self.is_portal {
            true => Vec3::from_array(place.point) + single(span),
            false => plane.end(place, span),
        })
    }
}

impl Plane {
    /// To where a direction meets it.
    fn span(&self, direction: Vector) -> Option<Vector> {
        let way = self.distance / direction.dot(self.normal);
        (way > 0.0 && way.is_finite()).then(|| direction * way)
    }

    /// A point on it, moved off it towards the receiver.
    fn end(&self, place: &Place, span: Vector) -> Vec3 {
        let point = Vec3::from_array(place.point) + single(span);
        let facing = if self.distance < 0.0 {
            self.normal
        } else {
            -self.normal
        };
        let off = clearance(point.into(), (self.size + span.length()) as f32);
        point + single(facing) * off
    }
}

fn single(v: Vector) -> Vec3 {
    Vec3::from_array(v.to_array().map(|x| x as f32))
}
