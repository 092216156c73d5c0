//! What a check found.

use crate::geometry::Direction;

/// A law of the contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Check {
    /// Numbers are finite and not negative.
    Values,
    /// ρ(a, b)/n_a² = ρ(b, a)/n_b².
    Reciprocity,
    /// albedo + transmittance ≤ 1.
    Energy,
    /// A sample tells its own value and density.
    Agreement,
    /// ∫ pdf dω ≤ 1.
    Density,
    /// Directions have the density pdf.
    Sampling,
    /// E(weight) is the albedo, and the transmittance.
    MeanWeight,
    /// A model without loss keeps all light.
    Furnace,
}

impl Check {
    /// For tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Values => "values",
            Self::Reciprocity => "reciprocity",
            Self::Energy => "energy",
            Self::Agreement => "agreement",
            Self::Density => "density",
            Self::Sampling => "sampling",
            Self::MeanWeight => "mean weight",
            Self::Furnace => "furnace",
        }
    }

    /// What the worst value of a finding is.
    pub const fn measure(self) -> &'static str {
        match self {
            Self::Values => "numbers that are negative, infinite or NaN",
            Self::Reciprocity => "relative difference of ρ(a, b)/n_a² and ρ(b, a)/n_b²",
            Self::Energy => "albedo + transmittance",
            Self::Agreement => {
                "relative difference of a sample's value or density from evaluate and pdf"
            }
            Self::Density => "∫ pdf dω",
            Self::Sampling => "χ² of samples against pdf, in standard deviations",
            Self::MeanWeight => {
                "difference of E[weight] from albedo or transmittance, over what chance and the method allow"
            }
            Self::Furnace => "difference of albedo + transmittance from 1",
        }
    }
}

/// Where a value was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// d_e.
    pub wo: Direction,
    /// d_i, of values for two directions.
    pub wi: Option<Direction>,
    /// The lane, of values that differ by lane.
    pub lane: Option<usize>,
}

impl Place {
    /// A view as a whole.
    pub(super) const fn view(wo: Direction) -> Self {
        Self {
            wo,
            wi: None,
            lane: None,
        }
    }
}

/// The worst that a check saw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The law.
    pub check: Check,
    /// Its worst value: see [`Check::measure`].
    pub worst: f64,
    /// What the value may be at most.
    pub bound: f64,
    /// Where it is; `None` if there was nothing to look at, as of a black surface.
    pub place: Option<Place>,
}

impl Finding {
    pub(super) const fn new(check: Check, bound: f64) -> Self {
        Self {
            check,
            worst: 0.0,
            bound,
            place: None,
        }
    }

    /// Keeps the larger value; NaN is larger than any number.
    pub(super) fn see(&mut self, value: f64, place: Place) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        if self.place.is_none() || value > self.worst {
            (self.worst, self.place) = (value, Some(place));
        }
    }

    /// Whether the worst value is within the bound.
    pub fn passed(&self) -> bool {
        self.worst <= self.bound
    }
}
