//! What absorbs on the two sides of a surface.
//!
//! Radiance falls along a path of length s through a medium to exp(−a s) of itself: the law of Bouguer, with the absorption
//! coefficient a in 1/m. The inside is where the normal does not point.

/// Absorption on each side of a surface, in 1/m; `None` for clear media.
#[derive(Clone, Debug, PartialEq)]
pub struct Media<T> {
    /// Behind the surface.
    pub inside: Option<T>,
    /// Before it.
    pub outside: Option<T>,
}

impl<T> Default for Media<T> {
    fn default() -> Self {
        Self {
            inside: None,
            outside: None,
        }
    }
}

impl<T> Media<T> {
    /// Whether both sides are clear.
    pub const fn is_clear(&self) -> bool {
        self.inside.is_none() && self.outside.is_none()
    }

    /// Each side turned into something else.
    ///
    /// # Errors
    /// The first that a side cannot be turned for.
    pub fn turn<U, E>(
        &self,
        mut with: impl FnMut(&'static str, &T) -> Result<U, E>,
    ) -> Result<Media<U>, E> {
        let mut side = |key, absorption: &Option<T>| {
            absorption
                .as_ref()
                .map(|found| with(key, found))
                .transpose()
        };
        Ok(Media {
            inside: side("absorption", &self.inside)?,
            outside: side("exterior_absorption", &self.outside)?,
        })
    }
}
