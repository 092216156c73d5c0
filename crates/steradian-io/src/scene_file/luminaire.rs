//! `kind = "luminaire"`: a light whose intensities come from a file. Lights that name the same file share its table.

use std::path::Path;
use std::sync::Arc;

use steradian::geometry::Vector;
use steradian::light::{FarField, Opening};
use steradian::quantity::{Amount, Intensity, LuminousIntensity};
use steradian::scene::description::{LightKind, LuminaireDescription};

use super::fields::Fields;
use super::placement;
use super::value::choices;
use crate::diagnostic::Diagnostic;
use crate::import::photometry::{self, IntensityUnit, Photometry};

const DOWN: Vector = Vector::new(0.0, 0.0, -1.0);

/// What a scene needs to know of a luminaire's file.
#[derive(Debug)]
pub(super) struct LoadedLuminaire {
    far_field: Arc<FarField>,
    opening: Opening,
    unit: IntensityUnit,
}

/// Where light leaves.
#[derive(Copy, Clone, PartialEq, Eq)]
enum Emit {
    Opening,
    Point,
}

choices! { Emit, "opening" => Self::Opening, "point" => Self::Point }
choices! { IntensityUnit, "cd" => Self::Candela, "mW/sr" => Self::MilliwattPerSteradian }

pub(super) fn read(fields: &Fields<'_>) -> Option<LightKind> {
    let (position, c0) = (
        placement::point(fields, "position"),
        placement::direction(fields, "c0"),
    );
    let aim = match fields.has("aim") {
        true => placement::direction(fields, "aim"),
        false => Some(DOWN),
    };
    let (dimming, maintenance_factor) = (fields.get("dimming"), fields.get("maintenance_factor"));
    let (flux, unit) = (fields.get("flux"), fields.get("file_unit"));
    let emit = fields.get("emit");
    let luminaire = loaded(fields)?;
    let opening = opening(fields, emit, luminaire.opening);
    Some(LightKind::Luminaire(Box::new(LuminaireDescription {
        position: position?,
        aim: aim?,
        c0: c0?,
        far_field: Arc::clone(&luminaire.far_field),
        unit: of_one(unit.unwrap_or(luminaire.unit)),
        opening: opening?,
        flux,
        dimming: dimming?,
        maintenance_factor: maintenance_factor?,
    })))
}

/// What a 1 of a table stands for.
fn of_one(unit: IntensityUnit) -> Amount<Intensity, LuminousIntensity> {
    match unit {
        IntensityUnit::Candela => Amount::Photometric(LuminousIntensity::from_candelas(1.0)),
        IntensityUnit::MilliwattPerSteradian => {
            Amount::Radiant(Intensity::from_watts_per_steradian(1e-3))
        }
    }
}

/// Where light leaves: as the file says, unless a point is asked for.
fn opening(fields: &Fields<'_>, emit: Option<Emit>, stated: Opening) -> Option<Opening> {
    match emit {
        Some(Emit::Point) => Some(Opening::Point),
        Some(Emit::Opening) if !stated.has_area() => {
            let message = "the file of the luminaire tells of no luminous opening that has an area";
            let hint = "leave out `emit`, or set it to \"point\"".to_owned();
            let span = fields.span_of("emit");
            fields.context().error(span, message, Some(hint));
            None
        }
        _ => Some(stated),
    }
}

fn loaded(fields: &Fields<'_>) -> Option<Arc<LoadedLuminaire>> {
    let name: String = fields.get("file")?;
    fields.context().luminaire(&name, || {
        let photometry = from_file(fields, &name)?;
        tell(fields, &name, &photometry);
        Some(LoadedLuminaire {
            far_field: Arc::new(photometry.far_field),
            opening: photometry.opening,
            unit: photometry.unit,
        })
    })
}

fn from_file(fields: &Fields<'_>, name: &str) -> Option<Photometry> {
    let (context, span) = (fields.context(), fields.span_of("file"));
    if !photometry::is_luminaire(Path::new(name)) {
        let message =
            format!("expected a luminaire file (.ies, .ldt or TM-33 .xml), found {name:?}");
        context.error(span, message, None);
        return None;
    }
    match photometry::read(&context.path_of(name), context.files()) {
        Ok(photometry) => Some(photometry),
        Err(problems) => {
            for problem in problems {
                let message = format!("{}: {}", place(name, &problem), problem.message);
                context.error(span.clone(), message, problem.hints.into_iter().next());
            }
            None
        }
    }
}

/// Warns of what may not be as the author of the scene thinks.
fn tell(fields: &Fields<'_>, name: &str, photometry: &Photometry) {
    let context = fields.context();
    for warning in &photometry.warnings {
        context.warn(format!("{}: {}", place(name, warning), warning.message));
    }
    if photometry.opening != Opening::Point && !photometry.opening.has_area() {
        context.warn(format!(
            "{name}: its luminous opening has no area that faces down; it emits as a point"
        ));
    }
    if let Some(other) = photometry.other_sets.first() {
        context.warn(format!(
            "{name}: it comes with other lamps, too, such as {:?}; its first set is meant",
            other.kind
        ));
    }
}

/// The name of the file, with the line that a diagnostic is about.
fn place(name: &str, diagnostic: &Diagnostic) -> String {
    let line = diagnostic.file.as_ref().zip(diagnostic.span.as_ref());
    let line = line.and_then(|(file, span)| file.text.get(..span.start));
    line.map_or_else(
        || name.to_owned(),
        |before| format!("{name}, line {}", before.matches('\n').count() + 1),
    )
}
