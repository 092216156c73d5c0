//! A radiance picture with its standard errors, as the picture formats take it.

use serde::Serialize;
use steradian::spectrum::REC709_LUMINANCE;
use steradian::transport::Picture;

use super::error::ReportError;

/// One lane of a picture, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// `red`, `green`, `blue`, or the name of a band.
    pub name: String,
    /// Radiance in W/(m² sr).
    pub values: Vec<f32>,
    /// Standard error of each value, in the same unit.
    pub std_errors: Vec<f32>,
}

/// How one number is read from the lanes of a pixel: Σ weight · lane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PixelQuantity {
    /// The field's name, e.g. `luminance`.
    pub name: String,
    /// Its unit, e.g. `cd/m2`.
    pub unit: String,
    /// One weight a lane.
    pub weights: Vec<f64>,
}

/// What a reader of the picture must know to use its numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ImageFacts {
    /// Title of the scene.
    pub scene: String,
    /// Hash of the scene's content.
    pub scene_hash: String,
    /// Name of the camera.
    pub camera: String,
    /// Unit of the lanes.
    pub unit: String,
    /// The number that a meter at a pixel would show.
    pub quantity: PixelQuantity,
    /// Luminous efficacy K in lm/W, if the run has one.
    pub luminous_efficacy: Option<f64>,
    /// Seed of the run.
    pub seed: u64,
    /// Longest path in segments, if it was limited.
    pub max_depth: Option<u32>,
    /// Samples of all pixels and passes together.
    pub samples: u64,
    /// Independent passes that the standard error comes from.
    pub passes: u32,
    /// True when the run was not stopped early and met its tolerance.
    pub converged: bool,
    /// Path classes that no estimator could sample.
    pub unsampled: Vec<String>,
    /// Version of Steradian.
    pub version: String,
}

impl ImageFacts {
    fn new(picture: &Picture, scene_hash: &str, version: &str) -> Self {
        Self {
            scene: picture.scene_name.clone(),
            scene_hash: scene_hash.to_owned(),
            camera: picture.camera.clone(),
            unit: LANE_UNIT.to_owned(),
            quantity: PixelQuantity::of(picture),
            luminous_efficacy: picture.luminous_efficacy,
            seed: picture.seed,
            max_depth: picture.max_depth,
            samples: picture.exposure.samples(),
            passes: picture.exposure.passes(),
            converged: picture.exposure.converged(),
            unsampled: picture.unsampled.clone(),
            version: version.to_owned(),
        }
    }
}

impl PixelQuantity {
    /// What the camera's last readout shows: the photometric one where there are two.
    fn of(picture: &Picture) -> Self {
        match picture.readouts.last() {
            Some(readout) => Self {
                name: readout.name.clone(),
                unit: readout.unit.clone(),
                weights: readout.weights.clone(),
            },
            None => Self {
                name: "radiance".to_owned(),
                unit: LANE_UNIT.to_owned(),
                weights: vec![1.0; picture.lanes.len()],
            },
        }
    }
}

/// A lane of a picture in single precision.
fn channel(picture: &Picture, lane: usize, name: &str) -> Channel {
    Channel {
        name: name.to_owned(),
        values: picture
            .exposure
            .values()
            .iter()
            .map(|lanes| lanes[lane] as f32)
            .collect(),
        std_errors: picture
            .exposure
            .std_errors()
            .map(|lanes| lanes[lane] as f32)
            .collect(),
    }
}

/// A radiance picture.
#[derive(Clone, Debug, PartialEq)]
pub struct RadianceImage {
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The lanes.
    pub channels: Vec<Channel>,
    /// What goes with the pixels.
    pub facts: ImageFacts,
}

/// Unit of the lanes of every picture.
const LANE_UNIT: &str = "W/(m2 sr)";

impl RadianceImage {
    /// The picture that a run made of a scene with this hash.
    pub fn new(picture: &Picture, scene_hash: &str, version: &str) -> Self {
        let [width, height] = picture.exposure.size().map(|pixels| pixels as usize);
        let channels = picture
            .lanes
            .iter()
            .enumerate()
            .map(|(lane, name)| channel(picture, lane, name))
            .collect();
        Self {
            width,
            height,
            channels,
            facts: ImageFacts::new(picture, scene_hash, version),
        }
    }

    /// True when the first lanes are red, green and blue.
    pub fn is_rgb(&self) -> bool {
        let names = self.channels.iter().map(|channel| channel.name.as_str());
        names.take(3).eq(["red", "green", "blue"])
    }

    /// What the brightness of a displayed pixel follows: the quantity, or the luminance of the colours where the
    /// picture also has light that is not seen.
    pub fn brightness(&self) -> (Vec<f64>, &str, f64) {
        let facts = &self.facts.quantity;
        if !(self.is_rgb() && self.channels.len() > 3) {
            return (self.quantity(), &facts.unit, facts.weights.iter().sum());
        }
        let [red, green, blue] = [0, 1, 2].map(|lane| &self.channels[lane].values);
        let pixel = |at: usize| {
            let [r, g, b] = [red, green, blue].map(|lane| f64::from(lane[at]));
            let [of_red, of_green, of_blue] = REC709_LUMINANCE;
            of_red * r + of_green * g + of_blue * b
        };
        let pixels = (0..self.width * self.height).map(pixel).collect();
        (pixels, "W/(m2 sr) as seen", 1.0)
    }

    /// The quantity of every pixel: Σ weight · lane.
    pub fn quantity(&self) -> Vec<f64> {
        let weights = &self.facts.quantity.weights;
        let pixel = |at: usize| {
            let terms = self.channels.iter().zip(weights);
            terms
                .map(|(channel, weight)| weight * f64::from(channel.values[at]))
                .sum()
        };
        (0..self.width * self.height).map(pixel).collect()
    }

    /// The facts as one JSON object.
    pub fn facts_as_json(&self) -> Result<String, ReportError> {
        serde_json::to_string(&self.facts).map_err(|error| ReportError::Encoding(error.to_string()))
    }

    /// The lanes of a format that holds either one or red, green and blue.
    pub(super) fn one_or_three(&self, format: &'static str) -> Result<&[Channel], ReportError> {
        if self.is_rgb() {
            return Ok(&self.channels[..3]);
        }
        if self.channels.len() == 1 {
            return Ok(&self.channels);
        }
        let names: Vec<&str> = self
            .channels
            .iter()
            .map(|channel| channel.name.as_str())
            .collect();
        Err(ReportError::Lanes {
            format,
            lanes: names.join(", "),
        })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A picture whose lane `c` at pixel `i` is (i + 1) / (c + 3), with a tenth of it as standard error.
    pub fn picture(width: usize, height: usize, names: &[&str]) -> RadianceImage {
        let value = |channel: usize, at: usize| (at + 1) as f32 / (channel + 3) as f32;
        let channel = |(number, name): (usize, &&str)| Channel {
            name: (*name).to_owned(),
            values: (0..width * height).map(|at| value(number, at)).collect(),
            std_errors: (0..width * height)
                .map(|at| value(number, at) / 10.0)
                .collect(),
        };
        RadianceImage {
            width,
            height,
            channels: names.iter().enumerate().map(channel).collect(),
            facts: facts(names),
        }
    }

    fn facts(names: &[&str]) -> ImageFacts {
        let weights = if names.len() == 3 {
            vec![0.2126, 0.7152, 0.0722]
        } else {
            vec![1.0; names.len()]
        };
        ImageFacts {
            scene: "test".to_owned(),
            scene_hash: "abc".to_owned(),
            camera: "front".to_owned(),
            unit: "W/(m2 sr)".to_owned(),
            quantity: PixelQuantity {
                name: "radiance".to_owned(),
                unit: "W/(m2 sr)".to_owned(),
                weights,
            },
            luminous_efficacy: Some(179.0),
            seed: 7,
            max_depth: None,
            samples: 64,
            passes: 4,
            converged: true,
            unsampled: Vec::new(),
            version: "0".to_owned(),
        }
    }

    #[test]
    fn the_quantity_weighs_the_lanes() {
        let picture = picture(1, 1, &["red", "green", "blue"]);
        let expected = 0.2126 / 3.0 + 0.7152 / 4.0 + 0.0722 / 5.0;
        assert!((picture.quantity()[0] - expected).abs() < 1e-7);
    }

    #[test]
    fn two_bands_do_not_fit_a_format_of_one_or_three() {
        let error = picture(1, 1, &["visible", "nir"])
            .one_or_three("PFM")
            .unwrap_err();
        assert_eq!(
            error.to_string(),
            "PFM holds one lane or red, green and blue, not visible, nir; write EXR instead"
        );
    }
}
