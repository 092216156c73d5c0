//! Exchange of heat or light between grey, diffuse surfaces.
//!
//! What leaves a surface is what it emits and what it reflects of what arrives,
//!
//! J_i = M_i + ρ_i H_i ,  H_i = Σ_j F_ij J_j + F_i∞ M∞ ,  q_i = J_i − H_i
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | J | radiosity: exitance, emitted and reflected | W/m² |
//! | H | irradiance | W/m² |
//! | M | emitted exitance: εσT⁴, or given | W/m² |
//! | ρ | reflectance 1 − ε | – |
//! | q | net flux that leaves, by area | W/m² |
//! | F_i∞, M∞ | the rest of a row, and the exitance of what surrounds an open scene | –, W/m² |
//!
//! A surface whose net flux is given (0 where it is insulated) obeys the same equation with M = q and ρ = 1.
//!
//! In a closed enclosure H_i is taken as J_i + Σ_j F_ij (J_j − J_i), which is the same where rows add up to 1. Where they do so only within their
//! errors, it keeps an enclosure of one temperature in equilibrium, and with reciprocal factors the net fluxes add up to 0.
//!
//! *Solution.* Gauss–Seidel iteration. It converges as Σ_j ρ_i F_ij ≤ ρ_i < 1 in every row (M. F. Modest, *Radiative Heat Transfer*, 3rd ed. 2013,
//! §5.3 for the equations; R. S. Varga, *Matrix Iterative Analysis*, 1962, theorem 3.4 for convergence, also where some rows have ρ = 1 and
//! are coupled to others).
//!
//! *Errors.* To first order a change δF changes the radiosities by the solution of ΔJ = ρ (F ΔJ + δF J). With δF drawn 32 times as ± the standard
//! error of each factor the mean square of ΔJ is its variance. A pair's two factors change together, by the same exchange area; the factors
//! of a row by rays change so that their sum stays.
//!
//! ```
//! use steradian::exchange::radiosity::{STEFAN_BOLTZMANN, emitted};
//! // A black body of 1000 K: 56.70 kW/m².
//! assert!((emitted(1.0, 1000.0) - 56_703.744).abs() < 1e-3);
//! # assert_eq!(STEFAN_BOLTZMANN, 5.670374419e-8);
//! ```

use super::row::Row;
use super::uncertain::Uncertain;
use crate::sampling::hash::{combine, key_of_name};

/// σ in W/(m² K⁴), CODATA 2018 (exact to these digits).
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Changes of the factors that errors are found from.
const DIRECTIONS: u32 = 32;
/// Iteration ends when no radiosity changes by more than this part of the greatest.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: usize = 100_000;

/// M = εσT⁴ in W/m².
pub fn emitted(emissivity: f64, kelvin: f64) -> f64 {
    emissivity * STEFAN_BOLTZMANN * (kelvin * kelvin) * (kelvin * kelvin)
}

/// What is known of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Boundary {
    /// T in K.
    Temperature(f64),
    /// What it emits in W/m², without what it reflects.
    Exitance(f64),
    /// What leaves it on balance, in W/m²; 0 if it is insulated.
    NetFlux(f64),
}

/// A grey surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GreySurface {
    /// ε, from 0 to 1; 1 − ε is reflected.
    pub emissivity: f64,
    /// What is known of it.
    pub boundary: Boundary,
}

impl GreySurface {
    /// M and ρ.
    fn source(&self) -> (f64, f64) {
        match self.boundary {
            Boundary::Temperature(kelvin) => {
                (emitted(self.emissivity, kelvin), 1.0 - self.emissivity)
            }
            Boundary::Exitance(exitance) => (exitance, 1.0 - self.emissivity),
            Boundary::NetFlux(flux) => (flux, 1.0),
        }
    }

    fn check(&self) -> bool {
        let value = match self.boundary {
            Boundary::Temperature(value) | Boundary::Exitance(value) => {
                Some(value).filter(|value| *value >= 0.0)
            }
            Boundary::NetFlux(value) => Some(value),
        };
        (0.0..=1.0).contains(&self.emissivity) && value.is_some_and(f64::is_finite)
    }
}

/// How the factors were found, and what is around them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// M∞ of what surrounds an open scene, in W/m²; `None` in a closed one.
    pub exitance: Option<f64>,
    /// Whether factors are of pairs, so that the two of a pair have the same error.
    pub reciprocal: bool,
}

/// What was found of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exchanged {
    /// J in W/m².
    pub radiosity: Uncertain,
    /// H in W/m².
    pub irradiance: Uncertain,
    /// q in W/m².
    pub net_flux: Uncertain,
    /// T in K; none where it is not a matter of temperature.
    pub temperature: Option<Uncertain>,
}

/// The solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Of each surface.
    pub surfaces: Vec<Exchanged>,
    /// Σ A q in W: what leaves all surfaces on balance, 0 in a closed enclosure.
    pub balance: Uncertain,
    /// Gauss–Seidel iterations.
    pub iterations: usize,
}

/// Why there is no solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RadiosityError {
    /// The numbers of surfaces, areas and rows differ.
    #[error("{rows} rows of factors, but {surfaces} surfaces: the matrix must be complete")]
    Counts {
        /// Rows.
        rows: usize,
        /// Surfaces.
        surfaces: usize,
    },
    /// A surface with an impossible number.
    #[error(
        "surface {0}: the emissivity lies between 0 and 1, temperature and exitance are at least 0 and finite"
    )]
    Surface(usize),
    /// Nothing absorbs.
    #[error("no surface has a temperature or absorbs, so that nothing determines the exchange")]
    Undetermined,
    /// It goes on for ever.
    #[error(
        "the exchange does not settle in {0} iterations: some surfaces are coupled to none that absorbs"
    )]
    NotConverged(usize),
}

/// Solves the exchange between surfaces by the rows of their matrix.
///
/// # Errors
/// If numbers are impossible or nothing determines the solution.
pub fn exchange(
    rows: &[Row],
    areas: &[f64],
    surfaces: &[GreySurface],
    surroundings: Surroundings,
) -> Result<Equilibrium, RadiosityError> {
    if rows.len() != surfaces.len() || areas.len() != surfaces.len() {
        let (rows, surfaces) = (rows.len(), surfaces.len());
        return Err(RadiosityError::Counts { rows, surfaces });
    }
    if let Some(index) = surfaces.iter().position(|surface| !surface.check()) {
        return Err(RadiosityError::Surface(index));
    }
    let enclosure = Enclosure::new(rows, areas, surfaces, surroundings);
    if enclosure.reflectance.iter().all(|&rho| rho == 1.0) && surroundings.exitance.is_none() {
        return Err(RadiosityError::Undetermined);
    }
    let (radiosity, iterations) = enclosure.solve(&enclosure.source)?;
    let mut spread = Spread::new(surfaces.len());
    for direction in 0..DIRECTIONS {
        let change = enclosure.irradiance_change(&radiosity, direction);
        spread.add(&enclosure, &change)?;
    }
    Ok(enclosure.equilibrium(&radiosity, &spread, surfaces, iterations))
}

/// The equations.
struct Enclosure<'a> {
    rows: &'a [Row],
    areas: &'a [f64],
    /// Of each row, what goes to the surface itself: F_ii, with what is missing to 1 in a closed enclosure.
    own: Vec<f64>,
    source: Vec<f64>,
    reflectance: Vec<f64>,
    surroundings: Surroundings,
}

impl<'a> Enclosure<'a> {
    fn new(
        rows: &'a [Row],
        areas: &'a [f64],
        surfaces: &[GreySurface],
        surroundings: Surroundings,
    ) -> Self {
        let (emitted, reflectance): (Vec<f64>, Vec<f64>) =
            surfaces.iter().map(GreySurface::source).unzip();
        let own = rows.iter().map(|row| {
            let missing = match surroundings.exitance {
                Some(_) => 0.0,
                None => 1.0 - row.sum.value,
            };
            row.factor_to(row.from).value + missing
        });
        let arriving = |row: &Row| {
            surroundings
                .exitance
                .map_or(0.0, |m| m * (1.0 - row.sum.value))
        };
        let reflected = rows
            .iter()
            .zip(&reflectance)
            .map(|(row, rho)| rho * arriving(row));
        let source = emitted
            .iter()
            .zip(reflected)
            .map(|(m, more)| m + more)
            .collect();
        Self {
            rows,
            areas,
            own: own.collect(),
            source,
            reflectance,
            surroundings,
        }
    }

    /// Σ_{j≠i} F_ij x_j.
    fn arriving_from_others(&self, i: usize, x: &[f64]) -> f64 {
        let others = self.rows[i]
            .entries
            .iter()
            .filter(|entry| entry.to as usize != i);
        others.map(|entry| entry.value * x[entry.to as usize]).sum()
    }

    /// J = s + ρ F J by Gauss–Seidel iteration.
    fn solve(&self, source: &[f64]) -> Result<(Vec<f64>, usize), RadiosityError> {
        let mut x = source.to_vec();
        for iteration in 1..=MOST_ITERATIONS {
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for i in 0..x.len() {
                let rho = self.reflectance[i];
                let new = (source[i] + rho * self.arriving_from_others(i, &x))
                    / (1.0 - rho * self.own[i]);
                change = change.max((new - x[i]).abs());
                greatest = greatest.max(new.abs());
                x[i] = new;
            }
            if !greatest.is_finite() {
                break;
            }
            if change <= TOLERANCE * greatest {
                return Ok((x, iteration));
            }
        }
        Err(RadiosityError::NotConverged(MOST_ITERATIONS))
    }

    fn irradiance(&self, i: usize, x: &[f64]) -> f64 {
        self.arriving_from_others(i, x) + self.own[i] * x[i]
    }

    /// (δF J)_i for one choice of signs.
    fn irradiance_change(&self, radiosity: &[f64], direction: u32) -> Vec<f64> {
        let mut change = vec![0.0; self.rows.len()];
        for row in self.rows {
            let i = row.from;
            // Radiosity that a change of the factor is measured against: what is lost elsewhere.
            let reference = match self.surroundings.exitance {
                Some(m) => m,
                None => radiosity[i],
            };
            let mean = self.mean_of_row(row, radiosity, reference);
            for entry in row.entries.iter().filter(|entry| entry.std_error > 0.0) {
                let j = entry.to as usize;
                if !self.surroundings.reciprocal {
                    change[i] += sign(direction, i, j) * entry.std_error * (radiosity[j] - mean);
                } else if j >= i {
                    let step = sign(direction, i, j) * entry.std_error;
                    change[i] += step * (radiosity[j] - reference);
                    if j > i {
                        let reference = self.surroundings.exitance.unwrap_or(radiosity[j]);
                        change[j] +=
                            step * self.areas[i] / self.areas[j] * (radiosity[i] - reference);
                    }
                }
            }
        }
        change
    }

    /// Σ F J / Σ F: errors of rays add up to 0 over a row and its rest.
    fn mean_of_row(&self, row: &Row, radiosity: &[f64], reference: f64) -> f64 {
        let terms = row
            .entries
            .iter()
            .map(|entry| entry.value * radiosity[entry.to as usize]);
        terms.sum::<f64>() + (1.0 - row.sum.value) * reference
    }

    fn equilibrium(
        &self,
        radiosity: &[f64],
        spread: &Spread,
        surfaces: &[GreySurface],
        iterations: usize,
    ) -> Equilibrium {
        let found = |value: f64, squares: f64| Uncertain {
            value,
            std_error: (squares / f64::from(DIRECTIONS)).sqrt(),
            degrees: if squares == 0.0 {
                f64::INFINITY
            } else {
                f64::from(DIRECTIONS)
            },
        };
        let arriving = |i: usize| {
            self.surroundings
                .exitance
                .map_or(0.0, |m| m * (1.0 - self.rows[i].sum.value))
        };
        let mut balance = 0.0;
        let surfaces = surfaces.iter().enumerate().map(|(i, surface)| {
            let irradiance = self.irradiance(i, radiosity) + arriving(i);
            let net_flux = radiosity[i] - irradiance;
            balance += self.areas[i] * net_flux;
            let radiosity = found(radiosity[i], spread.radiosity[i]);
            Exchanged {
                radiosity,
                irradiance: found(irradiance, spread.irradiance[i]),
                net_flux: found(net_flux, spread.net_flux[i]),
                temperature: temperature(surface, radiosity),
            }
        });
        let surfaces = surfaces.collect();
        Equilibrium {
            surfaces,
            balance: found(balance, spread.balance),
            iterations,
        }
    }
}

/// From q = ε/(1 − ε) (σT⁴ − J), for a surface of given net flux; errors by dT/T = ¼ dJ/(σT⁴).
fn temperature(surface: &GreySurface, radiosity: Uncertain) -> Option<Uncertain> {
    let Boundary::NetFlux(flux) = surface.boundary else {
        let Boundary::Temperature(kelvin) = surface.boundary else {
            return None;
        };
        return Some(Uncertain::exact(kelvin));
    };
    let black = radiosity.value + flux * (1.0 - surface.emissivity) / surface.emissivity;
    (black > 0.0 && black.is_finite()).then(|| {
        let kelvin = (black / STEFAN_BOLTZMANN).sqrt().sqrt();
        Uncertain {
            value: kelvin,
            std_error: 0.25 * kelvin * radiosity.std_error / black,
            ..radiosity
        }
    })
}

/// +1 or −1, the same for both factors of a pair.
fn sign(direction: u32, i: usize, j: usize) -> f64 {
    let key = combine(combine(key_of_name("sign"), u64::from(direction)), i as u64);
    if combine(key, j as u64) & 1 == 0 {
        1.0
    } else {
        -1.0
    }
}

/// Sums of squares of the changes of what is found.
struct Spread {
    radiosity: Vec<f64>,
    irradiance: Vec<f64>,
    net_flux: Vec<f64>,
    balance: f64,
}

impl Spread {
    fn new(count: usize) -> Self {
        Self {
            radiosity: vec![0.0; count],
            irradiance: vec![0.0; count],
            net_flux: vec![0.0; count],
            balance: 0.0,
        }
    }

    /// Adds the changes that follow from `change` of the irradiances at constant radiosities.
    fn add(&mut self, enclosure: &Enclosure, change: &[f64]) -> Result<(), RadiosityError> {
        if change.iter().all(|&x| x == 0.0) {
            return Ok(());
        }
        let reflected = change
            .iter()
            .zip(&enclosure.reflectance)
            .map(|(x, rho)| x * rho);
        let (radiosity, _) = enclosure.solve(&reflected.collect::<Vec<f64>>())?;
        let mut balance = 0.0;
        for i in 0..change.len() {
            let irradiance = enclosure.irradiance(i, &radiosity) + change[i];
            let net_flux = radiosity[i] - irradiance;
            balance += enclosure.areas[i] * net_flux;
            self.radiosity[i] += radiosity[i] * radiosity[i];
            self.irradiance[i] += irradiance * irradiance;
            self.net_flux[i] += net_flux * net_flux;
        }
        self.balance += balance * balance;
        Ok(())
    }
}
