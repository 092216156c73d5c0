//! What is wrong with a scene: how often, and where.

use std::fmt::Write;

use serde_json::{Value, json};
use steradian::scene::Scene;
use steradian::shape::Side;
use steradian::shape::health::{Edge, Health};
use steradian_io::report::numbers::significant;

use super::triangles::Triangles;

/// Places listed for people, and kept for programs.
const SHOWN: usize = 3;
const KEPT: usize = 10;
/// Digits of a coordinate.
const DIGITS: i32 = 6;

/// One kind of fault.
#[derive(Debug)]
pub struct Finding {
    /// The kind, as programs call it.
    kind: &'static str,
    /// One of them and many of them.
    nouns: [&'static str; 2],
    /// What it means.
    meaning: &'static str,
    count: usize,
    /// The first few.
    examples: Vec<Example>,
}

/// Where a fault is.
#[derive(Debug)]
struct Example {
    /// The shape, or the light.
    name: String,
    /// Ends of an edge or corners of a triangle.
    points: Vec<[f64; 3]>,
    /// More about it.
    remark: String,
}

/// Everything that is wrong.
pub fn of(scene: &Scene, triangles: &Triangles, health: &Health) -> Vec<Finding> {
    let tell = Teller { scene, triangles };
    let leaks: Vec<Edge> = health
        .boundary
        .iter()
        .filter(|edge| !edge.flat)
        .copied()
        .collect();
    let findings = [
        tell.edges(BOUNDARY, &leaks),
        tell.edges(NON_MANIFOLD, &health.non_manifold),
        tell.edges(TURNED, &health.turned),
        tell.doubled(health),
        tell.degenerate(health),
        tell.unseen(),
    ];
    let found = findings.into_iter().filter(|finding| finding.count > 0);
    found.collect()
}

/// Kind, nouns and meaning.
type Fault = (&'static str, [&'static str; 2], &'static str);

const BOUNDARY: Fault = (
    "boundary-edge",
    ["boundary edge", "boundary edges"],
    "of one triangle alone: light leaks past it if the surface is meant to be closed",
);
const NON_MANIFOLD: Fault = (
    "non-manifold-edge",
    ["non-manifold edge", "non-manifold edges"],
    "of three triangles or more: inside and outside have no meaning there",
);
const TURNED: Fault = (
    "turned-edge",
    ["turned edge", "turned edges"],
    "where one of two triangles shows its back: its sides have each other's material and emission",
);
const DOUBLED: Fault = (
    "doubled-face",
    ["doubled triangle", "doubled triangles"],
    "with the corners of another: which one light meets is arbitrary, and emission counts twice",
);
const DEGENERATE: Fault = (
    "degenerate-face",
    ["degenerate triangle", "degenerate triangles"],
    "without area: no ray meets it",
);
const UNSEEN: Fault = (
    "unseen-light",
    ["unseen light", "unseen lights"],
    "that a closed shape separates from all sensors",
);

/// Turns numbers of triangles and vertices into names and coordinates.
struct Teller<'a> {
    scene: &'a Scene,
    triangles: &'a Triangles,
}

impl Teller<'_> {
    fn edges(&self, fault: Fault, edges: &[Edge]) -> Finding {
        let example = |edge: &Edge| Example {
            name: self.owner(edge.triangle),
            points: edge
                .ends
                .map(|vertex| self.triangles.place(vertex))
                .to_vec(),
            remark: match edge.uses {
                0..=2 => String::new(),
                uses => format!("{uses} triangles"),
            },
        };
        finding(fault, edges.len(), edges.iter().map(example))
    }

    fn doubled(&self, health: &Health) -> Finding {
        let faces = &health.doubled;
        let examples = faces.iter().map(|face| {
            let way = if face.turned {
                "back to back with"
            } else {
                "as in"
            };
            Example {
                name: self.owner(face.triangle),
                points: self.triangles.places(face.triangle),
                remark: format!("{way} {}", self.owner(face.original)),
            }
        });
        finding(DOUBLED, faces.len(), examples)
    }

    fn degenerate(&self, health: &Health) -> Finding {
        let faces = &health.degenerate;
        let examples = faces.iter().map(|&triangle| Example {
            name: self.owner(triangle),
            points: self.triangles.places(triangle),
            remark: String::new(),
        });
        finding(DEGENERATE, faces.len(), examples)
    }

    fn unseen(&self) -> Finding {
        let unseen = self.scene.unseen_lights();
        let examples = unseen.iter().map(|one| {
            let side = match one.side {
                Side::Inside => "inside",
                Side::Outside => "outside",
            };
            Example {
                name: self.scene.lights()[one.light].name.clone(),
                points: Vec::new(),
                remark: format!("{side} {}", self.scene.shape_name(one.shape)),
            }
        });
        finding(UNSEEN, unseen.len(), examples)
    }

    fn owner(&self, triangle: u32) -> String {
        let shape = self.triangles.shape(triangle);
        self.scene.shape_name(shape).to_owned()
    }
}

fn finding(
    (kind, nouns, meaning): Fault,
    count: usize,
    examples: impl Iterator<Item = Example>,
) -> Finding {
    Finding {
        kind,
        nouns,
        meaning,
        count,
        examples: examples.take(KEPT).collect(),
    }
}

/// All findings for people; nothing if there are none.
pub fn list(findings: &[Finding]) -> String {
    let mut text = String::new();
    for finding in findings {
        let noun = finding.nouns[usize::from(finding.count != 1)];
        // Writing to a string cannot fail.
        let _ = writeln!(text, "Found: {} {noun} {}", finding.count, finding.meaning);
        for example in finding.examples.iter().take(SHOWN) {
            let _ = writeln!(text, "  {}", example.line());
        }
        if finding.count > SHOWN {
            let _ = writeln!(text, "  … and {} more", finding.count - SHOWN);
        }
    }
    text
}

impl Example {
    fn line(&self) -> String {
        let points: Vec<String> = self.points.iter().map(coordinates).collect();
        let place = match points.len() {
            0 => String::new(),
            _ => format!(": {}", points.join(" – ")),
        };
        let remark = match (self.remark.as_str(), points.len()) {
            ("", _) => String::new(),
            (remark, 0) => format!(": {remark}"),
            (remark, _) => format!(", {remark}"),
        };
        format!("{}{place}{remark}", self.name)
    }
}

fn coordinates(point: &[f64; 3]) -> String {
    let [x, y, z] = point.map(|value| significant(value, DIGITS));
    format!("({x}, {y}, {z})")
}

impl Finding {
    /// The object for programs; coordinates are in metres.
    pub fn json(&self) -> Value {
        let example = |example: &Example| json!({ "name": example.name, "points": example.points, "remark": example.remark });
        json!({
            "kind": self.kind,
            "count": self.count,
            "meaning": self.meaning,
            "examples": self.examples.iter().map(example).collect::<Vec<_>>(),
        })
    }
}
