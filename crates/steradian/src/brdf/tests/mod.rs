//! The contract of [`Brdf`], model by model: what [`check`] leaves open.

pub(crate) mod cases;

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use proptest::prelude::*;

use super::*;
use crate::geometry::Vector;
use crate::geometry::testing::any_direction;
use crate::sampling::testing::{assert_mean, independent};

/// A model and how well its albedo is known.
struct Subject {
    model: Brdf,
    albedo_error: f64,
    /// What its weights stay below.
    weight: f64,
}

const REFLECTANCE: Spectrum = Spectrum::from_lanes([0.1, 0.2, 0.3, 0.4]);

fn subject(model: Brdf, albedo_error: f64, weight: f64) -> Subject {
    Subject {
        model,
        albedo_error,
        weight,
    }
}

/// Models that have values in 1/sr.
static FINITE: LazyLock<Vec<Subject>> = LazyLock::new(|| {
    let mut models: Vec<_> = [[0.0, 0.25, 0.5, 1.0], [0.9; 4]]
        .map(|lanes| Brdf::Lambertian(lambertian(lanes)))
        .map(|model| subject(model, 1e-6, 1.0 + 1e-6))
        .into();
    for sigma in [0.0, 0.4, FRAC_PI_2] {
        let model = OrenNayar::new(Spectrum::ONE, sigma).unwrap();
        models.push(subject(Brdf::OrenNayar(model), 1e-6, 2.2));
    }
    for roughness in [0.0, 0.3, 1.0] {
        let white = [0.5, 0.8, 0.99, 1.0];
        let model = EnergyPreservingOrenNayar::new(Spectrum::from_lanes(white), roughness).unwrap();
        models.push(subject(Brdf::EnergyPreservingOrenNayar(model), 1e-6, 3.0));
    }
    let paper = DiffuseTransmission::new(REFLECTANCE, Spectrum::splat(0.6)).unwrap();
    models.push(subject(Brdf::DiffuseTransmission(paper), 1e-6, 2.0));
    for exponent in [0.0, 1.5, 40.0] {
        let model = Phong::new(REFLECTANCE, Spectrum::splat(0.6), exponent).unwrap();
        models.push(subject(Brdf::Phong(model), 2e-4, 2.0));
    }
    models.extend(rough_models());
    let measured = measured::testing::subjects().into_iter();
    models.extend(
        measured.map(|(model, error, weight)| subject(Brdf::Measured(model), error, weight)),
    );
    models.extend(layered_models());
    models.extend(principled_models());
    models
});

/// Models with a coat, of Radiance, and mixtures.
fn layered_models() -> Vec<Subject> {
    let facets = Facets::isotropic(Slopes::Ggx, 0.3).unwrap();
    let sharp = Facets::isotropic(Slopes::Beckmann, 0.1).unwrap();
    let plastics = [
        RoughPlastic::new(facets, 1.5, REFLECTANCE),
        RoughPlastic::new(sharp, 1.33, Spectrum::ONE),
        RoughPlastic::single_scattering(facets, 2.0, REFLECTANCE),
    ];
    let plastics = plastics.map(|model| Brdf::RoughPlastic(model.unwrap()));
    let trans = Ward::radiance_trans(REFLECTANCE, [0.1, 0.2], [0.5, 0.4]);
    let wards = [
        Ward::new(REFLECTANCE, Spectrum::splat(0.5), [0.1, 0.3]),
        Ward::radiance_metal(REFLECTANCE, 0.8, 0.2),
        trans,
    ];
    let wards = wards.map(|model| Brdf::Ward(model.unwrap()));
    let glass = RoughDielectric::new(Facets::isotropic(Slopes::Ggx, 0.5).unwrap(), 1.5).unwrap();
    let tinted = glass.with_tints(REFLECTANCE, Spectrum::splat(0.5)).unwrap();
    let paint = Brdf::Lambertian(lambertian([0.5; 4]));
    let mixture = vec![
        (0.25, wards[0].clone()),
        (0.5, paint),
        (0.25, Brdf::RoughDielectric(tinted)),
    ];
    let mixture = Brdf::Mixture(Mixture::new(mixture).unwrap());
    let plastics = plastics.map(|model| subject(model, 2e-3, 8.0));
    let wards = wards.map(|model| subject(model, 2e-4, 8.0));
    plastics
        .into_iter()
        .chain(wards)
        .chain([subject(mixture, 2e-3, 10.0)])
        .collect()
}

/// glTF's materials, at corners where parts meet.
fn principled_models() -> Vec<Subject> {
    let plain = PrincipledParameters {
        base_color: REFLECTANCE,
        roughness: 0.5,
        ..Default::default()
    };
    let car_paint = PrincipledParameters {
        metallic: 0.5,
        clearcoat: 1.0,
        clearcoat_roughness: 0.3,
        ..plain
    };
    let velvet = PrincipledParameters {
        roughness: 1.0,
        sheen_color: REFLECTANCE,
        sheen_roughness: 0.5,
        specular: 0.5,
        ..plain
    };
    let frosted_sheet = PrincipledParameters {
        transmission: 0.75,
        ior: 1.33,
        ..plain
    };
    let ground_solid = PrincipledParameters {
        thin: false,
        roughness: 0.8,
        clearcoat: 0.5,
        clearcoat_roughness: 0.6,
        ..frosted_sheet
    };
    let brushed = PrincipledParameters {
        metallic: 1.0,
        anisotropy: 0.6,
        anisotropy_rotation: 0.4,
        specular_color: Spectrum::splat(3.0),
        ..plain
    };
    [
        plain,
        car_paint,
        velvet,
        frosted_sheet,
        ground_solid,
        brushed,
    ]
    .map(|parameters| Principled::new(&parameters).unwrap())
    .map(|model| subject(Brdf::Principled(Box::new(model)), 3e-3, 16.0))
    .into()
}

/// Models that couple single directions and have values besides.
fn half_smooth_models() -> Vec<Brdf> {
    let white = Plastic::new(1.5, Spectrum::ONE).unwrap();
    let coloured = Plastic::new(1.9, REFLECTANCE).unwrap();
    let polished = Ward::radiance_trans(REFLECTANCE, [0.1, 0.0], [0.5, 0.4]).unwrap();
    let chrome = Brdf::SmoothConductor(SmoothConductor::new(gold()));
    let sheet = PrincipledParameters {
        base_color: REFLECTANCE,
        roughness: 0.0,
        transmission: 0.5,
        clearcoat: 0.5,
        clearcoat_roughness: 0.5,
        ..Default::default()
    };
    let solid = PrincipledParameters {
        thin: false,
        ..sheet
    };
    let [sheet, solid] = [sheet, solid]
        .map(|parameters| Brdf::Principled(Box::new(Principled::new(&parameters).unwrap())));
    let paint = Brdf::Lambertian(lambertian([0.5; 4]));
    let flakes = Mixture::new(vec![(0.25, chrome), (0.7, paint)]).unwrap();
    vec![
        Brdf::Plastic(white),
        Brdf::Plastic(coloured),
        Brdf::Ward(polished),
        Brdf::Mixture(flakes),
        sheet,
        solid,
    ]
}

fn rough_models() -> Vec<Subject> {
    let metals = [
        Facets::isotropic(Slopes::Ggx, 0.4),
        Facets::isotropic(Slopes::Ggx, 1.0),
        Facets::isotropic(Slopes::Beckmann, 0.5),
        Facets::anisotropic(Slopes::Ggx, [0.4, 0.8]),
        Facets::anisotropic(Slopes::Beckmann, [0.9, 0.4]),
    ]
    .map(Result::unwrap);
    let mut models: Vec<_> = metals
        .map(|facets| RoughConductor::new(facets, gold()))
        .map(|model| subject(Brdf::RoughConductor(model), 2e-3, 4.0))
        .into();
    let glass = [
        Facets::isotropic(Slopes::Ggx, 0.8),
        Facets::anisotropic(Slopes::Beckmann, [0.8; 2]),
        Facets::anisotropic(Slopes::Ggx, [0.7, 1.0]),
    ]
    .map(Result::unwrap);
    let separable = metals[0].with_shadowing(Shadowing::Separable);
    let single = RoughConductor::single_scattering(separable, gold());
    models.push(subject(Brdf::RoughConductor(single), 2e-3, 1.0));
    for (facets, eta) in [(glass[0], 1.5), (glass[1], 1.0 / 1.33)] {
        let model = RoughDielectric::new(facets, eta).unwrap();
        models.push(subject(Brdf::RoughDielectric(model), 2e-3, 10.0));
    }
    let single = RoughDielectric::single_scattering(glass[2], 1.5).unwrap();
    models.push(subject(Brdf::RoughDielectric(single), 2e-3, 2.3));
    models
}

fn gold() -> ComplexIndex {
    ComplexIndex::new([0.15, 0.37, 1.4, 1.5], [3.6, 2.6, 1.9, 1.9]).unwrap()
}

/// Models that only couple single directions.
fn smooth_models() -> Vec<Brdf> {
    let mirror = Mirror {
        reflectance: REFLECTANCE,
    };
    vec![
        Brdf::Mirror(mirror),
        Brdf::SmoothConductor(SmoothConductor::new(gold())),
        Brdf::SmoothConductor(SmoothConductor::new(ComplexIndex::PERFECT)),
        Brdf::SmoothDielectric(SmoothDielectric::new(1.5).unwrap()),
        Brdf::SmoothDielectric(SmoothDielectric::new(1.0 / 1.33).unwrap()),
        Brdf::Pane(Pane::new(1.52, [0.2, 0.8, 0.95, 1.0]).unwrap()),
    ]
}

fn lambertian(lanes: [f32; 4]) -> Lambertian {
    Lambertian {
        reflectance: Spectrum::from_lanes(lanes),
    }
}

/// Whether light on the outside comes from, or goes to, the inside.
fn transmits(model: &Brdf) -> bool {
    !model.transmittance(Direction::Z).is_zero()
}

/// Every angle at which a model is looked at: one azimuth that no symmetry hides, and the inside where light gets there.
fn views(model: &Brdf) -> Vec<Direction> {
    let above = [0.0, 0.5, 1.0, 1.35, 1.5]
        .map(|theta| Direction::from_polar(libm::sin(theta), libm::cos(theta), 0.6));
    let below = above.map(|view| -view);
    let inside = below.into_iter().filter(|_| transmits(model));
    above.into_iter().chain(inside).collect()
}

fn upwards() -> impl Strategy<Value = Direction> {
    any_direction()
        .prop_filter("on the horizon", |d| d.z().abs() > 1e-3)
        .prop_map(|d| if d.z() < 0.0 { -d } else { d })
}

pub(crate) fn tilted(theta: f64) -> Direction {
    Direction::new(Vector::new(libm::sin(theta), 0.0, libm::cos(theta))).unwrap()
}

fn lanes(spectrum: Spectrum) -> [f64; 4] {
    spectrum.to_lanes().map(f64::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// Values are single precision, and kernels in double precision are symmetric but for rounding.
    #[test]
    fn values_are_reciprocal_and_not_negative(a in any_direction(), b in any_direction()) {
        for Subject { model, .. } in FINITE.iter() {
            let there = lanes(model.evaluate(a, b));
            let back = lanes(model.evaluate(b, a));
            for lane in 0..4 {
                let scaled = back[lane] * model.radiance_scale(a, b);
                prop_assert!(there[lane] >= 0.0 && there[lane].is_finite());
                prop_assert!((there[lane] - scaled).abs() <= 1e-5 * there[lane].max(1e-6), "{model:?}: {there:?} {back:?}");
            }
        }
    }

    #[test]
    fn what_does_not_transmit_is_black_below(wo in upwards(), wi in upwards(), u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        let finite = FINITE.iter().map(|subject| subject.model.clone());
        for model in finite.chain(smooth_models()).filter(|model| !transmits(model)) {
            for (wo, wi) in [(-wo, wi), (wo, -wi), (-wo, -wi)] {
                prop_assert!(model.evaluate(wo, wi).is_zero());
                prop_assert_eq!(model.pdf(wo, wi), 0.0);
            }
            prop_assert_eq!(model.sample(-wo, [u, v]), None);
            prop_assert!(model.albedo(-wo).is_zero());
        }
    }

    #[test]
    fn a_sample_tells_its_own_value_and_density(wo in any_direction(), u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        for Subject { model, weight, .. } in FINITE.iter() {
            let Some(scatter) = model.sample(wo, [u, v]) else { continue };
            let Scatter::Finite { wi, value, pdf } = scatter else {
                return Err(TestCaseError::fail("not finite"));
            };
            prop_assert_eq!(value, model.evaluate(wo, wi));
            prop_assert_eq!(pdf, model.pdf(wo, wi));
            prop_assert_eq!(scatter.is_transmitted(wo), wo.z() * wi.z() < 0.0);
            prop_assert!(f64::from(scatter.weight().mean()) <= *weight, "{model:?}: {scatter:?} {:?}", scatter.weight());
        }
    }

    #[test]
    fn a_smooth_surface_keeps_the_tangent_and_has_no_value(wo in any_direction(), u in 0.0..1.0_f64) {
        for model in smooth_models() {
            let Some(Scatter::Specular { wi, .. }) = model.sample(wo, [u, u]) else {
                prop_assert!(wo.z() <= 0.0, "{model:?} loses light");
                continue;
            };
            let ratio = model.radiance_scale(wo, wi).sqrt();
            prop_assert!((wi.x() + ratio * wo.x()).abs() < 1e-14 && (wi.y() + ratio * wo.y()).abs() < 1e-14);
            prop_assert!(model.evaluate(wo, wi).is_zero() && model.pdf(wo, wi) == 0.0);
        }
    }
}

/// E[weight] over each side, as shares of power: 4096 samples a view, false alarms below 1e-6 in all (six errors).
#[test]
fn the_mean_weight_of_samples_is_the_albedo() {
    let smooth = smooth_models()
        .into_iter()
        .chain(half_smooth_models())
        .map(|model| subject(model, 1e-6, 4.0))
        .collect::<Vec<_>>();
    for Subject {
        model,
        albedo_error,
        ..
    } in FINITE.iter().chain(&smooth)
    {
        for wo in views(model) {
            let drawn = independent(1, 4096).map(|u| model.sample(wo, u));
            let drawn: Vec<_> = drawn.collect();
            for (transmitted, expected) in
                [(false, model.albedo(wo)), (true, model.transmittance(wo))]
            {
                let power = |scatter: &Option<Scatter>| match scatter {
                    Some(scatter) if scatter.is_transmitted(wo) == transmitted => {
                        let scale = model.radiance_scale(wo, scatter.wi());
                        lanes(scatter.weight()).map(|weight| weight / scale)
                    }
                    _ => [0.0; 4],
                };
                let weights: Vec<_> = drawn.iter().map(power).collect();
                for lane in 0..4 {
                    let weights: Vec<_> = weights.iter().map(|weight| weight[lane]).collect();
                    assert_mean(&weights, lanes(expected)[lane], *albedo_error);
                }
            }
        }
    }
}

/// ∫ f cosθ dω by the midpoint rule in cos²θ and φ.
fn projected_integral(f: impl Fn(Direction) -> f64) -> f64 {
    let cells = 96;
    let at = |i: u32| (f64::from(i) + 0.5) / f64::from(cells);
    let row = |i: u32| (0..cells).map(move |j| (at(i), TAU * at(j)));
    let value = |(square, phi): (f64, f64)| {
        f(Direction::from_polar(
            (1.0_f64 - square).sqrt(),
            square.sqrt(),
            phi,
        ))
    };
    let sum: f64 = (0..cells).flat_map(row).map(value).sum();
    PI * sum / f64::from(cells * cells)
}

/// The diffuse models: the rule is exact for a constant ρ and off by less than 4e-3 for the others.
#[test]
fn the_albedo_is_the_integral_of_the_value() {
    for Subject { model, .. } in FINITE.iter().filter(|subject| is_diffuse(&subject.model)) {
        for theta in [0.0, 0.7, 1.3] {
            let wo = tilted(theta);
            let albedo = lanes(model.albedo(wo));
            for lane in 0..4 {
                let integral = projected_integral(|wi| lanes(model.evaluate(wo, wi))[lane]);
                assert!(
                    (integral - albedo[lane]).abs() < 4e-3,
                    "{model:?} {theta}: {integral} {albedo:?}"
                );
            }
        }
    }
}

fn is_diffuse(model: &Brdf) -> bool {
    matches!(
        model,
        Brdf::Lambertian(_)
            | Brdf::OrenNayar(_)
            | Brdf::EnergyPreservingOrenNayar(_)
            | Brdf::DiffuseTransmission(_)
    )
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let message = |error: ModelError| error.to_string();
    let sigma = OrenNayar::new(Spectrum::ONE, f64::NAN).unwrap_err();
    assert_eq!(
        message(sigma),
        "sigma must lie between 0 and 1.5707963267948966, got NaN"
    );
    let bright = Spectrum::splat(1.5);
    assert!(EnergyPreservingOrenNayar::new(bright, 0.5).is_err());
    assert!(EnergyPreservingOrenNayar::new(Spectrum::ONE, -0.1).is_err());
    let both = DiffuseTransmission::new(Spectrum::splat(0.75), Spectrum::splat(0.5)).unwrap_err();
    assert!(message(both).starts_with("reflectance and transmittance add up to 1.25"));
    assert!(Phong::new(Spectrum::ONE, Spectrum::ONE, 5.0).is_err());
    assert!(ComplexIndex::new([0.0; 4], [0.0; 4]).is_err());
    assert!(Facets::isotropic(Slopes::Ggx, 0.0).is_err());
    assert!(Facets::anisotropic(Slopes::Beckmann, [0.5, f64::NAN]).is_err());
    let facets = Facets::isotropic(Slopes::Ggx, 0.5).unwrap();
    assert!(RoughDielectric::new(facets, -1.5).is_err());
    assert!(SmoothDielectric::new(f64::INFINITY).is_err());
    assert!(Pane::new(0.9, [1.0; 4]).is_err() && Pane::new(1.5, [1.1; 4]).is_err());
    assert!(Plastic::new(0.9, Spectrum::ONE).is_err() && Plastic::new(1.5, bright).is_err());
    assert!(RoughPlastic::new(facets, 0.9, Spectrum::ONE).is_err());
    assert!(glass(1.5).with_tints(bright, Spectrum::ONE).is_err());
    let milky = PrincipledParameters {
        transmission: 1.5,
        ..Default::default()
    };
    let message = message(Principled::new(&milky).unwrap_err());
    assert_eq!(message, "transmission must lie between 0 and 1, got 1.5");
}

fn glass(eta: f64) -> SmoothDielectric {
    SmoothDielectric::new(eta).unwrap()
}

#[test]
fn parts_of_a_mixture_must_fit_together() {
    let [glass, water] = [1.5, 1.33].map(|eta| (0.5, Brdf::SmoothDielectric(glass(eta))));
    let error = Mixture::new(vec![glass.clone(), water]).unwrap_err();
    assert!(error.to_string().ends_with("got 1.5 and 1.33"));
    let error = Mixture::new(vec![glass.clone(), glass.clone(), glass]).unwrap_err();
    assert!(error.to_string().starts_with("weights add up to 1.5"));
}

/// All models of these tests.
pub(super) fn every_model() -> Vec<Brdf> {
    let finite = FINITE.iter().map(|subject| subject.model.clone());
    finite
        .chain(smooth_models())
        .chain(half_smooth_models())
        .chain(sharp_models())
        .collect()
}

/// Rough models that are nearly smooth.
fn sharp_models() -> Vec<Brdf> {
    let ground = Facets::isotropic(Slopes::Ggx, 0.1).unwrap();
    let satin = Facets::isotropic(Slopes::Beckmann, 0.05).unwrap();
    vec![
        Brdf::RoughDielectric(RoughDielectric::new(ground, 1.5).unwrap()),
        Brdf::RoughDielectric(RoughDielectric::new(satin, 1.33).unwrap()),
        Brdf::RoughDielectric(RoughDielectric::new(ground, 1.0).unwrap()),
        Brdf::RoughConductor(RoughConductor::new(satin, gold())),
        Brdf::RoughPlastic(RoughPlastic::new(satin, 1.5, REFLECTANCE).unwrap()),
    ]
}

/// White everywhere, at the corners of every number: tables are true to 2e-3.
#[test]
fn gltf_materials_gain_no_light_at_any_corner() {
    let ends = [0.0, 1.0];
    let corner = |bits: u32| ends[usize::from(bits & 1 == 1)];
    for bits in 0..128_u32 {
        let parameters = PrincipledParameters {
            metallic: corner(bits),
            transmission: corner(bits >> 1),
            thin: bits >> 2 & 1 == 1,
            clearcoat: corner(bits >> 3),
            clearcoat_roughness: corner(bits >> 4),
            sheen_color: Spectrum::splat(corner(bits >> 5) as f32),
            sheen_roughness: 0.5,
            roughness: [0.1, 0.7][usize::from(bits >> 6 & 1 == 1)],
            specular_color: Spectrum::from_lanes([1.0, 0.0, 3.0, 30.0]),
            ..Default::default()
        };
        let model = Principled::new(&parameters).unwrap();
        for theta in [0.0, 0.8, 1.4, 1.56] {
            for wo in [tilted(theta), -tilted(theta)] {
                let sum = model.albedo(wo) + model.transmittance(wo);
                assert!(
                    sum.max_lane() <= 1.0 + 2e-3,
                    "{parameters:?} {theta}: {sum:?}"
                );
            }
        }
    }
}
