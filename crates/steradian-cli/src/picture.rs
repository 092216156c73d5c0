//! A picture on its way out.

use std::path::Path;

use clap::Args;
use steradian::transport::Picture;
use steradian_io::report::{Look, PictureFormat, RadianceImage};

use crate::output;
use crate::result::VERSION;
use crate::status::{Failure, Outcome, remark};

/// How a PNG shows a picture.
#[derive(Args, Clone, Copy, Debug)]
#[command(next_help_heading = "Appearance of a PNG")]
pub struct LookArguments {
    /// Show luminance or radiance in colours, with a legend that states the unit
    #[arg(long)]
    false_colour: bool,
    /// Make it brighter (or darker) by this many stops, each a factor of 2; at 0 the log-average of the picture is
    /// middle grey
    #[arg(
        long,
        value_name = "STOPS",
        default_value_t = 0.0,
        allow_negative_numbers = true,
        conflicts_with = "false_colour"
    )]
    exposure: f64,
}

impl LookArguments {
    /// The look asked for.
    pub fn look(self) -> Look {
        Look {
            false_colour: self.false_colour,
            stops: self.exposure,
        }
    }
}

/// A picture of a scene.
pub struct Finished {
    /// The picture.
    pub picture: Picture,
    /// Hash of the scene.
    pub scene_hash: String,
}

impl Finished {
    /// Writes the picture; not as asked when a tolerance was missed or light was left out, which is told too.
    pub fn write(&self, look: Look, file: &Path) -> Result<Outcome, Failure> {
        let image = RadianceImage::new(&self.picture, &self.scene_hash, VERSION);
        for (path, bytes) in PictureFormat::of(file)?.encode(&image, look, file)? {
            output::write(&bytes, Some(&path))?;
        }
        let picture = &self.picture;
        picture
            .warnings
            .iter()
            .for_each(|warning| remark(&format!("warning: {warning}")));
        picture
            .unsampled
            .iter()
            .for_each(|class| remark(&format!("not sampled, so the picture is too dark: {class}")));
        let converged = picture.exposure.converged();
        if !converged {
            remark("the picture was stopped early or missed its tolerance");
        }
        Ok(Outcome::fine_if(converged && picture.unsampled.is_empty()))
    }
}
