//! A result as one page: facts of the run, statistics, pictures and tables of every sensor.
//!
//! The page is a file by itself: no script, no font, no picture from elsewhere. It prints, and follows the reader's choice of
//! a light or dark screen; drawings stay on white, so that their colours stay what they are.

mod facts;
mod markup;
mod sensor;
mod tables;

pub use markup::Markup;

use super::figure::Subject;
use super::plot::PlotError;
use super::run::Run;

const STYLE: &str = include_str!("style.css");

/// The page.
///
/// # Errors
/// If a number of the measurements makes no diagram.
pub fn encode(run: &Run<'_>) -> Result<String, PlotError> {
    let subjects = Subject::all(run.measurements);
    let sections = subjects.iter().enumerate();
    let sections = sections.map(|(number, subject)| sensor::section(run, subject, number));
    let sections: Vec<Markup> = sections.collect::<Result<_, _>>()?;
    let mut page = Markup::default();
    page.element("html", &[("lang", "en")], |html| {
        html.element("head", &[], |head| self::head(head, run));
        html.element("body", &[], |body| {
            body.element("header", &[], |header| facts::header(header, run));
            body.element("main", &[], |main| {
                facts::statements(main, run);
                facts::facts(main, run);
                tables::overview(main, run, &subjects);
                sections
                    .into_iter()
                    .for_each(|section| main.append(section));
            });
            body.element("footer", &[], |footer| footer.words(&facts::made_by(run)));
        });
    });
    Ok(format!("<!DOCTYPE html>\n{}", page.finish()))
}

fn head(head: &mut Markup, run: &Run<'_>) {
    head.void("meta", &[("charset", "utf-8")]);
    let fits = ("content", "width=device-width, initial-scale=1");
    head.void("meta", &[("name", "viewport"), fits]);
    head.leaf("title", &facts::title(run));
    head.style(STYLE);
}

#[cfg(test)]
mod tests {
    use steradian::measurement::Measurements;
    use steradian::sensor::Layout;

    use super::super::run::SAMPLING_ERROR_ONLY;
    use super::super::run::tests::{measurements, run};
    use super::*;

    fn page(measurements: &Measurements) -> String {
        encode(&run(measurements)).unwrap()
    }

    /// The words of the page, whose markup must be well-formed.
    fn words(page: &str) -> String {
        let page = page.strip_prefix("<!DOCTYPE html>").unwrap();
        let document = roxmltree::Document::parse(page).unwrap();
        let texts = document.descendants().filter_map(|node| node.text());
        texts.collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn the_page_tells_what_a_reader_must_know() {
        let text = words(&page(&measurements()));
        for part in [
            "A, \"desk\"",
            SAMPLING_ERROR_ONLY,
            "0123456789abcdef0123",
            "Steradian 1.2.3",
            "179 lm/W",
            "40 paths in all",
            "95 %",
            "Not complete",
            "point lights seen in mirrors",
            "a warning",
        ] {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }

    /// Every reading with its error, and each part of it.
    #[test]
    fn every_reading_is_in_a_table() {
        let measurements = measurements();
        let text = words(&page(&measurements));
        let readings = measurements.readings();
        for reading in &readings {
            let groups = reading.groups.iter().map(|(_, part)| part);
            for found in groups.chain([&reading.estimate]) {
                let expected = crate::report::numbers::estimate(found);
                assert!(text.contains(&expected), "{expected} is not in {text}");
            }
        }
    }

    #[test]
    fn names_stay_words() {
        let name = "</td><script>alert('x')</script>&amp;\u{0}\"";
        let mut measurements = measurements();
        name.clone_into(&mut measurements.scene_name);
        name.clone_into(&mut measurements.sensors[0].name);
        name.clone_into(&mut measurements.groups[0]);
        measurements.warnings.push(name.to_owned());
        let page = page(&measurements);
        assert!(!page.contains("<script"));
        let shown = name.replace('\u{0}', "\u{fffd}");
        assert!(words(&page).matches(&shown).count() >= 6);
    }

    #[test]
    fn nothing_is_fetched_from_elsewhere() {
        let page = page(&measurements());
        for source in ["src=", "<link", "<script", "@import", "url("] {
            assert!(!page.contains(source), "{source}");
        }
        let links = page.matches("http").count();
        assert_eq!(links, page.matches("http://www.w3.org/2000/svg").count());
    }

    #[test]
    fn grids_have_maps_and_long_tables_are_folded() {
        let mut measurements = measurements();
        let sensor = &mut measurements.sensors[0];
        let point = sensor.points[0].clone();
        let at = |index: usize| {
            let mut point = point.clone();
            (point.index, point.exact[0]) = (index, index as f64);
            point
        };
        sensor.points = (0..60).map(at).collect();
        assert!(!page(&measurements).contains("Lines of equal values"));
        measurements.sensors[0].layout = Some(Layout {
            origin: [0.0; 3],
            edges: [[10.0, 0.0, 0.0], [0.0, 6.0, 0.0]],
            count: [10, 6],
        });
        let page = page(&measurements);
        assert!(words(&page).contains("Lines of equal values"));
        assert_eq!(page.matches("<details>").count(), 1);
    }

    #[test]
    fn a_result_without_sensors_is_a_page() {
        let mut measurements = measurements();
        measurements.sensors.clear();
        assert!(words(&page(&measurements)).contains("179 lm/W"));
    }
}
