//! Surfaces on the command line.

use steradian::exchange::Element;
use steradian::geometry::form_factor::Surface;
use steradian::geometry::{Direction, Point, Polygon, Vector};
use steradian::quantity::Length;

use crate::values;

/// `X,Y,Z,NX,NY,NZ`.
pub fn element(text: &str) -> Result<Element, String> {
    let [x, y, z, nx, ny, nz] = numbers(text, "a place and a normal such as 0,0,0,0,0,1")?;
    Ok(Element {
        position: Point::new(x, y, z),
        normal: direction([nx, ny, nz])?,
    })
}

/// `X,Y,Z X,Y,Z …`.
pub fn polygon(text: &str) -> Result<Surface, String> {
    let corners: Result<Vec<Point>, String> = text
        .split_whitespace()
        .map(|corner| values::vector(corner).map(Point::from))
        .collect();
    let polygon = Polygon::new(corners?, Vec::new()).map_err(|error| error.to_string())?;
    Ok(Surface::Polygon(polygon))
}

/// `CX,CY,CZ,NX,NY,NZ,R`.
pub fn disc(text: &str) -> Result<Surface, String> {
    let [x, y, z, nx, ny, nz, radius] = numbers(
        text,
        "a centre, a normal and a radius such as 0,0,2,0,0,-1,0.5",
    )?;
    Ok(Surface::Disc {
        center: Point::new(x, y, z),
        normal: direction([nx, ny, nz])?,
        radius: positive(radius)?,
    })
}

/// `CX,CY,CZ,R`.
pub fn sphere(text: &str) -> Result<Surface, String> {
    let [x, y, z, radius] = numbers(text, "a centre and a radius such as 0,0,2,0.5")?;
    Ok(Surface::Sphere {
        center: Point::new(x, y, z),
        radius: positive(radius)?,
    })
}

fn numbers<const N: usize>(text: &str, expected: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>())
        .collect();
    let finite = numbers
        .ok()
        .filter(|numbers| numbers.iter().all(|number| number.is_finite()));
    finite
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("expected {expected}"))
}

fn direction(normal: [f64; 3]) -> Result<Direction, String> {
    Direction::new(Vector::from(normal)).map_err(|error| error.to_string())
}

fn positive(radius: f64) -> Result<Length, String> {
    if radius > 0.0 {
        Ok(Length::from_metres(radius))
    } else {
        Err("expected a positive radius".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_surfaces_say_what_was_expected() {
        for (error, part) in [
            (element("0,0,0").unwrap_err(), "a place and a normal"),
            (element("0,0,0,0,0,0").unwrap_err(), "no direction"),
            (polygon("0,0,0 1,0,0").unwrap_err(), "at least 3"),
            (polygon("0,0,0 1,0,0 2,0,0").unwrap_err(), "no area"),
            (
                polygon("0,0,0 1,0,0 1,1,1 0,1,0").unwrap_err(),
                "off the plane",
            ),
            (polygon("0,0 1,0 1,1").unwrap_err(), "three numbers"),
            (disc("0,0,0,0,0,1").unwrap_err(), "a radius"),
            (disc("0,0,0,0,0,1,-2").unwrap_err(), "positive radius"),
            (sphere("0,0,0,nan").unwrap_err(), "a centre and a radius"),
        ] {
            assert!(error.contains(part), "{error}");
        }
        assert!(polygon("0,0,0 1,0,0\n1,1,0").is_ok());
    }
}
