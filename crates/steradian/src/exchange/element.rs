//! What a surface element sees of the surfaces of a scene, with what stands between.
//!
//! The configuration factor from the element to facet j is F_j = (1/π) ∫ V cosθ dω over j. Where nothing reaches into the convex hull
//! of the element and what it may see of the facet (but for less than [`Surfaces::clearance`](crate::shape::Surfaces::clearance)), it is
//! [`configuration_factor::of_polygon`], exactly. All others, and where the rest goes, come from the same cosine-distributed rays, as the
//! rows of a matrix do.
//!
//! ```
//! use steradian::estimation::Plan;
//! use steradian::exchange::{Element, Facets, Grouping, Groups, Sides, factors_of_element};
//! use steradian::geometry::{Direction, Point, Transform};
//! use steradian::scene::Scene;
//! use steradian::scene::description::{GeometryDescription, SceneDescription, ShapeDescription};
//! // On the middle of the floor of a room of 2 m × 2 m × 1 m: the ceiling is four rectangles with a corner above the element.
//! let (min, max) = ([-1.0, -1.0, 0.0].into(), [1.0, 1.0, 1.0].into());
//! let geometry = GeometryDescription::Box { min, max, inside: true, faces: vec![], openings: vec![] };
//! let room = ShapeDescription {
//!     name: None, geometry, material: None, transform: Transform::IDENTITY, repeat: None, emission: None,
//! };
//! let scene = Scene::of_surfaces(&SceneDescription { shapes: vec![room], ..Default::default() }).expect("a room");
//! let facets = Facets::new(&scene, Sides::Front)?;
//! let groups = Groups::new(&facets, Grouping::Face);
//! let element = Element { position: Point::ORIGIN, normal: Direction::Z };
//! let row = factors_of_element(&facets, &groups, element, &Plan::default())?;
//! assert!((row.factor_to(5).value - 0.5541264239796).abs() < 1e-12);
//! assert!((row.sum.value - 1.0).abs() < 1e-12);
//! # Ok::<(), steradian::exchange::ExchangeError>(())
//! ```

use std::collections::BTreeMap;

use steradian_kernel::InstructionSet;

use super::effort::{Found, Rule};
use super::facets::Facets;
use super::grouping::Groups;
use super::matrix::{ExchangeError, check_plan};
use super::polygon::ConvexPolygon;
use super::rays::{RayCaster, RayWorkspace, Source, Traced};
use super::row::{Entry, Row};
use super::uncertain::{IndependentSum, Uncertain};
use crate::estimation::Plan;
use crate::geometry::{Direction, Hull, Point, configuration_factor};
use crate::quantity::Length;
use crate::sampling::hash::key_of_name;

/// A piece of a surface so small that all of it is in one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Where it is.
    pub position: Point,
    /// Where it faces.
    pub normal: Direction,
}

/// Corners within this share of the distances lie in the plane of the element or of the facet.
const IN_PLANE: f64 = 1e-9;
/// Rays of each replicate in the pilot.
const PILOT: u32 = 1024;

/// The factors from an element to all groups, as a row whose `from` is 0. A tolerance is judged as in [`matrix`](super::matrix); entries
/// of one group are added as if they were independent, which they are not quite: rays that meet one facet miss the others, and the
/// error stated is a little too large.
///
/// # Errors
/// Those of [`matrix`](super::matrix).
pub fn factors_of_element(
    facets: &Facets<'_>,
    groups: &Groups,
    element: Element,
    plan: &Plan,
) -> Result<Row, ExchangeError> {
    check_plan(plan)?;
    let exact: Vec<Option<f64>> = (0..facets.count())
        .map(|facet| element.closed_form(facets, facet))
        .collect();
    let floor = (1.0 / groups.count() as f64).min(0.01);
    let (traced, samples, converged) = trace(facets, element, &Rule::new(plan, floor), &exact);
    let mut sums: BTreeMap<u32, IndependentSum> = BTreeMap::new();
    let mut add = |facet: usize, factor: Uncertain| {
        let group = groups.of_facet()[facet];
        sums.entry(group).or_default().add(factor, 1.0);
    };
    for (facet, factor) in exact.iter().enumerate() {
        if let Some(factor) = factor.filter(|factor| *factor > 0.0) {
            add(facet, Uncertain::exact(factor));
        }
    }
    for entry in sampled(&traced, &exact) {
        add(entry.to as usize, entry.factor());
    }
    let entries: Vec<Entry> = sums
        .iter()
        .map(|(&to, sum)| Entry::found(to, sum.total()))
        .collect();
    let mut sum = IndependentSum::default();
    entries
        .iter()
        .for_each(|entry| sum.add(entry.factor(), 1.0));
    Ok(Row {
        from: 0,
        entries,
        sum: sum.total(),
        rest: Some(traced.rest),
        samples,
        converged,
    })
}

fn trace(
    facets: &Facets<'_>,
    element: Element,
    rule: &Rule,
    exact: &[Option<f64>],
) -> (Traced, u64, bool) {
    let columns: Vec<u32> = (0..facets.count() as u32).collect();
    let caster = RayCaster {
        facets,
        columns: &columns,
        set: InstructionSet::detect(),
    };
    let mut workspace = RayWorkspace::new(facets.count());
    rule.sample(key_of_name("element"), PILOT, |attempt| {
        let source = Source::Element(element);
        let value = caster.row(
            source,
            attempt.key,
            rule.replicates,
            attempt.samples,
            &mut workspace,
        );
        let factors = sampled(&value, exact).map(Entry::factor);
        let excess = factors
            .chain([value.rest.sky])
            .map(|factor| rule.excess(&factor));
        Found {
            excess: excess.fold(0.0, f64::max),
            order: Rule::ORDER,
            value,
        }
    })
}

/// The entries of facets without a closed form.
fn sampled<'a>(traced: &'a Traced, exact: &'a [Option<f64>]) -> impl Iterator<Item = &'a Entry> {
    let is_sampled = |entry: &&Entry| exact[entry.to as usize].is_none();
    traced.entries.iter().filter(is_sampled)
}

impl Element {
    /// The factor to a facet; `None` if something may stand between, or it is curved.
    fn closed_form(&self, facets: &Facets<'_>, facet: usize) -> Option<f64> {
        let polygon = facets.list()[facet].polygon()?;
        let Some(corners) = self.view(polygon) else {
            return Some(0.0);
        };
        let surfaces = facets.surfaces();
        let margin = Length::from_metres(surfaces.clearance());
        let hull = Hull::around(&[&[self.position], &corners[..]].concat()).shrunk(margin);
        let factor =
            || configuration_factor::of_polygon(self.position, self.normal, polygon.corners());
        surfaces.is_clear(&hull, &|_| false).then(factor)
    }

    /// Corners of the part of a polygon above the horizon; `None` if there is none, or it turns its back.
    fn view(&self, polygon: &ConvexPolygon) -> Option<Vec<Point>> {
        let towards = self.position - polygon.corners()[0];
        let tolerance = IN_PLANE * (polygon.diameter() + towards.length());
        let [low, high] = polygon.heights(self.position, self.normal);
        if polygon.normal().dot(towards) <= tolerance || high <= tolerance {
            return None;
        }
        if low >= -tolerance {
            return Some(polygon.corners().to_vec());
        }
        let above = polygon.above(self.position, self.normal)?;
        Some(above.corners().to_vec())
    }
}
