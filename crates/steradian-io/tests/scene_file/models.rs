//! Models of materials: what each key becomes, what is wrong with one, and single settings.

use steradian::brdf::Brdf;
use steradian::geometry::Direction;
use steradian::scene::Scene;
use steradian::scene::description::*;
use steradian::spectrum::Lanes;
use steradian_io::diagnostic::render;
use steradian_io::files::MemoryFiles;
use steradian_io::scene_file::{material_from_settings, models};

use crate::{describe, load};

const EVERY_KEY: &str = include_str!("every-key.toml");

fn material(name: &str) -> MaterialDescription {
    let mut materials = describe(EVERY_KEY).materials;
    materials.retain(|known| known.name == name);
    materials.remove(0)
}

fn recipe(name: &str) -> Recipe<Varying, Scalar> {
    match material(name).model {
        MaterialModel::Recipe(recipe) => recipe,
        other => panic!("{other:?}"),
    }
}

fn grey(value: f64) -> Varying {
    LaneValues::Uniform(value).into()
}

#[test]
fn diffuse_models() {
    let plaster = Recipe::OrenNayar {
        reflectance: grey(0.5),
        sigma: 20_f64.to_radians().into(),
    };
    let chalk = Recipe::EnergyPreservingOrenNayar {
        reflectance: grey(0.5),
        roughness: 0.75.into(),
    };
    let gloss = Recipe::Phong {
        diffuse: grey(0.5),
        glossy: grey(0.25),
        exponent: 50.0.into(),
    };
    let paper = Recipe::DiffuseTransmission {
        reflectance: grey(0.5),
        transmittance: grey(0.25),
    };
    assert_eq!(recipe("plaster"), plaster);
    assert_eq!(recipe("chalk"), chalk);
    assert_eq!(recipe("gloss"), gloss);
    assert_eq!(recipe("paper"), paper);
}

#[test]
fn metals() {
    let bands = [("visible".to_owned(), 4.2), ("nir".to_owned(), 5.5)];
    let silver = Recipe::Conductor {
        eta: grey(0.05),
        kappa: LaneValues::Bands(bands.to_vec()).into(),
        roughness: None,
    };
    assert_eq!(recipe("silver"), silver);
    let rough = |slopes, alpha, shadowing, multiple_scattering| Recipe::Conductor {
        eta: grey(0.05),
        kappa: grey(4.2),
        roughness: Some(Roughness {
            slopes,
            alpha,
            shadowing,
            multiple_scattering,
        }),
    };
    assert_eq!(
        recipe("brushed"),
        rough(Slopes::Beckmann, [0.125, 0.5], Shadowing::Separable, false)
    );
    assert_eq!(
        recipe("cast"),
        rough(Slopes::Ggx, [0.5; 2], Shadowing::HeightCorrelated, true)
    );
}

#[test]
fn glass() {
    let water = Recipe::Dielectric {
        ior: 1.333,
        exterior_ior: 1.5,
        roughness: None,
    };
    assert_eq!(recipe("water"), water);
    let bands = [("visible".to_owned(), 0.5), ("nir".to_owned(), 40.0)];
    let media = Media {
        inside: Some(LaneValues::Uniform(3.0)),
        outside: Some(LaneValues::Bands(bands.to_vec())),
    };
    assert_eq!(material("water").media, media);
    assert_eq!(
        material("ground").media.inside,
        Some(LaneValues::Uniform(50.0))
    );
    let frosted = Recipe::Dielectric {
        ior: 1.5,
        exterior_ior: 1.0,
        roughness: Some(Roughness {
            slopes: Slopes::Ggx,
            alpha: [0.25; 2],
            shadowing: Shadowing::HeightCorrelated,
            multiple_scattering: true,
        }),
    };
    assert_eq!(recipe("frosted"), frosted);
    let window = Recipe::Pane {
        ior: 1.52,
        transmittance: grey(0.9),
    };
    assert_eq!(recipe("window"), window);
}

#[test]
fn coats_and_gloss() {
    let plastic = |roughness| Recipe::Plastic {
        ior: 1.5,
        diffuse: grey(0.5),
        roughness,
    };
    assert_eq!(recipe("varnish"), plastic(None));
    let rough = |alpha| Roughness {
        slopes: Slopes::Ggx,
        alpha,
        shadowing: Shadowing::HeightCorrelated,
        multiple_scattering: true,
    };
    assert_eq!(recipe("eggshell"), plastic(Some(rough([0.25, 0.5]))));
    assert_eq!(recipe("satin"), plastic(Some(rough([0.25; 2]))));
    let lacquer = Recipe::Ward {
        diffuse: grey(0.5),
        specular: grey(0.25),
        alpha: [0.125, 0.25],
    };
    assert_eq!(recipe("lacquer"), lacquer);
    let old = |kind, specularity: f64| Recipe::Radiance {
        kind,
        color: grey(0.5),
        specularity: specularity.into(),
        roughness: 0.125.into(),
    };
    let trans = RadianceKind::Trans {
        transmissivity: 0.5,
        transmitted_specularity: 0.25,
    };
    assert_eq!(recipe("old-plastic"), old(RadianceKind::Plastic, 0.0625));
    assert_eq!(recipe("old-metal"), old(RadianceKind::Metal, 0.75));
    assert_eq!(recipe("old-trans"), old(trans, 0.0625));
    let mixed = MaterialModel::Mixture {
        of: vec!["plaster".into(), "silver".into()],
        weights: vec![0.25, 0.75],
    };
    assert_eq!(material("mixed").model, mixed);
}

#[test]
fn named_metals_and_glasses() {
    let ring = MaterialModel::Metal {
        metal: Metal::Gold,
        roughness: None,
    };
    assert_eq!(material("ring").model, ring);
    let cast = material("cast-iron").model;
    assert!(matches!(
        cast,
        MaterialModel::Metal {
            metal: Metal::Iron,
            roughness: Some(_)
        }
    ));
    let pond = Recipe::Dielectric {
        ior: Glass::Water.index(),
        exterior_ior: 1.0,
        roughness: None,
    };
    assert_eq!(recipe("pond"), pond);
    assert!(matches!(
        material("pond").media.inside,
        Some(LaneValues::Curve { .. })
    ));
    assert!(
        matches!(recipe("etched"), Recipe::Dielectric { ior, .. } if ior == Glass::NBk7.index())
    );
    assert!(material("etched").media.is_clear());
}

#[test]
fn gltfs_material() {
    let Recipe::Principled(car) = recipe("car") else {
        panic!("not principled")
    };
    let picture = car.roughness.picture.as_ref().unwrap();
    assert_eq!((car.roughness.factor, picture.channel), (0.5, 1));
    assert_eq!(picture.placement, [[1.0, 0.0, 0.0], [0.0, 2.0, 0.5]]);
    let expected = PrincipledRecipe {
        metallic: 0.25.into(),
        roughness: car.roughness.clone(),
        ior: 1.4,
        specular: 0.5.into(),
        specular_color: grey(2.0),
        transmission: Some(0.125.into()),
        thin: false,
        clearcoat: 1.0.into(),
        clearcoat_roughness: 0.0625.into(),
        sheen_color: grey(0.25),
        sheen_roughness: 0.75.into(),
        anisotropy: 0.5.into(),
        anisotropy_rotation: std::f64::consts::FRAC_PI_2.into(),
        ..PrincipledRecipe::new(grey(0.5), [grey(0.0), grey(1.0)])
    };
    assert_eq!(*car, expected);
    let Some(LaneValues::Uniform(absorption)) = material("car").media.inside else {
        panic!("{:?}", material("car").media)
    };
    // −ln .5/.1 m.
    assert!((absorption - 6.931_472).abs() < 1e-6);
}

#[test]
fn measured_surfaces_come_from_their_file() {
    let Recipe::Measured(table) = recipe("blind") else {
        panic!("no table")
    };
    let both = [Direction::Z, -Direction::Z].map(|wo| table.albedo(wo) + table.transmittance(wo));
    assert!(both.iter().any(|share| share.mean() > 0.0));
    let wrong = complaint("model = \"measured\"\nfile = \"parts/triangle.obj\"");
    assert!(
        wrong.contains("scene.toml:5:8") && wrong.contains("parts/triangle.obj:"),
        "{wrong}"
    );
}

/// What is wrong with a material, as the command line shows it.
fn complaint(material: &str) -> String {
    let text = format!(
        "[scene]\nspectrum = \"rgb\"\n[materials.a]\n{material}\n[[shapes]]\nkind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    let files = crate::files();
    let found = steradian_io::scene_file::read_scene_str("scene.toml", &text, &files);
    let problems = match found {
        Err(problems) => problems,
        Ok(loaded) => {
            let problems = Scene::of_surfaces(&loaded.description).err();
            let problems = problems.iter().flatten();
            problems.map(|problem| loaded.diagnostic(problem)).collect()
        }
    };
    render(&problems, false)
}

#[test]
fn what_is_wrong_is_told_at_its_line() {
    let cases = [
        (
            "model = \"oren-nayar\"\nreflectance = 0.5\nsigma = 0.3",
            "scene.toml:6:9",
            "expected an angle such as",
        ),
        (
            "model = \"oren-nayar\"\nreflectance = 0.5\nsigma = \"91 deg\"",
            "scene.toml:6:9",
            "sigma must lie between 0 and 1.57",
        ),
        (
            "model = \"eon\"\nroughness = 2\nreflectance = 0.5",
            "scene.toml:5:13",
            "roughness must lie between 0 and 1, got 2",
        ),
        (
            "model = \"phong\"\ndiffuse = 0.75\nglossy = 0.5\nexponent = 1",
            "scene.toml:5:11",
            "add up to 1.25",
        ),
        (
            "model = \"conductor\"\neta = -1\nk = 2",
            "scene.toml:5:7",
            "at least 0, not -1",
        ),
        (
            "model = \"conductor\"\neta = 1",
            "scene.toml:3:1",
            "missing key `k`",
        ),
        (
            "model = \"rough-conductor\"\neta = 1\nk = 2\nalpha = 2",
            "scene.toml:7:9",
            "alpha must lie between 0.001 and 1",
        ),
        (
            "model = \"rough-conductor\"\neta = 1\nk = 2\nalpha_x = 0.5\nalpha_y = 0",
            "scene.toml:8:11",
            "alpha_y must lie between",
        ),
        (
            "model = \"rough-conductor\"\neta = 1\nk = 2\nalpha = 0.5\nalpha_y = 0.5",
            "scene.toml:8:11",
            "only beside `alpha_x`",
        ),
        (
            "model = \"rough-conductor\"\neta = 1\nk = 2\nalpha = 0.5\ndistribution = \"phong\"",
            "scene.toml:8:16",
            "expected one of \"ggx\", \"beckmann\"",
        ),
        (
            "model = \"dielectric\"\nior = 20",
            "scene.toml:5:7",
            "ior must lie between 0.1 and 10",
        ),
        (
            "model = \"dielectric\"\nior = 1.5\nexterior_ior = 0",
            "scene.toml:6:16",
            "expected a number above 0",
        ),
        (
            "model = \"dielectric\"\nior = 1.5\nabsorption = 3",
            "scene.toml:6:14",
            "expected an absorption such as \"3 1/m\"",
        ),
        (
            "model = \"conductor\"\nmetal = \"glod\"",
            "scene.toml:5:9",
            "did you mean \"gold\"?",
        ),
        (
            "model = \"conductor\"\nmetal = \"gold\"\nk = 2",
            "scene.toml:6:5",
            "only beside `eta`",
        ),
        (
            "model = \"dielectric\"\nglass = \"water\"\nior = 1.33",
            "scene.toml:6:7",
            "exclude each other",
        ),
        (
            "model = \"principled\"\nbase_color = 0.5\nclearcoat_roughness = 2",
            "scene.toml:6:23",
            "clearcoat_roughness must lie between 0 and 1",
        ),
        (
            "model = \"principled\"\nbase_color = 0.5\nattenuation_color = 0\nattenuation_distance = 1",
            "scene.toml:6:21",
            "above 0 and up to 1",
        ),
        (
            "model = \"radiance-metal\"\ncolor = 0.5\nroughness = 2",
            "scene.toml:6:13",
            "roughness must lie between",
        ),
        (
            "model = \"radiance-plastic\"\ncolor = 1\nspecularity = 1.5",
            "scene.toml:6:15",
            "specularity must lie between 0 and 1",
        ),
        (
            "model = \"ward\"\ndiffuse = 0.5\nspecular = 0.75\nalpha = 0.25",
            "scene.toml:5:11",
            "add up to 1.25",
        ),
        (
            "model = \"mixture\"\nof = [\"b\"]\nweights = [1]",
            "scene.toml:5:6",
            "there is no material `b`",
        ),
        (
            "model = \"pane\"\nior = 1.5\ntransmitance = 0.5",
            "scene.toml:6:1",
            "did you mean `transmittance`?",
        ),
        (
            "model = \"pane\"\nior = 1.5\ntransmittance = 1.5",
            "scene.toml:6:17",
            "between 0 and 1, not 1.5",
        ),
    ];
    for (material, place, message) in cases {
        let told = complaint(material);
        assert!(
            told.contains(place) && told.contains(message),
            "{material}\n{told}"
        );
    }
}

#[test]
fn settings_are_read_as_keys_are() {
    let files = MemoryFiles::default();
    let settings = [("ior", "1.5"), ("transmittance", "[0.5, 0.75, 1]")];
    let pane = material_from_settings("pane", &settings, &Lanes::rgb(), &files).unwrap();
    assert!(matches!(
        pane.brdf([0.0; 4]).as_deref(),
        Some(Brdf::Pane(_))
    ));
    let says = |model: &str, settings: &[(&str, &str)]| {
        let found = material_from_settings(model, settings, &Lanes::rgb(), &files);
        render(&found.err().unwrap(), false)
    };
    let out_of_range = says("pane", &[("ior", "0.5")]);
    assert!(
        out_of_range.contains("settings of pane:3:7"),
        "{out_of_range}"
    );
    assert!(
        out_of_range.contains("ior must lie between 1 and 10"),
        "{out_of_range}"
    );
    assert!(says("pain", &[]).contains("did you mean \"pane\"?"));
    assert!(says("pane", &[("iro", "1.5")]).contains("did you mean `ior`?"));
    assert!(says("pane", &[("ior", "1.5"), ("ior", "1.6")]).contains("duplicate key"));
    assert!(says("two-sided", &[("front", "a"), ("back", "b")]).contains("names others"));
}

#[test]
fn every_model_lists_its_keys() {
    let models = models();
    let rough = models
        .iter()
        .find(|model| model.name == "rough-conductor")
        .unwrap();
    let key = |name| rough.keys.iter().find(|key| key.name == name).unwrap();
    assert_eq!(key("alpha").one_of, ["alpha", "alpha_x"]);
    assert_eq!(key("alpha_y").beside, Some("alpha_x"));
    assert_eq!(key("distribution").default, Some("\"ggx\""));
    assert_eq!(key("eta").one_of, ["metal", "eta"]);
    assert!(key("eta").doc.contains("0 to 1000") && !key("eta").required);
    let loaded = load(EVERY_KEY).description;
    assert!(models.len() > 11 && loaded.materials.len() > models.len());
}
