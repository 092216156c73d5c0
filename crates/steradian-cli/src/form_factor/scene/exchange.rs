//! Radiative exchange by the matrix: what each surface gives and takes.

use std::collections::HashMap;
use std::path::Path;

use serde_json::{Value, json};
use steradian::exchange::radiosity::{
    Boundary, Equilibrium, Exchanged, GreySurface, Surroundings, exchange,
};
use steradian::exchange::{Facets, Groups, Row, Uncertain};
use steradian::material::{Material, Model};
use steradian_io::files::DiskFiles;
use steradian_io::import::boundaries::{BoundaryLine, read_boundaries};
use steradian_io::report::columns::Columns;
use steradian_io::report::form_factors::FactorReport;
use steradian_io::report::numbers::{exact, with_half_width};

use super::Format;
use crate::status::Failure;

/// What each surface is and what is known of it.
pub fn surfaces(
    file: &Path,
    facets: &Facets,
    groups: &Groups,
) -> Result<Vec<GreySurface>, Failure> {
    let lines = read_boundaries(file, &DiskFiles::default())
        .map_err(|error| Failure::Other(error.into()))?;
    let by_name: HashMap<&str, &BoundaryLine> = lines
        .iter()
        .map(|line| (line.surface.as_str(), line))
        .collect();
    let mut first_facet = vec![None; groups.count()];
    for (facet, &group) in groups.of_facet().iter().enumerate() {
        first_facet[group as usize].get_or_insert(facet);
    }
    let surface = |(name, facet): (&String, Option<usize>)| {
        let object = name.split('/').next().unwrap_or_default();
        let line = by_name.get(name.as_str()).or_else(|| by_name.get(object));
        let line = line.or_else(|| by_name.get("*")).ok_or_else(|| {
            Failure::message(format!(
                "{}: nothing is said of `{name}`, and there is no line for `*`",
                file.display()
            ))
        })?;
        let needs_emissivity = !matches!(line.boundary, Boundary::NetFlux(_));
        let emissivity = line.emissivity.or_else(|| emissivity(facets, facet?));
        let missing = || {
            format!(
                "`{name}` has no emissivity: its reflectance varies, or depends on the direction; give a column `emissivity`"
            )
        };
        match emissivity {
            Some(emissivity) => Ok(GreySurface {
                emissivity,
                boundary: line.boundary,
            }),
            None if !needs_emissivity => Ok(GreySurface {
                emissivity: 1.0,
                boundary: line.boundary,
            }),
            None => Err(Failure::message(missing())),
        }
    };
    groups
        .names()
        .iter()
        .zip(first_facet)
        .map(surface)
        .collect()
}

/// 1 less the reflectance of the material, if that is one number.
fn emissivity(facets: &Facets, facet: usize) -> Option<f64> {
    let (scene, facet) = (facets.scene(), &facets.list()[facet]);
    let part = scene.parts()[facet.part.0 as usize];
    let material: &Material = scene.material(if facet.is_back { part.back } else { part.front });
    let tint = match &material.model {
        Model::Black => return Some(1.0),
        _ => material.reflectance()?,
    };
    let lanes = &tint.hue.lanes[..scene.lanes().count()];
    let grey = tint.is_constant() && lanes.iter().all(|lane| *lane == lanes[0]);
    grey.then(|| 1.0 - f64::from(lanes[0]))
}

/// Solves for all surfaces.
pub fn solve(
    rows: &[Row],
    groups: &Groups,
    surfaces: &[GreySurface],
    surroundings: Surroundings,
) -> Result<Equilibrium, Failure> {
    exchange(rows, groups.areas(), surfaces, surroundings)
        .map_err(|error| Failure::Other(error.into()))
}

/// The result in a format.
pub fn text(found: &Equilibrium, report: &FactorReport, format: Format) -> String {
    match format {
        Format::Json => json_text(found, report),
        Format::Csv => csv_text(found, report),
        Format::Table | Format::Npz => table(found, report),
    }
}

fn table(found: &Equilibrium, report: &FactorReport) -> String {
    let cell = |number: Uncertain| match number.std_error {
        0.0 => exact(number.value),
        _ => with_half_width(number.value, number.half_width(report.confidence)),
    };
    let mut columns = Columns::new([
        "surface",
        "area (m2)",
        "temperature (K)",
        "radiosity (W/m2)",
        "irradiance (W/m2)",
        "net flux (W/m2)",
        "net flux (W)",
    ]);
    for (name, area, surface) in rows(found, report) {
        let temperature = surface.temperature.map_or_else(String::new, cell);
        columns.row([
            name.clone(),
            exact(area),
            temperature,
            cell(surface.radiosity),
            cell(surface.irradiance),
            cell(surface.net_flux),
            cell(surface.net_flux.scaled(area)),
        ]);
    }
    let balance = with_half_width(
        found.balance.value,
        found.balance.half_width(report.confidence),
    );
    format!("{columns}balance of all surfaces: {balance} W\n")
}

fn rows<'a>(
    found: &'a Equilibrium,
    report: &'a FactorReport,
) -> impl Iterator<Item = (&'a String, f64, &'a Exchanged)> {
    let surfaces = report.names.iter().zip(&report.areas).zip(&found.surfaces);
    surfaces.map(|((name, &area), surface)| (name, area, surface))
}

fn json_text(found: &Equilibrium, report: &FactorReport) -> String {
    let number = |number: Uncertain, unit: &str| {
        let method = if number.std_error == 0.0 {
            "closed-form"
        } else {
            "estimate"
        };
        json!({ "value": number.value, "unit": unit, "std_error": number.std_error, "method": method })
    };
    let surfaces = rows(found, report).map(|(name, area, surface)| {
        json!({
            "name": name,
            "area": { "value": area, "unit": "m2" },
            "temperature": surface.temperature.map(|kelvin| number(kelvin, "K")),
            "radiosity": number(surface.radiosity, "W/m2"),
            "irradiance": number(surface.irradiance, "W/m2"),
            "net_flux": number(surface.net_flux, "W/m2"),
            "net_power": number(surface.net_flux.scaled(area), "W"),
        })
    });
    let object = json!({
        "schema": "steradian.exchange/1",
        "scene_hash": report.scene_hash,
        "seed": report.seed,
        "surfaces": surfaces.collect::<Vec<Value>>(),
        "balance": number(found.balance, "W"),
    });
    format!("{object:#}\n")
}

fn csv_text(found: &Equilibrium, report: &FactorReport) -> String {
    let mut text = "surface,area,radiosity,radiosity_std_error,irradiance,irradiance_std_error,net_flux,net_flux_std_error\n".to_owned();
    for (name, area, surface) in rows(found, report) {
        let Exchanged {
            radiosity,
            irradiance,
            net_flux,
            ..
        } = surface;
        text += &format!("\"{}\",{area}", name.replace('"', "\"\""));
        for Uncertain {
            value, std_error, ..
        } in [radiosity, irradiance, net_flux]
        {
            text += &format!(",{value},{std_error}");
        }
        text.push('\n');
    }
    text
}
