//! Factors on their way out.

use serde_json::{Map, Value, json};
use steradian::geometry::form_factor::Factor;
use steradian_io::report::columns::Columns;
use steradian_io::report::numbers::{exact, with_half_width};

/// A factor with its name.
#[derive(Clone, Copy, Debug)]
pub struct Named {
    pub name: &'static str,
    pub factor: Factor,
}

/// What is printed.
#[derive(Clone, Debug)]
pub struct Factors {
    pub factors: Vec<Named>,
    /// The factor back, by reciprocity.
    pub reverse: Option<Named>,
    /// In square metres; both or none.
    pub areas: Option<[f64; 2]>,
}

impl Factors {
    /// One factor.
    pub fn single(factor: Factor) -> Self {
        Self::several(vec![Named {
            name: "F12",
            factor,
        }])
    }

    /// The factors of a configuration.
    pub fn several(factors: Vec<Named>) -> Self {
        Self {
            factors,
            reverse: None,
            areas: None,
        }
    }

    pub fn table(&self) -> String {
        let mut columns = Columns::new(["factor", "value", "method"]);
        for Named { name, factor } in self.factors.iter().chain(&self.reverse) {
            columns.row([
                (*name).to_owned(),
                with_half_width(factor.value, factor.error),
                method(factor).to_owned(),
            ]);
        }
        let areas = self
            .areas
            .map(|[first, second]| format!("areas: {} m2, {} m2\n", exact(first), exact(second)));
        format!("{columns}{}", areas.unwrap_or_default())
    }

    pub fn json(&self) -> String {
        let mut object = match self.factors.as_slice() {
            [Named { factor, .. }] => members(factor),
            several => {
                let factors = several
                    .iter()
                    .map(|named| (named.name.to_owned(), Value::Object(members(&named.factor))));
                Map::from_iter([("factors".to_owned(), Value::Object(factors.collect()))])
            }
        };
        if let Some(Named { factor, .. }) = &self.reverse {
            object.insert("reverse".to_owned(), Value::Object(members(factor)));
        }
        if let Some(areas) = self.areas {
            object.insert(
                "areas".to_owned(),
                json!(areas.map(|area| json!({ "value": area, "unit": "m2" }))),
            );
        }
        format!("{:#}\n", Value::Object(object))
    }
}

/// The error of a quadrature takes the place of a standard error, which it does not exceed.
fn members(factor: &Factor) -> Map<String, Value> {
    let value = json!({ "value": factor.value, "unit": "1", "std_error": factor.error, "method": method(factor) });
    value.as_object().cloned().unwrap_or_default()
}

fn method(factor: &Factor) -> &'static str {
    if factor.error > 0.0 {
        "quadrature"
    } else {
        "closed-form"
    }
}
