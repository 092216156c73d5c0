//! The UGR table of a luminaire.

use serde_json::{Value, json};
use steradian::glare::{Reflectances, UgrRow, UgrTable};
use steradian_io::import::photometry::{IntensityUnit, Photometry};
use steradian_io::report::columns::Columns;

/// The table, or why there is none.
pub fn of(lamp: &Photometry) -> Result<UgrTable, String> {
    if lamp.unit != IntensityUnit::Candela {
        return Err("the intensities are radiometric".into());
    }
    let table = UgrTable::new(&lamp.far_field, |direction| lamp.projected_area(direction));
    table.map_err(|error| error.to_string())
}

/// For people.
pub fn table(found: &Result<UgrTable, String>) -> String {
    let table = match found {
        Ok(table) => table,
        Err(reason) => return format!("UGR: no table, {reason}\n"),
    };
    let halves = ["crosswise", "endwise"].map(|name| [name, "", "", "", ""]);
    let mut columns = Columns::new(["X", "Y"].into_iter().chain(halves.concat()));
    let names: Vec<String> = Reflectances::STANDARD.iter().map(name).collect();
    let empty = [String::new(), String::new()];
    columns.row(empty.iter().chain(&names).chain(&names));
    for column in 2..12 {
        columns = columns.right_aligned(column);
    }
    for UgrRow {
        room,
        crosswise,
        endwise,
    } in &table.rows
    {
        let sides = [room.x, room.y].map(|side| format!("{side}H"));
        let values = crosswise.iter().chain(endwise);
        let values = values.map(|value| value.map_or("-".into(), |value| format!("{value:.1}")));
        columns.row(sides.into_iter().chain(values));
    }
    format!(
        "UGR of luminaires H/4 apart, H = 2 m above the eye; ceiling/walls/plane in %\n{columns}"
    )
}

fn name(reflectances: &Reflectances) -> String {
    let parts = [reflectances.ceiling, reflectances.walls, reflectances.plane];
    parts.map(|part| format!("{:.0}", 100.0 * part)).join("/")
}

/// For programs.
pub fn as_json(found: &Result<UgrTable, String>) -> Value {
    let table = match found {
        Ok(table) => table,
        Err(reason) => return json!({ "missing": reason }),
    };
    let reflectances = Reflectances::STANDARD
        .iter()
        .map(|each| json!({ "ceiling": each.ceiling, "walls": each.walls, "plane": each.plane }));
    let rows = table.rows.iter().map(|row| {
        json!({
            "x_over_h": row.room.x,
            "y_over_h": row.room.y,
            "crosswise": row.crosswise,
            "endwise": row.endwise,
        })
    });
    json!({
        "unit": "1",
        "std_error": 0,
        "method": "closed-form",
        "spacing_over_h": 0.25,
        "height": { "value": 2.0, "unit": "m" },
        "reflectances": reflectances.collect::<Vec<_>>(),
        "rooms": rows.collect::<Vec<_>>(),
    })
}
