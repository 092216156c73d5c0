//! Colour: tristimulus values and linear Rec.709.
//!
//! ```text
//! X = ∫ ρ(λ) E(λ) x̄(λ) dλ ,  likewise Y and Z ;      x = X/(X + Y + Z) ,  y = Y/(X + Y + Z)
//!
//! (X, Y, Z) = M (R, G, B) ,  M = [P_R P_G P_B] · diag(s) ,  P_i = (x_i/y_i, 1, (1 − x_i − y_i)/y_i) ,  M (1,1,1) = W
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E | emission a nm | a radiometric unit a nm |
//! | ρ | reflectance, 1 if there is none | 1 |
//! | x̄, ȳ, z̄ | colour-matching functions | 1 |
//! | X, Y, Z | tristimulus values, without the factor 683 lm/W | that unit |
//! | P_i, W | primaries, and the white (0.3127, 0.3290) with Y = 1 | 1 |
//!
//! M follows from the chromaticities of ITU-R BT.709-6, item 1.3 and 1.4 (H. Grassmann's laws; Wyszecki & Stiles,
//! *Color Science*, 1982, §3.2.3). Its second row is 0.2126, 0.7152, 0.0722 to four digits.
//!
//! Integrals are exact for the straight lines between samples. ASTM E308 instead adds products every 5 or 10 nm with
//! weights for a cubic through the samples; for tables of 5 nm the two differ by some 10⁻⁵ in x and y, and for lamps with
//! spectral lines by 2·10⁻⁴.

use super::{Curve, Observer};

/// Chromaticities of red, green and blue.
const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
/// Chromaticity of white, which is D65.
const WHITE: [f64; 2] = [0.3127, 0.3290];

/// A 3 × 3 matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// Tristimulus values of light on a surface, or of the light alone.
///
/// ```
/// use steradian::spectrum::{Curve, Illuminant, Observer, chromaticity, xyz_of};
///
/// let light = Illuminant::D65.curve();
/// let [x, y] = chromaticity(xyz_of(light, None, Observer::Cie1931));
/// assert!((x - 0.3127).abs() < 5e-5 && (y - 0.3290).abs() < 5e-5);
/// let grey = xyz_of(light, Some(&Curve::constant(0.5)), Observer::Cie1931);
/// assert_eq!(chromaticity(grey), [x, y]);
/// ```
pub fn xyz_of(emission: &Curve, reflectance: Option<&Curve>, observer: Observer) -> [f64; 3] {
    observer
        .curves()
        .each_ref()
        .map(|sensitivity| match reflectance {
            None => emission.product_integral(sensitivity, sensitivity.range()),
            Some(reflectance) => triple_integral(emission, reflectance, sensitivity),
        })
}

/// ∫ f g h dλ over the range of h: a cubic between neighbouring samples, for which Simpson's rule is exact too.
pub(super) fn triple_integral(f: &Curve, g: &Curve, h: &Curve) -> f64 {
    let places = super::curve::breakpoints(&[f, g, h], h.range());
    let pieces = places.windows(2).map(|piece| {
        let (start, end) = (piece[0], piece[1]);
        let [a, b, c] = [f, g, h].map(|curve| curve.limits(start, end));
        let middle = (a[0] + a[1]) * (b[0] + b[1]) * (c[0] + c[1]) / 8.0;
        (end - start) * (a[0] * b[0] * c[0] + 4.0 * middle + a[1] * b[1] * c[1]) / 6.0
    });
    pieces.sum()
}

/// Chromaticity (x, y); NaN for black.
pub fn chromaticity(xyz: [f64; 3]) -> [f64; 2] {
    let sum = xyz[0] + xyz[1] + xyz[2];
    [xyz[0] / sum, xyz[1] / sum]
}

/// The matrix that takes linear Rec.709 to X, Y, Z.
pub fn xyz_from_rgb() -> Matrix {
    let stimulus = |[x, y]: [f64; 2]| [x / y, 1.0, (1.0 - x - y) / y];
    let primaries = transpose(PRIMARIES.map(stimulus));
    let scale = apply(&inverse(&primaries), stimulus(WHITE));
    primaries.map(|row| [row[0] * scale[0], row[1] * scale[1], row[2] * scale[2]])
}

/// The matrix that takes X, Y, Z to linear Rec.709.
///
/// ```
/// use steradian::spectrum::{apply, rgb_from_xyz};
/// // Y = 1 of the white point.
/// let white = apply(&rgb_from_xyz(), [0.3127 / 0.3290, 1.0, 0.3583 / 0.3290]);
/// assert!(white.iter().all(|channel| (channel - 1.0).abs() < 1e-14));
/// ```
pub fn rgb_from_xyz() -> Matrix {
    inverse(&xyz_from_rgb())
}

/// The product of a matrix and a column.
pub fn apply(matrix: &Matrix, column: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * column[0] + row[1] * column[1] + row[2] * column[2])
}

/// The three curves whose integrals with a light are its linear Rec.709 channels.
///
/// Each is a sum of x̄, ȳ, z̄ with the weights of a row of [`rgb_from_xyz`], and is negative somewhere: no light of one
/// wavelength lies within the primaries. The luminance 0.2126 R + 0.7152 G + 0.0722 B is ∫ E ȳ dλ.
pub fn rgb_curves(observer: Observer) -> [Curve; 3] {
    let [x, y, z] = observer.curves();
    rgb_from_xyz().map(|row| {
        let columns = x.values().iter().zip(y.values()).zip(z.values());
        let values = columns.map(|((x, y), z)| row[0] * x + row[1] * y + row[2] * z);
        let samples = x.wavelengths().iter().copied().zip(values).collect();
        Curve::new(samples, x.beyond()).expect("the observer's wavelengths are in order")
    })
}

fn transpose(m: Matrix) -> Matrix {
    std::array::from_fn(|row| std::array::from_fn(|column| m[column][row]))
}

/// The inverse, by cofactors; not finite if the matrix has none.
pub(super) fn inverse(m: &Matrix) -> Matrix {
    let cofactor = |row: usize, column: usize| {
        let (r1, r2) = ((row + 1) % 3, (row + 2) % 3);
        let (c1, c2) = ((column + 1) % 3, (column + 2) % 3);
        m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
    };
    let determinant: f64 = (0..3)
        .map(|column| m[0][column] * cofactor(0, column))
        .sum();
    std::array::from_fn(|row| std::array::from_fn(|column| cofactor(column, row) / determinant))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Beyond, Illuminant, blackbody};

    fn distance<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
        let distances = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        distances.fold(0.0, f64::max)
    }

    /// Values of both at every `step` between 360 and 780 nm, multiplied and added, those of the light held at its ends:
    /// the practice of ASTM E308-15, §7.1, for tables of 1 and 5 nm.
    fn added(light: &Curve, step: f64) -> [f64; 3] {
        let [low, high] = light.range();
        let count = (420.0 / step) as usize;
        let places = (0..=count).map(|index| 360.0 + step * index as f64);
        let sum = |curve: &Curve| {
            let products = places
                .clone()
                .map(|w| curve.at(w) * light.at(w.clamp(low, high)));
            products.sum()
        };
        Observer::Cie1931.curves().each_ref().map(sum)
    }

    /// Added in the practice of ASTM E308 they are those that another program finds, but for the digits of the tables of
    /// A (six) and of D (three or four decimals), where we use the laws. The exact integral is as close to the
    /// chromaticities that CIE 15 states as their four digits (A: five) allow; for lamps with lines, which a table every
    /// 5 nm cannot show, the two rules differ by 2.4e-4.
    #[test]
    fn illuminants_have_their_chromaticities() {
        for (illuminant, reference, table_error, published, rule_error) in [
            (
                Illuminant::A,
                [0.4475714334451141, 0.40744043259459417],
                3e-7,
                [0.44758, 0.40745],
                1.5e-5,
            ),
            (
                Illuminant::D50,
                [0.3456680370292732, 0.35849683893761874],
                3e-7,
                [0.3457, 0.3585],
                5e-5,
            ),
            (
                Illuminant::D65,
                [0.31271106772165347, 0.3290084840786826],
                3e-7,
                [0.3127, 0.3290],
                5e-5,
            ),
            (
                Illuminant::Fl2,
                [0.37206556365718607, 0.37511770045390885],
                1e-14,
                [0.3721, 0.3751],
                3e-4,
            ),
            (
                Illuminant::Fl11,
                [0.38053539173923306, 0.3769115268697814],
                1e-14,
                [0.3805, 0.3769],
                3e-4,
            ),
        ] {
            let light = illuminant.curve();
            let astm = chromaticity(added(light, 5.0));
            let exact = chromaticity(xyz_of(light, None, Observer::Cie1931));
            assert!(
                distance(astm, reference) < table_error,
                "{illuminant:?} {astm:?}"
            );
            assert!(
                distance(exact, published) < rule_error,
                "{illuminant:?} {exact:?}"
            );
        }
    }

    /// The 24 patches: name, X, Y, Z under D65 with Y = 100 for white, and reflectances every 10 nm from 380 to 730 nm.
    const PATCHES: &str = include_str!("../../data/spectra/colorchecker.csv");

    fn patches() -> impl Iterator<Item = (&'static str, [f64; 3], Vec<f64>)> {
        let lines = PATCHES.lines().filter(|line| !line.starts_with('#'));
        lines.map(|line| {
            let (name, numbers) = line.split_once(',').unwrap();
            let numbers: Vec<f64> = numbers.split(',').map(|x| x.parse().unwrap()).collect();
            let (xyz, samples) = numbers.split_first_chunk().unwrap();
            (name, *xyz, samples.to_vec())
        })
    }

    /// The cubic through four samples around w (three at the ends), as ASTM E308 has it.
    fn lagrange(samples: &[f64], w: f64) -> f64 {
        let place = (w - 380.0) / 10.0;
        let before = (place as usize).min(samples.len() - 2);
        let nodes = before.saturating_sub(1)..(before + 3).min(samples.len());
        let term = |i: usize| {
            let factors = nodes.clone().filter(|j| *j != i);
            samples[i]
                * factors
                    .map(|j| (place - j as f64) / (i as f64 - j as f64))
                    .product::<f64>()
        };
        nodes.clone().map(term).sum()
    }

    /// In the practice of ASTM E308 (the cubic between the samples, added every nm from 360 to 780) they are the reference's
    /// but for the digits of its table of D65, for which we use the law: 3e-7 of the chromaticity, here of 100. The exact
    /// integral goes on to 830 nm, which adds some 3e-3 of 100; straight lines between samples 10 nm apart cut the corners by
    /// up to .12.
    #[test]
    fn patches_have_their_tristimulus_values() {
        let light = Illuminant::D65.curve();
        let white = added(light, 1.0)[1];
        let exact_white = xyz_of(light, None, Observer::Cie1931)[1];
        assert_eq!(patches().count(), 24);
        for (name, reference, samples) in patches() {
            let through = |step: f64| {
                let shape = |w| lagrange(&samples, w);
                Curve::from_function([380.0, 730.0], step, Beyond::Held, shape).unwrap()
            };
            let practice = added(&light.times(&through(1.0)), 1.0);
            let practice = practice.map(|value| 100.0 * value / white);
            assert!(distance(practice, reference) < 2e-4, "{name}: {practice:?}");
            let exact = |step: f64| {
                let xyz = xyz_of(light, Some(&through(step)), Observer::Cie1931);
                xyz.map(|value| 100.0 * value / exact_white)
            };
            let (cubic, straight) = (exact(1.0), exact(10.0));
            assert!(distance(cubic, reference) < 5e-3, "{name}: {cubic:?}");
            assert!(distance(straight, reference) < 0.15, "{name}: {straight:?}");
        }
    }

    /// Added every nm they are the reference's to the last digit of its constants. The sum counts the outermost values
    /// whole, the integral by half: 2.7e-6 for the reddest.
    #[test]
    fn black_bodies_lie_on_the_planckian_locus() {
        const C2: f64 = 1.438_776_877e-2;
        for (kelvin, reference) in [
            (2000.0, [0.5266768041004901, 0.41329943964832455]),
            (2856.0, [0.44753660998250083, 0.40743030559562404]),
            (3500.0, [0.4053052724333737, 0.39071778120822165]),
            (5000.0, [0.3451026319881391, 0.3516100273764412]),
            (6500.0, [0.31352694045089313, 0.3236299704992594]),
        ] {
            let light = blackbody(kelvin * C2 / 1.4388e-2, [360.0, 780.0], 1.0).unwrap();
            assert!(distance(chromaticity(added(&light, 1.0)), reference) < 1e-9);
            let exact = chromaticity(xyz_of(&light, None, Observer::Cie1931));
            assert!(distance(exact, reference) < 3e-6);
        }
    }

    /// The 10° observer sees D65 at (0.31382, 0.33100): CIE 15:2004, table T.3.
    #[test]
    fn the_larger_field_has_another_white() {
        let white = chromaticity(xyz_of(Illuminant::D65.curve(), None, Observer::Cie1964));
        assert!(distance(white, [0.31382, 0.33100]) < 2e-5, "{white:?}");
    }

    /// IEC 61966-2-1 states the matrix to four decimals.
    #[test]
    fn the_matrix_of_rec709_is_the_published_one() {
        let published = [
            [0.4124, 0.3576, 0.1805],
            [0.2126, 0.7152, 0.0722],
            [0.0193, 0.1192, 0.9505],
        ];
        for (row, wanted) in xyz_from_rgb().into_iter().zip(published) {
            assert!(distance(row, wanted) < 5e-5);
        }
        let colour = [0.3, 0.1, 0.7];
        let back = apply(&rgb_from_xyz(), apply(&xyz_from_rgb(), colour));
        assert!(distance(back, colour) < 1e-15);
    }

    #[test]
    fn the_curves_of_rec709_integrate_to_its_channels() {
        let light = Illuminant::Fl2.curve();
        let direct = rgb_curves(Observer::Cie1931)
            .map(|curve| light.product_integral(&curve, [360.0, 830.0]));
        let by_matrix = apply(&rgb_from_xyz(), xyz_of(light, None, Observer::Cie1931));
        assert!(distance(direct, by_matrix) < 1e-12 * by_matrix[1]);
    }
}
