//! `brdf`: every reference case of reflection, and what a reader sees.

use serde_json::Value;
use steradian_tests::command::{Folder, steradian};

const TABLES: [&str; 2] = [
    include_str!("../../data/cases/brdf-fresnel.json"),
    include_str!("../../data/cases/brdf-models.json"),
];

/// Models answer in single precision: half a unit in the last of 24 bits.
const SINGLE: f64 = 6e-8;

fn json(words: &[&str]) -> Value {
    let all = [&["brdf"], words, &["--format", "json"]].concat();
    serde_json::from_str(&steradian(&all).fine()).unwrap()
}

/// The number at a path such as `transmittance/value`.
fn number(found: &Value, path: &str) -> f64 {
    let place = path.split('/').fold(found, |value, key| &value[key]);
    place
        .as_f64()
        .unwrap_or_else(|| panic!("no {path} in {found}"))
}

fn is_close(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() <= tolerance
}

/// A case: its id, parameters, expected numbers and the error of the reference.
struct Case(Value);

impl Case {
    fn param(&self, name: &str) -> String {
        self.0["params"][name].to_string()
    }

    fn angle(&self, name: &str) -> String {
        format!("{}deg", self.param(name))
    }

    /// Refuses a number that is further off than the reference's own error and `tolerance`, relative to 1 or to the number.
    fn assert(&self, name: &str, found: f64, tolerance: f64) {
        let expected = number(&self.0, &format!("expect/{name}"));
        let own = number(&self.0, "reference_rel_error") * expected.abs();
        let allowed = own + tolerance * expected.abs().max(1.0);
        assert!(
            is_close(found, expected, allowed),
            "{} {name}: {found}, expected {expected}",
            self.0["id"]
        );
    }
}

fn cases() -> Vec<Case> {
    let table = |text| serde_json::from_str::<Value>(text).unwrap()["cases"].take();
    let all = TABLES
        .into_iter()
        .flat_map(|text| table(text).as_array().cloned().unwrap());
    all.map(Case).collect()
}

/// What a command says of a case, name by name, and how exact the method is.
fn answers(case: &Case) -> Vec<(&'static str, f64, f64)> {
    match case.0["kind"].as_str().unwrap() {
        "fresnel_dielectric" => {
            let found = fresnel(&[
                "--ior",
                &case.param("eta_t_over_eta_i"),
                "--theta-i",
                &case.angle("theta_i_deg"),
            ]);
            let power = [
                ("R", "value"),
                ("Rs", "r_s/value"),
                ("Rp", "r_p/value"),
                ("T", "transmittance/value"),
            ];
            power
                .map(|(name, path)| (name, number(&found, path), 1e-14))
                .into()
        }
        "fresnel_conductor" => {
            let theta = case.angle("theta_i_deg");
            let found = fresnel(&[
                "--ior",
                &case.param("eta"),
                "--k",
                &case.param("k"),
                "--theta-i",
                &theta,
            ]);
            let power = [("R", "value"), ("Rs", "r_s/value"), ("Rp", "r_p/value")];
            power
                .map(|(name, path)| (name, number(&found, path), 1e-14))
                .into()
        }
        "fresnel_hemispherical" => {
            let found = fresnel(&["--ior", &case.param("eta_t_over_eta_i")]);
            vec![("value", number(&found, "hemispherical/value"), 1e-11)]
        }
        "schlick" => {
            let found = fresnel(&[
                "--schlick",
                &case.param("F0"),
                "--theta-i",
                &case.angle("theta_deg"),
            ]);
            vec![("value", number(&found, "value"), 1e-14)]
        }
        "refraction" => refraction(case),
        _ => of_models(case),
    }
}

fn fresnel(words: &[&str]) -> Value {
    json(&[&["fresnel"], words].concat())
}

fn refraction(case: &Case) -> Vec<(&'static str, f64, f64)> {
    let found = fresnel(&[
        "--ior",
        &case.param("eta"),
        "--theta-i",
        &case.angle("theta_i_deg"),
    ]);
    vec![
        ("theta_t_deg", number(&found, "theta_t/value"), 1e-12),
        (
            "radiance_scale",
            number(&found, "radiance_scale/value"),
            1e-14,
        ),
        (
            "critical_angle_deg",
            number(&found, "critical_angle/value"),
            1e-12,
        ),
        ("brewster_deg", number(&found, "brewster/value"), 1e-12),
    ]
}

/// `brdf albedo` with settings.
fn albedo(model: &str, settings: &[String], theta: &str) -> Value {
    let mut words = vec!["albedo", model, "--theta-i", theta];
    settings
        .iter()
        .for_each(|setting| words.extend(["--set", setting]));
    json(&words)
}

fn of_models(case: &Case) -> Vec<(&'static str, f64, f64)> {
    let set = |key: &str, param: &str| format!("{key}={}", case.param(param));
    let single = || "multiple_scattering=false".to_owned();
    match case.0["kind"].as_str().unwrap() {
        "lambert" => {
            let reflectance = set("reflectance", "reflectance");
            let value = json(&[
                "eval",
                "lambertian",
                "--set",
                &reflectance,
                "--theta-i",
                "20deg",
            ]);
            let share = albedo("lambertian", &[reflectance], "20deg");
            vec![
                ("f", number(&value, "value"), SINGLE),
                ("rho_dh", number(&share, "value"), SINGLE),
            ]
        }
        "oren_nayar" => {
            let settings = [
                set("reflectance", "rho"),
                format!("sigma={} deg", case.param("sigma_deg")),
            ];
            let share = albedo("oren-nayar", &settings, &case.angle("theta_i_deg"));
            vec![("value", number(&share, "value"), 2.0 * SINGLE)]
        }
        "ggx_directional_albedo" => {
            let mirror = ["eta=0".to_owned(), "k=1".to_owned()];
            let settings = [&mirror[..], &[set("alpha", "alpha"), single()]].concat();
            let share = albedo("rough-conductor", &settings, &case.angle("theta_i_deg"));
            vec![(
                "rho_dh_height_correlated",
                number(&share, "value"),
                number(&share, "error_bound"),
            )]
        }
        "rough_dielectric" => {
            let settings = [
                set("ior", "eta_t_over_eta_i"),
                set("alpha", "alpha"),
                single(),
            ];
            let share = albedo("rough-dielectric", &settings, &case.angle("theta_i_deg"));
            let bound = number(&share, "error_bound");
            vec![
                ("reflectance", number(&share, "value"), bound),
                (
                    "transmittance",
                    number(&share, "transmittance/value"),
                    bound,
                ),
            ]
        }
        "glass_pane" => {
            let settings = [
                set("ior", "eta"),
                set("transmittance", "internal_transmittance_normal"),
            ];
            let share = albedo("pane", &settings, &case.angle("theta_i_deg"));
            vec![
                ("reflectance", number(&share, "value"), SINGLE),
                (
                    "transmittance",
                    number(&share, "transmittance/value"),
                    SINGLE,
                ),
            ]
        }
        other => panic!("no command for {other}"),
    }
}

#[test]
fn every_reference_case_comes_out() {
    let cases = cases();
    assert_eq!(cases.len(), 99);
    for case in &cases {
        for (name, found, tolerance) in answers(case) {
            case.assert(name, found, tolerance);
        }
    }
}

/// Smooth interfaces answer as Fresnel's equations do, to single precision.
#[test]
fn smooth_models_have_the_shares_of_their_interface() {
    for case in cases() {
        let theta = || case.angle("theta_i_deg");
        match case.0["kind"].as_str().unwrap() {
            "fresnel_dielectric" => {
                let share = albedo(
                    "dielectric",
                    &[format!("ior={}", case.param("eta_t_over_eta_i"))],
                    &theta(),
                );
                case.assert("R", number(&share, "value"), SINGLE);
                case.assert("T", number(&share, "transmittance/value"), SINGLE);
            }
            "fresnel_conductor" => {
                let settings = [
                    format!("eta={}", case.param("eta")),
                    format!("k={}", case.param("k")),
                ];
                let share = albedo("conductor", &settings, &theta());
                case.assert("R", number(&share, "value"), SINGLE);
            }
            "fresnel_hemispherical" => {
                let ior = format!("ior={}", case.param("eta_t_over_eta_i"));
                let mean = json(&["albedo", "dielectric", "--set", &ior, "--hemispherical"]);
                case.assert("value", number(&mean, "value"), 2e-4);
            }
            _ => {}
        }
    }
}

/// Mitsuba 3's own tests of Fresnel's equations state these amplitudes, in single precision.
#[test]
fn amplitudes_are_those_of_mitsuba() {
    let found = fresnel(&["--ior", "1.5", "--theta-i", "45deg"]);
    for (path, expected) in [
        ("amplitude_s/value", 0.303_337_045_290_423_5),
        ("amplitude_p/value", 0.092_013_363_045_524_42),
    ] {
        assert!(
            is_close(number(&found, path).abs(), expected, 1e-15),
            "{path}"
        );
    }
    let inside = fresnel(&["--ior", "0.6666666666666666", "--theta-i", "10deg"]);
    for (path, expected) in [
        ("amplitude_s/value", 0.209_494_319_638_520_14),
        ("amplitude_p/value", 0.190_467_971_977_940_74),
    ] {
        assert!(
            is_close(number(&inside, path).abs(), expected, 1e-7),
            "{path}"
        );
    }
    // At Brewster's angle r_s = (η² − 1)/(η² + 1), 1.25/3.25 for glass.
    let brewster = fresnel(&["--ior", "1.5", "--theta-i", "56.309932474020215deg"]);
    assert!(is_close(
        number(&brewster, "amplitude_s/value").abs(),
        0.384_615_384_6,
        1e-9
    ));
}

/// Nori's references for its t-test of a rough plastic: diffuse (.1, .2, .15) and .8 times a lobe of Beckmann's facets, α = .1. They agree to
/// .15 %: its shadowing is a rational approximation, off by up to .35 %.
#[test]
fn the_lobe_of_rough_plastic_is_that_of_nori() {
    let diffuse = 0.2126 * 0.1 + 0.7152 * 0.2 + 0.0722 * 0.15;
    let settings = [
        "diffuse=0",
        "ior=1.4995846",
        "alpha=0.1",
        "distribution=beckmann",
        "multiple_scattering=false",
    ];
    let settings = settings.map(str::to_owned);
    for (theta, expected) in [
        ("0deg", 0.207_067),
        ("45deg", 0.215_733),
        ("60deg", 0.247_884),
        ("80deg", 0.430_936),
        ("85deg", 0.519_016),
    ] {
        let lobe = number(&albedo("rough-plastic", &settings, theta), "value");
        assert!(
            is_close((diffuse + 0.8 * lobe) / expected, 1.0, 1.5e-3),
            "{theta}: {lobe}"
        );
    }
}

#[test]
fn a_damaged_file_of_measured_data_is_told_with_its_line() {
    let file = "crates/steradian-io/tests/data/bsdf/klems_small_tab.xml";
    let message = steradian(&["brdf", "eval", file]).error();
    assert!(
        message.contains("line ") && message.contains("values are needed"),
        "{message}"
    );
}

#[test]
fn a_wavelength_takes_the_place_of_colours() {
    let gold = [
        "--set",
        "eta=[[450, 1.3831], [650, 0.15557]]",
        "--set",
        "k=[[450, 1.9155], [650, 3.6024]]",
    ];
    let share = |nm: &str| {
        let words = [&["albedo", "conductor", "--wavelength", nm][..], &gold].concat();
        number(&json(&words), "value")
    };
    // The ends of the table are reference cases of gold.
    assert!(
        is_close(share("450nm"), 0.408_192_234_737_171_9, 1e-4),
        "{}",
        share("450nm")
    );
    assert!(is_close(share("650nm"), 0.956_522_309_575_009_5, 1e-4));
}

#[test]
fn the_three_estimators_agree_under_constant_light() {
    let words = [
        "reflect",
        "oren-nayar",
        "--set",
        "reflectance=0.8",
        "--set",
        "sigma=20deg",
    ];
    let found = json(
        &[
            &words[..],
            &["--theta-o", "50deg", "--radiance", "2 W/(m2 sr)"],
        ]
        .concat(),
    );
    let exact = number(&found, "exact/value");
    assert!(
        is_close(number(&found, "sum/value") / exact, 1.0, 1e-3),
        "{found}"
    );
    assert!(is_close(
        number(&found, "quadrature/value") / exact,
        1.0,
        1e-3
    ));
    let error = number(&found, "monte_carlo/std_error");
    assert!(error > 0.0 && is_close(number(&found, "monte_carlo/value"), exact, 6.0 * error));
}

#[test]
fn a_light_gives_value_times_irradiance_times_cosine() {
    let words = [
        "reflect",
        "lambertian",
        "--set",
        "reflectance=0.5",
        "--incoming",
        "lights",
    ];
    let found = json(&[&words[..], &["--light", "60deg,0deg,100 W/m2"]].concat());
    // .5/π × 100 × cos 60°.
    let expected = 25.0 / std::f64::consts::PI;
    assert!(is_close(number(&found, "sum/value"), expected, 1e-6));
    assert!(is_close(
        number(&found, "quadrature/value") / expected,
        1.0,
        0.05
    ));
    let error = number(&found, "monte_carlo/std_error");
    assert!(
        is_close(number(&found, "monte_carlo/value"), expected, 6.0 * error),
        "{found}"
    );
}

#[test]
fn a_model_passes_its_checks_and_its_furnace() {
    let fine = steradian(&[
        "brdf",
        "check",
        "eon",
        "--set",
        "reflectance=[0.9,0.5,0.1]",
        "--set",
        "roughness=0.5",
        "--effort",
        "quick",
    ]);
    let text = fine.fine();
    for word in [
        "reciprocity",
        "energy",
        "sampling",
        "mean weight",
        "furnace",
        "ok",
    ] {
        assert!(text.contains(word), "{word} is not in {text}");
    }
    assert!(!text.contains("FAILED"));
}

#[test]
fn plots_are_drawn_with_their_units() {
    let folder = Folder::new();
    let model = "oren-nayar reflectance=0.8 sigma=20 deg";
    for (kind, words) in [
        ("lobes", ["ρ (1/sr)", "θ_i = 45°"]),
        ("albedo", ["angle of incidence (°)", "share of the light"]),
        ("map", ["ρ (1/sr)", "the dot is the light"]),
    ] {
        let file = folder.path(&format!("{kind}.svg"));
        steradian(&[
            "brdf",
            "plot",
            model,
            "lambertian reflectance=0.5",
            "--kind",
            kind,
            "--theta-i",
            "45deg",
            "-o",
            &file,
        ])
        .fine();
        let svg = std::fs::read_to_string(&file).unwrap();
        for word in words
            .into_iter()
            .chain([model, "lambertian reflectance=0.5"])
        {
            assert!(svg.contains(word), "{kind}: {word}");
        }
    }
}

#[test]
fn models_and_their_parameters_are_listed() {
    let list = steradian(&["brdf", "list"]).fine();
    for name in ["lambertian", "oren-nayar", "rough-conductor", "pane"] {
        assert!(list.contains(name), "{name}");
    }
    let one = steradian(&["brdf", "list", "pane"]).fine();
    assert!(
        one.contains("ior") && one.contains("transmittance"),
        "{one}"
    );
}

#[test]
fn mistakes_are_told_by_the_name_of_the_setting() {
    for (words, parts) in [
        (&["eval", "lambertin"][..], &["lambertin", "lambertian"][..]),
        (
            &["eval", "lambertian", "--set", "reflectance=5"],
            &["reflectance", "0 and 1"],
        ),
        (
            &[
                "eval",
                "rough-conductor",
                "--set",
                "metal=gold",
                "--set",
                "alhpa=0.1",
            ],
            &["alhpa", "alpha"],
        ),
        (
            &["eval", "lambertian", "--set", "reflectance"],
            &["KEY=VALUE"],
        ),
        (
            &[
                "eval",
                "lambertian",
                "--set",
                "reflectance=0.5",
                "--wavelength",
                "5nm",
            ],
            &["280", "4000"],
        ),
        (&["fresnel", "--ior", "-1"], &["index of refraction"]),
        (
            &["fresnel", "--ior", "1.5", "--theta-i", "95deg"],
            &["between 0 and 90 deg"],
        ),
        (
            &[
                "reflect",
                "lambertian",
                "--set",
                "reflectance=1",
                "--incoming",
                "lights",
            ],
            &["--light"],
        ),
        (
            &[
                "reflect",
                "lambertian",
                "--set",
                "reflectance=1",
                "--incoming",
                "no.exr",
            ],
            &["no.exr"],
        ),
        (&["list", "glas"], &["glas", "pane"]),
        (&["check", "--set", "alpha=1"], &["--set goes with a model"]),
    ] {
        let message = steradian(&[&["brdf"], words].concat()).error();
        for part in parts {
            assert!(message.contains(part), "{part} is not in {message}");
        }
    }
}

#[test]
fn every_part_has_help_with_examples() {
    for part in [
        "list", "eval", "albedo", "fresnel", "reflect", "check", "plot",
    ] {
        let help = steradian(&["brdf", part, "--help"]).fine();
        assert!(
            help.contains("Examples:") && help.contains(&format!("steradian brdf {part}")),
            "{part}"
        );
    }
}
