//! Synthetic tensor files of RGL.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use steradian::brdf::Measured;
use steradian::brdf::measured::Reading;
use steradian::geometry::{Direction, Vector};
use steradian::material::Recipe;
use steradian::scene::LoneMaterial;
use steradian::scene::description::{MaterialDescription, MaterialModel};
use steradian::spectrum::Lanes;
use steradian_io::files::MemoryFiles;
use steradian_io::import::bsdf::{MeasuredFile, read};

use super::{direction, parsed};

/// Points along the sides of the warped square.
const POINTS: usize = 64;

/// A field: its name, type, dimensions and data.
struct Field(&'static str, u8, Vec<usize>, Vec<u8>);

fn floats(name: &'static str, shape: &[usize], values: impl IntoIterator<Item = f64>) -> Field {
    let data = values
        .into_iter()
        .flat_map(|value| (value as f32).to_le_bytes());
    Field(name, 10, shape.to_vec(), data.collect())
}

fn octets(name: &'static str, data: &[u8]) -> Field {
    Field(name, 1, vec![data.len()], data.to_vec())
}

fn written(fields: &[Field]) -> Vec<u8> {
    let header: usize = fields
        .iter()
        .map(|field| 13 + field.0.len() + 8 * field.2.len())
        .sum();
    let mut bytes = b"tensor_file\0\x01\0".to_vec();
    bytes.extend((fields.len() as u32).to_le_bytes());
    let mut at = (bytes.len() + header) as u64;
    for Field(name, kind, shape, data) in fields {
        bytes.extend((name.len() as u16).to_le_bytes());
        bytes.extend(name.bytes());
        bytes.extend((shape.len() as u16).to_le_bytes());
        bytes.push(*kind);
        bytes.extend(at.to_le_bytes());
        bytes.extend(shape.iter().flat_map(|n| (*n as u64).to_le_bytes()));
        at += data.len() as u64;
    }
    bytes.extend(fields.iter().flat_map(|field| field.3.iter().copied()));
    bytes
}

/// What a synthetic table is made of.
struct Law<'a> {
    phi: Vec<f64>,
    theta: Vec<f64>,
    /// Wavelengths in nm; none for colours.
    wavelengths: Vec<f64>,
    /// ρ in 1/sr of d_e, d_i and a channel.
    value: &'a dyn Fn(Direction, Direction, usize) -> f64,
}

/// Visible facets have the density 2u₁, so that the warp is (√s₁, s₂); D = 1 + u₁ and σ = (1 + u₁)/4 are no constants.
fn fields(law: &Law) -> Vec<Field> {
    let [phi, theta] = [law.phi.len(), law.theta.len()];
    let channels = law.wavelengths.len().max(3);
    let ramp = |scale: f64| (0..4).map(move |k| scale * (1.0 + f64::from(k % 2)));
    let nodes = phi * theta;
    let point = |k: usize| [k % POINTS, k / POINTS].map(|at| at as f64 / (POINTS - 1) as f64);
    let value = |k: usize| {
        let (sheet, place) = (k / (POINTS * POINTS), point(k % (POINTS * POINTS)));
        let (node, channel) = (sheet / channels, sheet % channels);
        reflected(
            law,
            [law.phi[node / theta], law.theta[node % theta]],
            place,
            channel,
        )
    };
    let count = nodes * channels * POINTS * POINTS;
    let shape = [phi, theta, channels, POINTS, POINTS];
    let mut fields = vec![
        octets("description", b"synthetic"),
        octets("jacobian", &[1]),
        floats("phi_i", &[phi], law.phi.iter().copied()),
        floats("theta_i", &[theta], law.theta.iter().copied()),
        floats("ndf", &[2, 2], ramp(1.0)),
        floats("sigma", &[2, 2], ramp(0.25)),
        floats(
            "vndf",
            &[phi, theta, 2, 2],
            (0..4 * nodes).map(|k| (k % 2) as f64),
        ),
        floats(
            "luminance",
            &[phi, theta, POINTS, POINTS],
            (0..nodes * POINTS * POINTS).map(|k| 1.0 + point(k % (POINTS * POINTS))[1]),
        ),
    ];
    if law.wavelengths.is_empty() {
        fields.push(floats("rgb", &shape, (0..count).map(value)));
    } else {
        fields.push(floats(
            "wavelengths",
            &[channels],
            law.wavelengths.iter().copied(),
        ));
        fields.push(floats("spectra", &shape, (0..count).map(value)));
    }
    fields
}

/// ρ cosθ_i over D/(4σ), at a point of the warped square.
fn reflected(law: &Law, [phi_e, theta_e]: [f64; 2], [s, t]: [f64; 2], channel: usize) -> f64 {
    let wo = polar(theta_e, phi_e);
    let u = s.sqrt();
    let from = if law.phi.len() <= 2 { phi_e } else { 0.0 };
    let half = polar(u * u * FRAC_PI_2, (2.0 * t - 1.0) * PI + from);
    let wi = half.mirror(wo);
    if wo.dot(half) <= 0.0 || wi.z() <= 1e-9 {
        return 0.0;
    }
    let factor = (1.0 + u) / (1.0 + (theta_e / FRAC_PI_2).sqrt());
    (law.value)(wo, wi, channel) * wi.z() / factor
}

fn polar(theta: f64, phi: f64) -> Direction {
    let sin = libm::sin(theta);
    let vector = Vector::new(sin * libm::cos(phi), sin * libm::sin(phi), libm::cos(theta));
    Direction::new(vector).unwrap()
}

/// GGX with F = 1 and without shadowing, of widths along x and y.
fn ggx(wo: Direction, wi: Direction, [x, y]: [f64; 2]) -> f64 {
    let h = Direction::new(wo.to_vector() + wi.to_vector()).unwrap();
    let slope = (h.x() / x).powi(2) + (h.y() / y).powi(2) + h.z() * h.z();
    1.0 / (PI * x * y * slope * slope) / (4.0 * wo.z().max(wi.z()))
}

fn isotropic(wavelengths: Vec<f64>) -> Vec<Field> {
    fields(&Law {
        phi: vec![0.0],
        theta: vec![0.0, 0.4, 0.8, 1.2, FRAC_PI_2],
        wavelengths,
        value: &|wo, wi, channel| (0.1 + ggx(wo, wi, [0.6; 2])) * (channel + 1) as f64 / 3.0,
    })
}

/// Half a turn of azimuths, which the other half repeats.
fn anisotropic() -> Vec<Field> {
    fields(&Law {
        phi: (0..9).map(|k| PI * (f64::from(k) / 8.0 - 1.0)).collect(),
        theta: vec![0.0, 0.4, 0.8, 1.2],
        wavelengths: vec![],
        value: &|wo, wi, _| 0.1 + ggx(wo, wi, [0.4, 0.8]),
    })
}

fn file(fields: &[Field]) -> MeasuredFile {
    parsed("a.bsdf", written(fields))
}

fn lanes(model: &Measured, wo: Direction, wi: Direction) -> [f64; 4] {
    model.evaluate(wo, wi).to_lanes().map(f64::from)
}

/// At the nodes of θ_e only the grid's straight lines stand between table and law: 64 points leave less than 1 %.
#[test]
fn an_isotropic_table_gives_the_law_that_it_was_made_of() {
    let file = file(&isotropic(vec![]));
    assert!(file.warnings.is_empty());
    let model = file.model().unwrap();
    for theta in [0.4, 0.8, 1.2] {
        for (theta_i, phi) in [(0.1, 2.0), (0.7, 3.3), (1.0, 4.0), (0.9, 0.3)] {
            let (wo, wi) = (polar(theta, 0.7), polar(theta_i, 0.7 + phi));
            let expected = 0.1 + ggx(wo, wi, [0.6; 2]);
            let [red, green, blue, rest] = lanes(model, wo, wi);
            assert!(
                (blue / expected - 1.0).abs() < 0.01,
                "{theta} {theta_i}: {blue} {expected}"
            );
            assert!(
                (red / blue - 1.0 / 3.0).abs() < 1e-6 && (green / blue - 2.0 / 3.0).abs() < 1e-6
            );
            assert_eq!(rest, 0.0);
        }
    }
}

#[test]
fn an_anisotropic_table_gives_the_law_that_it_was_made_of() {
    let file = file(&anisotropic());
    let model = file.model().unwrap();
    for phi in [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0].map(|k| k * PI / 4.0) {
        for (theta_i, turn) in [(0.1, 2.0), (0.7, 3.3), (1.0, 4.0)] {
            let (wo, wi) = (polar(0.8, phi), polar(theta_i, phi + turn));
            let expected = 0.1 + ggx(wo, wi, [0.4, 0.8]);
            let found = lanes(model, wo, wi)[0];
            assert!(
                (found / expected - 1.0).abs() < 0.015,
                "{phi}: {found} {expected}"
            );
        }
    }
}

/// Of 16384 stratified samples the mean weight is the albedo to 1 %, and the share of samples whose half vector has φ_m − φ_e > 0
/// is the integral of the density.
#[test]
fn samples_follow_their_density() {
    for fields in [isotropic(vec![]), anisotropic()] {
        let file = file(&fields);
        let model = file.model().unwrap();
        for wo in [polar(0.3, 0.7), polar(1.0, -2.0)] {
            let side = 128;
            let at = |k: usize| [k % side, k / side].map(|i| (i as f64 + 0.5) / side as f64);
            let (mut mean, mut right) = (0.0, 0.0);
            for scatter in (0..side * side).filter_map(|k| model.sample(wo, at(k))) {
                assert!(f64::from(scatter.weight().max_lane()) < 20.0);
                mean += f64::from(scatter.weight().to_lanes()[2]) / (side * side) as f64;
                right += f64::from(u8::from(scatter.wi().x() > 0.0)) / (side * side) as f64;
            }
            let albedo = f64::from(model.albedo(wo).to_lanes()[2]);
            assert!((mean / albedo - 1.0).abs() < 0.01, "{mean} {albedo}");
            let (mut reflected, mut density) = (0.0, 0.0);
            let fine = 128;
            for k in 0..fine * fine {
                let cos = (k / fine) as f64 / fine as f64 + 0.5 / fine as f64;
                let wi = polar(libm::acos(cos), 2.0 * PI * (k % fine) as f64 / fine as f64);
                let weight = 2.0 * PI / (fine * fine) as f64;
                reflected += lanes(model, wo, wi)[2] * cos * weight;
                density += f64::from(u8::from(wi.x() > 0.0)) * model.pdf(wo, wi) * weight;
            }
            assert!(
                (reflected / albedo - 1.0).abs() < 0.01,
                "{reflected} {albedo}"
            );
            assert!((right - density).abs() < 0.01, "{right} {density}");
        }
    }
}

#[test]
fn spectra_are_read_at_the_wavelengths_of_a_run_and_as_colours() {
    let file = file(&isotropic(vec![400.0, 500.0, 600.0, 700.0]));
    let model = file.model().unwrap();
    let (wo, wi) = (polar(0.4, 0.0), polar(0.5, 3.0));
    let at = Reading::Wavelengths([450.0, 600.0, 650.0, 800.0]);
    let [a, b, c, d] = lanes(&model.in_lanes(at).unwrap(), wo, wi);
    // 1.5, 3, 3.5 and 4 thirds: linear between the nodes, and held beyond.
    for (found, thirds) in [(a, 1.5), (c, 3.5), (d, 4.0)] {
        assert!((found / b - thirds / 3.0).abs() < 1e-6, "{found} {b}");
    }
    let [red, green, blue, _] = lanes(model, wo, wi);
    assert!(red > green && green > blue && blue > 0.0);
    let colours = parsed("a.bsdf", written(&isotropic(vec![])));
    assert!(colours.model().unwrap().in_lanes(at).is_none());
}

/// Mitsuba 3.9.1's `measured` on this very file: ρ cosθ_i at 450, 600, 650 and 700 nm; its arithmetic is single precision: 1e-4.
#[test]
fn a_synthetic_file_has_mitsubas_values() {
    let file = file(&isotropic(vec![400.0, 500.0, 600.0, 700.0]));
    let at = Reading::Wavelengths([450.0, 600.0, 650.0, 700.0]);
    let model = file.model().unwrap().in_lanes(at).unwrap();
    for (angles, expected, density) in MITSUBA {
        let [theta_o, phi_o, theta_i, phi_i] = angles;
        let (wo, wi) = (direction(theta_o, phi_o), direction(theta_i, phi_i));
        let found = lanes(&model, wo, wi).map(|value| value * wi.z());
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < 1e-4,
                "{angles:?} {found} {expected}"
            );
        }
        let found = model.pdf(wo, wi);
        assert!(
            (found / density - 1.0).abs() < 1e-4,
            "{angles:?} {found} {density}"
        );
    }
}

/// θ and φ of d_e and d_i in degrees, ρ cosθ_i, density in 1/sr.
const MITSUBA: [([f64; 4], [f64; 4], f64); 6] = [
    (
        [20.0, 0.0, 30.0, 170.0],
        [0.13792546, 0.27585092, 0.32182607, 0.36780125],
        0.37278241,
    ),
    (
        [45.0, 60.0, 50.0, 250.0],
        [0.12856799, 0.25713599, 0.299992, 0.342848],
        0.28602067,
    ),
    (
        [60.0, -30.0, 10.0, 100.0],
        [0.1066104, 0.2132208, 0.24875765, 0.28429443],
        0.067357384,
    ),
    (
        [10.0, 0.0, 70.0, 200.0],
        [0.028421873, 0.056843746, 0.066317707, 0.075791672],
        0.046303391,
    ),
    (
        [75.0, 120.0, 60.0, -80.0],
        [0.091147058, 0.18229412, 0.21267647, 0.24305883],
        0.16984043,
    ),
    (
        [30.0, 0.0, 30.0, 20.0],
        [0.091357201, 0.1827144, 0.21316679, 0.2436192],
        0.05239474,
    ),
];

#[test]
fn broken_files_are_refused_with_their_place() {
    let message = |bytes: Vec<u8>| {
        let files = MemoryFiles::default().with("a.bsdf", bytes);
        match read(Path::new("a.bsdf"), &files) {
            Ok(_) => "no fault".to_owned(),
            Err(error) => error.to_string(),
        }
    };
    let whole = || isotropic(vec![]);
    let bytes = written(&whole());
    assert_eq!(message(bytes.clone()), "no fault");
    let magic = "byte 0: not a tensor file: it does not begin with \"tensor_file\"";
    assert_eq!(message(vec![0; 30]), magic);
    assert_eq!(
        message(bytes[..16].to_vec()),
        "byte 14: the file needs 18 bytes, but has 16"
    );
    assert!(message(bytes[..bytes.len() - 1].to_vec()).contains("the file needs"));
    let without = |name: &str| {
        let mut fields = whole();
        fields.retain(|field| field.0 != name);
        message(written(&fields))
    };
    for name in [
        "phi_i",
        "theta_i",
        "ndf",
        "sigma",
        "vndf",
        "luminance",
        "rgb",
        "jacobian",
    ] {
        assert!(
            without(name).ends_with(&format!("the file has no field {name}")),
            "{name}"
        );
    }
    let changed = |index: usize, change: &dyn Fn(&mut Field)| {
        let mut fields = whole();
        change(&mut fields[index]);
        message(written(&fields))
    };
    let nan = changed(4, &|field| {
        field.3[4..8].copy_from_slice(&f32::NAN.to_le_bytes())
    });
    assert!(nan.ends_with("NaN is no finite number"), "{nan}");
    let negative = changed(6, &|field| {
        field.3[4..8].copy_from_slice(&(-1.0_f32).to_le_bytes())
    });
    assert!(
        negative.contains("field vndf: value 2 is -1 1/sr"),
        "{negative}"
    );
    let shape = changed(7, &|field| field.2[1] = 4);
    assert!(
        shape.contains("field luminance has the dimensions [1, 4, 64, 64]"),
        "{shape}"
    );
    assert!(changed(3, &|field| field.1 = 11).contains("field theta_i has numbers of type 11"));
    let nodes = changed(3, &|field| field.3[8..12].fill(0));
    assert!(
        nodes.contains("nodes are not finite, or do not rise"),
        "{nodes}"
    );
    assert!(changed(3, &|field| field.2[0] = usize::MAX).contains("the file needs"));
}

/// Of a path the model has the path's wavelengths; colours are refused there.
#[test]
fn materials_read_tables_in_the_lanes_of_a_run() {
    let spectra = file(&isotropic(vec![400.0, 500.0, 600.0, 700.0]));
    let material = |file: &MeasuredFile, lanes: &Lanes| {
        let recipe = Recipe::Measured(file.model().unwrap().clone());
        let description = MaterialDescription::new("a", MaterialModel::Recipe(recipe));
        LoneMaterial::new(&description, lanes)
    };
    let spectral = Lanes::spectral([400.0, 700.0], vec![]).unwrap();
    let material_at = material(&spectra, &spectral).unwrap();
    let (wo, wi) = (polar(0.4, 0.0), polar(0.5, 3.0));
    for wavelengths in [[450.0, 600.0, 650.0, 700.0], [650.0, 450.0, 500.0, 400.0]] {
        let model = spectra
            .model()
            .unwrap()
            .in_lanes(Reading::Wavelengths(wavelengths))
            .unwrap();
        let found = material_at
            .brdf(wavelengths)
            .unwrap()
            .evaluate(wo, wi)
            .to_lanes();
        // Places of wavelengths are single precision.
        for (found, expected) in found.into_iter().zip(model.evaluate(wo, wi).to_lanes()) {
            assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
        }
    }
    let bands = Lanes::broadband(&["visible".to_owned()]).unwrap();
    let grey = material(&spectra, &bands)
        .unwrap()
        .brdf([0.0; 4])
        .unwrap()
        .evaluate(wo, wi);
    let [red, green, blue, _] = lanes(spectra.model().unwrap(), wo, wi);
    let luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    assert!(
        grey.to_lanes()
            .iter()
            .all(|lane| (f64::from(*lane) / luminance - 1.0).abs() < 1e-6)
    );
    let colours = file(&isotropic(vec![]));
    let refused = material(&colours, &spectral).err().unwrap();
    assert!(
        refused
            .message
            .contains("colours, which say nothing about wavelengths")
    );
}
