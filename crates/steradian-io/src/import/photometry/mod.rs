//! Luminaires as laboratories and makers publish them: IES LM-63, EULUMDAT and IES TM-33 files.
//!
//! ```
//! use std::path::Path;
//! use steradian_io::files::MemoryFiles;
//! use steradian_io::import::photometry::read;
//!
//! // One lamp of 1000 lm, 10 cd in every direction: 40π lm.
//! let text = "IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 25\n0 180\n0\n10 10\n";
//! let files = MemoryFiles::default().with("lamp.ies", text);
//! let lamp = read(Path::new("lamp.ies"), &files).unwrap();
//! assert!((lamp.far_field.flux() - 40.0 * std::f64::consts::PI).abs() < 1e-12);
//! assert_eq!(lamp.lamp_flux, Some(1000.0));
//! ```

mod eulumdat;
mod ies;
mod numbers;
mod opening;
mod projected_area;
mod source;
mod symmetry;
mod tm33;

use std::path::Path;

use steradian::light::FarField;

pub use ies::Tilt;
pub use opening::Opening;

use crate::diagnostic::Diagnostic;
use crate::files::Files;

/// What intensities are given in.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum IntensityUnit {
    /// cd.
    Candela,
    /// mW/sr.
    MilliwattPerSteradian,
}

/// Lamps that a luminaire is equipped with.
#[derive(Clone, Debug, PartialEq)]
pub struct LampSet {
    /// Number of lamps; negative in files of absolute photometry.
    pub lamps: f64,
    /// What they are called.
    pub kind: String,
    /// Flux of all of them in lm.
    pub flux: f64,
    /// Electrical power with ballast in W.
    pub watts: f64,
}

/// A luminaire.
#[derive(Clone, Debug)]
pub struct Photometry {
    /// The version line or name of the format.
    pub format: String,
    /// What the header says, in its order; lines without a keyword have an empty one.
    pub keywords: Vec<(String, String)>,
    /// What the intensities are given in.
    pub unit: IntensityUnit,
    /// Intensities of the luminaire, with all factors of the file.
    pub far_field: FarField,
    /// How the table was completed.
    pub symmetry: &'static str,
    /// Rated flux of all lamps; `None` where the file is absolute.
    pub lamp_flux: Option<f64>,
    /// Number of lamps.
    pub lamps: f64,
    /// Electrical power in W.
    pub watts: f64,
    /// Other lamps that the luminaire is sold with, which are not used.
    pub other_sets: Vec<LampSet>,
    /// Where light leaves.
    pub opening: Opening,
    /// Heights in m of the luminous sides that face C0, C90, C180 and C270, where the file tells them apart.
    pub side_heights: Option<[f64; 4]>,
    /// How the lamp fares when the luminaire is tilted.
    pub tilt: Option<Tilt>,
    /// What may not be as its author thinks.
    pub warnings: Vec<Diagnostic>,
}

/// Whether a file of this name may be a luminaire's; one that ends with .xml may be a measured surface's, too.
pub fn is_luminaire(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|extension| {
        ["ies", "ldt", "xml", "iesxml"]
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
    })
}

/// Whether an XML file is a luminaire's by its first element; `false` if it cannot be read.
pub fn is_tm33(path: &Path, files: &dyn Files) -> bool {
    let bytes = files.read(path).unwrap_or_default();
    tm33::is_tm33(&String::from_utf8_lossy(&bytes))
}

/// Reads a luminaire.
///
/// # Errors
/// What is wrong with the file, at its line, and what was expected.
pub fn read(path: &Path, files: &dyn Files) -> Result<Photometry, Vec<Diagnostic>> {
    let extension = path.extension().and_then(|extension| extension.to_str());
    match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("ies") => ies::read(path, files),
        Some("ldt") => eulumdat::read(path, files),
        Some("xml" | "iesxml") => tm33::read(path, files),
        _ => {
            let message = "expected a luminaire file (.ies, .ldt or TM-33 .xml)";
            let file = std::sync::Arc::new(crate::diagnostic::SourceFile {
                name: path.display().to_string(),
                text: String::new(),
            });
            Err(vec![Diagnostic::error(message).about(&file)])
        }
    }
}

#[cfg(test)]
mod glare_tests;
#[cfg(test)]
mod tests;
