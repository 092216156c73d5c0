//! HTML that is XML too: every element is closed, and words cannot leave theirs.
//!
//! ```
//! use steradian_io::report::html::Markup;
//! let mut page = Markup::default();
//! page.element("p", &[("class", "note")], |p| p.words("r < R & so on"));
//! assert_eq!(page.finish(), "<p class=\"note\">r &lt; R &amp; so on</p>\n");
//! ```

use std::fmt::Write;

use crate::report::svg::{Svg, escaped};

/// A part of a page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Markup {
    text: String,
}

impl Markup {
    /// An element with what it holds.
    pub fn element(
        &mut self,
        name: &str,
        attributes: &[(&str, &str)],
        content: impl FnOnce(&mut Self),
    ) {
        self.open(name, attributes);
        content(self);
        let _ = writeln!(self.text, "</{name}>");
    }

    /// An element that holds words.
    pub fn leaf(&mut self, name: &str, words: &str) {
        self.element(name, &[], |element| element.words(words));
    }

    /// An element that holds nothing, such as `meta`.
    pub fn void(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.open(name, attributes);
        self.text.truncate(self.text.len() - 1);
        self.text.push_str("/>\n");
    }

    /// Words.
    pub fn words(&mut self, words: &str) {
        self.text.push_str(&escaped(words));
    }

    /// A style sheet, which must hold neither `<` nor `&`.
    pub fn style(&mut self, sheet: &'static str) {
        debug_assert!(!sheet.contains(['<', '&']));
        let _ = writeln!(self.text, "<style>\n{sheet}</style>");
    }

    /// A drawing, and what it shows for those who cannot see it.
    pub fn drawing(&mut self, drawing: Svg, shows: &str) {
        self.element(
            "div",
            &[("class", "sheet"), ("role", "img"), ("aria-label", shows)],
            |sheet| {
                sheet.text.push_str(&drawing.finish());
            },
        );
    }

    /// What another part holds.
    pub fn append(&mut self, part: Self) {
        self.text.push_str(&part.text);
    }

    fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        let _ = write!(self.text, "<{name}");
        for (key, value) in attributes {
            let _ = write!(self.text, " {key}=\"{}\"", escaped(value));
        }
        self.text.push('>');
    }

    /// The text.
    pub fn finish(self) -> String {
        self.text
    }
}
