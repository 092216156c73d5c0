//! A parallel view of space on a sheet.

use steradian::geometry::{Direction, Spherical, Vector};
use steradian::quantity::Angle;
use steradian_io::report::svg::{Anchor, Stroke, Svg};

pub const INK: &str = "#333333";
pub const FAINT: &str = "#bbbbbb";
pub const BLUE: &str = "#0072B2";
pub const RED: &str = "#D55E00";

const SIZE: [f64; 2] = [560.0, 440.0];
const WORDS: f64 = 17.0;

/// A drawing seen from an azimuth and an elevation.
pub struct View {
    sheet: Svg,
    right: Vector,
    up: Vector,
    towards: Vector,
    origin: [f64; 2],
    scale: f64,
}

impl View {
    /// Seen from these angles in degrees; `origin` is the place on the sheet of the point 0, `scale` the pixels of 1.
    pub fn new(azimuth: f64, elevation: f64, origin: [f64; 2], scale: f64) -> Self {
        let towards = spherical(90.0 - elevation, azimuth);
        let right = spherical(90.0, azimuth + 90.0);
        let up = spherical(-elevation, azimuth);
        Self {
            sheet: Svg::new(SIZE[0], SIZE[1]),
            right,
            up,
            towards,
            origin,
            scale,
        }
    }

    fn place(&self, point: Vector) -> [f64; 2] {
        [
            self.origin[0] + self.scale * self.right.dot(point),
            self.origin[1] - self.scale * self.up.dot(point),
        ]
    }

    pub fn path(&mut self, points: &[Vector], colour: &str, width: f64) {
        let places: Vec<[f64; 2]> = points.iter().map(|&point| self.place(point)).collect();
        self.sheet.polyline(&places, &Stroke::new(colour, width));
    }

    pub fn dashes(&mut self, points: &[Vector], colour: &str) {
        let places: Vec<[f64; 2]> = points.iter().map(|&point| self.place(point)).collect();
        self.sheet
            .polyline(&places, &Stroke::new(colour, 1.2).dashed(5.0, 4.0));
    }

    /// A line on a sphere around 0: faint where it is behind.
    pub fn on_sphere(&mut self, points: &[Vector]) {
        let is_in_front = |pair: &[Vector]| self.towards.dot(pair[0] + pair[1]) >= 0.0;
        let steps: Vec<bool> = points.windows(2).map(is_in_front).collect();
        let mut start = 0;
        for run in steps.chunk_by(|a, b| a == b) {
            let (colour, width) = if run[0] {
                ("#888888", 0.9)
            } else {
                ("#dddddd", 0.7)
            };
            self.path(&points[start..=start + run.len()], colour, width);
            start += run.len();
        }
    }

    pub fn face(&mut self, outline: &[Vector], colour: &str, opacity: f64) {
        let places: Vec<[f64; 2]> = outline.iter().map(|&point| self.place(point)).collect();
        self.sheet
            .area(&[places], colour, opacity, Some(&Stroke::new(colour, 1.5)));
    }

    pub fn arrow(&mut self, from: Vector, to: Vector, colour: &str) {
        let [start, tip] = [self.place(from), self.place(to)];
        let along = [tip[0] - start[0], tip[1] - start[1]];
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
        let [x, y] = along.map(|part| part / length);
        let corner = |side: f64| [tip[0] - 11.0 * x - side * y, tip[1] - 11.0 * y + side * x];
        self.sheet.line(start, tip, &Stroke::new(colour, 2.0));
        self.sheet
            .area(&[vec![tip, corner(4.5), corner(-4.5)]], colour, 1.0, None);
    }

    pub fn dot(&mut self, point: Vector, colour: &str) {
        let place = self.place(point);
        self.sheet.circle(place, 3.5, colour, None);
    }

    /// Words beside a point, moved by pixels.
    pub fn label(&mut self, point: Vector, shift: [f64; 2], words: &str, colour: &str) {
        let [x, y] = self.place(point);
        let at = [x + shift[0], y + shift[1]];
        self.sheet.text(at, words, WORDS, Anchor::Middle, colour);
    }

    pub fn finish(self) -> String {
        self.sheet.finish()
    }
}

/// The unit vector of two angles in degrees.
pub fn spherical(theta: f64, phi: f64) -> Vector {
    let direction: Direction =
        Spherical::new(Angle::from_degrees(theta), Angle::from_degrees(phi)).to_direction();
    direction.to_vector()
}

/// The arc of a meridian.
pub fn meridian(phi: f64, theta: [f64; 2]) -> Vec<Vector> {
    steps(theta).map(|theta| spherical(theta, phi)).collect()
}

/// The arc of a parallel.
pub fn parallel(theta: f64, phi: [f64; 2]) -> Vec<Vector> {
    steps(phi).map(|phi| spherical(theta, phi)).collect()
}

/// The outline of a patch between two parallels and two meridians.
pub fn patch(theta: [f64; 2], phi: [f64; 2]) -> Vec<Vector> {
    let mut outline = parallel(theta[0], phi);
    outline.extend(meridian(phi[1], theta));
    outline.extend(parallel(theta[1], [phi[1], phi[0]]));
    outline.extend(meridian(phi[0], [theta[1], theta[0]]));
    outline
}

/// From one angle to another in steps of at most 5 degrees.
fn steps([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    let count = ((to - from).abs() / 5.0).ceil().max(1.0);
    (0..=count as u32).map(move |step| from + (to - from) * f64::from(step) / count)
}
