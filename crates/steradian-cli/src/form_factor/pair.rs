//! One surface or element to another surface.

use steradian::exchange::Element;
use steradian::geometry::form_factor::{self, Factor, Surface};

use super::report::{Factors, Named};
use crate::status::Failure;

/// The configuration factor.
pub fn from_element(element: Element, to: &Surface, two_sided: bool) -> Factors {
    let seen = |surface: &Surface| surface.seen_from(element.position, element.normal);
    let behind = to.back().filter(|_| two_sided);
    let value = seen(to) + behind.as_ref().map_or(0.0, seen);
    Factors::single(Factor { value, error: 0.0 })
}

/// The form factor, and by reciprocity the one back.
pub fn between(
    from: &Surface,
    to: &Surface,
    two_sided: bool,
    rel_error: f64,
) -> Result<Factors, Failure> {
    let factor = |to: &Surface| {
        form_factor::between(from, to, rel_error)
            .map_err(|error| Failure::message(error.to_string()))
    };
    let mut forth = factor(to)?;
    if let Some(back) = to.back().filter(|_| two_sided) {
        let behind = factor(&back)?;
        forth.value += behind.value;
        forth.error += behind.error;
    }
    let ratio = from.area() / to.area();
    let reverse = Factor {
        value: forth.value * ratio,
        error: forth.error * ratio,
    };
    let mut factors = Factors::single(forth);
    factors.reverse = Some(Named {
        name: "F21",
        factor: reverse,
    });
    factors.areas = Some([from, to].map(|surface| surface.area().to_square_metres()));
    Ok(factors)
}
