//! Tables completed by the symmetry that a file leaves to be understood.

use steradian::light::{FarField, FarFieldError, Planes};

/// A table over one turn of C and the symmetry that it was completed by, or what is wrong with its angles.
pub(super) fn whole_turn(
    laterals: &[f64],
    verticals: &[f64],
    values: &[f64],
) -> Result<(FarField, &'static str), String> {
    let columns: Vec<&[f64]> = values.chunks(verticals.len()).collect();
    let (first, last) = (laterals[0], laterals[laterals.len() - 1]);
    let mut planes: Vec<(f64, &[f64])> = laterals.iter().copied().zip(columns).collect();
    let symmetry = match (first, last) {
        _ if laterals.len() == 1 => {
            planes = vec![(0.0, planes[0].1), (360.0, planes[0].1)];
            "the same in all planes"
        }
        (0.0, 90.0) => {
            mirror(&mut planes);
            mirror(&mut planes);
            "mirrored at C0-C180 and C90-C270"
        }
        (0.0, 180.0) => {
            mirror(&mut planes);
            "mirrored at C0-C180"
        }
        (90.0, 270.0) | (-90.0, 90.0) => {
            mirror(&mut planes);
            "mirrored at C90-C270"
        }
        (0.0, 360.0) => "none",
        (0.0, last) if last > 180.0 && closes(laterals) => {
            let start = planes[0].1;
            planes.push((360.0, start));
            "none, the last plane is the first"
        }
        _ => {
            return Err(format!(
                "lateral angles of type C go from 0° to 0°, 90°, 180° or 360°, or from 90° to 270°, not from {first}° to {last}°"
            ));
        }
    };
    let table = grid(Planes::C, &planes, verticals);
    table
        .map(|table| (table, symmetry))
        .map_err(|error| error.to_string())
}

/// Adds the planes mirrored at the last one.
fn mirror(planes: &mut Vec<(f64, &[f64])>) {
    let twice = 2.0 * planes[planes.len() - 1].0;
    let others = planes[..planes.len() - 1].iter().rev();
    let mirrored: Vec<_> = others
        .map(|(angle, column)| (twice - angle, *column))
        .collect();
    planes.extend(mirrored);
}

/// Whether one more step of the last size makes the turn full.
fn closes(laterals: &[f64]) -> bool {
    let last = laterals.len() - 1;
    last > 0 && (2.0 * laterals[last] - laterals[last - 1] - 360.0).abs() < 1e-6
}

/// Floodlights and lamps of vehicles: laterals from 0 are mirrored.
pub(super) fn latitudes(
    planes: Planes,
    laterals: &[f64],
    verticals: &[f64],
    values: &[f64],
) -> Result<(FarField, &'static str), String> {
    let columns: Vec<&[f64]> = values.chunks(verticals.len()).collect();
    let mut table: Vec<(f64, &[f64])> = laterals.iter().copied().zip(columns).collect();
    let symmetry = match (laterals[0], laterals[laterals.len() - 1]) {
        (0.0, 90.0) => {
            let mirrored = table[1..]
                .iter()
                .rev()
                .map(|(angle, column)| (-angle, *column));
            table = mirrored.chain(table.iter().copied()).collect();
            "mirrored at the vertical plane"
        }
        (-90.0, 90.0) => "none",
        (first, last) => {
            return Err(format!(
                "lateral angles of types A and B go from -90° or 0° to 90°, not from {first}° to {last}°"
            ));
        }
    };
    let made = if planes == Planes::A {
        // Azimuth X, latitude Y.
        let turned: Vec<Vec<f64>> = table
            .iter()
            .map(|(_, column)| column.iter().rev().copied().collect())
            .collect();
        let azimuths = table.iter().zip(&turned);
        let azimuths: Vec<_> = azimuths
            .map(|((angle, _), column)| (*angle, &column[..]))
            .collect();
        grid(planes, &azimuths, &from_pole(verticals))
    } else {
        // Azimuth V, latitude H.
        let column = |row: usize| table.iter().rev().map(|(_, column)| column[row]).collect();
        let columns: Vec<Vec<f64>> = (0..verticals.len()).map(column).collect();
        let azimuths = verticals.iter().zip(&columns);
        let azimuths: Vec<_> = azimuths
            .map(|(angle, column)| (*angle, &column[..]))
            .collect();
        let latitudes: Vec<f64> = table.iter().map(|(angle, _)| *angle).collect();
        grid(planes, &azimuths, &from_pole(&latitudes))
    };
    made.map(|table| (table, symmetry))
        .map_err(|error| error.to_string())
}

/// Angles from the pole of latitudes that increase.
fn from_pole(latitudes: &[f64]) -> Vec<f64> {
    latitudes
        .iter()
        .rev()
        .map(|latitude| 90.0 - latitude)
        .collect()
}

fn grid(
    planes: Planes,
    columns: &[(f64, &[f64])],
    polars: &[f64],
) -> Result<FarField, FarFieldError> {
    let azimuths: Vec<f64> = columns.iter().map(|(angle, _)| *angle).collect();
    let values: Vec<f64> = columns
        .iter()
        .flat_map(|(_, column)| column.iter().copied())
        .collect();
    FarField::new(planes, &azimuths, polars, &values)
}
