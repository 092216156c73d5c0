//! What a file says about energy: directional-hemispherical totals, and where they exceed 1.

use steradian::brdf::Measured;
use steradian::brdf::measured::{Side, TwoSided};
use steradian::geometry::{Direction, Vector};

use super::Band;

/// Angles of incidence in degrees.
pub const ANGLES: [f64; 9] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];

/// Shares of the light that arrives under an angle, means over the azimuths.
#[derive(Clone, Debug, PartialEq)]
pub struct Total {
    /// The band, or a colour.
    pub channel: String,
    /// Where the light comes from.
    pub from: Side,
    /// θ_i in degrees.
    pub theta: f64,
    /// What leaves on the same side.
    pub reflected: f64,
    /// What leaves on the other.
    pub transmitted: f64,
    /// The largest sum of both at an azimuth.
    pub largest: f64,
}

/// Where more light leaves than arrives: the worst angle of every channel and side.
pub fn gains(totals: &[Total]) -> Vec<String> {
    let worse = |total: &&Total| {
        let same = |other: &&Total| other.channel == total.channel && other.from == total.from;
        let alike = totals.iter().filter(same);
        // Of equal ones the first counts.
        let worst = alike.reduce(|worst, other| {
            if other.largest > worst.largest {
                other
            } else {
                worst
            }
        });
        total.largest > 1.0 + TOLERANCE && worst.is_some_and(|worst| std::ptr::eq(worst, *total))
    };
    let told = |total: &Total| {
        let Total {
            channel,
            theta,
            largest,
            ..
        } = total;
        let side = side(total.from);
        format!("{channel}: {largest:.4} of the light from {side} at {theta} degrees leaves again")
    };
    totals.iter().filter(worse).map(told).collect()
}

/// By how much a total may exceed 1: sums of colours are that coarse.
const TOLERANCE: f64 = 2e-3;

/// A side in words.
pub fn side(side: Side) -> &'static str {
    match side {
        Side::Above => "above",
        Side::Below => "below",
    }
}

/// Totals under [`ANGLES`] from every side from which light leaves again.
pub fn totals(band: &Band) -> Vec<Total> {
    match &band.model {
        Measured::TwoSided(table) => sides(table)
            .flat_map(|from| ANGLES.map(|theta| total(&band.name, table, from, theta)))
            .collect(),
        model => ANGLES
            .iter()
            .flat_map(|theta| colours(model, *theta))
            .collect(),
    }
}

fn sides(table: &TwoSided) -> impl Iterator<Item = Side> {
    [Side::Above, Side::Below]
        .into_iter()
        .filter(|from| table.reflection(*from).is_some() || table.transmission(*from).is_some())
}

/// 24 azimuths: as many as the finest ring of Klems has.
fn total(channel: &str, table: &TwoSided, from: Side, theta: f64) -> Total {
    let azimuths = 24;
    let (mut sums, mut largest) = ([0.0; 2], 0.0_f64);
    for k in 0..azimuths {
        let found = table.hemispherical(direction(from, theta, f64::from(k) * 15.0));
        largest = largest.max(found[0] + found[1]);
        (0..2).for_each(|part| sums[part] += found[part]);
    }
    let [reflected, transmitted] = sums.map(|sum| sum / f64::from(azimuths));
    Total {
        channel: channel.to_owned(),
        from,
        theta,
        reflected,
        transmitted,
        largest,
    }
}

/// Colours of reflection, which is the same in both directions of light.
fn colours(model: &Measured, theta: f64) -> Vec<Total> {
    let azimuths: &[f64] = match model {
        Measured::Rgl(table, _) if !table.is_isotropic() => &[0.0, 45.0, 90.0, 135.0],
        _ => &[0.0],
    };
    let lanes: Vec<_> = azimuths
        .iter()
        .map(|phi| model.albedo(direction(Side::Above, theta, *phi)).to_lanes())
        .collect();
    let of = |channel: usize| lanes.iter().map(move |lanes| f64::from(lanes[channel]));
    let total = |(channel, name): (usize, &str)| Total {
        channel: name.to_owned(),
        from: Side::Above,
        theta,
        reflected: of(channel).sum::<f64>() / azimuths.len() as f64,
        transmitted: 0.0,
        largest: of(channel).fold(0.0, f64::max),
    };
    ["red", "green", "blue"]
        .into_iter()
        .enumerate()
        .map(total)
        .collect()
}

fn direction(from: Side, theta: f64, phi: f64) -> Direction {
    let [theta, phi] = [theta, phi].map(f64::to_radians);
    let (sin, cos) = (libm::sin(theta), libm::cos(theta));
    let z = if from == Side::Above { cos } else { -cos };
    let vector = Vector::new(sin * libm::cos(phi), sin * libm::sin(phi), z);
    Direction::new(vector).unwrap_or(Direction::Z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use steradian::brdf::measured::{AngleBasis, Block, PatchMatrix};

    #[test]
    fn a_table_that_gains_energy_is_found() {
        let basis = || AngleBasis::named("LBNL/Klems Quarter").remove(0);
        let values = vec![1.2 / std::f32::consts::PI; 41 * 41];
        let mut table = TwoSided::default();
        let matrix = PatchMatrix::new(basis(), basis(), values).unwrap();
        table.set_reflection(Side::Below, Block::Matrix(matrix));
        let band = Band {
            name: "Visible".to_owned(),
            model: Measured::TwoSided(Arc::new(table)),
        };
        let totals = super::totals(&band);
        assert_eq!(totals.len(), ANGLES.len());
        assert!((totals[3].reflected - 1.2).abs() < 1e-6 && totals[3].transmitted == 0.0);
        assert_eq!(
            gains(&totals),
            ["Visible: 1.2000 of the light from below at 0 degrees leaves again"]
        );
    }
}
