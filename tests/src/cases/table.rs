//! The tables of cases and how their parameters are read.

use serde_json::{Map, Value};
use steradian::geometry::{Point, Vector};

/// The tables, as JSON.
const TABLES: [&str; 6] = [
    include_str!("../../data/cases/irradiance-lights.json"),
    include_str!("../../data/cases/irradiance-emitters.json"),
    include_str!("../../data/cases/irradiance-skies.json"),
    include_str!("../../data/cases/closed-environment.json"),
    include_str!("../../data/cases/cie171.json"),
    include_str!("../../data/cases/cie171-like.json"),
];

/// The table of what happens in time, each case of which a command answers by itself.
const TIME: &str = include_str!("../../data/cases/time.json");

/// One line of a table.
pub struct Case {
    /// Group, kind and name: `group/kind/name`.
    pub id: String,
    params: Value,
    /// What is expected, by name.
    pub expect: Map<String, Value>,
    rel_error: f64,
    abs_error: f64,
}

/// All cases of the tables of scenes.
pub fn tables() -> Vec<Case> {
    TABLES.into_iter().flat_map(cases).collect()
}

/// The cases of the table of what happens in time.
pub fn time_table() -> Vec<Case> {
    cases(TIME).collect()
}

fn cases(text: &str) -> impl Iterator<Item = Case> {
    let mut table: Value = serde_json::from_str(text).expect("a table is JSON");
    let Value::Array(cases) = table["cases"].take() else {
        panic!("a table has cases")
    };
    cases.into_iter().map(Case::new)
}

impl Case {
    fn new(mut value: Value) -> Self {
        let Value::Object(expect) = value["expect"].take() else {
            panic!("a case expects something")
        };
        Self {
            id: value["id"].as_str().expect("a case has an id").into(),
            params: value["params"].take(),
            expect,
            rel_error: value["reference_rel_error"].as_f64().unwrap_or(0.0),
            abs_error: value["reference_abs_error"].as_f64().unwrap_or(0.0),
        }
    }

    /// The kind of the case.
    pub fn kind(&self) -> &str {
        self.id
            .split('/')
            .nth(1)
            .unwrap_or_else(|| panic!("no kind in {}", self.id))
    }

    /// The number expected under this name.
    pub fn expected(&self, name: &str) -> f64 {
        let number = self.expect.get(name).and_then(Value::as_f64);
        number.unwrap_or_else(|| panic!("{} expects no `{name}`", self.id))
    }

    /// Error of the expected number.
    pub fn reference_error(&self, expected: f64) -> f64 {
        self.abs_error + self.rel_error * expected.abs()
    }

    /// Names of expected numbers that begin with `prefix`, with the numbers that follow, separated by `_`.
    pub fn series(&self, prefix: &str) -> Vec<(String, Vec<f64>)> {
        let parse = |name: &String| {
            let rest = name.strip_prefix(prefix)?;
            let numbers: Result<Vec<f64>, _> = rest.split('_').map(str::parse).collect();
            Some((name.clone(), numbers.ok()?))
        };
        self.expect.keys().filter_map(parse).collect()
    }

    /// A parameter, or a part of one: `emitter/x`.
    pub fn value(&self, key: &str) -> &Value {
        let found = self.params.pointer(&format!("/{key}"));
        found.unwrap_or_else(|| panic!("{} has no `{key}`", self.id))
    }

    /// A number.
    pub fn number(&self, key: &str) -> f64 {
        number(self.value(key))
    }

    /// A list of numbers.
    pub fn numbers(&self, key: &str) -> Vec<f64> {
        self.list(key).iter().map(number).collect()
    }

    /// A list.
    pub fn list(&self, key: &str) -> &[Value] {
        let list = self.value(key).as_array();
        list.unwrap_or_else(|| panic!("`{key}` of {} is no list", self.id))
    }

    /// A point.
    pub fn point(&self, key: &str) -> Point {
        let [x, y, z] = triple(self.value(key));
        Point::new(x, y, z)
    }

    /// A vector.
    pub fn vector(&self, key: &str) -> Vector {
        let [x, y, z] = triple(self.value(key));
        Vector::new(x, y, z)
    }

    /// A list of points.
    pub fn points(&self, key: &str) -> Vec<Point> {
        let point = |value: &Value| {
            let [x, y, z] = triple(value);
            Point::new(x, y, z)
        };
        self.list(key).iter().map(point).collect()
    }
}

/// A JSON number.
pub(super) fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// Three JSON numbers.
pub(super) fn triple(value: &Value) -> [f64; 3] {
    std::array::from_fn(|axis| number(&value[axis]))
}
