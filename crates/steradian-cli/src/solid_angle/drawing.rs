//! The picture of a solid angle: the object's projection on the unit sphere around the observer, with a graticule.

use steradian::geometry::{Direction, Point, Spherical, Vector};
use steradian::quantity::{Angle, SolidAngle};
use steradian_io::report::numbers::significant;
use steradian_io::report::svg::{Anchor, Stroke, Svg};

use super::object::Object;
use super::outline;
use super::projection::{Half, Projection};
use crate::status::Failure;

const SIZE: [f64; 2] = [640.0, 680.0];
const CENTER: [f64; 2] = [320.0, 330.0];
const RADIUS: f64 = 270.0;
/// Degrees between lines of the graticule.
const SPACING: u32 = 15;
const LABELLED: u32 = 30;
const INK: &str = "#222222";
const FILL: &str = "#d55e00";

/// The sheet.
pub fn draw(object: &Object, observer: Point, solid_angle: SolidAngle) -> Result<String, Failure> {
    let outlines = outline::outlines(object, observer)?;
    // One outline bounds two areas, of which more than a hemisphere is the larger.
    let is_rest = outlines.len() < 2 && solid_angle > SolidAngle::HEMISPHERE;
    let projection = Projection::towards(middle(&outlines, is_rest), CENTER, RADIUS);
    let mut sheet = Svg::new(SIZE[0], SIZE[1]);
    sheet.circle(CENTER, RADIUS, "#f5f8fb", Some(&Stroke::new(INK, 1.5)));
    graticule(&mut sheet, &projection, Half::Back);
    fill(&mut sheet, &projection, Half::Back, &outlines, is_rest);
    sheet.circle(CENTER, 3.0, INK, None);
    axes(&mut sheet, &projection);
    fill(&mut sheet, &projection, Half::Front, &outlines, is_rest);
    graticule(&mut sheet, &projection, Half::Front);
    labels(&mut sheet, &projection);
    caption(&mut sheet, observer, solid_angle);
    Ok(sheet.finish())
}

/// The mean direction of what is drawn; Z where there is none, as of a hemisphere.
fn middle(outlines: &[Vec<Direction>], is_rest: bool) -> Direction {
    let all = outlines.iter().flatten();
    let sum = all
        .clone()
        .fold(Vector::ZERO, |sum, &direction| sum + direction.into());
    let mean = sum / all.count().max(1) as f64;
    let middle = Direction::new(mean).ok().filter(|_| mean.length() > 1e-9);
    middle.map_or(
        Direction::Z,
        |middle| if is_rest { -middle } else { middle },
    )
}

fn fill(
    sheet: &mut Svg,
    projection: &Projection,
    half: Half,
    outlines: &[Vec<Direction>],
    is_rest: bool,
) {
    let (opacity, width) = if half == Half::Front {
        (0.75, 1.2)
    } else {
        (0.25, 0.6)
    };
    let stroke = Stroke::new("#8a3d00", width);
    let areas = outlines
        .iter()
        .filter_map(|outline| projection.area(half, outline));
    if is_rest {
        let rings: Vec<_> = areas.chain([projection.limb()]).collect();
        sheet.area(&rings, FILL, opacity, Some(&stroke));
        return;
    }
    for area in areas {
        sheet.area(&[area], FILL, opacity, Some(&stroke));
    }
}

fn at(theta: f64, phi: f64) -> Direction {
    Spherical::new(Angle::from_degrees(theta), Angle::from_degrees(phi)).to_direction()
}

fn graticule(sheet: &mut Svg, projection: &Projection, half: Half) {
    let colour = if half == Half::Front {
        "#7d8fa3"
    } else {
        "#d3dce6"
    };
    let stroke = |degrees: u32| {
        let is_main = degrees.is_multiple_of(LABELLED);
        Stroke::new(colour, if is_main { 0.9 } else { 0.45 })
    };
    for degrees in (SPACING..180).step_by(SPACING as usize) {
        let parallel: Vec<Direction> = (0..=360)
            .map(|phi| at(f64::from(degrees), f64::from(phi)))
            .collect();
        lines(sheet, projection, half, &parallel, &stroke(degrees));
    }
    for degrees in (0..360).step_by(SPACING as usize) {
        let meridian: Vec<Direction> = (0..=180)
            .map(|theta| at(f64::from(theta), f64::from(degrees)))
            .collect();
        lines(sheet, projection, half, &meridian, &stroke(degrees));
    }
}

fn lines(
    sheet: &mut Svg,
    projection: &Projection,
    half: Half,
    line: &[Direction],
    stroke: &Stroke,
) {
    for run in projection.runs(half, line) {
        sheet.polyline(&run, stroke);
    }
}

/// From the observer to where X, Y and Z leave the sphere.
fn axes(sheet: &mut Svg, projection: &Projection) {
    for (axis, name) in [
        (Direction::X, "x"),
        (Direction::Y, "y"),
        (Direction::Z, "z"),
    ] {
        let end = projection.place(axis);
        let stroke = Stroke::new(INK, 1.0);
        sheet.line(CENTER, end, &stroke.dashed(4.0, 3.0));
        let beyond = [0, 1].map(|i| CENTER[i] + (end[i] - CENTER[i]) * 1.07);
        sheet.text(
            [beyond[0], beyond[1] + 5.0],
            name,
            15.0,
            Anchor::Middle,
            INK,
        );
    }
}

/// Degrees of φ on the equator and of θ on a meridian, where they are in front.
fn labels(sheet: &mut Svg, projection: &Projection) {
    let mut label = |direction: Direction, degrees: u32| {
        if projection.is_on(Half::Front, direction) {
            let [x, y] = projection.place(direction);
            sheet.text(
                [x + 3.0, y - 3.0],
                &format!("{degrees}°"),
                11.0,
                Anchor::Start,
                "#44566b",
            );
        }
    };
    for degrees in (0..360).step_by(LABELLED as usize) {
        label(at(90.0, f64::from(degrees)), degrees);
    }
    let meridian = projection.front_meridian(f64::from(LABELLED));
    for degrees in (LABELLED..180)
        .step_by(LABELLED as usize)
        .filter(|&degrees| degrees != 90)
    {
        label(at(f64::from(degrees), meridian), degrees);
    }
}

fn caption(sheet: &mut Svg, observer: Point, solid_angle: SolidAngle) {
    let share = significant(100.0 * (solid_angle / SolidAngle::SPHERE), 4);
    let text = format!(
        "ω = {} sr, {share} % of the sphere",
        significant(solid_angle.to_steradians(), 6)
    );
    sheet.text(
        [CENTER[0], SIZE[1] - 36.0],
        &text,
        17.0,
        Anchor::Middle,
        INK,
    );
    let place = observer.to_array().map(|x| significant(x, 6)).join(", ");
    let text = format!("seen from ({place}) m; θ from z, φ from x");
    sheet.text(
        [CENTER[0], SIZE[1] - 14.0],
        &text,
        12.0,
        Anchor::Middle,
        "#44566b",
    );
}
