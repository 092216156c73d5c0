//! What one facet does with light, by direction, in tables that are made once.
//!
//! M(ω) = 1 − E(ω), with E the share of light along ω that leaves the surface after one facet. A lobe
//! (1 − E(d_e))(1 − E(d_i))/(π M̄) gives that light back and is reciprocal, M̄ = (1/π) ∫ M cosθ dω.
//!
//! Beside M stands a second share N(ω) of the light, of which each model says what it is. Both are linear in √cosθ between 129 nodes, and cubic
//! (Catmull and Rom) in a stretched azimuth φ′ between 0 and 90° where the surface is anisotropic, tanφ′ = √(α_y/α_x) tanφ,
//! which resolves the narrow range of azimuths along which the surface is smoothest. Source: C. Kulla and A. Conty,
//! *Revisiting physically based shading at Imageworks*, SIGGRAPH 2017 course; after C. Kelemen and
//! L. Szirmay-Kalos, Eurographics 2001.
//!
//! Directions are drawn from the azimuthal mean of M cosθ: a band of cosθ by its share, evenly in cos²θ inside it.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, TAU};

use crate::geometry::{Direction, gauss};

/// Bands of cosθ.
const BANDS: usize = 128;
/// Intervals of stretched azimuth between 0 and 90° of an anisotropic surface.
const SECTORS: usize = 16;
/// M̄ of a surface that loses nothing that matters, so that it can be divided by.
const LEAST: f64 = 1e-12;

/// (M, N) at the nodes of √cosθ.
type Row = [[f64; 2]; BANDS + 1];

/// M and N of every direction of one side.
#[derive(Clone, PartialEq)]
pub(in crate::brdf) struct Table {
    /// For each azimuth.
    rows: Vec<Row>,
    /// √(α_y/α_x).
    stretch: f64,
    /// Share of ∫ M cosθ dω below the upper edge of each band.
    cumulative: [f64; BANDS],
    /// M̄ and N̄.
    averages: [f64; 2],
}

impl Table {
    /// From (M, N) of directions above the surface, and √(α_y/α_x) of an anisotropic one.
    pub(in crate::brdf) fn new(
        stretch: Option<f64>,
        shares: impl Fn(Direction) -> [f64; 2],
    ) -> Self {
        let sectors = if stretch.is_some() { SECTORS } else { 0 };
        let stretch = stretch.unwrap_or(1.0);
        let row = |sector: usize| {
            let phi = azimuth(sector, stretch);
            std::array::from_fn(|node| {
                // At the horizon the limit.
                let cos = edge(node).max(1e-5);
                let sin = (1.0 - cos * cos).sqrt();
                shares(Direction::from_polar(sin, cos, phi)).map(|share| share.clamp(0.0, 1.0))
            })
        };
        let rows: Vec<Row> = (0..=sectors).map(row).collect();
        let [shares, others] = [0, 1].map(|share| shares_of_bands(&rows, share, stretch));
        let average = shares.iter().sum::<f64>().max(LEAST);
        let mut sum = 0.0;
        let cumulative = shares.map(|share| {
            sum += share;
            sum / average
        });
        Self {
            rows,
            stretch,
            cumulative,
            averages: [average, others.iter().sum()],
        }
    }

    /// M̄ and N̄.
    pub(in crate::brdf) fn averages(&self) -> [f64; 2] {
        self.averages
    }

    /// (M, N) of a direction above the surface.
    pub(in crate::brdf) fn at(&self, direction: Direction) -> [f64; 2] {
        let place = direction.z().clamp(0.0, 1.0).sqrt() * BANDS as f64;
        let node = (place as usize).min(BANDS - 1);
        let part = place - node as f64;
        let in_row = |row: &Row, share: usize| {
            row[node][share] + part * (row[node + 1][share] - row[node][share])
        };
        if let [only] = self.rows.as_slice() {
            return [in_row(only, 0), in_row(only, 1)];
        }
        let phi = libm::atan2(self.stretch * direction.y().abs(), direction.x().abs());
        let place = phi / FRAC_PI_2 * SECTORS as f64;
        let sector = (place as usize).min(SECTORS - 1);
        // Shares are even about 0 and 90°.
        let row = |k: usize| &self.rows[SECTORS - SECTORS.abs_diff(k)];
        let rows = [
            &self.rows[sector.abs_diff(1)],
            row(sector),
            row(sector + 1),
            row(sector + 2),
        ];
        [0, 1].map(|share| {
            let points = rows.map(|row| in_row(row, share));
            catmull_rom(points, place - sector as f64).clamp(0.0, 1.0)
        })
    }

    /// A direction above the surface.
    pub(in crate::brdf) fn sample(&self, u: [f64; 2]) -> Direction {
        let band = self
            .cumulative
            .partition_point(|&upper| upper <= u[0])
            .min(BANDS - 1);
        let (lower, share) = self.band(band);
        let part = ((u[0] - lower) / share).clamp(0.0, 1.0);
        let [from, to] = squares(band);
        let square = from + part * (to - from);
        Direction::from_polar((1.0 - square).max(0.0).sqrt(), square.sqrt(), TAU * u[1])
    }

    /// Its density.
    pub(in crate::brdf) fn pdf(&self, direction: Direction) -> f64 {
        let cos = direction.z();
        if cos <= 0.0 {
            return 0.0;
        }
        let band = ((cos.min(1.0).sqrt() * BANDS as f64) as usize).min(BANDS - 1);
        let [from, to] = squares(band);
        self.band(band).1 * cos * FRAC_1_PI / (to - from)
    }

    /// M at the nodes, if it does not depend on azimuth.
    pub(super) fn nodes(&self) -> Option<[f64; BANDS + 1]> {
        match self.rows.as_slice() {
            [only] => Some(only.map(|[missing, _]| missing)),
            _ => None,
        }
    }

    /// The density of [`sample`](Self::sample) over cosθ in each band.
    pub(super) fn bands(&self) -> [f64; BANDS] {
        std::array::from_fn(|band| {
            let [from, to] = squares(band);
            self.band(band).1 * FRAC_1_PI / (to - from)
        })
    }

    /// What lies below a band, and in it.
    fn band(&self, band: usize) -> (f64, f64) {
        let lower = if band == 0 {
            0.0
        } else {
            self.cumulative[band - 1]
        };
        (lower, self.cumulative[band] - lower)
    }
}

/// cosθ at a node.
fn edge(node: usize) -> f64 {
    let root = node as f64 / BANDS as f64;
    root * root
}

/// cos²θ at the edges of a band.
fn squares(band: usize) -> [f64; 2] {
    [band, band + 1].map(|node| edge(node) * edge(node))
}

/// φ at a sector's edge: tanφ = tanφ′/s.
fn azimuth(sector: usize, stretch: f64) -> f64 {
    let (sin, cos) = libm::sincos(FRAC_PI_2 * sector as f64 / SECTORS as f64);
    libm::atan2(sin, stretch * cos)
}

/// dφ/dφ′ there.
fn widening(sector: usize, stretch: f64) -> f64 {
    let (sin, cos) = libm::sincos(FRAC_PI_2 * sector as f64 / SECTORS as f64);
    stretch / (stretch * stretch * cos * cos + sin * sin)
}

/// (1/π) ∫ M cosθ dω over each band, or that of N: ∫ 2M µ dµ = ∫ 4 M t³ dt, of degree 4, and the trapezoidal rule in azimuth.
fn shares_of_bands(rows: &[Row], share: usize, stretch: f64) -> [f64; BANDS] {
    let last = rows.len() - 1;
    let weight = |sector: usize| match sector {
        _ if last == 0 => 1.0,
        sector if sector == 0 || sector == last => 0.5 * widening(sector, stretch) / last as f64,
        _ => widening(sector, stretch) / last as f64,
    };
    let mean = |node: usize| -> f64 {
        (0..rows.len())
            .map(|sector| weight(sector) * rows[sector][node][share])
            .sum()
    };
    std::array::from_fn(|band| {
        let ends = [mean(band), mean(band + 1)];
        let edges = [band, band + 1].map(|node| node as f64 / BANDS as f64);
        gauss::integrate(3, edges, |t| {
            let part = t * BANDS as f64 - band as f64;
            4.0 * t * t * t * (ends[0] + part * (ends[1] - ends[0]))
        })
    })
}

/// The cubic through the two middle points whose slopes there are those of the chords across them.
fn catmull_rom([a, b, c, d]: [f64; 4], t: f64) -> f64 {
    let cubic = 3.0 * (b - c) + d - a;
    let square = 2.0 * a - 5.0 * b + 4.0 * c - d;
    b + 0.5 * t * (c - a + t * (square + t * cubic))
}
