//! Closed forms that need no scene, beside numbers found otherwise.

use std::f64::consts::{FRAC_PI_2, PI};

use steradian::geometry::{
    Bounds, Direction, Point, Polygon, configuration_factor, form_factor, solid_angle,
};
use steradian::quantity::{Angle, Energy, Flux, Length, SolidAngle, Time};
use steradian::time::{Interval, Rule, Series, Waveform};

use crate::status::Failure;

/// A value with what it must be.
pub struct Formula {
    /// What it is of.
    pub name: &'static str,
    /// The quantity.
    pub quantity: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// What theory, or a table, says.
    pub expected: f64,
    /// What this program says.
    pub found: f64,
}

/// All of them.
pub fn all() -> Result<Vec<Formula>, Failure> {
    let groups = [
        solid_angles()?,
        configuration_factors(),
        form_factors()?,
        energies()?,
    ];
    Ok(groups.into_iter().flatten().collect())
}

fn solid_angles() -> Result<Vec<Formula>, Failure> {
    let row = |name, expected, found: SolidAngle| Formula {
        name,
        quantity: "solid angle",
        unit: "sr",
        expected,
        found: found.to_steradians(),
    };
    let eye = Point::ORIGIN;
    let metre = Length::from_metres(1.0);
    let cube = Bounds::around([Point::new(1.0, -1.0, -1.0), Point::new(3.0, 1.0, 1.0)]);
    let axes = [Direction::X, Direction::Y, Direction::Z];
    let octant = solid_angle::of_spherical_polygon(&axes)
        .map_err(|error| Failure::message(error.to_string()))?;
    let disc = |aside, height| {
        solid_angle::of_disc(eye, Point::new(aside, 0.0, height), Direction::Z, metre)
    };
    Ok(vec![
        row(
            "sphere of 1 m, 2 m away",
            2.0 * PI * (1.0 - 0.75_f64.sqrt()),
            solid_angle::of_sphere(eye, Point::new(0.0, 0.0, 2.0), metre),
        ),
        row(
            "cap of 60 deg",
            PI,
            solid_angle::of_cap(Angle::from_degrees(60.0)),
        ),
        // Integrated numerically.
        row("disc off its axis", 1.637_103_549_345_426_5, disc(0.5, 1.0)),
        row("disc farther off", 0.325_800_248_453_458_3, disc(2.0, 1.0)),
        row(
            "cube before its face",
            4.0 * PI / 6.0,
            solid_angle::of_box(eye, &cube),
        ),
        row("octant", FRAC_PI_2, octant),
    ])
}

fn configuration_factors() -> Vec<Formula> {
    let row = |name, expected, found| Formula {
        name,
        quantity: "configuration factor",
        unit: "1",
        expected,
        found,
    };
    let up = Direction::Z;
    let metre = Length::from_metres(1.0);
    let overhead =
        configuration_factor::of_sphere(Point::ORIGIN, up, Point::new(0.0, 0.0, 2.0), metre);
    let square = corners(
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        |[x, y]| [x, y, 1.0],
    );
    vec![
        row("sphere overhead", 0.25, overhead),
        // (4/π)(1/√2) atan(1/√2)
        row(
            "square overhead",
            0.554_126_423_979_571_9,
            configuration_factor::of_polygon(Point::ORIGIN, up, &square),
        ),
    ]
}

const UNIT_SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

fn corners(outline: [[f64; 2]; 4], place: impl Fn([f64; 2]) -> [f64; 3]) -> [Point; 4] {
    outline.map(|corner| place(corner).into())
}

fn square(place: impl Fn([f64; 2]) -> [f64; 3]) -> Result<Polygon, Failure> {
    let corners = corners(UNIT_SQUARE, place).to_vec();
    Polygon::new(corners, Vec::new()).map_err(|error| Failure::message(error.to_string()))
}

fn form_factors() -> Result<Vec<Formula>, Failure> {
    let row = |name, expected, found| Formula {
        name,
        quantity: "form factor",
        unit: "1",
        expected,
        found,
    };
    // The faces of a unit cube, their fronts inside.
    let floor = square(|[x, y]| [x, y, 0.0])?;
    let ceiling = square(|[x, y]| [y, x, 1.0])?;
    let walls = [
        square(|[y, z]| [0.0, y, z])?,
        square(|[z, y]| [1.0, y, z])?,
        square(|[z, x]| [x, 0.0, z])?,
        square(|[x, z]| [x, 1.0, z])?,
    ];
    let to = |other: &Polygon| form_factor::between_polygons(&floor, other);
    let sum = to(&ceiling) + walls.iter().map(to).sum::<f64>();
    Ok(vec![
        row(
            "parallel unit squares",
            0.199_824_895_698_387_46,
            to(&ceiling),
        ),
        row(
            "unit squares at right angles",
            0.200_043_776_075_403_13,
            to(&walls[0]),
        ),
        row("all walls of a cube", 1.0, sum),
    ])
}

fn energies() -> Result<Vec<Formula>, Failure> {
    let row = |name, expected, found: Energy| Formula {
        name,
        quantity: "energy",
        unit: "J",
        expected,
        found: found.to_joules(),
    };
    let seconds = |seconds| Interval::lasting(Time::from_seconds(seconds), Time::ZERO);
    let record = [(0.0, 0.0), (10.0, 100.0), (30.0, 0.0)]
        .map(|(time, flux)| (Time::from_seconds(time), Flux::from_watts(flux)));
    let decay = Waveform::Exponential {
        initial: Flux::from_watts(5.0),
        time_constant: Time::from_seconds(2.0),
    };
    let duty = Waveform::DutyCycle {
        on: Flux::from_watts(100.0),
        period: Time::from_seconds(3600.0),
        duty: 0.5,
    };
    Ok(vec![
        row(
            "flux that rises to 100 W and falls",
            1500.0,
            Series::new(record, Rule::Linear)?.integral(seconds(30.0)?)?,
        ),
        row(
            "flux of 5 W that decays",
            10.0 * (1.0 - libm::exp(-5.0)),
            decay.integral(seconds(10.0)?)?,
        ),
        row(
            "lamp of 100 W, on half of each hour",
            450e3,
            duty.integral(seconds(2.25 * 3600.0)?)?,
        ),
    ])
}
