//! XML of ANSI/IES TM-33-18 and -23 (UNI 11733; root `IESTM33-…` or `LuminaireOpticalData`).
//!
//! | element | what is read |
//! |---|---|
//! | `Header` | its children as keywords |
//! | `Luminaire/Dimensions` | `Length` along C0 and `Width` along C90 in mm: a rectangle that faces down, with a warning |
//! | `Emitter` | `Quantity`, `RatedLumens`, `InputWattage` or `InputWatts`; only the first emitter |
//! | `LuminousData`, `IntensityDistribution` | intensities in cd |
//! | `RadiantData` | intensities in W/sr, if there are none in cd |
//!
//! In the data, `PhotometryType` ends with A, B or C, `Metric` is `Luminous` or `Radiant`, `Multiplier` scales all intensities, and each
//! intensity is an element `IntData` or `IntensityData` with its angles in the attributes `h` and `v`, or `horz` and `vert`. They may come in any order, but must fill a
//! grid; symmetry follows from the horizontal angles as in LM-63, and a `SymmType` that says otherwise gives a warning.

use std::ops::Range;
use std::path::Path;

use roxmltree::{Document, Node, ParsingOptions};
use steradian::light::{FarField, Planes};

use super::source::{Source, shortened};
use super::{IntensityUnit, Opening, Photometry, symmetry};
use crate::diagnostic::{Diagnostic, Severity};
use crate::files::Files;

/// Elements and texts of a file at most.
const NODES: u32 = 2_000_000;

/// Whether a text is such a file: its first element says so.
pub(super) fn is_tm33(text: &str) -> bool {
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        rest = &rest[start + 1..];
        if rest.starts_with("!--") {
            rest = rest.find("-->").map_or("", |end| &rest[end..]);
        } else if !rest.starts_with(['?', '!']) {
            return is_root(rest.split(|c: char| c.is_whitespace() || c == '>').next());
        }
    }
    false
}

fn is_root(name: Option<&str>) -> bool {
    name.is_some_and(|name| name.starts_with("IESTM33") || name == "LuminaireOpticalData")
}

pub(super) fn read(path: &Path, files: &dyn Files) -> Result<Photometry, Vec<Diagnostic>> {
    let source = Source::read(path, files).map_err(|problem| vec![problem])?;
    let options = ParsingOptions {
        nodes_limit: NODES,
        ..ParsingOptions::default()
    };
    let text = source.file.text.clone();
    let document = Document::parse_with_options(&text, options)
        .map_err(|error| vec![syntax(&source, &error)])?;
    let reader = Reader { source: &source };
    reader
        .file(document.root_element())
        .map_err(|problem| vec![problem])
}

/// What the parser says, at its place.
fn syntax(source: &Source, error: &roxmltree::Error) -> Diagnostic {
    let (text, place) = (&source.file.text, error.pos());
    let before = text
        .split_inclusive('\n')
        .take((place.row as usize).saturating_sub(1));
    let start = before.map(str::len).sum::<usize>().min(text.len());
    let line = text[start..].lines().next().unwrap_or("");
    let column = line
        .char_indices()
        .nth((place.col as usize).saturating_sub(1));
    let at = start + column.map_or(line.len(), |(byte, _)| byte);
    source.error(at..at, format!("not an XML file: {error}"))
}

struct Reader<'a> {
    source: &'a Source,
}

/// An intensity of the file.
struct Entry {
    horizontal: f64,
    vertical: f64,
    value: f64,
    place: Range<usize>,
}

/// A table of the file.
struct Table {
    far_field: FarField,
    symmetry: &'static str,
    unit: IntensityUnit,
    is_absolute: bool,
}

impl Reader<'_> {
    fn file(&self, root: Node) -> Result<Photometry, Diagnostic> {
        if !is_root(Some(root.tag_name().name())) {
            let found = shortened(root.tag_name().name());
            let message =
                format!("expected <IESTM33-…> or <LuminaireOpticalData>, found <{found}>");
            return Err(self.at(root, message));
        }
        let mut warnings = Vec::new();
        let mut emitters = children(root, "Emitter");
        let emitter = emitters
            .next()
            .ok_or_else(|| self.at(root, "expected an <Emitter>"))?;
        if let Some(second) = emitters.next() {
            warnings.push(self.warning(second, "only the first emitter is read"));
        }
        let table = self.table(emitter, &mut warnings)?;
        let rated = self.optional(emitter, &["RatedLumens"])?;
        let watts = self.optional(emitter, &["InputWattage", "InputWatts"])?;
        Ok(Photometry {
            format: root.tag_name().name().to_owned(),
            keywords: keywords(root),
            unit: table.unit,
            far_field: table.far_field,
            symmetry: table.symmetry,
            lamp_flux: rated.filter(|_| !table.is_absolute),
            lamps: self.optional(emitter, &["Quantity"])?.unwrap_or(1.0),
            watts: watts.unwrap_or(0.0),
            other_sets: Vec::new(),
            opening: self.opening(root, &mut warnings)?,
            side_heights: None,
            tilt: None,
            warnings,
        })
    }

    fn opening(&self, root: Node, warnings: &mut Vec<Diagnostic>) -> Result<Opening, Diagnostic> {
        let dimensions = child(root, "Luminaire").and_then(|node| child(node, "Dimensions"));
        let Some(dimensions) = dimensions else {
            return Ok(Opening::Point);
        };
        let metres = |name: &str| {
            let millimetres = self.optional(dimensions, &[name])?.unwrap_or(0.0);
            Ok(millimetres.max(0.0) / 1000.0)
        };
        let (length, width) = (metres("Length")?, metres("Width")?);
        if length <= 0.0 || width <= 0.0 {
            return Ok(Opening::Point);
        }
        let message =
            "the luminous opening is taken to be as large as the luminaire, seen from below";
        warnings.push(self.warning(dimensions, message));
        Ok(Opening::Box {
            width,
            length,
            height: 0.0,
        })
    }

    /// The first of the data that are luminous, or else radiant.
    fn table(&self, emitter: Node, warnings: &mut Vec<Diagnostic>) -> Result<Table, Diagnostic> {
        let names = ["LuminousData", "IntensityDistribution", "RadiantData"];
        let data = names.iter().find_map(|name| child(emitter, name));
        let data = data.ok_or_else(|| {
            self.at(
                emitter,
                "expected <LuminousData>, <IntensityDistribution> or <RadiantData>",
            )
        })?;
        let unit = self.unit(data)?;
        let per_unit = match unit {
            IntensityUnit::Candela => 1.0,
            IntensityUnit::MilliwattPerSteradian => 1000.0,
        };
        let factor = self.optional(data, &["Multiplier"])?.unwrap_or(1.0) * per_unit;
        let entries = self.entries(data, factor)?;
        let [horizontals, verticals, values] = self.grid(data, &entries)?;
        let made = match self.planes(data)? {
            Planes::C => symmetry::whole_turn(&horizontals, &verticals, &values),
            planes => symmetry::latitudes(planes, &horizontals, &verticals, &values),
        };
        let (far_field, symmetry) = made.map_err(|message| self.at(data, message))?;
        if let Some(said) =
            texts(data, &["SymmType", "Symm"]).filter(|said| !agrees(said, &horizontals))
        {
            let message = format!(
                "the file says \"{}\", but its angles are read as: {symmetry}",
                shortened(said)
            );
            warnings.push(self.warning(data, message));
        }
        let is_absolute = texts(data, &["AbsolutePhotometry"]) == Some("true");
        Ok(Table {
            far_field,
            symmetry,
            unit,
            is_absolute,
        })
    }

    fn unit(&self, data: Node) -> Result<IntensityUnit, Diagnostic> {
        match (data.tag_name().name(), texts(data, &["Metric"])) {
            ("RadiantData", _) | (_, Some("Radiant")) => Ok(IntensityUnit::MilliwattPerSteradian),
            (_, None | Some("Luminous")) => Ok(IntensityUnit::Candela),
            (_, Some(other)) => {
                let other = shortened(other);
                Err(self.at(
                    data,
                    format!("expected the metric Luminous or Radiant, found \"{other}\""),
                ))
            }
        }
    }

    fn planes(&self, data: Node) -> Result<Planes, Diagnostic> {
        match texts(data, &["PhotometryType"]).and_then(|text| text.chars().last()) {
            None | Some('C') => Ok(Planes::C),
            Some('B') => Ok(Planes::B),
            Some('A') => Ok(Planes::A),
            Some(_) => Err(self.at(data, "expected a photometry type that ends with A, B or C")),
        }
    }

    fn entries(&self, data: Node, factor: f64) -> Result<Vec<Entry>, Diagnostic> {
        let is_entry =
            |node: &Node| node.has_tag_name("IntData") || node.has_tag_name("IntensityData");
        let entry = |node: Node| {
            let value = self.number(node, node.text().unwrap_or(""), "an intensity")? * factor;
            if !(value.is_finite() && value >= 0.0) {
                return Err(self.at(node, "an intensity is finite and not negative"));
            }
            Ok(Entry {
                horizontal: self.angle(node, ["h", "horz"])?,
                vertical: self.angle(node, ["v", "vert"])?,
                value,
                place: node.range(),
            })
        };
        data.descendants().filter(is_entry).map(entry).collect()
    }

    fn angle(&self, node: Node, names: [&str; 2]) -> Result<f64, Diagnostic> {
        let text = names.iter().find_map(|name| node.attribute(*name));
        let expected = format!("an angle \"{}\" or \"{}\"", names[0], names[1]);
        let text = text.ok_or_else(|| self.at(node, format!("expected {expected}")))?;
        self.number(node, text, &expected)
    }

    /// Horizontal angles, vertical angles, and the intensities of the first horizontal one, the second …
    fn grid(&self, data: Node, entries: &[Entry]) -> Result<[Vec<f64>; 3], Diagnostic> {
        let mut sorted: Vec<&Entry> = entries.iter().collect();
        let key = |entry: &Entry| [entry.horizontal, entry.vertical];
        sorted.sort_by(|a, b| {
            let ([h, v], [k, w]) = (key(a), key(b));
            h.total_cmp(&k).then(v.total_cmp(&w))
        });
        if let Some(twice) = sorted.windows(2).find(|pair| key(pair[0]) == key(pair[1])) {
            let message = format!(
                "a second intensity at {}°, {}°",
                twice[1].horizontal, twice[1].vertical
            );
            return Err(self.source.error(twice[1].place.clone(), message));
        }
        let (horizontals, verticals) = (
            distinct(entries.iter().map(|entry| entry.horizontal)),
            distinct(entries.iter().map(|entry| entry.vertical)),
        );
        if verticals.len() < 2 {
            return Err(self.at(data, "expected intensities at two vertical angles or more"));
        }
        let places = horizontals
            .iter()
            .flat_map(|h| verticals.iter().map(move |v| [*h, *v]));
        for (index, [h, v]) in places.enumerate() {
            if sorted.get(index).is_none_or(|entry| key(entry) != [h, v]) {
                return Err(self.at(
                    data,
                    format!("no intensity at horizontal {h}°, vertical {v}°"),
                ));
            }
        }
        let values = sorted.iter().map(|entry| entry.value).collect();
        Ok([horizontals, verticals, values])
    }

    /// A number of the first of these children that is there and not empty.
    fn optional(&self, node: Node, names: &[&str]) -> Result<Option<f64>, Diagnostic> {
        let found = names.iter().find_map(|name| child(node, name));
        let Some(found) = found.filter(|found| !trimmed(*found).is_empty()) else {
            return Ok(None);
        };
        let expected = format!("a number in <{}>", names[0]);
        self.number(found, trimmed(found), &expected).map(Some)
    }

    fn number(&self, node: Node, text: &str, expected: &str) -> Result<f64, Diagnostic> {
        let number = text
            .trim()
            .parse::<f64>()
            .ok()
            .filter(|number| number.is_finite());
        number.ok_or_else(|| {
            let found = shortened(text.trim());
            self.at(node, format!("expected {expected}, found \"{found}\""))
        })
    }

    fn at(&self, node: Node, message: impl Into<String>) -> Diagnostic {
        let start = node.range().start;
        let text = &self.source.file.text[start..];
        let length = text
            .find(['\n', '\r'])
            .unwrap_or(text.len())
            .min(node.range().len());
        self.source.error(start..start + length, message)
    }

    fn warning(&self, node: Node, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            severity: Severity::Warning,
            ..self.at(node, message)
        }
    }
}

fn children<'a>(node: Node<'a, 'a>, name: &str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children()
        .filter(move |child| child.tag_name().name() == name)
}

fn child<'a>(node: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    children(node, name).next()
}

fn trimmed<'a>(node: Node<'a, 'a>) -> &'a str {
    node.text().unwrap_or("").trim()
}

/// The text of the first of these elements below a node that is there.
fn texts<'a>(node: Node<'a, 'a>, names: &[&str]) -> Option<&'a str> {
    let found = node
        .descendants()
        .find(|below| names.contains(&below.tag_name().name()));
    found.map(trimmed).filter(|text| !text.is_empty())
}

fn keywords(root: Node) -> Vec<(String, String)> {
    let header = root.children().find(|node| node.has_tag_name("Header"));
    let header = header.into_iter().flat_map(|header| header.children());
    header
        .filter(Node::is_element)
        .map(|node| {
            (
                node.tag_name().name().to_owned(),
                node.text().unwrap_or("").trim().to_owned(),
            )
        })
        .collect()
}

fn distinct(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut angles: Vec<f64> = angles.collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    angles
}

/// Whether a symmetry's name fits the range of the horizontal angles; names that are not known do.
fn agrees(said: &str, horizontals: &[f64]) -> bool {
    let range = (horizontals[0], horizontals[horizontals.len() - 1]);
    match said.rsplit(['_', ' ']).next() {
        Some("Full") => horizontals.len() == 1,
        Some("Quad") => range == (0.0, 90.0),
        Some("Bi0") => range == (0.0, 180.0),
        Some("Bi90") => range == (90.0, 270.0) || range == (-90.0, 90.0),
        Some("None") => range.1 > 180.0,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::render;
    use crate::files::MemoryFiles;

    /// I = 100 cd · multiplier · f(v), with f = 1, ½, 0 at 0°, 45°, 90°, the same at 0° and 90° of two planes of symmetry.
    const WHOLE: &str = include_str!("../../../../../tests/data/photometry/quadrant_tm33.xml");

    fn read_text(text: &str) -> Result<Photometry, String> {
        let files = MemoryFiles::default().with("a.xml", text);
        read(Path::new("a.xml"), &files).map_err(|problems| render(&problems, false))
    }

    #[test]
    fn a_whole_file_is_read() {
        let lamp = read_text(WHOLE).unwrap();
        assert_eq!(lamp.format, "IESTM33-22");
        assert_eq!(
            lamp.keywords[0],
            ("Manufacturer".to_owned(), "Test".to_owned())
        );
        assert_eq!(lamp.unit, IntensityUnit::Candela);
        assert_eq!(lamp.symmetry, "mirrored at C0-C180 and C90-C270");
        assert_eq!((lamp.lamps, lamp.watts, lamp.lamp_flux), (2.0, 12.5, None));
        let at = |c: f64, gamma: f64| lamp.far_field.at_angles(c.to_radians(), gamma.to_radians());
        assert_eq!(
            [at(0.0, 0.0), at(180.0, 45.0), at(270.0, 45.0)],
            [200.0, 100.0, 50.0]
        );
        let Opening::Box {
            width,
            length,
            height,
        } = lamp.opening
        else {
            panic!("{:?}", lamp.opening)
        };
        assert_eq!([width, length, height], [0.3, 1.2, 0.0]);
        assert_eq!(lamp.warnings.len(), 1);
    }

    #[test]
    fn other_spellings_are_the_same() {
        let old = WHOLE
            .replace("IESTM33-22", "LuminaireOpticalData")
            .replace("LuminousData", "IntensityDistribution")
            .replace("<IntData h", "<IntensityData horz")
            .replace("v=\"", "vert=\"")
            .replace("IntData", "IntensityData")
            .replace("AbsolutePhotometry", "Other");
        let (new, old) = (read_text(WHOLE).unwrap(), read_text(&old).unwrap());
        assert_eq!(new.far_field, old.far_field);
        assert_eq!(old.lamp_flux, Some(300.0));
    }

    #[test]
    fn watts_become_milliwatts() {
        let radiant = read_text(&WHOLE.replace(">Luminous<", ">Radiant<")).unwrap();
        assert_eq!(radiant.unit, IntensityUnit::MilliwattPerSteradian);
        assert_eq!(radiant.far_field.at_angles(0.0, 0.0), 200_000.0);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let cases = [
            (
                "<IntData h=\"0\" v=\"45\">50<",
                "<IntData h=\"0\" v=\"45\">much<",
                "an intensity, found \"much\"",
            ),
            (
                "<IntData h=\"0\" v=\"45\">50<",
                "<IntData h=\"0\">50<",
                "an angle \"v\" or \"vert\"",
            ),
            (
                "h=\"90\" v=\"45\"",
                "h=\"90\" v=\"90\"",
                "a second intensity at 90°, 90°",
            ),
            (
                "<IntData h=\"90\" v=\"45\">25</IntData>",
                "",
                "no intensity at horizontal 90°, vertical 45°",
            ),
            ("h=\"90\"", "h=\"80\"", "not from 0° to 80°"),
            (
                ">Luminous<",
                ">Photon<",
                "Luminous or Radiant, found \"Photon\"",
            ),
            ("CIE-C", "CIE-D", "ends with A, B or C"),
            (
                "<Multiplier>2<",
                "<Multiplier>-2<",
                "finite and not negative",
            ),
            ("</Emitter>", "", "not an XML file"),
            ("IESTM33-22", "WindowElement", "found <WindowElement>"),
            ("Emitter", "Lamp", "expected an <Emitter>"),
        ];
        for (from, to, expected) in cases {
            assert!(WHOLE.contains(from), "{from}");
            let message = read_text(&WHOLE.replace(from, to)).unwrap_err();
            assert!(
                message.contains(expected) && message.contains("a.xml:"),
                "{message}"
            );
        }
        let odd = read_text(&WHOLE.replace("Symm_Quad", "Symm_None")).unwrap();
        assert!(
            odd.warnings
                .iter()
                .any(|warning| warning.message.contains("Symm_None"))
        );
    }

    #[test]
    fn files_are_told_by_their_first_element() {
        assert!(is_tm33(WHOLE));
        assert!(is_tm33(
            "<!-- <a> --><LuminaireOpticalData version=\"1.0\"/>"
        ));
        assert!(!is_tm33("<?xml version=\"1.0\"?><WindowElement/>"));
        assert!(!is_tm33("<!--") && !is_tm33(""));
    }

    #[test]
    fn no_cut_makes_the_reader_fail() {
        for (length, _) in WHOLE.trim_end().char_indices() {
            assert!(read_text(&WHOLE[..length]).is_err());
        }
    }
}
