//! The ends of the parameters' ranges, model by model, and how a model is set to lose nothing.

use steradian_io::scene_file::models;

use super::model::Settings;

/// Roughnesses of a furnace.
const ROUGHNESSES: [f64; 6] = [0.05, 0.1, 0.25, 0.5, 0.75, 1.0];

/// A model with settings, or its furnace.
pub struct Corner {
    /// The model's name.
    pub model: String,
    /// KEY=VALUE.
    pub settings: Vec<String>,
    /// Settings without loss and what is varied.
    pub furnace: Option<Furnace>,
}

/// A model that loses nothing, over roughness.
pub struct Furnace {
    /// KEY=VALUE, without the roughness.
    fixed: Vec<String>,
    /// The key of the roughness; none if there is none.
    key: Option<&'static str>,
    /// Its values.
    pub roughnesses: Vec<f64>,
}

impl Furnace {
    /// For reports.
    pub fn title(&self, model: &str) -> String {
        let varied = self.key.map(|key| format!("over {key}"));
        let words = self.fixed.iter().cloned().chain(varied);
        format!("{model} {}", words.collect::<Vec<_>>().join(" "))
    }

    /// The settings at a roughness.
    pub fn settings(&self, roughness: f64) -> Vec<String> {
        let varied = self.key.map(|key| format!("{key}={roughness}"));
        self.fixed.iter().cloned().chain(varied).collect()
    }
}

/// Settings that stay, and lists of values for each key of which every combination is a corner.
struct Range {
    model: &'static str,
    fixed: &'static [&'static str],
    ends: &'static [(&'static str, &'static [&'static str])],
}

const fn range(
    model: &'static str,
    fixed: &'static [&'static str],
    ends: &'static [(&'static str, &'static [&'static str])],
) -> Range {
    Range { model, fixed, ends }
}

const SHARE: &[&str] = &["0", "1", "[0.9,0.5,0.1]"];
const WIDTH: &[&str] = &["0.001", "0.05", "0.3", "1"];
const SLOPES: (&str, &[&str]) = ("distribution", &["ggx", "beckmann"]);
const SCATTERING: (&str, &[&str]) = ("multiple_scattering", &["true", "false"]);

const RANGES: &[Range] = &[
    range("lambertian", &[], &[("reflectance", SHARE)]),
    range("mirror", &[], &[("reflectance", SHARE)]),
    range(
        "oren-nayar",
        &[],
        &[
            ("reflectance", SHARE),
            ("sigma", &["0deg", "20deg", "90deg"]),
        ],
    ),
    range(
        "eon",
        &[],
        &[("reflectance", SHARE), ("roughness", &["0", "0.3", "1"])],
    ),
    range(
        "phong",
        &["diffuse=0.3", "glossy=[0.7,0.4,0.1]"],
        &[("exponent", &["0", "20", "1e4"])],
    ),
    range(
        "phong",
        &["diffuse=0", "glossy=1"],
        &[("exponent", &["0", "1e6"])],
    ),
    range(
        "diffuse-transmission",
        &[],
        &[
            ("reflectance", &["0", "0.3"]),
            ("transmittance", &["0", "0.7"]),
        ],
    ),
    range("conductor", &["eta=[0.14,0.37,1.44]", "k=[4,2.4,1.6]"], &[]),
    range(
        "conductor",
        &[],
        &[("eta", &["0", "1"]), ("k", &["0.001", "1000"])],
    ),
    range(
        "rough-conductor",
        &["eta=[0.14,0.37,1.44]", "k=[4,2.4,1.6]"],
        &[("alpha", WIDTH), SLOPES, SCATTERING],
    ),
    range(
        "rough-conductor",
        &[
            "eta=[0.14,0.37,1.44]",
            "k=[4,2.4,1.6]",
            "alpha_x=0.05",
            "alpha_y=0.5",
        ],
        &[SLOPES, SCATTERING],
    ),
    range(
        "dielectric",
        &[],
        &[("ior", &["0.1", "0.75", "1", "1.5", "10"])],
    ),
    range(
        "rough-dielectric",
        &["ior=1.5"],
        &[("alpha", WIDTH), SLOPES, SCATTERING],
    ),
    range(
        "rough-dielectric",
        &["alpha=0.3"],
        &[("ior", &["0.5", "1.01", "3"]), SCATTERING],
    ),
    range(
        "rough-dielectric",
        &["ior=1.33", "alpha_x=0.1", "alpha_y=0.6"],
        &[SLOPES],
    ),
    range(
        "pane",
        &[],
        &[
            ("ior", &["1", "1.52", "10"]),
            ("transmittance", &["0", "0.9", "1"]),
        ],
    ),
    range(
        "plastic",
        &[],
        &[("ior", &["1.01", "1.5", "3"]), ("diffuse", SHARE)],
    ),
    range(
        "rough-plastic",
        &["diffuse=[0.9,0.5,0.1]", "ior=1.5"],
        &[("alpha", WIDTH), SLOPES, SCATTERING],
    ),
    range(
        "ward",
        &["diffuse=[0.4,0.2,0.1]", "specular=0.3"],
        &[
            ("alpha_x", &["0.002", "0.05", "0.2", "1"]),
            ("alpha_y", &["0.002", "0.01", "0.1", "1"]),
        ],
    ),
    range(
        "radiance-plastic",
        &["color=[0.8,0.4,0.1]"],
        &[
            ("specularity", &["0", "0.05", "1"]),
            ("roughness", &["0", "0.1", "0.5"]),
        ],
    ),
    range(
        "radiance-metal",
        &["color=[0.8,0.4,0.1]"],
        &[
            ("specularity", &["0", "0.9", "1"]),
            ("roughness", &["0", "0.1", "0.5"]),
        ],
    ),
    range(
        "radiance-trans",
        &["color=0.8", "specularity=0.05"],
        &[
            ("roughness", &["0", "0.2"]),
            ("transmissivity", &["0", "0.5", "1"]),
            ("transmitted_specularity", &["0", "0.5", "1"]),
        ],
    ),
    range(
        "principled",
        &["base_color=[0.9,0.5,0.1]"],
        &[
            ("metallic", &["0", "0.5", "1"]),
            ("roughness", &["0.05", "0.5", "1"]),
        ],
    ),
    range(
        "principled",
        &["base_color=1", "metallic=0", "roughness=0.2"],
        &[
            ("transmission", &["0.5", "1"]),
            ("clearcoat", &["0", "1"]),
            ("sheen_color", &["0", "1"]),
        ],
    ),
    range(
        "principled",
        &["base_color=0.8", "metallic=1", "roughness=0.4"],
        &[
            ("anisotropy", &["0.5", "1"]),
            ("clearcoat", &["1"]),
            ("sheen_color", &["1"]),
        ],
    ),
];

/// Models without loss, and the key that is varied.
const LOSSLESS: &[(&str, &[&str], Option<&str>)] = &[
    ("lambertian", &["reflectance=1"], None),
    ("mirror", &["reflectance=1"], None),
    ("eon", &["reflectance=1"], Some("roughness")),
    ("dielectric", &["ior=1.5"], None),
    ("pane", &["ior=1.52", "transmittance=1"], None),
    ("rough-conductor", &["eta=0", "k=1"], Some("alpha")),
    (
        "rough-conductor",
        &["eta=0", "k=1", "distribution=beckmann"],
        Some("alpha"),
    ),
    ("rough-dielectric", &["ior=1.5"], Some("alpha")),
    (
        "rough-dielectric",
        &["ior=1.5", "distribution=beckmann"],
        Some("alpha"),
    ),
    ("plastic", &["ior=1.5", "diffuse=1"], None),
    ("rough-plastic", &["ior=1.5", "diffuse=1"], Some("alpha")),
    (
        "principled",
        &["base_color=1", "metallic=1"],
        Some("roughness"),
    ),
    (
        "principled",
        &["base_color=1", "metallic=0"],
        Some("roughness"),
    ),
];

/// Every corner of every model, then the furnaces.
pub fn all() -> Vec<Corner> {
    let models = models();
    let is_known = |name: &str| models.iter().any(|model| model.name == name);
    let corners = RANGES
        .iter()
        .filter(|range| is_known(range.model))
        .flat_map(|range| {
            combinations(range).into_iter().map(|settings| Corner {
                model: range.model.to_owned(),
                settings,
                furnace: None,
            })
        });
    let furnaces =
        LOSSLESS
            .iter()
            .filter(|(name, ..)| is_known(name))
            .map(|&(model, fixed, key)| Corner {
                model: model.to_owned(),
                settings: Vec::new(),
                furnace: Some(varied(fixed, key)),
            });
    corners.chain(furnaces).collect()
}

/// The furnace of a model as it is set: of compensated ones, with the same slopes of facets.
pub fn furnace(model: &str, settings: &Settings) -> Option<Furnace> {
    let is_set = |setting: &str| {
        settings
            .set
            .iter()
            .any(|own| own.replace(' ', "") == setting)
    };
    if is_set("multiple_scattering=false") {
        return None;
    }
    let mut fitting = LOSSLESS.iter().filter(|(name, ..)| *name == model);
    let same_slopes = |fixed: &[&str]| {
        fixed.contains(&"distribution=beckmann") == is_set("distribution=beckmann")
    };
    let found = fitting.find(|(_, fixed, _)| same_slopes(fixed))?;
    Some(varied(found.1, found.2))
}

fn varied(fixed: &[&str], key: Option<&'static str>) -> Furnace {
    Furnace {
        fixed: fixed.iter().map(|&setting| setting.to_owned()).collect(),
        key,
        roughnesses: if key.is_some() {
            ROUGHNESSES.to_vec()
        } else {
            vec![0.0]
        },
    }
}

/// Every choice of one value for each key.
fn combinations(range: &Range) -> Vec<Vec<String>> {
    let start: Vec<String> = range
        .fixed
        .iter()
        .map(|&setting| setting.to_owned())
        .collect();
    range.ends.iter().fold(vec![start], |all, (key, values)| {
        all.iter()
            .flat_map(|settings| {
                values.iter().map(move |value| {
                    let mut settings = settings.clone();
                    settings.push(format!("{key}={value}"));
                    settings
                })
            })
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Those that name others or a file have no ranges of their own.
    #[test]
    fn every_model_has_corners() {
        for model in models() {
            let named = ["two-sided", "mixture", "measured"].contains(&model.name);
            assert!(
                named || RANGES.iter().any(|range| range.model == model.name),
                "{}",
                model.name
            );
        }
    }

    #[test]
    fn every_combination_is_a_corner_once() {
        let range = range("x", &["a=1"], &[("b", &["1", "2"]), ("c", &["3", "4"])]);
        let all = combinations(&range);
        assert_eq!(all.len(), 4);
        assert_eq!(all[1], ["a=1", "b=1", "c=4"]);
    }

    #[test]
    fn a_furnace_has_the_slopes_of_the_model() {
        let set = |words: &[&str]| Settings {
            set: words.iter().map(|&word| word.to_owned()).collect(),
            wavelength: None,
        };
        let found = furnace(
            "rough-conductor",
            &set(&["metal=gold", "distribution=beckmann"]),
        );
        let settings = found.unwrap().settings(0.5);
        assert_eq!(
            settings,
            ["eta=0", "k=1", "distribution=beckmann", "alpha=0.5"]
        );
        assert!(furnace("rough-conductor", &set(&["multiple_scattering=false"])).is_none());
        assert!(furnace("ward", &set(&[])).is_none());
    }
}
