//! Pictures of numbers against numbers.

use std::f64::consts::PI;

use anyhow::Context;
use steradian::geometry::{
    Direction, Point, Polygon, PolygonError, configuration_factor, form_factor, solid_angle,
};
use steradian::quantity::{Angle, Length};
use steradian_course::LESSONS;
use steradian_io::report::plot::{Axis, LinePlot, Series};

use crate::view::spherical;

type Picture = anyhow::Result<String>;

/// A square of side 1 whose middle is at 0, tilted about the X axis by degrees.
fn tilted_square(degrees: f64) -> [Point; 4] {
    let up = spherical(90.0 - degrees, 90.0);
    [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
        .map(|(x, y)| Point::new(x, y * up.y, y * up.z))
}

/// Solid angle of the tilted square from a distance along the Z axis, in sr.
fn exact(degrees: f64, distance: f64) -> f64 {
    let observer = Point::new(0.0, 0.0, distance);
    solid_angle::of_polygon(observer, &tilted_square(degrees)).to_steradians()
}

/// A logarithmic row of numbers.
fn decades(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let step = libm::log(to / from) / 60.0;
    (0..=60).map(move |i| from * libm::exp(step * f64::from(i)))
}

pub fn foreshortening() -> Picture {
    let degrees = || (0..=90).step_by(2).map(f64::from);
    let cosine = degrees().map(|tilt| [tilt, Angle::from_degrees(tilt).cos()]);
    let from = |distance: f64| {
        let share = degrees().map(move |tilt| [tilt, exact(tilt, distance) * distance * distance]);
        Series::new(&format!("exact, from {distance} m"), share)
    };
    Ok(LinePlot::new(
        "A square of 1 m², tilted",
        Axis::new("tilt θ", "°").from_to(0.0, 90.0).tick_every(15.0),
        Axis::new("ω r² / A", ""),
    )
    .with(Series::new("cosθ", cosine).dashed())
    .with(from(1.0))
    .with(from(2.0))
    .with(from(8.0))
    .to_svg()?)
}

pub fn patch() -> Picture {
    let error = |degrees: f64| {
        let cosine = Angle::from_degrees(degrees).cos();
        let points = decades(0.01, 2.0).map(move |size| {
            let approximation = cosine * size * size;
            [
                size,
                (approximation / exact(degrees, 1.0 / size) - 1.0).abs(),
            ]
        });
        Series::new(&format!("tilted by {degrees}°"), points)
    };
    Ok(LinePlot::new(
        "How far A cosθ / r² is off",
        Axis::new("side / distance", "").logarithmic(),
        Axis::new("relative error", "").logarithmic(),
    )
    .with(error(0.0))
    .with(error(60.0))
    .to_svg()?)
}

/// The rows of a lesson's file, without the heading.
fn record(lesson: usize, file: &str) -> anyhow::Result<Vec<[f64; 2]>> {
    let mut files = LESSONS[lesson - 1].files.iter();
    let (_, text) = files
        .find(|(name, _)| *name == file)
        .with_context(|| format!("lesson {lesson} has no {file}"))?;
    let row = |line: &str| -> anyhow::Result<[f64; 2]> {
        let (x, y) = line.split_once(',').context("two numbers in a row")?;
        Ok([x.parse()?, y.parse()?])
    };
    text.lines().skip(1).map(row).collect()
}

pub fn energy() -> Picture {
    let flux = record(7, "lamp.csv")?;
    Ok(LinePlot::new(
        "The area under the line is the energy",
        Axis::new("time", "h").from_to(0.0, 12.0).tick_every(1.0),
        Axis::new("flux", "W").from_to(0.0, 50.0),
    )
    .with(Series::new("", flux))
    .to_svg()?)
}

pub fn flux() -> Picture {
    let energy = record(8, "meter.csv")?;
    Ok(LinePlot::new(
        "The slope of the line is the flux",
        Axis::new("time", "h").from_to(0.0, 6.0).tick_every(1.0),
        Axis::new("energy", "Wh").from_to(0.0, 140.0),
    )
    .with(Series::new("", energy))
    .to_svg()?)
}

pub fn irradiance() -> Picture {
    let lamp = square(2.0, 1.0, true)?;
    let mean = |side: f64| {
        let receiver = square(side, 0.0, false)?;
        Ok([side, PI * form_factor::between_polygons(&receiver, &lamp)])
    };
    let means: Result<Vec<[f64; 2]>, PolygonError> = decades(0.02, 2.0).map(mean).collect();
    let at_a_point =
        PI * configuration_factor::of_polygon(Point::ORIGIN, Direction::Z, lamp.outline());
    Ok(LinePlot::new(
        "Under a square of 2 m with L = 1 W/(m² sr), 1 m above",
        Axis::new("side of the receiving square", "m").logarithmic(),
        Axis::new("irradiance", "W/m²").from_to(1.2, 1.8),
    )
    .with(Series::new("mean of the square", means?))
    .with(Series::new("at its middle", [[0.02, at_a_point], [2.0, at_a_point]]).dashed())
    .to_svg()?)
}

/// A level square around the Z axis; its front looks down or up.
fn square(side: f64, height: f64, down: bool) -> Result<Polygon, PolygonError> {
    let half = side / 2.0;
    let sign = if down { -1.0 } else { 1.0 };
    let corner = |(x, y)| Point::new(sign * x * half, y * half, height);
    Polygon::new(
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(corner)
            .to_vec(),
        vec![],
    )
}

pub fn point_light() -> Picture {
    let from = |height: f64| {
        let places = (-30..=30).map(move |i| {
            let x = f64::from(i) / 10.0;
            let squared = x * x + height * height;
            [x, 100.0 * height / (squared * squared.sqrt())]
        });
        Series::new(&format!("{height} m above"), places)
    };
    Ok(LinePlot::new(
        "A point light of 100 W/sr over a plane",
        Axis::new("place", "m").from_to(-3.0, 3.0).tick_every(1.0),
        Axis::new("irradiance", "W/m²"),
    )
    .with(from(1.0))
    .with(from(1.5))
    .with(from(2.0))
    .to_svg()?)
}

pub fn radiance() -> Picture {
    let irradiance = |distance: f64| {
        let sine = Length::from_metres(0.5) / Length::from_metres(libm::hypot(0.5, distance));
        [distance, PI * sine * sine]
    };
    Ok(LinePlot::new(
        "A disc of radius 0.5 m with L = 1 W/(m² sr)",
        Axis::new("distance", "m").logarithmic(),
        Axis::new("L in W/(m² sr), E in W/m²", "").logarithmic(),
    )
    .with(Series::new(
        "radiance",
        decades(0.1, 10.0).map(|distance| [distance, 1.0]),
    ))
    .with(Series::new(
        "irradiance",
        decades(0.1, 10.0).map(irradiance),
    ))
    .with(
        Series::new(
            "π L R² / d²",
            decades(0.5, 10.0).map(|d| [d, PI * 0.25 / (d * d)]),
        )
        .dashed(),
    )
    .to_svg()?)
}
