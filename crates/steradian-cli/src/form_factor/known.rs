//! Configurations of the catalogues, by name.

use steradian::geometry::form_factor::{
    self, ClosedCylinder, ConcentricCylinders, DimensionError, Factor,
};
use steradian::quantity::{Angle, Length};
use steradian_io::report::columns::Columns;

use super::report::{Factors, Named};
use crate::status::Failure;

/// A configuration: its name, its sizes, what it is, and its factors.
struct Configuration {
    name: &'static str,
    keys: &'static [&'static str],
    what: &'static str,
    factors: fn(&Sizes) -> Result<Vec<Named>, Failure>,
}

const CONFIGURATIONS: [Configuration; 13] = [
    Configuration {
        name: "parallel-rectangles",
        keys: &["width", "height", "distance"],
        what: "two equal rectangles face to face",
        factors: |sizes| {
            let sides = [sizes.interval("width")?, sizes.interval("height")?];
            closed(form_factor::between_parallel_rectangles(
                sides,
                sides,
                sizes.length("distance")?,
            ))
        },
    },
    Configuration {
        name: "perpendicular-rectangles",
        keys: &["width", "height", "edge"],
        what: "a floor of this width and a wall of this height with a common edge",
        factors: |sizes| {
            let [width, height, edge] = [
                sizes.interval("width")?,
                sizes.interval("height")?,
                sizes.interval("edge")?,
            ];
            closed(form_factor::between_perpendicular_rectangles(
                [width, edge],
                [edge, height],
            ))
        },
    },
    Configuration {
        name: "hinged-rectangles",
        keys: &["width1", "width2", "edge", "angle"],
        what: "two rectangles with a common edge, at an angle",
        factors: |sizes| {
            let widths = [sizes.length("width1")?, sizes.length("width2")?];
            closed(form_factor::between_hinged_rectangles(
                widths,
                sizes.length("edge")?,
                sizes.angle("angle")?,
            ))
        },
    },
    Configuration {
        name: "coaxial-discs",
        keys: &["radius1", "radius2", "distance"],
        what: "two discs with a common axis, face to face",
        factors: |sizes| {
            let radii = [sizes.length("radius1")?, sizes.length("radius2")?];
            closed(form_factor::between_coaxial_discs(
                radii,
                sizes.length("distance")?,
            ))
        },
    },
    Configuration {
        name: "concentric-cylinders",
        keys: &["inner", "outer", "length"],
        what: "a cylinder around another of the same length, open at the ends",
        factors: concentric_cylinders,
    },
    Configuration {
        name: "closed-cylinder",
        keys: &["radius", "height"],
        what: "the inside of a cylinder and its two ends",
        factors: closed_cylinder,
    },
    Configuration {
        name: "parallel-cylinders",
        keys: &["radius1", "radius2", "distance"],
        what: "two endless cylinders side by side, by the distance of their axes",
        factors: |sizes| {
            let radii = [sizes.length("radius1")?, sizes.length("radius2")?];
            closed(form_factor::between_parallel_cylinders(
                radii,
                sizes.length("distance")?,
            ))
        },
    },
    Configuration {
        name: "spheres",
        keys: &["radius1", "radius2", "distance"],
        what: "two spheres side by side, by the distance of their centres; a single integral",
        factors: |sizes| {
            let radii = [sizes.length("radius1")?, sizes.length("radius2")?];
            let value =
                form_factor::between_spheres(radii, sizes.length("distance")?).map_err(refused)?;
            Ok(vec![Named {
                name: "F12",
                factor: Factor {
                    value,
                    error: 1e-11 * value,
                },
            }])
        },
    },
    Configuration {
        name: "concentric-spheres",
        keys: &["inner", "outer"],
        what: "from the inside of a sphere to a smaller one in it",
        factors: |sizes| {
            closed(form_factor::from_outer_to_inner_sphere(
                sizes.length("inner")?,
                sizes.length("outer")?,
            ))
        },
    },
    Configuration {
        name: "sphere-coaxial-disc",
        keys: &["sphere", "disc", "distance"],
        what: "from a sphere to a disc whose axis passes through its centre",
        factors: |sizes| {
            let [sphere, disc] = [sizes.length("sphere")?, sizes.length("disc")?];
            closed(form_factor::from_sphere_to_coaxial_disc(
                sphere,
                disc,
                sizes.length("distance")?,
            ))
        },
    },
    Configuration {
        name: "spherical-cap",
        keys: &["half_angle"],
        what: "from the inside of a sphere's cap to itself",
        factors: |sizes| closed(form_factor::of_cap_to_itself(sizes.angle("half_angle")?)),
    },
    Configuration {
        name: "parallel-strips",
        keys: &["width", "distance"],
        what: "two equal endless strips face to face",
        factors: |sizes| {
            closed(form_factor::between_parallel_strips(
                sizes.length("width")?,
                sizes.length("distance")?,
            ))
        },
    },
    Configuration {
        name: "wedge",
        keys: &["width1", "width2", "angle"],
        what: "the two sides of an endless wedge",
        factors: |sizes| {
            let widths = [sizes.length("width1")?, sizes.length("width2")?];
            closed(form_factor::between_wedge_sides(
                widths,
                sizes.angle("angle")?,
            ))
        },
    },
];

/// All configurations, for people.
pub fn list() -> String {
    let mut columns = Columns::new(["name", "sizes", "what it is"]);
    for known in &CONFIGURATIONS {
        let keys = known
            .keys
            .iter()
            .map(|key| format!("{key}="))
            .collect::<Vec<_>>();
        columns.row([known.name.to_owned(), keys.join(" "), known.what.to_owned()]);
    }
    columns.to_string()
}

/// The factors of `NAME KEY=VALUE …`.
pub fn factors(words: &[String]) -> Result<Factors, Failure> {
    let [name, sizes @ ..] = words else {
        return Err(Failure::message(
            "give the name of a configuration; --known list prints them all",
        ));
    };
    let known = CONFIGURATIONS
        .iter()
        .find(|known| known.name == name)
        .ok_or_else(|| {
            Failure::message(format!(
                "`{name}` is no known configuration; --known list prints them all"
            ))
        })?;
    Ok(Factors::several((known.factors)(&Sizes::read(
        known, sizes,
    )?)?))
}

/// The sizes given for a configuration.
struct Sizes<'a>(Vec<(&'a str, &'a str)>);

impl<'a> Sizes<'a> {
    fn read(known: &Configuration, words: &'a [String]) -> Result<Self, Failure> {
        let expected = || format!("{} needs {}", known.name, known.keys.join("=, ") + "=");
        let pairs: Option<Vec<(&str, &str)>> =
            words.iter().map(|word| word.split_once('=')).collect();
        let pairs = pairs.ok_or_else(|| Failure::message(expected()))?;
        let count = |key: &str| pairs.iter().filter(|(given, _)| *given == key).count();
        if pairs.len() == known.keys.len() && known.keys.iter().all(|key| count(key) == 1) {
            Ok(Self(pairs))
        } else {
            Err(Failure::message(expected()))
        }
    }

    fn text(&self, key: &str) -> &str {
        self.0
            .iter()
            .find(|(given, _)| *given == key)
            .map_or("", |(_, value)| value)
    }

    fn length(&self, key: &str) -> Result<Length, Failure> {
        self.text(key)
            .parse()
            .map_err(|error| Failure::message(format!("{key}: {error}")))
    }

    fn angle(&self, key: &str) -> Result<Angle, Failure> {
        self.text(key)
            .parse()
            .map_err(|error| Failure::message(format!("{key}: {error}")))
    }

    /// From 0 to this length.
    fn interval(&self, key: &str) -> Result<[Length; 2], Failure> {
        Ok([Length::ZERO, self.length(key)?])
    }
}

fn refused(error: DimensionError) -> Failure {
    Failure::message(error.to_string())
}

fn closed(value: Result<f64, DimensionError>) -> Result<Vec<Named>, Failure> {
    Ok(vec![exact("F12", value.map_err(refused)?)])
}

fn exact(name: &'static str, value: f64) -> Named {
    Named {
        name,
        factor: Factor { value, error: 0.0 },
    }
}

fn concentric_cylinders(sizes: &Sizes) -> Result<Vec<Named>, Failure> {
    let [inner, outer] = [sizes.length("inner")?, sizes.length("outer")?];
    let cylinders =
        ConcentricCylinders::new(inner, outer, sizes.length("length")?).map_err(refused)?;
    Ok(vec![
        exact("outer to inner", cylinders.outer_to_inner()),
        exact("outer to itself", cylinders.outer_to_outer()),
        exact("outer to ends", cylinders.outer_to_ends()),
        exact("inner to outer", cylinders.inner_to_outer()),
        exact("inner to ends", cylinders.inner_to_ends()),
    ])
}

fn closed_cylinder(sizes: &Sizes) -> Result<Vec<Named>, Failure> {
    let cylinder =
        ClosedCylinder::new(sizes.length("radius")?, sizes.length("height")?).map_err(refused)?;
    Ok(vec![
        exact("end to end", cylinder.end_to_end()),
        exact("end to side", cylinder.end_to_side()),
        exact("side to one end", cylinder.side_to_end()),
        exact("side to side", cylinder.side_to_side()),
    ])
}
