//! Grey exchange with known answers.

use super::*;
use crate::exchange::radiosity::{
    Boundary, Equilibrium, GreySurface, RadiosityError, Surroundings, emitted, exchange,
};

const PAIRS: Surroundings = Surroundings {
    exitance: None,
    reciprocal: true,
};
const RAYS: Surroundings = Surroundings {
    exitance: None,
    reciprocal: false,
};

fn grey(emissivity: f64, kelvin: f64) -> GreySurface {
    GreySurface {
        emissivity,
        boundary: Boundary::Temperature(kelvin),
    }
}

fn insulated() -> GreySurface {
    GreySurface {
        emissivity: 0.5,
        boundary: Boundary::NetFlux(0.0),
    }
}

/// A matrix without errors.
fn exact(factors: &[&[f64]]) -> Vec<Row> {
    let row = |(from, factors): (usize, &&[f64])| Row {
        from,
        entries: (0..)
            .zip(*factors)
            .map(|(to, &value)| Entry::exact(to, value))
            .collect(),
        sum: Uncertain::exact(factors.iter().sum()),
        rest: None,
        samples: 0,
        converged: true,
    };
    factors.iter().enumerate().map(row).collect()
}

fn fluxes(found: &Equilibrium) -> Vec<f64> {
    found
        .surfaces
        .iter()
        .map(|surface| surface.net_flux.value)
        .collect()
}

/// Concentric spheres: Q = σ(T₁⁴ − T₂⁴) A₁/(1/ε₁ + A₁/A₂ (1/ε₂ − 1)).
#[test]
fn concentric_spheres() {
    let rows = exact(&[&[0.0, 1.0], &[0.25, 0.75]]);
    let surfaces = [grey(0.8, 600.0), grey(0.3, 300.0)];
    let found = exchange(&rows, &[1.0, 4.0], &surfaces, PAIRS).unwrap();
    let expected =
        (emitted(1.0, 600.0) - emitted(1.0, 300.0)) / (1.0 / 0.8 + 0.25 * (1.0 / 0.3 - 1.0));
    let [inner, outer] = fluxes(&found)[..] else {
        unreachable!()
    };
    assert!((inner / expected - 1.0).abs() < 1e-11 && (4.0 * outer / expected + 1.0).abs() < 1e-11);
    assert_eq!(found.surfaces[0].net_flux.std_error, 0.0);
}

/// Parallel plates, and a shield between them, insulated from all else, that halves the flux: q = σ(T₁⁴ − T₂⁴)/(1/ε₁ + 1/ε₂ − 1).
#[test]
fn plates_and_a_radiation_shield() {
    let q = (emitted(1.0, 500.0) - emitted(1.0, 300.0)) / (2.0 / 0.2 - 1.0);
    let plates = exchange(
        &exact(&[&[0.0, 1.0], &[1.0, 0.0]]),
        &[1.0; 2],
        &[grey(0.2, 500.0), grey(0.2, 300.0)],
        PAIRS,
    );
    assert!((fluxes(&plates.unwrap())[0] / q - 1.0).abs() < 1e-11);
    // The shield's sides are one surface of both halves of space here: its radiosity is what arrives, (J₁ + J₂)/2.
    let rows = exact(&[&[0.0, 0.0, 1.0], &[0.0, 0.0, 1.0], &[0.5, 0.5, 0.0]]);
    let surfaces = [grey(1.0, 500.0), grey(1.0, 300.0), insulated()];
    let shielded = exchange(&rows, &[1.0, 1.0, 2.0], &surfaces, PAIRS).unwrap();
    let half = 0.5 * (emitted(1.0, 500.0) - emitted(1.0, 300.0));
    assert!((fluxes(&shielded)[0] / half - 1.0).abs() < 1e-12);
    let between = (0.5 * (500.0_f64.powi(4) + 300.0_f64.powi(4)))
        .sqrt()
        .sqrt();
    assert!((shielded.surfaces[2].temperature.unwrap().value - between).abs() < 1e-9);
    assert!(shielded.balance.value.abs() < 1e-9);
}

/// Faces of a cube at three temperatures against elimination of the full equations.
#[test]
fn a_cube_of_three_temperatures() {
    let cube = scene(vec![("cube", cuboid([0.0; 3], [1.0; 3], true))]);
    let (rows, _) = rows(
        &cube,
        Grouping::Face,
        Technique::Pairs,
        Stopping::at_rel_error(0.01),
    );
    let surfaces: Vec<_> = (0..6)
        .map(|k| {
            grey(
                0.3 + 0.1 * f64::from(k),
                [300.0, 400.0, 500.0][k as usize % 3],
            )
        })
        .collect();
    let found = exchange(&rows, &[1.0; 6], &surfaces, PAIRS).unwrap();
    let mut system = [[0.0; 7]; 6];
    for (i, surface) in surfaces.iter().enumerate() {
        for j in 0..6 {
            system[i][j] = f64::from(u8::from(i == j))
                - (1.0 - surface.emissivity) * rows[i].factor_to(j).value;
        }
        let Boundary::Temperature(kelvin) = surface.boundary else {
            unreachable!()
        };
        system[i][6] = emitted(surface.emissivity, kelvin);
    }
    for k in 0..6 {
        let pivot = system[k];
        for row in system
            .iter_mut()
            .enumerate()
            .filter(|(i, _)| *i != k)
            .map(|(_, row)| row)
        {
            let factor = row[k] / pivot[k];
            row.iter_mut()
                .zip(pivot)
                .for_each(|(x, p)| *x -= factor * p);
        }
    }
    for k in 0..6 {
        let expected = system[k][6] / system[k][k];
        assert!((found.surfaces[k].radiosity.value / expected - 1.0).abs() < 1e-11);
    }
    assert!(found.balance.value.abs() < 1e-9);
}

/// A room with a block in it, by both techniques: fluxes agree within their errors, one temperature gives no flux at all.
#[test]
fn errors_are_carried_through() {
    let room = scene(vec![
        ("room", cuboid([0.0; 3], [2.0, 3.0, 2.0], true)),
        ("block", cuboid([0.5, 0.5, 0.2], [1.2, 1.5, 1.1], false)),
    ]);
    let facets = Facets::new(&room, Sides::Front).unwrap();
    let areas: Vec<f64> = facets.list().iter().map(|facet| facet.area).collect();
    let surfaces: Vec<_> = (0..12)
        .map(|k| grey(0.6, if k < 6 { 300.0 } else { 350.0 + f64::from(k) }))
        .collect();
    let solve = |technique, surroundings, stop| {
        let (rows, _) = rows(&room, Grouping::Face, technique, stop);
        let even = exchange(&rows, &areas, &[grey(0.6, 300.0); 12], surroundings).unwrap();
        assert!(fluxes(&even).iter().all(|flux| flux.abs() < 1e-9));
        exchange(&rows, &areas, &surfaces, surroundings).unwrap()
    };
    let pairs = solve(Technique::Pairs, PAIRS, Stopping::at_rel_error(0.02));
    let rays = solve(Technique::Rays, RAYS, Stopping::at_samples(1 << 16));
    assert!(pairs.balance.value.abs() < 1e-8, "{:?}", pairs.balance);
    assert!(
        rays.balance.agrees_with(0.0, 1e-8, 1e-6),
        "{:?}",
        rays.balance
    );
    for (one, other) in pairs.surfaces.iter().zip(&rays.surfaces) {
        let mut difference = IndependentSum::default();
        difference.add(one.net_flux, 1.0);
        difference.add(other.net_flux, -1.0);
        assert!(one.net_flux.std_error < 1.0 && other.net_flux.std_error > 0.0);
        assert!(
            difference.total().agrees_with(0.0, 1e-3, 1e-6),
            "{one:?} {other:?}"
        );
    }
}

#[test]
fn an_open_plate_radiates_to_its_surroundings() {
    let rows = exact(&[&[]]);
    let cold = Surroundings {
        exitance: Some(emitted(1.0, 100.0)),
        reciprocal: true,
    };
    let found = exchange(&rows, &[2.0], &[grey(0.9, 300.0)], cold).unwrap();
    let expected = 0.9 * (emitted(1.0, 300.0) - emitted(1.0, 100.0));
    assert!((fluxes(&found)[0] / expected - 1.0).abs() < 1e-13);
}

#[test]
fn what_nothing_determines_is_refused() {
    let rows = exact(&[&[0.0, 1.0], &[1.0, 0.0]]);
    let solve = |surfaces: &[GreySurface]| exchange(&rows, &[1.0; 2], surfaces, PAIRS).unwrap_err();
    assert_eq!(solve(&[insulated(); 2]), RadiosityError::Undetermined);
    assert_eq!(
        solve(&[grey(0.5, 300.0)]),
        RadiosityError::Counts {
            rows: 2,
            surfaces: 1
        }
    );
    assert_eq!(
        solve(&[grey(0.5, 300.0), grey(1.5, 300.0)]),
        RadiosityError::Surface(1)
    );
    assert_eq!(
        solve(&[grey(0.5, f64::NAN), grey(0.5, 300.0)]),
        RadiosityError::Surface(0)
    );
}
