//! The textures of material libraries.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use steradian::scene::description::{Bitmap, Pattern, Placement, Texture, Wrap};

use crate::files::{Files, reason};
use crate::import::alpha::as_opacity;
use crate::import::image::{self, Encoding};

/// What a `map_…` statement says.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    file: String,
    scale: [f64; 2],
    offset: [f64; 2],
    wrap: Wrap,
}

/// What a map is for.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Purpose {
    Colour,
    Opacity,
}

/// Options and how many words follow them; of `-s`, `-o` and `-t` one to three numbers do.
const OPTIONS: [(&str, usize); 10] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-boost", 1),
    ("-bm", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-texres", 1),
    ("-type", 1),
];

impl Map {
    /// The options, and then the file's name; `None` if there is no name.
    pub fn parse(text: &str) -> Option<Self> {
        let mut map = Self {
            file: String::new(),
            scale: [1.0; 2],
            offset: [0.0; 2],
            wrap: Wrap::Repeat,
        };
        let mut rest = text;
        while rest.starts_with('-') {
            let (option, after) = split(rest);
            rest = match option {
                "-s" => triple(after, &mut map.scale),
                "-o" => triple(after, &mut map.offset),
                "-t" => triple(after, &mut [0.0; 2]),
                _ => {
                    if option == "-clamp" && split(after).0 == "on" {
                        map.wrap = Wrap::Clamp;
                    }
                    let (_, words) = OPTIONS.iter().find(|(name, _)| *name == option)?;
                    (0..*words).fold(after, |rest, _| split(rest).1)
                }
            };
        }
        map.file = rest.to_owned();
        (!rest.is_empty()).then_some(map)
    }

    fn placement(&self) -> Placement {
        let ([su, sv], [ou, ov]) = (self.scale, self.offset);
        Placement([[su, 0.0, ou], [0.0, sv, ov]])
    }
}

/// The first word, and what follows it.
fn split(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim_start())
}

/// One to three numbers, of which the first two are kept; gives what follows them.
fn triple<'a>(text: &'a str, kept: &mut [f64; 2]) -> &'a str {
    let mut rest = text;
    for index in 0..3 {
        let (word, after) = split(rest);
        let Some(number) = word.parse().ok().filter(|number: &f64| number.is_finite()) else {
            break;
        };
        if let Some(kept) = kept.get_mut(index) {
            *kept = number;
        }
        rest = after;
    }
    rest
}

/// Reads pictures, each once.
pub(super) struct Pictures<'f> {
    directory: &'f Path,
    files: &'f dyn Files,
    known: HashMap<(String, Purpose, bool), Option<Arc<Bitmap>>>,
    /// What could not be read.
    pub warnings: Vec<String>,
}

impl<'f> Pictures<'f> {
    /// Pictures with names relative to `directory`.
    pub fn new(directory: &'f Path, files: &'f dyn Files) -> Self {
        Self {
            directory,
            files,
            known: HashMap::new(),
            warnings: vec![],
        }
    }

    /// The texture of a map; `None`, and a warning, if it cannot be read.
    pub fn texture(&mut self, map: &Map, purpose: Purpose) -> Option<Texture> {
        let key = (map.file.clone(), purpose, map.wrap == Wrap::Clamp);
        if !self.known.contains_key(&key) {
            let picture = self.picture(map, purpose);
            if let Err(reason) = &picture {
                self.warnings
                    .push(format!("the texture {} is left out: {reason}", map.file));
            }
            self.known.insert(key.clone(), picture.ok());
        }
        let picture = self.known.get(&key)?.clone()?;
        Some(Texture {
            pattern: Pattern::Bitmap(picture),
            placement: map.placement(),
        })
    }

    fn picture(&self, map: &Map, purpose: Purpose) -> Result<Arc<Bitmap>, String> {
        let path = self.directory.join(map.file.replace('\\', "/"));
        let bytes = self.files.read(&path).map_err(|error| reason(&error))?;
        let encoding = match purpose {
            Purpose::Colour => Encoding::Srgb,
            Purpose::Opacity => Encoding::Linear,
        };
        let mut picture = image::read(&bytes, encoding).map_err(|error| error.to_string())?;
        if purpose == Purpose::Opacity {
            picture = as_opacity(picture).map_err(|error| error.to_string())?;
        }
        picture.wrap = [map.wrap; 2];
        Ok(Arc::new(picture))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_before_the_name() {
        let map = Map::parse("-s 2 3 1 -mm 0 1 -o 0.5 -clamp on my wood.png").unwrap();
        assert_eq!(map.file, "my wood.png");
        assert_eq!(
            map.placement(),
            Placement([[2.0, 0.0, 0.5], [0.0, 3.0, 0.0]])
        );
        assert_eq!(map.wrap, Wrap::Clamp);
        assert_eq!(Map::parse("-s 2"), None);
        assert_eq!(Map::parse("-unknown a.png"), None);
        assert_eq!(Map::parse(""), None);
    }
}
