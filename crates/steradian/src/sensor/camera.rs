//! Cameras: radiance arriving along the rays of a film.
//!
//! A film position (f_x, f_y) is in pixels from the upper left corner of W × H. It is scaled to the plane of the
//! [`Projection`], (a, b) with a to the right and b downwards, which says where its ray starts and goes. What is measured
//! is the radiance along that ray, in every projection: no cosine, no weight of the lens, no vignetting. A camera is a
//! sensor, and lights that it looks at directly count.
//!
//! | projection | (a, b) |
//! |---|---|
//! | perspective, thin lens, orthographic | (2f_x − W, 2f_y − H) / W |
//! | panorama | ((2f_x − W) / W, (2f_y − H) / H) |
//! | fisheye | (2f_x − W, 2f_y − H) / min(W, H) |
//!
//! Outside the circle of a fisheye nothing is sampled: pixels further from it than the filter reaches are exactly 0, with error 0, and those
//! on its rim are in part.
//!
//! Rays are given in f64; the batched loops of the transport have their twin in f32, which is tested against it.

mod projection;

pub use projection::{Fisheye, Projection};

use crate::geometry::{Bounds, Direction, Frame, Point, Vector};
use crate::quantity::SolidAngle;

/// A camera: a place, a frame and a projection.
///
/// ```
/// use steradian::geometry::{Point, Vector};
/// use steradian::quantity::Angle;
/// use steradian::sensor::{Camera, Fisheye, Projection};
///
/// // In an equal-area fisheye of 180° every pixel of the circle sees 2π sr / (π 200²).
/// let projection = Projection::Fisheye { mapping: Fisheye::Equisolid, fov: Angle::from_degrees(180.0) };
/// let (up, north) = (Point::new(0.0, 0.0, 1.0), Vector::new(0.0, 1.0, 0.0));
/// let camera = Camera::new(Point::ORIGIN, up, north, projection, [400, 400]).unwrap();
/// for film in [[200.0, 200.0], [10.0, 190.0]] {
///     assert!((camera.solid_angle(film).to_steradians() - 5e-5).abs() < 1e-18);
/// }
/// assert!(camera.ray([10.0, 10.0], [0.0; 2]).is_none(), "outside the circle nothing is seen");
/// ```
#[derive(Clone, Debug)]
pub struct Camera {
    /// The eye: the middle of the lens, or of the plane from which an orthographic camera looks.
    pub position: Point,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    projection: Projection,
    /// To the right, down and ahead.
    frame: Frame,
}

/// Pixels beyond the picture from which filters reach it.
const BEYOND: f64 = 2.0;

/// How a camera sees a point.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct Sight {
    /// The film position, which may be beyond the borders of the picture.
    pub film: [f64; 2],
    /// Where the ray to the point starts.
    pub from: Point,
    /// Pixels per square metre at the point, of an area that faces the ray.
    pub pixels_per_area: f64,
}

impl Camera {
    /// `None` when `look_at` is the position or `up` is along the view.
    ///
    /// The numbers of the projection are taken as they are; [`Scene::new`](crate::scene::Scene::new) refuses those
    /// without a meaning.
    pub fn new(
        position: Point,
        look_at: Point,
        up: Vector,
        projection: Projection,
        resolution: [u32; 2],
    ) -> Option<Self> {
        let ahead = Direction::new(look_at - position).ok()?;
        let right = Direction::new(ahead.to_vector().cross(up)).ok()?;
        Some(Self {
            position,
            resolution,
            projection,
            frame: Frame::from_normal_and_tangent(ahead, right.to_vector())?,
        })
    }

    /// How directions become film positions.
    pub const fn projection(&self) -> Projection {
        self.projection
    }

    /// Right, down and ahead.
    pub const fn frame(&self) -> Frame {
        self.frame
    }

    /// The same view in another resolution.
    pub fn with_resolution(&self, resolution: [u32; 2]) -> Self {
        Self {
            resolution,
            ..self.clone()
        }
    }

    /// Where the ray of a film position starts and goes; `None` outside the image circle of a fisheye.
    ///
    /// `lens` is a place on the unit disc of the lens, (0, 0) its middle; only a thin lens heeds it.
    pub fn ray(&self, film: [f64; 2], lens: [f64; 2]) -> Option<(Point, Direction)> {
        let (start, towards) = self.projection.ray(self.to_plane(film), lens)?;
        let world = |local| self.frame.vector_to_world(local);
        Some((
            self.position + world(start),
            Direction::new(world(towards)).ok()?,
        ))
    }

    /// The film position at which a point is seen through this place of the lens; also beyond the borders of the
    /// picture. `None` where no film position sees it: behind the camera, or outside the image circle.
    pub fn film_of(&self, point: Point, lens: [f64; 2]) -> Option<[f64; 2]> {
        let local = self.frame.vector_to_local(point - self.position);
        let plane = self.projection.plane_of(local, lens)?;
        let (middle, scale) = self.middle_and_scale();
        Some(std::array::from_fn(|axis| {
            middle[axis] + scale[axis] * plane[axis]
        }))
    }

    /// How a point is seen through this place of the lens; `None` where no film position sees it.
    ///
    /// ```
    /// use steradian::geometry::{Point, Vector};
    /// use steradian::quantity::Angle;
    /// use steradian::sensor::{Camera, Projection};
    ///
    /// // At 2 m a picture of 90° across is 4 m wide: 100 pixels are 25 a metre.
    /// let projection = Projection::Perspective { fov: Angle::from_degrees(90.0) };
    /// let (ahead, up) = (Point::new(0.0, 2.0, 0.0), Vector::new(0.0, 0.0, 1.0));
    /// let camera = Camera::new(Point::ORIGIN, ahead, up, projection, [100, 100]).unwrap();
    /// let sight = camera.sight(ahead, [0.0; 2]).unwrap();
    /// assert_eq!(sight.film, [50.0, 50.0]);
    /// assert!((sight.pixels_per_area - 625.0).abs() < 1e-9);
    /// ```
    pub fn sight(&self, point: Point, lens: [f64; 2]) -> Option<Sight> {
        let film = self.film_of(point, lens)?;
        let local = self.frame.vector_to_local(point - self.position);
        let (start, density) = self.projection.sight(local, lens)?;
        let (_, scale) = self.middle_and_scale();
        Some(Sight {
            film,
            from: self.position + self.frame.vector_to_world(start),
            pixels_per_area: density * scale[0] * scale[1],
        })
    }

    /// A film position and those that show the same: a panorama, which closes in itself, goes on beyond its borders.
    pub(crate) fn repeats(&self, [x, y]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> + use<> {
        let [width, height] = self.resolution.map(f64::from);
        let around = [-width, 0.0, width].map(|turn| [x + turn, y]);
        let over = [-0.5 * width, 0.5 * width].map(|turn| [x + turn, -y]);
        let under = over.map(|[x, y]| [x, 2.0 * height + y]);
        let closes = self.projection == Projection::Panorama;
        let places = around.into_iter().chain(over).chain(under);
        places.filter(move |place| closes || *place == [x, y])
    }

    /// False only if no part of a box is in the picture or within the reach of its filter. Nothing is known of projections other than the
    /// perspective one.
    pub fn may_see(&self, bounds: &Bounds) -> bool {
        let Projection::Perspective { fov } = self.projection else {
            return true;
        };
        let [width, height] = self.resolution.map(f64::from);
        let slope = |size: f64| (fov / 2.0).tan() * (size + 2.0 * BEYOND) / width;
        let [right, down] = [slope(width), slope(height)];
        let corners = bounds.corners();
        let corners = corners.map(|corner| self.frame.vector_to_local(corner - self.position));
        let is_beyond = |side: &dyn Fn(&Vector) -> bool| corners.iter().all(side);
        ![
            is_beyond(&|at| at.z <= 0.0),
            is_beyond(&|at| at.x > at.z * right),
            is_beyond(&|at| -at.x > at.z * right),
            is_beyond(&|at| at.y > at.z * down),
            is_beyond(&|at| -at.y > at.z * down),
        ]
        .contains(&true)
    }

    /// Solid angle per pixel at a film position, seen from the middle of the lens: the limit for small pixels of the
    /// solid angle that a pixel covers. It is 0 outside an image circle and for an orthographic camera, whose rays are parallel.
    pub fn solid_angle(&self, film: [f64; 2]) -> SolidAngle {
        let (_, scale) = self.middle_and_scale();
        let density = self.projection.solid_angle_density(self.to_plane(film));
        SolidAngle::from_steradians(density / (scale[0] * scale[1]))
    }

    /// The place on the plane of projection of a film position.
    fn to_plane(&self, film: [f64; 2]) -> [f64; 2] {
        let (middle, scale) = self.middle_and_scale();
        std::array::from_fn(|axis| (film[axis] - middle[axis]) / scale[axis])
    }

    /// The middle of the film, and pixels per unit of the plane of projection.
    pub(crate) fn middle_and_scale(&self) -> ([f64; 2], [f64; 2]) {
        let middle = self.resolution.map(|pixels| 0.5 * f64::from(pixels));
        let scale = match self.projection {
            Projection::Perspective { .. }
            | Projection::ThinLens { .. }
            | Projection::Orthographic { .. } => [middle[0]; 2],
            Projection::Panorama => middle,
            Projection::Fisheye { .. } => [middle[0].min(middle[1]); 2],
        };
        (middle, scale)
    }
}

#[cfg(test)]
mod tests;
