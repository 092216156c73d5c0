//! `steradian area`: the area of a shape in closed form and by quadrature of A = ∫ dA.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use steradian::geometry::{Point, Transform, Vector};
use steradian::quantity::Length;
use steradian::scene::Problem;
use steradian::scene::description::GeometryDescription;
use steradian::shape::{Form, quadrature};
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, significant};

use crate::status::{Failure, Outcome};
use crate::{
    load,
    output::{self, Format},
    values,
};

/// Area of a shape, in closed form and by quadrature
///
/// The closed form stands beside the sum of the area elements dA over a grid in the shape's own coordinates: |e₁ × e₂| du dv
/// for a rectangle, ρ dρ dφ for a disc, R² sinθ dθ dφ for a sphere. The more cells, the closer the two.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// rectangle, disc, sphere or polygon; or a mesh (.obj, .ply, .stl) or scene file (.toml), whose shapes are listed
    #[arg(value_name = "SHAPE|FILE")]
    target: String,
    /// rectangle: WIDTH HEIGHT; disc: RADIUS and perhaps INNER; sphere: RADIUS; polygon: corners X,Y,Z in metres. Lengths may have a unit
    #[arg(value_name = "SIZE", allow_negative_numbers = true)]
    sizes: Vec<String>,
    /// Cells along each coordinate of the quadrature
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=10_000), default_value_t = 64)]
    quadrature: u32,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  steradian area sphere \"20 cm\" --quadrature 8
  steradian area disc 1 0.5
  steradian area polygon 0,0,0 2,0,0 2,1,0 0,1,0
  steradian area scenes/cornell-box.toml";

/// Prints the areas.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let forms = forms(arguments)?;
    output::print(&match arguments.format {
        Format::Table => table(&forms, arguments.quadrature),
        Format::Json => json(&forms, arguments.quadrature),
    })?;
    Ok(Outcome::Fine)
}

/// The shapes asked for, each with a name.
fn forms(arguments: &Arguments) -> Result<Vec<(String, Form)>, Failure> {
    let named = |geometry: GeometryDescription| {
        let form = geometry
            .form(&Transform::IDENTITY)
            .map_err(|problem: Problem| Failure::message(problem.message))?;
        Ok(vec![(arguments.target.clone(), form)])
    };
    match arguments.target.as_str() {
        "rectangle" => named(rectangle(&arguments.sizes)?),
        "disc" => named(disc(&arguments.sizes)?),
        "sphere" => named(sphere(&arguments.sizes)?),
        "polygon" => named(polygon(&arguments.sizes)?),
        file if arguments.sizes.is_empty() => from_file(Path::new(file)),
        other => Err(Failure::message(format!(
            "`{other}` is no shape; expected rectangle, disc, sphere, polygon or a file"
        ))),
    }
}

fn from_file(path: &Path) -> Result<Vec<(String, Form)>, Failure> {
    let scene = load::scene(&PathBuf::from(path))?.scene;
    let shapes = scene.surfaces().shapes().iter().zip(0..);
    Ok(shapes
        .map(|(placed, id)| {
            (
                scene.shape_name(steradian::shape::ShapeId(id)).to_owned(),
                placed.form.clone(),
            )
        })
        .collect())
}

fn lengths<const N: usize>(sizes: &[String], expected: &str) -> Result<[f64; N], Failure> {
    let read = |text: &String| text.parse::<Length>().map(Length::to_metres);
    let lengths: Result<Vec<f64>, _> = sizes.iter().map(read).collect();
    let lengths = lengths.map_err(|error| Failure::Other(error.into()))?;
    lengths
        .try_into()
        .map_err(|_| Failure::message(format!("expected {expected}")))
}

fn rectangle(sizes: &[String]) -> Result<GeometryDescription, Failure> {
    let [width, height] = lengths(sizes, "a width and a height: area rectangle 2 \"50 cm\"")?;
    Ok(GeometryDescription::Rectangle {
        origin: Point::ORIGIN,
        edges: [Vector::new(width, 0.0, 0.0), Vector::new(0.0, height, 0.0)],
    })
}

fn disc(sizes: &[String]) -> Result<GeometryDescription, Failure> {
    let mut sizes = sizes.to_vec();
    if sizes.len() == 1 {
        sizes.push("0".to_owned());
    }
    let [radius, inner_radius] = lengths(
        &sizes,
        "a radius, and perhaps an inner radius: area disc 1 0.5",
    )?;
    Ok(GeometryDescription::Disc {
        center: Point::ORIGIN,
        normal: Vector::new(0.0, 0.0, 1.0),
        radius,
        inner_radius,
    })
}

fn sphere(sizes: &[String]) -> Result<GeometryDescription, Failure> {
    let [radius] = lengths(sizes, "a radius: area sphere \"20 cm\"")?;
    Ok(GeometryDescription::Sphere {
        center: Point::ORIGIN,
        radius,
        inside: false,
        ports: Vec::new(),
    })
}

fn polygon(sizes: &[String]) -> Result<GeometryDescription, Failure> {
    let corner = |text: &String| values::vector(text).map(|[x, y, z]| Point::new(x, y, z));
    let vertices: Result<Vec<Point>, _> = sizes
        .iter()
        .flat_map(|text| text.split_whitespace())
        .map(|text| corner(&text.to_owned()))
        .collect();
    Ok(GeometryDescription::Polygon {
        vertices: vertices.map_err(Failure::message)?,
        holes: Vec::new(),
    })
}

fn table(forms: &[(String, Form)], cells: u32) -> String {
    let headings = [
        "shape".to_owned(),
        "area (m2)".to_owned(),
        format!("by {cells} x {cells} cells"),
        "difference".to_owned(),
    ];
    let mut columns = Columns::new(headings);
    for (name, form) in forms {
        let area = form.area();
        let sum = quadrature::area(form, cells);
        let difference = sum.map(|sum| format!("{} %", significant(100.0 * (sum / area - 1.0), 2)));
        let sum = sum.map_or_else(|| "infinite".to_owned(), exact);
        columns.row([
            name.clone(),
            exact(area),
            sum,
            difference.unwrap_or_default(),
        ]);
    }
    columns.to_string()
}

fn json(forms: &[(String, Form)], cells: u32) -> String {
    let shape = |(name, form): &(String, Form)| {
        let area = Some(form.area()).filter(|area| area.is_finite());
        json!({
            "name": name,
            "value": area,
            "unit": "m2",
            "std_error": 0.0,
            "method": "closed-form",
            "quadrature": { "value": quadrature::area(form, cells), "cells": cells },
        })
    };
    let object = json!({ "shapes": forms.iter().map(shape).collect::<Vec<_>>() });
    format!("{object:#}\n")
}
