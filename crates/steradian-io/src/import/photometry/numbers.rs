//! Columns of numbers that both formats have: angles that increase, and intensities.

use std::ops::Range;

use super::source::Source;
use crate::diagnostic::Diagnostic;

/// A file that gives one number after the other, each with its place.
pub(super) trait Numbers {
    /// The next number; `what` is expected.
    fn number(&mut self, what: &str) -> Result<(Range<usize>, f64), Diagnostic>;

    /// A diagnostic about these bytes.
    fn error(&self, span: Range<usize>, message: String) -> Diagnostic;

    /// Angles that increase, and where they stand.
    fn angles(&mut self, count: usize, what: &str) -> Result<(Range<usize>, Vec<f64>), Diagnostic> {
        let mut angles: Vec<f64> = Vec::with_capacity(count);
        let mut place = 0..0;
        for index in 0..count {
            let (span, angle) = self.number(&format!("{what} ({} of {count})", index + 1))?;
            if let Some(&previous) = angles.last().filter(|previous| **previous >= angle) {
                let message = format!("angles must increase: {angle} follows {previous}");
                return Err(self.error(span, message));
            }
            let start = if index == 0 { span.start } else { place.start };
            place = start..span.end;
            angles.push(angle);
        }
        Ok((place, angles))
    }

    /// Intensities, multiplied.
    fn intensities(&mut self, count: usize, factor: f64) -> Result<Vec<f64>, Diagnostic> {
        let mut values = Vec::with_capacity(count);
        for index in 0..count {
            let (span, value) = self.number(&format!("an intensity ({} of {count})", index + 1))?;
            let value = value * factor;
            if !(value.is_finite() && value >= 0.0) {
                let message = "an intensity is finite and not negative".into();
                return Err(self.error(span, message));
            }
            values.push(value);
        }
        Ok(values)
    }
}

impl Numbers for Source {
    fn number(&mut self, what: &str) -> Result<(Range<usize>, f64), Diagnostic> {
        Self::number(self, what)
    }

    fn error(&self, span: Range<usize>, message: String) -> Diagnostic {
        Self::error(self, span, message)
    }
}
