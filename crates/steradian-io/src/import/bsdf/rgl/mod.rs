//! The tensor files of EPFL's Realistic Graphics Lab, `.bsdf`.
//!
//! | field | dimensions | what it is |
//! |---|---|---|
//! | `theta_i`, `phi_i` | nodes | angles of incidence in rad |
//! | `ndf`, `sigma` | 2 | density of facets, projected area |
//! | `vndf`, `luminance` | φ, θ, 2 | density of visible facets, luminance |
//! | `rgb` | φ, θ, 3, 2 | reflection of red, green and blue |
//! | `spectra`, `wavelengths` | φ, θ, λ, 2; λ | reflection by wavelength in nm |
//! | `jacobian`, `description` | 1; bytes | whether `ndf`/(4 `sigma`) is a factor; a name |
//!
//! Of files with spectra, colours are those under D65; negative numbers of `rgb` and `spectra` become 0 with a warning. What the numbers mean
//! is told in [`Rgl`]. Source: J. Dupuy, W. Jakob, *An adaptive parameterization for efficient material acquisition
//! and rendering* (SIGGRAPH Asia 2018).

mod tensor;

use std::sync::Arc;

use steradian::brdf::Measured;
use steradian::brdf::measured::{MeasuredError, Reading, Rgl, RglTables, Sheets};
use steradian::spectrum::{Beyond, Curve, Illuminant, Observer, apply, rgb_from_xyz, xyz_of};

use super::error::{BinaryFault, BsdfError};
use super::{Band, MeasuredFile};
use tensor::{Field, Tensors};

/// Reads a tensor file.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn read(bytes: &[u8]) -> Result<MeasuredFile, BsdfError> {
    let mut reader = Reader {
        tensors: Tensors::read(bytes)?,
        warnings: vec![],
    };
    let nodes = [reader.nodes("phi_i")?, reader.nodes("theta_i")?];
    let counts = [nodes[0].len(), nodes[1].len()];
    let spectra = reader.spectra(counts)?;
    let colours = match (&spectra, reader.tensors.find("rgb").is_some()) {
        (Some((wavelengths, sheets)), false) => reader.coloured(wavelengths, sheets)?,
        _ => reader.sheets("rgb", &[counts[0], counts[1], 3])?,
    };
    let [phi, theta] = nodes;
    let tables = RglTables {
        phi,
        theta,
        facets: reader.sheets("ndf", &[])?,
        projected_area: reader.sheets("sigma", &[])?,
        visible_facets: reader.sheets("vndf", &counts)?,
        luminance: reader.sheets("luminance", &counts)?,
        colours,
        spectra: spectra.map(|(wavelengths, sheets)| (wavelengths, sheets.sheets)),
        has_factor: reader.flag("jacobian")?,
    };
    reader.finish(tables)
}

struct Reader<'a> {
    tensors: Tensors<'a>,
    warnings: Vec<String>,
}

/// Sheets and the numbers they are made of.
struct Read {
    sheets: Sheets,
    values: Vec<f32>,
    size: [usize; 2],
}

impl Reader<'_> {
    fn finish(self, tables: RglTables) -> Result<MeasuredFile, BsdfError> {
        let table = Rgl::new(tables).map_err(|fault| BinaryFault::Table(fault).at(0))?;
        let name = if table.wavelengths().is_some() {
            "spectral"
        } else {
            "rgb"
        };
        Ok(MeasuredFile {
            format: "RGL",
            header: self.header(&table)?,
            bands: vec![Band {
                name: name.to_owned(),
                model: Measured::Rgl(Arc::new(table), Reading::default()),
            }],
            warnings: self.warnings,
        })
    }

    fn header(&self, table: &Rgl) -> Result<Vec<(String, String)>, BsdfError> {
        let mut header = vec![];
        if let Some(field) = self.tensors.find("description") {
            let text = String::from_utf8_lossy(self.tensors.octets(field)?).into_owned();
            header.push(("Description".to_owned(), text));
        }
        let kind = if table.is_isotropic() {
            "isotropic"
        } else {
            "anisotropic"
        };
        header.push(("Kind".to_owned(), kind.to_owned()));
        header.extend(self.tensors.fields.iter().map(|field| {
            let sizes: Vec<_> = field.shape.iter().map(usize::to_string).collect();
            (field.name.clone(), sizes.join(" x "))
        }));
        Ok(header)
    }

    fn nodes(&self, name: &'static str) -> Result<Vec<f64>, BsdfError> {
        let field = self.tensors.need(name)?;
        if field.shape.len() != 1 {
            return Err(shape_fault(field));
        }
        let values = self.tensors.floats(field)?;
        Ok(values.into_iter().map(f64::from).collect())
    }

    fn flag(&self, name: &'static str) -> Result<bool, BsdfError> {
        let field = self.tensors.need(name)?;
        let octets = self.tensors.octets(field)?;
        octets
            .first()
            .map(|octet| *octet != 0)
            .ok_or_else(|| shape_fault(field))
    }

    fn spectra(&mut self, [phi, theta]: [usize; 2]) -> Result<Option<(Vec<f64>, Read)>, BsdfError> {
        if self.tensors.find("spectra").is_none() {
            return Ok(None);
        }
        let wavelengths = self.nodes("wavelengths")?;
        let sheets = self.read_sheets("spectra", &[phi, theta, wavelengths.len()])?;
        Ok(Some((wavelengths, sheets)))
    }

    fn sheets(&mut self, name: &'static str, nodes: &[usize]) -> Result<Sheets, BsdfError> {
        Ok(self.read_sheets(name, nodes)?.sheets)
    }

    /// Sheets for these numbers of nodes.
    fn read_sheets(&mut self, name: &'static str, nodes: &[usize]) -> Result<Read, BsdfError> {
        let field = self.tensors.need(name)?;
        let (sizes, [height, width]) = match field.shape.split_last_chunk::<2>() {
            Some(parts) => parts,
            None => return Err(shape_fault(field)),
        };
        if sizes != nodes {
            return Err(shape_fault(field));
        }
        let (size, byte) = ([*width, *height], field.byte);
        let mut values = self.tensors.floats(field)?;
        if matches!(name, "rgb" | "spectra") {
            self.mend(name, &mut values);
        }
        let fault = |fault| BinaryFault::Field { name, fault }.at(byte);
        let sheets = Sheets::new(size, values.clone()).map_err(fault)?;
        Ok(Read {
            sheets,
            values,
            size,
        })
    }

    fn mend(&mut self, name: &str, values: &mut [f32]) {
        let negative = values.iter_mut().filter(|value| **value < 0.0);
        let count = negative.map(|value| *value = 0.0).count();
        if count > 0 {
            self.warnings
                .push(format!("{count} negative numbers of {name}; these are 0"));
        }
    }

    /// Red, green and blue of every spectrum, under D65.
    fn coloured(&self, wavelengths: &[f64], spectra: &Read) -> Result<Sheets, BsdfError> {
        let weights = colour_weights(wavelengths).map_err(|fault| {
            let byte = self
                .tensors
                .find("wavelengths")
                .map_or(0, |field| field.byte);
            BinaryFault::Table(fault).at(byte)
        })?;
        let points = spectra.size[0] * spectra.size[1];
        let mut values = vec![];
        for node in spectra.values.chunks(points * wavelengths.len()) {
            for channel in 0..3 {
                values.extend((0..points).map(|point| {
                    let terms = node.iter().skip(point).step_by(points).zip(&weights);
                    let sum: f64 = terms
                        .map(|(s, weight)| f64::from(*s) * weight[channel])
                        .sum();
                    sum.max(0.0) as f32
                }));
            }
        }
        let fault = |fault| BinaryFault::Table(fault).at(0);
        Sheets::new(spectra.size, values).map_err(fault)
    }
}

/// What each node of a spectrum adds to red, green and blue under D65; a white spectrum gives 1, 1, 1.
fn colour_weights(wavelengths: &[f64]) -> Result<Vec<[f64; 3]>, MeasuredError> {
    let light = Illuminant::D65.curve();
    let [_, white, _] = xyz_of(light, None, Observer::Cie1931);
    let last = wavelengths.len().saturating_sub(1);
    let weight = |k: usize| {
        let from = k.saturating_sub(1);
        let samples =
            (from..=(k + 1).min(last)).map(|at| (wavelengths[at], f64::from(u8::from(at == k))));
        let hat = Curve::new(samples.collect(), Beyond::Held).map_err(|_| MeasuredError::Nodes)?;
        let xyz = xyz_of(light, Some(&hat), Observer::Cie1931);
        Ok(apply(&rgb_from_xyz(), xyz.map(|value| value / white)))
    };
    (0..wavelengths.len()).map(weight).collect()
}

fn shape_fault(field: &Field) -> BsdfError {
    let fault = BinaryFault::Shape {
        name: field.name.clone(),
        shape: field.shape.clone(),
    };
    fault.at(field.byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends of the range are held, so that a white spectrum is white whatever its nodes.
    #[test]
    fn a_white_spectrum_is_white() {
        for nodes in [
            &[550.0][..],
            &[400.0, 700.0],
            &[380.0, 450.0, 500.0, 610.0, 700.0],
        ] {
            let weights = colour_weights(nodes).unwrap();
            for channel in 0..3 {
                let sum: f64 = weights.iter().map(|weight| weight[channel]).sum();
                assert!((sum - 1.0).abs() < 3e-4, "{nodes:?}: {sum}");
            }
        }
        assert!(colour_weights(&[500.0, 400.0]).is_err());
    }
}
