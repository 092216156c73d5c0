//! The intensity of a lamp by direction, from a table: bilinear in two angles, zero beyond them.
//!
//! I(ψ, θ) is linear in ψ and in θ between the nodes of a grid. A luminaire hangs with its light towards −z; C0 is +x and C90
//! is +y. Three systems of angles are in use, each about an axis of its own:
//!
//! | system | azimuth ψ | polar angle θ | axis θ = 0 | ψ = 0 at θ = 90° | ψ = 90° at θ = 90° |
//! |---|---|---|---|---|---|
//! | C, γ (type C) | C | γ, from below | −z | +x | +y |
//! | B, β (type B) | V | 90° − H | +x | −z | +y |
//! | A, α (type A) | X | 90° − Y | +y | −z | +x |
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | I | intensity | cd, W/sr or any other |
//! | Φ | ∫ I dω = ∫∫ I sinθ dθ dψ: a closed form in every cell of the grid | the same times sr |
//! | p | I/Φ, the density of a sampled direction: its weight is Φ, whatever the direction | 1/sr |
//!
//! With I = I₀ + q (θ − θ₀) in a cell, ∫ I sinθ dθ = I₀ cosθ₀ − I₁ cosθ₁ + q (sinθ₁ − sinθ₀). Directions are drawn by inverting
//! the share of Φ: exactly in ψ, where it is a parabola, by Newton's method in θ.
//!
//! Source: EN 13032-1:2004, §4.3 (systems of planes); ANSI/IES LM-63-19, §5 (types A, B and C).
//!
//! ```
//! use steradian::light::{FarField, Planes};
//! // I = 2 in the lower half of space: Φ = 2 · 2π.
//! let half = FarField::new(Planes::C, &[0.0, 360.0], &[0.0, 90.0], &[2.0, 2.0, 2.0, 2.0])?;
//! assert!((half.flux() - 4.0 * std::f64::consts::PI).abs() < 1e-14);
//! # Ok::<(), steradian::light::FarFieldError>(())
//! ```

mod cell;
mod error;
mod figures;

pub use error::FarFieldError;

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::geometry::{Direction, Vector};

/// A system of angles.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Planes {
    /// Half planes through the vertical axis: azimuth X, latitude Y of lamps of vehicles.
    A,
    /// Half planes through the horizontal axis: azimuth V, latitude H of floodlights.
    B,
    /// Half planes through the vertical: C and γ.
    C,
}

impl Planes {
    /// Towards θ = 0, and towards ψ = 0 and 90° at θ = 90°.
    const fn axes(self) -> [Vector; 3] {
        let (x, y) = (Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0));
        let below = Vector::new(0.0, 0.0, -1.0);
        match self {
            Self::A => [y, below, x],
            Self::B => [x, below, y],
            Self::C => [below, x, y],
        }
    }
}

/// A table of intensities.
#[derive(Clone, Debug, PartialEq)]
pub struct FarField {
    planes: Planes,
    /// ψ in rad, increasing over at most 2π.
    azimuths: Vec<f64>,
    /// θ in rad, increasing between 0 and π.
    polars: Vec<f64>,
    /// I by azimuth, then polar angle.
    values: Vec<f64>,
    /// ∫ I sinθ dθ from the first polar angle up to each one, for each azimuth.
    columns: Vec<f64>,
    /// Flux up to each azimuth.
    cumulative: Vec<f64>,
}

/// A direction drawn from a table.
#[derive(Copy, Clone, Debug, PartialEq)]
pub struct FarFieldSample {
    /// Away from the lamp.
    pub direction: Direction,
    /// I.
    pub intensity: f64,
    /// I/Φ, in 1/sr.
    pub pdf: f64,
}

impl FarField {
    /// From the azimuths and polar angles θ of a grid in degrees, and the intensities of the first azimuth, the second …
    ///
    /// Nothing is mirrored: symmetric tables are to be given whole.
    ///
    /// # Errors
    /// If there are fewer than two angles of a kind, or they do not increase, or leave 0 … 180° (θ) or a turn of 360° (ψ); if
    /// the number of intensities is not that of the nodes, or one is negative or not finite.
    pub fn new(
        planes: Planes,
        azimuths: &[f64],
        polars: &[f64],
        values: &[f64],
    ) -> Result<Self, FarFieldError> {
        error::check(azimuths, polars, values)?;
        let [azimuths, polars] = [azimuths, polars].map(radians);
        let mut table = Self {
            planes,
            columns: Vec::with_capacity(values.len()),
            cumulative: vec![0.0],
            azimuths,
            polars,
            values: values.to_vec(),
        };
        table.integrate();
        Ok(table)
    }

    fn integrate(&mut self) {
        for azimuth in 0..self.azimuths.len() {
            let mut sum = 0.0;
            self.columns.push(sum);
            for polar in 1..self.polars.len() {
                sum += self.strip(azimuth, polar - 1, self.polars[polar]);
                self.columns.push(sum);
            }
        }
        let mut sum = 0.0;
        for band in 0..self.azimuths.len() - 1 {
            let width = self.azimuths[band + 1] - self.azimuths[band];
            sum += 0.5 * width * (self.column(band) + self.column(band + 1));
            self.cumulative.push(sum);
        }
    }

    /// ∫ I sinθ dθ at a node of azimuth, from a node of the polar angle to an angle before the next.
    fn strip(&self, azimuth: usize, polar: usize, to: f64) -> f64 {
        let node = azimuth * self.polars.len() + polar;
        let (from, next) = (self.polars[polar], self.polars[polar + 1]);
        let [first, last] = [self.values[node], self.values[node + 1]];
        cell::integral([first, (last - first) / (next - from)], from, to)
    }

    /// ∫ I sinθ dθ over all polar angles at a node of azimuth.
    fn column(&self, azimuth: usize) -> f64 {
        self.columns[(azimuth + 1) * self.polars.len() - 1]
    }

    /// The system of angles.
    pub const fn planes(&self) -> Planes {
        self.planes
    }

    /// Φ = ∫ I dω.
    pub fn flux(&self) -> f64 {
        self.cumulative[self.cumulative.len() - 1]
    }

    /// ψ and θ in rad of the greatest intensity, which is that of a node, and the intensity; of equal ones the first.
    pub fn peak(&self) -> [f64; 3] {
        let mut best = 0;
        for (node, value) in self.values.iter().enumerate() {
            if *value > self.values[best] {
                best = node;
            }
        }
        let count = self.polars.len();
        [
            self.azimuths[best / count],
            self.polars[best % count],
            self.values[best],
        ]
    }

    /// The flux at polar angles up to one in rad: of C planes the flux in a cone about the downward vertical.
    pub fn flux_within(&self, polar: f64) -> f64 {
        let up_to = |azimuth: usize| {
            let place = self.polars.partition_point(|&angle| angle <= polar);
            match place {
                0 => 0.0,
                place if place == self.polars.len() => self.column(azimuth),
                place => {
                    self.columns[azimuth * self.polars.len() + place - 1]
                        + self.strip(azimuth, place - 1, polar)
                }
            }
        };
        (0..self.azimuths.len() - 1)
            .map(|band| {
                let width = self.azimuths[band + 1] - self.azimuths[band];
                0.5 * width * (up_to(band) + up_to(band + 1))
            })
            .sum()
    }

    /// I towards a direction away from the lamp.
    pub fn intensity(&self, direction: Direction) -> f64 {
        let [polar_axis, zero, quarter] = self.planes.axes();
        let direction = direction.to_vector();
        let (along, across) = (direction.dot(zero), direction.dot(quarter));
        let theta = libm::atan2(
            (along * along + across * across).sqrt(),
            direction.dot(polar_axis),
        );
        self.at_angles(libm::atan2(across, along), theta)
    }

    /// I at ψ and θ in rad; ψ by whole turns.
    pub fn at_angles(&self, azimuth: f64, polar: f64) -> f64 {
        let first = self.azimuths[0];
        let turned = first + libm::fmod(libm::fmod(azimuth - first, TAU) + TAU, TAU);
        let Some((band, t)) = cell::locate(&self.azimuths, turned) else {
            return 0.0;
        };
        let Some((row, s)) = cell::locate(&self.polars, polar) else {
            return 0.0;
        };
        let node = band * self.polars.len() + row;
        let next = node + self.polars.len();
        let mix = |a: f64, b: f64, part: f64| a + part * (b - a);
        mix(
            mix(self.values[node], self.values[node + 1], s),
            mix(self.values[next], self.values[next + 1], s),
            t,
        )
    }

    /// A direction of density I/Φ from two uniform numbers; `None` of a lamp without light.
    pub fn sample(&self, [u, v]: [f64; 2]) -> Option<FarFieldSample> {
        let flux = self.flux();
        if flux <= 0.0 {
            return None;
        }
        let target = u * flux;
        let bands = self.cumulative.len() - 1;
        let band = self.cumulative.partition_point(|&sum| sum <= target);
        let band = band.saturating_sub(1).min(bands - 1);
        let within = self.cumulative[band + 1] - self.cumulative[band];
        let share = ((target - self.cumulative[band]) / within).clamp(0.0, 1.0);
        let part = cell::invert_linear([self.column(band), self.column(band + 1)], share);
        let width = self.azimuths[band + 1] - self.azimuths[band];
        let azimuth = self.azimuths[band] + part * width;
        let polar = self.sample_polar(band, part, v);
        let intensity = self.at_angles(azimuth, polar);
        (intensity > 0.0).then(|| FarFieldSample {
            direction: self.direction(azimuth, polar),
            intensity,
            pdf: intensity / flux,
        })
    }

    /// θ between two azimuths, by its share of ∫ I sinθ dθ there.
    fn sample_polar(&self, band: usize, part: f64, v: f64) -> f64 {
        let count = self.polars.len();
        let mix = |table: &[f64], row: usize| {
            let node = band * count + row;
            table[node] + part * (table[node + count] - table[node])
        };
        let target = v * mix(&self.columns, count - 1);
        let row = cell::partition_point(count, |row| mix(&self.columns, row) <= target);
        let row = row.saturating_sub(1).min(count - 2);
        let (from, to) = (self.polars[row], self.polars[row + 1]);
        let [first, last] = [row, row + 1].map(|row| mix(&self.values, row));
        let line = [first, (last - first) / (to - from)];
        cell::invert_polar(line, [from, to], target - mix(&self.columns, row))
    }

    /// The direction of ψ and θ in rad.
    pub fn direction(&self, azimuth: f64, polar: f64) -> Direction {
        let [polar_axis, zero, quarter] = self.planes.axes();
        let (sin, cos) = (libm::sin(polar), libm::cos(polar));
        let across = zero * libm::cos(azimuth) + quarter * libm::sin(azimuth);
        Direction::from_unit(polar_axis * cos + across * sin)
    }

    /// ψ and θ of the nodes in rad.
    pub fn nodes(&self) -> [&[f64]; 2] {
        [&self.azimuths, &self.polars]
    }
}

/// Radians that are exact at whole quarters of a turn.
fn radians(angles: &[f64]) -> Vec<f64> {
    let radians = |&degrees: &f64| degrees / 90.0 * FRAC_PI_2;
    angles.iter().map(radians).collect()
}

#[cfg(test)]
mod tests;
