//! Directions towards a convex polygon, in proportion to the cosine: uniform in projected solid angle.
//!
//! Directions above the horizon, seen along the receiver's normal, are the points of the unit disc, and areas there are
//! projected solid angles. An edge lies in a plane n·d = 0 through the receiver, which the disc sees as an ellipse around its middle,
//! r² = n_z²/(n_z² + (n·e)²) in the direction e of the disc. Cut into sectors at its corners, the polygon is in each the space between the
//! ellipses of two edges, or within one where it surrounds the zenith or reaches it. Up to the direction e a sector from e₀ has the area
//!
//! A(e) = ½ [G_outer(e) − G_inner(e)] ,  G(e) = |n_z| atan2(|n_z| e₀×e, n_z² e₀·e + (n·e₀)(n·e))
//!
//! G/|n_z| being the angle that the piece of the edge subtends. Sectors within one ellipse are inverted in closed form; between two,
//! A(e) = uA is solved by Newton's method within a bracket. Then r² is uniform between the two ellipses.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Ω | projected solid angle ∫ cosθ dω = πF | sr |
//! | n | unit normal of the plane of receiver and edge; n_z along the receiver's normal | – |
//! | e, r | direction and distance in the unit disc | – |
//!
//! Density: cosθ/Ω per steradian. A sample of radiance L has the weight LΩ in irradiance, whatever its direction: the irradiance by an
//! unoccluded polygon of constant radiance is estimated without variance, and no weight exceeds L·Ω ≤ πL.
//!
//! Precision: absolute errors of some 2⁻⁵² in Ω, and of 2⁻⁵²/α of the polygon's size in a sample if it subtends the angle α.
//!
//! Source: C. Peters, *BRDF importance sampling for polygonal lights* (ACM TOG 40 (4), 2021), §3; the sectors and ellipses are
//! his, the bracketed iteration replaces his fixed one.
//!
//! ```
//! use steradian::geometry::Vector;
//! use steradian::sampling::projected_polygon::ProjectedPolygon;
//! // The square of the emitting square's scene: Ω = πF with F = (4/π) (1/√2) atan(1/√2).
//! let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vector::new(x, y, 1.0));
//! let square = ProjectedPolygon::new(&corners).unwrap();
//! assert!((square.projected_solid_angle().to_steradians() - 1.7408395).abs() < 1e-7);
//! ```

use crate::geometry::{Direction, Vector};
use crate::quantity::ProjectedSolidAngle;

mod table;

use table::{Interval, Table};

/// A convex polygon as seen by a receiver at the origin whose normal is z.
#[derive(Clone, Debug, Default)]
pub struct ProjectedPolygon {
    sectors: Vec<Sector>,
    area: f64,
    /// Of the tables of all sectors.
    intervals: Vec<Interval>,
}

/// Memory for making polygons, to be used again.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    visible: Vec<Vector>,
    edges: Vec<Edge>,
    corners: Vec<(f64, [f64; 2])>,
}

impl ProjectedPolygon {
    /// The polygon with these corners relative to the receiver, in its frame; `None` if nothing of it is seen above the horizon.
    ///
    /// The polygon must be plane and convex.
    pub fn new(corners: &[Vector]) -> Option<Self> {
        let mut polygon = Self::default();
        let is_seen = polygon.set(corners, &mut Scratch::default());
        is_seen.then_some(polygon)
    }

    /// Becomes the polygon with these corners, in the memory that it has; false if nothing of it is seen above the horizon.
    pub fn set(&mut self, corners: &[Vector], scratch: &mut Scratch) -> bool {
        self.sectors.clear();
        self.area = 0.0;
        scratch.clip(corners);
        let Scratch { edges, corners, .. } = scratch;
        if edges.iter().all(|edge| edge.arc.normal[2] >= 0.0) {
            for edge in edges {
                self.push([edge.from, edge.to], edge.arc, None);
            }
        } else {
            self.push_between(edges, corners);
        }
        self.area > 0.0
    }

    /// The same, prepared for many samples: see [`tabulate`](Self::tabulate).
    #[must_use]
    pub fn tabulated(mut self) -> Self {
        self.tabulate();
        self
    }

    /// Prepares it for many samples: areas are tabulated, so that a sample need not iterate, where that moves samples by no more than some 2⁻²⁴ of
    /// the polygon. It takes as long as some dozens of samples.
    pub fn tabulate(&mut self) {
        self.intervals.clear();
        for sector in &mut self.sectors {
            let table = |inner: Arc| Table::new(sector, &inner, &mut self.intervals);
            sector.table = sector.inner.and_then(table);
        }
    }

    /// Ω.
    pub fn projected_solid_angle(&self) -> ProjectedSolidAngle {
        ProjectedSolidAngle::from_steradians(self.area)
    }

    /// A direction of density cosθ/Ω, in the receiver's frame.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Direction {
        let wanted = u * self.area;
        let last = self.sectors.len() - 1;
        let index = self
            .sectors
            .partition_point(|sector| sector.end <= wanted)
            .min(last);
        let before = if index == 0 {
            0.0
        } else {
            self.sectors[index - 1].end
        };
        let sector = &self.sectors[index];
        let area = sector.end - before;
        let wanted = (wanted - before).clamp(0.0, area);
        let towards = sector.direction_at(wanted, area, &self.intervals);
        sector.within(towards, v)
    }

    /// The numbers that [`sample`](Self::sample) maps to a direction within the polygon.
    pub fn inverse(&self, direction: Direction) -> [f64; 2] {
        let towards = unit([direction.x(), direction.y()]);
        let holds = |sector: &Sector| {
            cross(sector.from, towards) >= 0.0 && cross(towards, sector.to) >= 0.0
        };
        let index = self.sectors.iter().position(holds).unwrap_or(0);
        let before = if index == 0 {
            0.0
        } else {
            self.sectors[index - 1].end
        };
        let sector = &self.sectors[index];
        let squared = direction.x() * direction.x() + direction.y() * direction.y();
        let [outer, inner] = [
            sector.outer.at(towards).0,
            sector.inner.map_or(0.0, |arc| arc.at(towards).0),
        ];
        [
            (before + sector.area_up_to(towards)) / self.area,
            (squared - inner) / (outer - inner),
        ]
    }

    /// Sectors of a polygon beside the zenith: between neighbouring corners by azimuth.
    fn push_between(&mut self, edges: &mut [Edge], corners: &mut Vec<(f64, [f64; 2])>) {
        let middle = edges.iter().fold([0.0; 2], |sum, edge| {
            [sum[0] + edge.weight[0], sum[1] + edge.weight[1]]
        });
        let turn = |e: [f64; 2]| libm::atan2(cross(middle, e), dot(middle, e));
        corners.clear();
        for edge in edges.iter_mut() {
            edge.turns = [edge.from, edge.to].map(turn);
            corners.push((edge.turns[0], edge.from));
        }
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        let covering = |(low, high): (f64, f64), outer: bool| {
            let covers = |edge: &&Edge| {
                let [from, to] = edge.turns;
                let (first, last) = if outer { (from, to) } else { (to, from) };
                (edge.arc.normal[2] > 0.0) == outer && first <= low && last >= high
            };
            edges.iter().find(covers).map(|edge| edge.arc)
        };
        for pair in corners.windows(2) {
            let between = (pair[0].0, pair[1].0);
            if let Some(outer) = covering(between, true) {
                self.push([pair[0].1, pair[1].1], outer, covering(between, false));
            }
        }
    }

    /// Adds a sector, in two where it is wider than a right angle.
    fn push(&mut self, [from, to]: [[f64; 2]; 2], outer: Arc, inner: Option<Arc>) {
        if inner.is_some() && dot(from, to) < 0.0 {
            let middle = unit([to[1] - from[1], from[0] - to[0]]);
            self.push([from, middle], outer, inner);
            self.push([middle, to], outer, inner);
            return;
        }
        let mut sector = Sector {
            from,
            to,
            outer,
            inner,
            end: 0.0,
            table: None,
        };
        let area = sector.area_up_to(to);
        if area > 0.0 {
            self.area += area;
            sector.end = self.area;
            self.sectors.push(sector);
        }
    }
}

/// A part of the polygon between two directions of the disc, less than half a turn apart.
#[derive(Clone, Debug)]
struct Sector {
    from: [f64; 2],
    to: [f64; 2],
    outer: Arc,
    inner: Option<Arc>,
    /// Sum of the areas up to and including this one.
    end: f64,
    table: Option<Table>,
}

impl Sector {
    /// A(e).
    fn area_up_to(&self, e: [f64; 2]) -> f64 {
        let inner = self.inner.map_or(0.0, |arc| arc.area(self.from, e));
        self.outer.area(self.from, e) - inner
    }

    /// A place along the chord from e₀ (0) to e₁ (1).
    fn at(&self, x: f64) -> [f64; 2] {
        [0, 1].map(|k| self.from[k] + x * (self.to[k] - self.from[k]))
    }

    /// dA/dx along the chord.
    fn density(&self, inner: &Arc, e: [f64; 2]) -> f64 {
        let turn = cross(self.from, self.to);
        0.5 * turn * (self.outer.at(e).0 - inner.at(e).0) / dot(e, e)
    }

    /// Where A(e) is `wanted`, out of `area`: e of any length.
    fn direction_at(&self, wanted: f64, area: f64, intervals: &[Interval]) -> [f64; 2] {
        match (&self.inner, &self.table) {
            (None, _) => self
                .outer
                .along(self.from, 2.0 * wanted / self.outer.normal[2].abs()),
            (Some(_), Some(table)) => self.at(table.inverse(wanted, intervals)),
            (Some(inner), None) => self.solve(inner, wanted, area),
        }
    }

    /// Newton's method along the chord, within a bracket; it starts where a density that is linear along the chord
    /// would have it.
    fn solve(&self, inner: &Arc, wanted: f64, area: f64) -> [f64; 2] {
        let share = wanted / area;
        let [p, q] = [self.from, self.to].map(|e| self.density(inner, e).max(0.0));
        let root = (p * p + share * (q * q - p * p)).max(0.0).sqrt();
        let mut x = if p + root > 0.0 {
            share * (p + q) / (p + root)
        } else {
            share
        };
        let [mut low, mut high] = [0.0, 1.0];
        for _ in 0..MOST_STEPS {
            let e = self.at(x);
            let excess = self.area_up_to(e) - wanted;
            (low, high) = if excess < 0.0 { (x, high) } else { (low, x) };
            let step = excess / self.density(inner, e);
            let next = x - step;
            let next = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            let done = (next - x).abs() < ACCURACY;
            x = next;
            if done {
                break;
            }
        }
        self.at(x)
    }

    /// The direction of azimuth `e`, of any length, that divides the squared radius as v.
    fn within(&self, e: [f64; 2], v: f64) -> Direction {
        let e = if dot(e, e) > 0.0 { e } else { self.to };
        let (outer, outer_height) = self.outer.at(e);
        let (inner, inner_height) = self.inner.map_or((0.0, 1.0), |arc| arc.at(e));
        let r = ((inner + v * (outer - inner)) / dot(e, e)).sqrt();
        let z = (inner_height + v * (outer_height - inner_height)).sqrt();
        Direction::from_unit(Vector::new(r * e[0], r * e[1], z))
    }
}

/// Steps of the iteration; half of a bracket each would do.
const MOST_STEPS: u32 = 60;
/// Length of the last step of x. The error that it leaves is of the order of its square.
const ACCURACY: f64 = 1e-6;

/// The plane of an edge, by its unit normal.
#[derive(Copy, Clone, Debug)]
struct Arc {
    normal: [f64; 3],
}

impl Arc {
    /// Area between the middle of the disc and the ellipse, between two directions less than half a turn apart.
    fn area(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let height = self.normal[2].abs();
        let across = height * cross(from, to);
        let along = height * height * dot(from, to) + self.slope(from) * self.slope(to);
        0.5 * height * libm::atan2(across, along)
    }

    fn slope(&self, e: [f64; 2]) -> f64 {
        self.normal[0] * e[0] + self.normal[1] * e[1]
    }

    /// r² and 1 − r² in a direction of the disc, of any length.
    fn at(&self, e: [f64; 2]) -> (f64, f64) {
        let (height, slope) = (self.normal[2] * self.normal[2], self.slope(e));
        let (height, slope) = (height * dot(e, e), slope * slope);
        let scale = 1.0 / (height + slope);
        (height * scale, slope * scale)
    }

    /// The direction of the disc where the edge has come by an angle from the direction `from`.
    fn along(&self, from: [f64; 2], angle: f64) -> [f64; 2] {
        let [x, y, z] = self.normal;
        let start = Vector::new(z * from[0], z * from[1], -self.slope(from));
        let sideways = Vector::new(x, y, z).cross(start);
        let (sin, cos) = libm::sincos(angle);
        unit([
            cos * start.x + sin * sideways.x,
            cos * start.y + sin * sideways.y,
        ])
    }
}

/// An edge: the directions of its ends in the disc, their azimuths from the middle, its plane, and its first corner as a direction above the
/// disc.
#[derive(Clone, Debug)]
struct Edge {
    from: [f64; 2],
    to: [f64; 2],
    turns: [f64; 2],
    arc: Arc,
    weight: [f64; 2],
}

impl Scratch {
    /// Finds the edges of the part above the horizon.
    fn clip(&mut self, corners: &[Vector]) {
        self.visible.clear();
        above_horizon(corners, &mut self.visible);
        self.edges.clear();
        self.edges.extend(edges(&self.visible));
    }
}

/// The edges, round the side of their planes' normals; those that subtend nothing are left out.
fn edges(corners: &[Vector]) -> impl Iterator<Item = Edge> {
    let pairs = || corners.iter().zip(corners.iter().cycle().skip(1));
    let area = pairs().fold(Vector::ZERO, |sum, (a, b)| sum + a.cross(*b - *a));
    let forwards = corners.first().is_some_and(|corner| corner.dot(area) > 0.0);
    let edge = move |(a, b): (&Vector, &Vector)| {
        let (a, b) = if forwards { (a, b) } else { (b, a) };
        let normal = Direction::new(a.cross(*b - *a)).ok()?.to_array();
        let corner = *a / a.length();
        Some(Edge {
            from: unit([a.x, a.y]),
            to: unit([b.x, b.y]),
            turns: [0.0; 2],
            arc: Arc { normal },
            weight: [corner.x, corner.y],
        })
    };
    pairs().filter_map(edge)
}

/// The part with z ≥ 0 (Sutherland & Hodgman, CACM 17 (1), 1974).
fn above_horizon(corners: &[Vector], visible: &mut Vec<Vector>) {
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        if a.z >= 0.0 {
            visible.push(*a);
        }
        if (a.z < 0.0) != (b.z < 0.0) {
            let crossing = (*a * b.z - *b * a.z) / (b.z - a.z);
            visible.push(Vector::new(crossing.x, crossing.y, 0.0));
        }
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Of length one; the middle of the disc stays.
fn unit(e: [f64; 2]) -> [f64; 2] {
    let length = dot(e, e).sqrt();
    if length > 0.0 {
        e.map(|x| x / length)
    } else {
        e
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::any_vector;
    use crate::geometry::{Direction, Point, configuration_factor};
    use crate::sampling::testing::{assert_uniform, from_projected, independent, to_projected};
    use proptest::prelude::*;
    use std::f64::consts::PI;

    /// Around the zenith, beside it, cut by the horizon, an edge and a corner at the zenith, huge and near, edge-on but for 1e-3,
    /// slender at the horizon, far off the axis and 1e-6 across.
    fn extremes() -> Vec<Vec<Vector>> {
        let quadrilaterals = [
            [
                [-1.0, -0.7, 1.0],
                [1.0, -1.0, 1.0],
                [0.8, 1.0, 1.0],
                [-1.0, 0.9, 1.0],
            ],
            [
                [1.0, -0.7, 1.0],
                [2.0, -1.0, 1.0],
                [2.0, 2.0, 1.0],
                [1.0, 1.5, 1.0],
            ],
            [
                [1.0, -1.0, -0.5],
                [1.0, 2.0, -0.5],
                [1.0, 2.0, 1.0],
                [1.0, -1.0, 1.0],
            ],
            [
                [0.0, -1.0, 1.0],
                [2.0, -1.0, 1.0],
                [2.0, 1.0, 1.0],
                [0.0, 1.0, 1.0],
            ],
            [
                [0.0, 0.0, 1.0],
                [2.0, 0.0, 1.0],
                [2.0, 1.0, 1.0],
                [0.0, 1.0, 1.0],
            ],
            [
                [-1e3, -2e3, 0.01],
                [2e3, -2e3, 0.01],
                [2e3, 1e3, 0.01],
                [-1e3, 1e3, 0.01],
            ],
            [
                [1e-3, -1.0, -0.2],
                [1e-3, 2.0, -0.2],
                [1e-3, 2.0, 1.0],
                [1e-3, -1.0, 1.0],
            ],
            [
                [5.0, -9.0, 0.0],
                [5.0, 9.0, 0.0],
                [5.0, 9.0, 0.01],
                [5.0, -9.0, 0.01],
            ],
            [
                [0.8, 0.0, 0.6],
                [0.8 + 1e-6, 0.0, 0.6],
                [0.8 + 1e-6, 1e-6, 0.6],
                [0.8, 1e-6, 0.6],
            ],
        ];
        quadrilaterals
            .iter()
            .map(|corners| corners.map(Vector::from).to_vec())
            .collect()
    }

    /// An inverse that is 2⁻²⁴ of a sector off half-way between two knots is no more than a third further off elsewhere: |H − A| is
    /// s²(1 − s)² ρ‴ h⁴/24 to leading order, and what the next order adds is left to the margin.
    #[test]
    fn tables_move_no_sample_by_more_than_they_say() {
        let tolerance = 4.0 / 3.0 / f64::from(1 << 24);
        for corners in extremes() {
            let polygon = ProjectedPolygon::new(&corners).unwrap().tabulated();
            for u in independent(5, 4_096) {
                let found = polygon.inverse(polygon.sample(u));
                assert!(
                    (found[0] - u[0]).abs() < tolerance + 1e-15 / polygon.area,
                    "{corners:?} {u:?} {found:?}"
                );
            }
        }
    }

    /// A square overhead to the side, as lamps of rooms are, and one that fills a quarter of the view.
    #[test]
    fn lamps_of_rooms_have_tables() {
        for offset in [0.6, 1.5, 4.0] {
            let corner = |[x, y]: [f64; 2]| Vector::new(x + offset, y + 0.2, 2.0);
            let corners = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.4], [0.0, 0.4]].map(corner);
            let polygon = ProjectedPolygon::new(&corners).unwrap().tabulated();
            assert!(polygon.sectors.iter().all(|sector| sector.table.is_some()));
        }
    }

    fn contains(corners: &[Vector], d: Vector) -> bool {
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        let volume = corners[0].dot((corners[1] - corners[0]).cross(corners[2] - corners[0]));
        let mut sides = pairs.map(|(a, b)| d.dot(a.cross(*b - *a)) * volume);
        sides.all(|side| side >= 0.0)
    }

    fn expected(corners: &[Vector]) -> f64 {
        let outline: Vec<_> = corners.iter().map(|c| Point::ORIGIN + *c).collect();
        PI * configuration_factor::of_polygon(Point::ORIGIN, Direction::Z, &outline)
    }

    #[test]
    fn samples_are_uniform_in_the_disc() {
        for (number, corners) in extremes().into_iter().enumerate() {
            let polygon = ProjectedPolygon::new(&corners).unwrap();
            let samples = independent(number as u64, 65_536).map(|u| polygon.sample(u).to_vector());
            assert_uniform(samples.map(to_projected), |p| {
                contains(&corners, from_projected(p))
            });
            assert!(
                (polygon.area - expected(&corners)).abs() < 1e-14,
                "{number}"
            );
        }
    }

    #[test]
    fn nothing_is_seen_from_the_plane_or_below_the_horizon() {
        let square = |z: f64| [[1.0, 1.0, z], [2.0, 1.0, z], [2.0, 2.0, z]].map(Vector::from);
        assert!(ProjectedPolygon::new(&square(0.0)).is_none());
        assert!(ProjectedPolygon::new(&square(-1.0)).is_none());
        assert!(ProjectedPolygon::new(&[]).is_none());
    }

    proptest! {
        #[test]
        fn the_area_is_that_of_lamberts_formula(corners in prop::array::uniform3(any_vector(2.0))) {
            let area = ProjectedPolygon::new(&corners).map_or(0.0, |polygon| polygon.area);
            prop_assert!((area - expected(&corners)).abs() < 1e-13, "{area} {}", expected(&corners));
        }

        #[test]
        fn the_inverse_leads_back(corners in prop::array::uniform3(any_vector(2.0)), u in 0.01..0.99_f64, v in 0.01..0.99_f64) {
            let polygon = ProjectedPolygon::new(&corners);
            prop_assume!(polygon.as_ref().is_some_and(|polygon| polygon.area > 1e-2));
            let polygon = polygon.unwrap();
            let sample = polygon.sample([u, v]);
            let found = polygon.inverse(sample);
            prop_assert!((found[0] - u).abs() < 1e-8 && (found[1] - v).abs() < 1e-8, "{found:?}");
        }
    }
}
