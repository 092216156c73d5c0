//! The binary files of MERL's database, `.binary`.
//!
//! Three 32-bit integers, 90, 90, 180, then 64-bit numbers: all of red, of green, of blue; all little-endian. A number times
//! 1/1500, 1.15/1500 and 1.66/1500 is a value in 1/sr of its colour; negative ones mark what was not measured. Source: W. Matusik et
//! al., *A data-driven reflectance model* (SIGGRAPH 2003), and the code that comes with the data.

use std::sync::Arc;

use steradian::brdf::Measured;
use steradian::brdf::measured::{Merl, Reading};

use super::error::{BinaryFault, BsdfError};
use super::{Band, MeasuredFile};

/// 1/sr of one unit of red, green and blue.
pub const SCALES: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

const HEADER: usize = 12;
const NUMBER: usize = 8;

/// Reads a file of MERL.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn read(bytes: &[u8]) -> Result<MeasuredFile, BsdfError> {
    let cells = cells(bytes)?;
    let (needed, found) = (HEADER + 3 * NUMBER * cells, bytes.len());
    if found != needed {
        let fault = BinaryFault::Length { needed, found };
        return Err(fault.at(needed.min(found)));
    }
    let mut values = vec![[0.0_f32; 3]; cells];
    for channel in 0..3 {
        for (cell, value) in values.iter_mut().enumerate() {
            let byte = HEADER + (channel * cells + cell) * NUMBER;
            let number = number(bytes, byte)?;
            value[channel] = (number * SCALES[channel]) as f32;
        }
    }
    let (header, warnings) = (header(&values), warnings(&values));
    let table = Merl::new(values).map_err(|fault| BinaryFault::Table(fault).at(HEADER))?;
    Ok(MeasuredFile {
        format: "MERL",
        header,
        bands: vec![Band {
            name: "rgb".to_owned(),
            model: Measured::Merl(Arc::new(table), Reading::default()),
        }],
        warnings,
    })
}

fn cells(bytes: &[u8]) -> Result<usize, BsdfError> {
    let size = |k: usize| {
        let four = bytes.get(4 * k..4 * k + 4)?;
        Some(u32::from_le_bytes(four.try_into().ok()?) as usize)
    };
    for (k, expected) in Merl::CELLS.into_iter().enumerate() {
        let found = size(k).ok_or(
            BinaryFault::Length {
                needed: HEADER,
                found: bytes.len(),
            }
            .at(bytes.len()),
        )?;
        if found != expected {
            return Err(BinaryFault::Dimension { expected, found }.at(4 * k));
        }
    }
    Ok(Merl::CELLS.iter().product())
}

/// A number that is finite in single precision.
fn number(bytes: &[u8], byte: usize) -> Result<f64, BsdfError> {
    let eight = bytes[byte..byte + NUMBER].try_into().unwrap_or_default();
    let number = f64::from_le_bytes(eight);
    match (number as f32).is_finite() {
        true => Ok(number),
        false => Err(BinaryFault::NotFinite(number.to_string()).at(byte)),
    }
}

fn missing(value: &[f32; 3]) -> usize {
    value.iter().filter(|channel| **channel < 0.0).count()
}

fn header(values: &[[f32; 3]]) -> Vec<(String, String)> {
    let measured = values.iter().filter(|value| missing(value) == 0).count();
    let share = measured as f64 / values.len() as f64;
    let [half, difference, azimuth] = Merl::CELLS;
    vec![
        (
            "Cells".to_owned(),
            format!("{half} x {difference} x {azimuth} (half angle, difference angle, azimuth)"),
        ),
        (
            "Measured".to_owned(),
            format!("{:.4} % of the cells", 100.0 * share),
        ),
    ]
}

fn warnings(values: &[[f32; 3]]) -> Vec<String> {
    let partly = values
        .iter()
        .filter(|value| (1..3).contains(&missing(value)));
    let holes = values
        .iter()
        .enumerate()
        .filter(|(cell, value)| missing(value) > 0 && above(*cell));
    let told = [
        (partly.count(), "cells that lack some colours; these are 0"),
        (
            holes.count(),
            "cells above the horizon that were not measured; these are 0",
        ),
    ];
    let some = told.into_iter().filter(|(count, _)| *count > 0);
    some.map(|(count, what)| format!("{count} {what}"))
        .collect()
}

/// Whether both directions of the middle of a cell lie above the surface.
fn above(cell: usize) -> bool {
    let [_, difference, azimuth] = Merl::CELLS;
    let indices = [
        cell / azimuth / difference,
        cell / azimuth % difference,
        cell % azimuth,
    ];
    let [theta_h, theta_d, phi_d] = Merl::middle(indices);
    let up = libm::cos(theta_h) * libm::cos(theta_d);
    up > (libm::sin(theta_h) * libm::sin(theta_d) * libm::cos(phi_d)).abs()
}
