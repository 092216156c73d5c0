//! Matrices of scenes with known answers.

mod element;
mod pairs;
mod radiosity;
mod rays;
mod smoothing;

use super::*;
use crate::estimation::{Plan, Silent, Stopping};
use crate::geometry::{Transform, Vector};
use crate::scene::Scene;
use crate::scene::description::{GeometryDescription, SceneDescription, ShapeDescription};
use steradian_kernel::InstructionSet;

/// A scene of black shapes, each with a name.
fn scene(shapes: Vec<(&str, GeometryDescription)>) -> Scene {
    let shapes = shapes.into_iter().map(|(name, geometry)| ShapeDescription {
        name: Some(name.to_owned()),
        geometry,
        material: None,
        transform: Transform::IDENTITY,
        repeat: None,
        emission: None,
    });
    let description = SceneDescription {
        shapes: shapes.collect(),
        ..SceneDescription::default()
    };
    Scene::of_surfaces(&description).unwrap()
}

fn cuboid(min: [f64; 3], max: [f64; 3], inside: bool) -> GeometryDescription {
    GeometryDescription::Box {
        min: min.into(),
        max: max.into(),
        inside,
        faces: vec![],
        openings: vec![],
    }
}

fn sphere(center: [f64; 3], radius: f64, inside: bool) -> GeometryDescription {
    GeometryDescription::Sphere {
        center: center.into(),
        radius,
        inside,
        ports: vec![],
    }
}

/// All rows of a matrix.
fn rows(
    scene: &Scene,
    grouping: Grouping,
    technique: Technique,
    stop: Stopping,
) -> (Vec<Row>, MatrixSummary) {
    let facets = Facets::new(scene, Sides::Front).unwrap();
    rows_of(&facets, grouping, technique, stop)
}

/// The same for some facets.
fn rows_of(
    facets: &Facets,
    grouping: Grouping,
    technique: Technique,
    stop: Stopping,
) -> (Vec<Row>, MatrixSummary) {
    let groups = Groups::new(facets, grouping);
    let options = MatrixOptions {
        technique,
        rest: false,
        instruction_set: InstructionSet::detect(),
    };
    let plan = Plan {
        stop,
        threads: 2,
        ..Plan::default()
    };
    let mut rows = Vec::new();
    let summary = matrix(facets, &groups, &options, &plan, &mut Silent, &mut |row| {
        rows.push(row);
    });
    (rows, summary.unwrap())
}

/// With probability 1e-6 for a correct factor the test fails: |t| of 15 degrees of freedom stays below 7.6.
fn assert_factor(row: &Row, to: usize, expected: f64) {
    let found = row.factor_to(to);
    assert!(
        found.agrees_with(expected, 1e-9, 1e-6),
        "{} -> {to}: {found:?}, not {expected}",
        row.from
    );
}
