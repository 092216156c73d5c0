//! A reflectance for a colour.
//!
//! Linear Rec.709 says three numbers about a reflectance; the smooth one with these numbers is
//!
//! ```text
//! ρ(λ) = S(c₀ t² + c₁ t + c₂) ,   S(x) = ½ + x / (2 √(1 + x²)) ,   t = (λ − 560 nm)/100 nm ,
//! ```
//!
//! which is within 0 and 1 everywhere and whose three coefficients solve
//!
//! ```text
//! ∫ ρ(λ) D65(λ) r̄_i(λ) dλ / ∫ D65(λ) r̄_i(λ) dλ = rgb_i ,   i = 1, 2, 3 .
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ρ | reflectance | 1 |
//! | r̄_i | [functions of linear Rec.709](super::rgb_curves), 2° observer | 1 |
//! | rgb_i | the colour under D65; ρ = 1 is (1, 1, 1) | 1 |
//!
//! The equations are solved by Gauss–Newton steps, damped after Levenberg and Marquardt. A grey is flat and needs no
//! solver: x = (g − ½)/√(g (1 − g)).
//!
//! Source: W. Jakob, J. Hanika, *A low-dimensional function space for efficient spectral upsampling*, Computer Graphics
//! Forum 38 (2019), eq. 1–4. The range of a solution is 360 to 830 nm; nothing is known of a colour in the infrared.

use std::sync::LazyLock;

use super::colour::{inverse, triple_integral};
use super::{Beyond, Curve, CurveError, Illuminant, Observer, apply, rgb_curves};

/// Wavelength of t = 0, and that of t = 1 less that of t = 0, in nm.
const CENTRE: f64 = 560.0;
const SCALE: f64 = 100.0;
/// Wavelengths between which a colour is an integral, in nm.
const RANGE: [f64; 2] = [360.0, 830.0];
/// Steps of the solver at most. Some colours outside the cube have no solution.
const MAX_STEPS: usize = 100;
/// The argument of S for black (negative) and white: S is within 2.5·10⁻⁹ of 0 and 1.
const ALMOST: f64 = 1e4;

/// The reflectance S(c₀ t² + c₁ t + c₂).
///
/// ```
/// use steradian::spectrum::Sigmoid;
///
/// let grey = Sigmoid::from_rgb([0.2; 3]);
/// assert!((grey.at(400.0) - 0.2).abs() < 1e-15 && (grey.at(700.0) - 0.2).abs() < 1e-15);
/// let red = Sigmoid::from_rgb([0.6, 0.05, 0.05]);
/// assert!(red.at(450.0) < 0.1 && red.at(650.0) > 0.6);
/// assert!(red.to_rgb().iter().zip([0.6, 0.05, 0.05]).all(|(a, b)| (a - b).abs() < 1e-6));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sigmoid {
    /// The coefficients c₀, c₁, c₂.
    pub c: [f64; 3],
}

impl Sigmoid {
    /// The reflectance of a colour in linear Rec.709 under D65, each channel between 0 and 1.
    pub fn from_rgb(rgb: [f64; 3]) -> Self {
        if rgb[0] == rgb[1] && rgb[1] == rgb[2] {
            return Self::grey(rgb[0]);
        }
        let mean = (rgb[0] + rgb[1] + rgb[2]) / 3.0;
        Self::grey(mean).refined(rgb, &FINE, 1e-9)
    }

    fn grey(value: f64) -> Self {
        let x = (value - 0.5) / (value * (1.0 - value)).max(0.0).sqrt();
        Self {
            c: [0.0, 0.0, x.clamp(-ALMOST, ALMOST)],
        }
    }

    /// The reflectance at a wavelength in nm.
    pub fn at(&self, wavelength: f64) -> f64 {
        let t = (wavelength - CENTRE) / SCALE;
        let x = (self.c[0] * t + self.c[1]) * t + self.c[2];
        0.5 + 0.5 * x / (1.0 + x * x).sqrt()
    }

    /// Samples of the reflectance between two wavelengths, at most `step` nm apart.
    pub fn curve(&self, range: [f64; 2], step: f64) -> Result<Curve, CurveError> {
        Curve::from_function(range, step, Beyond::Held, |wavelength| self.at(wavelength))
    }

    /// Its colour: the integrals above, with ρ joined by parabolas every 5 nm.
    pub fn to_rgb(&self) -> [f64; 3] {
        let mut rgb = [0.0; 3];
        for Node { t, weights } in &FINE.0 {
            let value = self.at(CENTRE + SCALE * t);
            rgb = std::array::from_fn(|channel| rgb[channel] + weights[channel] * value);
        }
        rgb
    }

    /// The reflectance of a colour from that of one nearby, within 10⁻⁵ by a coarser quadrature.
    pub(super) fn towards(self, rgb: [f64; 3]) -> Self {
        if rgb[0] == rgb[1] && rgb[1] == rgb[2] {
            return Self::grey(rgb[0]);
        }
        self.refined(rgb, &COARSE, 1e-5)
    }

    /// Better coefficients for a colour, starting from these, until it is hit within `tolerance`.
    fn refined(self, rgb: [f64; 3], quadrature: &Quadrature, tolerance: f64) -> Self {
        let mut best = Linearised::new(self, rgb, quadrature);
        let mut damping = 1e-3;
        for _ in 0..MAX_STEPS {
            if best.error < tolerance * tolerance || damping > 1e12 {
                break;
            }
            let next = Linearised::new(best.step(damping), rgb, quadrature);
            if next.error < best.error {
                best = next;
                damping *= 0.1;
            } else {
                damping *= 10.0;
            }
        }
        best.sigmoid
    }
}

/// The reflectance at a wavelength in nm by single-precision coefficients, for textures: within 10⁻⁵ of [`Sigmoid::at`] as long
/// as the coefficients are below 10.
#[inline]
pub fn sigmoid_at(c: [f32; 3], wavelength: f32) -> f32 {
    let t = (wavelength - CENTRE as f32) / SCALE as f32;
    let x = (c[0] * t + c[1]) * t + c[2];
    0.5 + 0.5 * x / (1.0 + x * x).sqrt()
}

/// What a reflectance at some wavelengths adds to each channel: a quadrature of the colour.
struct Quadrature(Vec<Node>);

struct Node {
    /// Wavelength.
    t: f64,
    weights: [f64; 3],
}

/// Nodes every 2.5 nm: 10⁻⁴ for the steepest reflectances, the primaries, and 10⁻⁶ for mild ones.
static FINE: LazyLock<Quadrature> = LazyLock::new(|| Quadrature::new(2.5));
/// Nodes every 5 nm, for tables: 5·10⁻⁴ for the primaries.
static COARSE: LazyLock<Quadrature> = LazyLock::new(|| Quadrature::new(5.0));

impl Quadrature {
    /// Parabolas through three nodes at a time; a node's weight is the integral with the parabolas that are 1 there and 0
    /// at its neighbours.
    fn new(step: f64) -> Self {
        let light = Illuminant::D65.curve();
        let channels = rgb_curves(Observer::Cie1931);
        let white = channels
            .each_ref()
            .map(|channel| light.product_integral(channel, RANGE));
        let count = ((RANGE[1] - RANGE[0]) / step) as usize;
        let node = |index: usize| {
            let wavelength = RANGE[0] + step * index as f64;
            let shape = parabolas(wavelength, step, index % 2 == 1);
            let weight = |i: usize| triple_integral(light, &shape, &channels[i]) / white[i];
            Node {
                t: (wavelength - CENTRE) / SCALE,
                weights: std::array::from_fn(weight),
            }
        };
        Self((0..=count).map(node).collect())
    }
}

/// The function that is 1 at a node and a parabola on each panel of two steps, whose middle the node is, or its end.
fn parabolas(node: f64, step: f64, is_middle: bool) -> Curve {
    let value = |wavelength: f64| {
        let s = (wavelength - node).abs() / step;
        if is_middle {
            1.0 - s * s
        } else {
            (1.0 - s) * (1.0 - 0.5 * s)
        }
    };
    let reach = if is_middle { step } else { 2.0 * step };
    let range = [node - reach, node + reach];
    Curve::from_function(range, step / 20.0, Beyond::Zero, value).expect("a range of some nm")
}

/// A sigmoid with the distance of its colour from the one wanted, and the slopes of that distance.
struct Linearised {
    sigmoid: Sigmoid,
    /// Sum of squared distances.
    error: f64,
    /// Jᵀ e
    gradient: [f64; 3],
    /// Jᵀ J
    normal: [[f64; 3]; 3],
}

impl Linearised {
    fn new(sigmoid: Sigmoid, rgb: [f64; 3], quadrature: &Quadrature) -> Self {
        let [c0, c1, c2] = sigmoid.c;
        let mut distance = rgb.map(|channel| -channel);
        let mut slopes = [[0.0; 3]; 3];
        for Node { t, weights } in &quadrature.0 {
            let x = (c0 * t + c1) * t + c2;
            let root = 1.0 / (1.0 + x * x).sqrt();
            let value = 0.5 + 0.5 * x * root;
            let slope = 0.5 * root * root * root;
            for channel in 0..3 {
                let weighted = weights[channel] * slope;
                distance[channel] += weights[channel] * value;
                slopes[channel][0] += weighted * t * t;
                slopes[channel][1] += weighted * t;
                slopes[channel][2] += weighted;
            }
        }
        let column = |i: usize| slopes.map(|row| row[i]);
        Self {
            sigmoid,
            error: dot(distance, distance),
            gradient: std::array::from_fn(|i| dot(column(i), distance)),
            normal: std::array::from_fn(|i| std::array::from_fn(|j| dot(column(i), column(j)))),
        }
    }

    /// The Gauss–Newton step, with the diagonal raised by the share `damping`.
    fn step(&self, damping: f64) -> Sigmoid {
        let mut damped = self.normal;
        for i in 0..3 {
            damped[i][i] *= 1.0 + damping;
        }
        let step = apply(&inverse(&damped), self.gradient);
        Sigmoid {
            c: std::array::from_fn(|i| self.sigmoid.c[i] - step[i]),
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        let distances = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        distances.fold(0.0, f64::max)
    }

    /// The colour of straight lines every half nm, integrated exactly.
    fn seen(sigmoid: Sigmoid) -> [f64; 3] {
        let light = Illuminant::D65.curve();
        let reflectance = sigmoid.curve(RANGE, 0.5).unwrap();
        rgb_curves(Observer::Cie1931).map(|channel| {
            triple_integral(light, &reflectance, &channel) / light.product_integral(&channel, RANGE)
        })
    }

    /// No colour of the cube is out of reach: 11³ of them, black, white, edges and faces included, come back within 1e-8.
    #[test]
    fn every_colour_of_the_cube_comes_back() {
        let mut places = (0..11 * 11 * 11).map(|i| [i % 11, i / 11 % 11, i / 121]);
        let worst = places.try_fold(0.0, |worst: f64, place| {
            let rgb = place.map(|level| f64::from(level) / 10.0);
            let sigmoid = Sigmoid::from_rgb(rgb);
            let error = distance(sigmoid.to_rgb(), rgb);
            (error < 1e-8).then_some(worst.max(error)).ok_or(rgb)
        });
        assert!(worst.is_ok(), "{worst:?}");
    }

    /// The primaries are the steepest of the reflectances; lines of half a nm err by ρ'' h²/8, below 1e-5.
    #[test]
    fn the_quadrature_is_good_enough_for_the_steepest() {
        for rgb in [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
            [1, 1, 0],
            [0, 1, 1],
            [1, 0, 1],
        ] {
            let sigmoid = Sigmoid::from_rgb(rgb.map(f64::from));
            let error = distance(seen(sigmoid), rgb.map(f64::from));
            assert!(error < 1e-4, "{rgb:?} {error}");
        }
        let mild = [0.7, 0.3, 0.2];
        assert!(distance(seen(Sigmoid::from_rgb(mild)), mild) < 1e-6);
    }

    #[test]
    fn greys_are_flat() {
        for level in [0.0, 1e-9, 0.18, 0.5, 0.99, 1.0] {
            let grey = Sigmoid::from_rgb([level; 3]);
            assert_eq!(grey.c[..2], [0.0; 2]);
            assert!((grey.at(450.0) - level).abs() < 3e-9);
        }
        let nearly = Sigmoid::from_rgb([0.5, 0.5, 0.500_01]);
        assert!(
            [400.0, 500.0, 600.0, 700.0]
                .iter()
                .all(|&w| (nearly.at(w) - 0.5).abs() < 1e-4)
        );
    }

    /// Rounding of x: 3 operations on numbers up to 10 · 2.7², of S: slope ½.
    #[test]
    fn single_precision_is_enough() {
        for rgb in [[1.0, 0.0, 0.0], [0.2, 0.9, 0.1], [0.0; 3], [1.0; 3]] {
            let sigmoid = Sigmoid::from_rgb(rgb);
            let c = sigmoid.c.map(|c| c as f32);
            for wavelength in [380.0_f32, 500.0, 585.5, 700.0] {
                let exact = sigmoid.at(f64::from(wavelength));
                assert!((f64::from(sigmoid_at(c, wavelength)) - exact).abs() < 73.0 * 2e-7);
            }
        }
    }

    #[test]
    fn a_colour_that_is_none_is_no_panic() {
        for rgb in [
            [2.0, -1.0, 0.5],
            [f64::NAN, 0.5, 0.5],
            [f64::INFINITY, 0.0, 0.0],
            [-1.0; 3],
        ] {
            let value = Sigmoid::from_rgb(rgb).at(550.0);
            assert!(value.is_nan() || (0.0..=1.0).contains(&value));
        }
    }
}
