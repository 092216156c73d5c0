//! How much of the view a mesh fills whose parts may hide each other: rays from the observer.
//!
//! ω = ∫ V dω ≈ (ω₀/N) Σ Vᵢ,  Ω = ∫ V max(0, cosθ) dω ≈ (ω₀/N) Σ Vᵢ max(0, cosθᵢ)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ω, Ω | solid angle, projected solid angle | sr |
//! | V | 1 in directions where the mesh is met, else 0 | – |
//! | θ | angle from the normal of the element at the observer | rad |
//! | ω₀ | solid angle of the cone around the mesh's bounding sphere; 4π from inside that | sr |
//! | N | rays, evenly spread over ω₀ | – |
//!
//! Meshes may be open, and both sides of a triangle count. Rays are found in single precision, which moves edges by some 10⁻⁷ of the
//! mesh's size. An observer nearer than that to a triangle cannot be told from one on its other side.
//!
//! Replicates that agree by chance, or because all rays meet the mesh, do not make the value exact: a standard error of ω₀/(N + 2), or that of
//! single precision, ω₀ 2⁻²², is added to theirs.

use std::f64::consts::TAU;

use steradian_kernel::{BuildError, InstructionSet, RayBatch};

use crate::estimation::{
    Estimate, EstimationError, Integrand, Observer, Plan, SampleBatch, Tally, estimate,
};
use crate::geometry::{Bounds, Direction, Frame, Point, Vector};
use crate::sampling::block;
use crate::sampling::hash::{combine, key_of_name};
use crate::shape::{Form, PartId, Placed, Surfaces, TriangleMesh};

/// Radius of the cone's sphere over that of the mesh's corners.
const MARGIN: f64 = 1.0 + 1e-6;
/// Rays begin so much farther from the mesh's middle than its corners.
const HEADSTART: f64 = 1.01;
/// Share of ω₀ by which rounding in single precision may be wrong.
const ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// A mesh as an observer sees it.
///
/// ```
/// use steradian::estimation::{Plan, Silent, Stopping};
/// use steradian::exchange::MeshView;
/// use steradian::geometry::{Point, solid_angle};
/// let corners = [[1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]].map(Point::from);
/// let plan = Plan { stop: Stopping::at_samples(1 << 14), ..Plan::default() };
/// let found = MeshView::new(&[corners], Point::ORIGIN)?.solid_angle(&plan, &mut Silent)?;
/// let exact = solid_angle::of_triangle(Point::ORIGIN, corners); // half a cube's face, π/3
/// assert!((found.value - exact.to_steradians()).abs() < 4.0 * found.std_error);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct MeshView {
    surfaces: Surfaces,
    eye: Point,
    /// Around the direction to the mesh's middle.
    frame: Frame,
    /// 1 − cosα of the cone's half angle.
    one_minus_cos: f64,
    /// How far from the observer rays begin.
    start: f64,
    set: InstructionSet,
}

impl MeshView {
    /// The triangles seen from `eye`.
    ///
    /// # Errors
    /// If a coordinate is not finite or too large.
    pub fn new(triangles: &[[Point; 3]], eye: Point) -> Result<Self, BuildError> {
        let corners = || triangles.iter().flatten().copied();
        let middle = Bounds::around(corners()).center().unwrap_or(eye);
        let radius = corners().fold(0.0_f64, |most, corner| most.max((corner - middle).length()));
        let distance = (middle - eye).length();
        let axis = Direction::new(middle - eye).unwrap_or(Direction::Z);
        Ok(Self {
            surfaces: surfaces(triangles, middle)?,
            eye,
            frame: Frame::from_normal(axis),
            one_minus_cos: one_minus_cos(radius * MARGIN, distance),
            start: (distance - radius * HEADSTART).max(0.0),
            set: InstructionSet::detect(),
        })
    }

    /// ω in sr.
    ///
    /// # Errors
    /// If the plan contradicts itself, or a thread fails.
    pub fn solid_angle(
        &self,
        plan: &Plan,
        observer: &mut dyn Observer,
    ) -> Result<Estimate, EstimationError> {
        self.estimate(None, plan, observer)
    }

    /// Ω in sr for an element of this normal at the observer.
    ///
    /// # Errors
    /// As for [`solid_angle`](Self::solid_angle).
    pub fn projected_solid_angle(
        &self,
        normal: Direction,
        plan: &Plan,
        observer: &mut dyn Observer,
    ) -> Result<Estimate, EstimationError> {
        let cos = 1.0 - self.one_minus_cos;
        let sin = (self.one_minus_cos * (2.0 - self.one_minus_cos)).sqrt();
        if cos > 0.0 && normal.dot(self.frame.normal()) <= -sin {
            return Ok(Estimate::closed_form(0.0));
        }
        self.estimate(Some(normal), plan, observer)
    }

    fn estimate(
        &self,
        normal: Option<Direction>,
        plan: &Plan,
        observer: &mut dyn Observer,
    ) -> Result<Estimate, EstimationError> {
        let cone = TAU * self.one_minus_cos;
        if cone == 0.0 {
            return Ok(Estimate::closed_form(0.0));
        }
        let seen = Seen { view: self, normal };
        let streams = estimate(&seen, plan, observer)?;
        let unseen = 1.0 / (streams[0].total_samples() as f64 + 2.0);
        let found = streams[0].combine(&[1.0]).scaled(cone);
        Ok(found.widened(cone * unseen.max(ROUNDING)))
    }

    /// Evenly spread over the cone.
    fn direction(&self, [u, v]: [f64; 2]) -> Vector {
        let below_axis = u * self.one_minus_cos;
        let sin = (below_axis * (2.0 - below_axis)).sqrt();
        let (sin_phi, cos_phi) = libm::sincos(TAU * v);
        let local = Vector::new(sin * cos_phi, sin * sin_phi, 1.0 - below_axis);
        self.frame.vector_to_world(local)
    }
}

/// 1 − cosα with sinα = radius/distance, without cancellation; 2 for all directions.
fn one_minus_cos(radius: f64, distance: f64) -> f64 {
    if distance <= radius {
        return if radius > 0.0 { 2.0 } else { 0.0 };
    }
    let sin = radius / distance;
    let cos = ((distance - radius) * (distance + radius)).sqrt() / distance;
    sin * sin / (1.0 + cos)
}

fn surfaces(triangles: &[[Point; 3]], middle: Point) -> Result<Surfaces, BuildError> {
    let numbers =
        (0..triangles.len() as u32).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]);
    let mesh = TriangleMesh::new(triangles.concat(), numbers.collect());
    let placed = Placed {
        form: Form::Mesh(mesh),
        parts: vec![PartId(0); triangles.len()],
    };
    Surfaces::new(vec![placed], middle)
}

/// V, or V max(0, cosθ), of directions in the cone.
struct Seen<'a> {
    view: &'a MeshView,
    normal: Option<Direction>,
}

/// Scratch of a thread: rays with their values if they meet the mesh, and their runs.
#[derive(Default)]
struct Workspace {
    rays: RayBatch,
    waiting: Vec<(usize, f64)>,
    met: Vec<bool>,
}

impl Integrand for Seen<'_> {
    type Workspace = Workspace;

    fn streams(&self) -> usize {
        1
    }

    fn columns(&self) -> usize {
        1
    }

    fn sensor_of(&self, _: usize) -> usize {
        0
    }

    fn stream_key(&self, _: usize) -> u64 {
        combine(key_of_name("mesh view"), u64::from(self.normal.is_some()))
    }

    fn weights(&self, _: usize) -> &[f64] {
        &[1.0]
    }

    fn new_workspace(&self) -> Workspace {
        Workspace::default()
    }

    fn sample(&self, batch: &SampleBatch<'_>, workspace: &mut Workspace, tally: &mut Tally) {
        let Workspace { rays, waiting, met } = workspace;
        rays.clear();
        waiting.clear();
        for (number, run) in batch.runs.iter().enumerate() {
            for index in run.first..run.first + run.count {
                let [u, v, ..] = block::sample(run.key, index, 0).map(f64::from);
                let direction = self.view.direction([u, v]);
                let value = self
                    .normal
                    .map_or(1.0, |normal| normal.dot(direction).max(0.0));
                if value > 0.0 {
                    let start = self.view.eye + direction * self.view.start;
                    let towards = direction.to_array().map(|x| x as f32);
                    rays.push(self.view.surfaces.to_kernel(start), towards, f32::INFINITY);
                    waiting.push((number, value));
                }
            }
        }
        self.view.surfaces.occluded(rays, met, self.view.set);
        for (&(number, value), _) in waiting.iter().zip(met.iter()).filter(|(_, met)| **met) {
            tally.sample(number, &[value], &[1.0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimation::{Silent, Stopping};
    use crate::geometry::{configuration_factor, solid_angle};
    use std::f64::consts::PI;

    const L: [[f64; 2]; 6] = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];

    fn outline(z: f64) -> Vec<Point> {
        L.iter().map(|&[x, y]| Point::new(x, y, z)).collect()
    }

    /// A solid L between two heights; its first corner sees all of it.
    fn prism(bottom: f64, top: f64) -> Vec<[Point; 3]> {
        let [low, high] = [bottom, top].map(outline);
        let fan = |corners: &[Point]| -> Vec<[Point; 3]> {
            let rest = corners[1..].windows(2);
            rest.map(|pair| [corners[0], pair[0], pair[1]]).collect()
        };
        let turned = fan(&low).into_iter().map(|[a, b, c]| [a, c, b]);
        let side = |i: usize| {
            let j = (i + 1) % L.len();
            [[low[i], low[j], high[j]], [low[i], high[j], high[i]]]
        };
        let sides = (0..L.len()).flat_map(side);
        fan(&high).into_iter().chain(turned).chain(sides).collect()
    }

    fn plan(seed: u64) -> Plan {
        Plan {
            seed,
            threads: 1,
            stop: Stopping::at_rel_error(2e-3),
            ..Plan::default()
        }
    }

    /// |z| of a correct value is above 4 once in some 900 runs with 16 replicates.
    fn assert_agrees(found: &Estimate, exact: f64) {
        let z = (found.value - exact) / found.std_error;
        assert!(z.abs() < 4.0 && found.converged, "{found:?} {exact} {z}");
        assert!(found.std_error < 2e-3 * exact);
    }

    #[test]
    fn above_the_knee_of_an_l_only_its_top_is_seen() {
        let normal = Direction::new(Vector::new(0.3, 0.2, -1.0)).unwrap();
        for height in [1.4, 1e3] {
            // From over (½, ½) all sides lie behind the top.
            let eye = Point::new(0.5, 0.5, height);
            let view = MeshView::new(&prism(-3.0, 0.0), eye).unwrap();
            let exact = solid_angle::of_polygon(eye, &outline(0.0)).to_steradians();
            assert_agrees(&view.solid_angle(&plan(1), &mut Silent).unwrap(), exact);
            let exact = PI * configuration_factor::of_polygon(eye, normal, &outline(0.0));
            let found = view.projected_solid_angle(normal, &plan(1), &mut Silent);
            assert_agrees(&found.unwrap(), exact);
            let below = view.projected_solid_angle(Direction::Z, &plan(1), &mut Silent);
            assert_eq!(below.unwrap().value, 0.0);
        }
    }

    #[test]
    fn what_is_hidden_does_not_count() {
        let eye = Point::new(0.5, 0.5, 2.0);
        let two = [prism(-3.0, 0.0), prism(-9.0, -4.0)].concat();
        let exact = solid_angle::of_polygon(eye, &outline(0.0)).to_steradians();
        let found = MeshView::new(&two, eye)
            .unwrap()
            .solid_angle(&plan(3), &mut Silent);
        assert_agrees(&found.unwrap(), exact);
    }

    #[test]
    fn from_inside_and_through_a_hole() {
        let whole = prism(-1.0, 1.0);
        let eye = Point::new(0.5, 0.5, 0.0);
        let inside = MeshView::new(&whole, eye).unwrap();
        let found = inside.solid_angle(&plan(1), &mut Silent).unwrap();
        assert!((found.value - 4.0 * PI).abs() < 1e-12 && found.std_error > 0.0);
        let open = MeshView::new(&whole[4..], eye).unwrap();
        let hole = solid_angle::of_polygon(eye, &outline(1.0)).to_steradians();
        let found = open.solid_angle(&plan(1), &mut Silent).unwrap();
        assert_agrees(&found, 4.0 * PI - hole);
    }

    #[test]
    fn nothing_fills_nothing() {
        let view = MeshView::new(&[], Point::ORIGIN).unwrap();
        let found = view.solid_angle(&plan(1), &mut Silent).unwrap();
        assert_eq!(found, Estimate::closed_form(0.0));
    }
}
