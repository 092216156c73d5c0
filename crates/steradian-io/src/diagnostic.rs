//! What is wrong with a file, where, and what would be right: shown with the line it is about.
//!
//! Readers collect every [`Diagnostic`] they can before they give up, and [`render`] prints them together:
//!
//! ```
//! use std::sync::Arc;
//! use steradian_io::diagnostic::{Diagnostic, SourceFile, render};
//!
//! let file = Arc::new(SourceFile { name: "lamp.toml".into(), text: "intensity = 100\n".into() });
//! let problem = Diagnostic::error("expected an intensity such as \"100 W/sr\"").at(&file, 12..15);
//! let text = render(&[problem], false);
//! assert!(text.contains("lamp.toml:1:13"));
//! assert!(text.contains("1 | intensity = 100"));
//! ```

use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

/// How bad it is.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The file cannot be used.
    Error,
    /// The file can be used, but perhaps not as its author thinks.
    Warning,
}

/// The text that a diagnostic points into.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// The name to print, usually a path.
    pub name: String,
    /// All of its text; empty if it could not be read.
    pub text: String,
}

/// One thing wrong with a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// The bytes of `file` it is about; `None` for the file as a whole.
    pub span: Option<Range<usize>>,
    /// The file; `None` if there is none.
    pub file: Option<Arc<SourceFile>>,
    /// What is wrong and what was expected, in one sentence.
    pub message: String,
    /// What would help.
    pub hints: Vec<String>,
}

impl Diagnostic {
    /// An error without a place.
    pub fn error(message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            span: None,
            file: None,
            message: message.into(),
            hints: Vec::new(),
        }
    }

    /// The same about these bytes of this file.
    pub fn at(self, file: &Arc<SourceFile>, span: Range<usize>) -> Self {
        Self {
            file: Some(Arc::clone(file)),
            span: Some(span),
            ..self
        }
    }

    /// The same about a file as a whole.
    pub fn about(self, file: &Arc<SourceFile>) -> Self {
        Self {
            file: Some(Arc::clone(file)),
            span: None,
            ..self
        }
    }

    /// The same with one more hint.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    fn level(&self) -> Level<'static> {
        match self.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        }
    }

    fn group(&self) -> Group<'_> {
        let title = self.level().primary_title(self.message.as_str());
        let group = match (&self.file, &self.span) {
            (Some(file), Some(span)) => {
                let place = AnnotationKind::Primary.span(within(&file.text, span));
                title.element(
                    Snippet::source(file.text.as_str())
                        .path(file.name.as_str())
                        .annotation(place),
                )
            }
            (Some(file), None) => title.element(Origin::path(file.name.as_str())),
            (None, _) => Group::with_title(title),
        };
        group.elements(
            self.hints
                .iter()
                .map(|hint| Level::HELP.message(hint.as_str())),
        )
    }
}

/// Problems beyond this many are counted, not shown.
const MOST_SHOWN: usize = 50;

/// Renders diagnostics together: message, file:line:column, the line and the hints of each.
pub fn render(diagnostics: &[Diagnostic], colour: bool) -> String {
    let renderer = if colour {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let mut shown: Vec<String> = diagnostics
        .iter()
        .take(MOST_SHOWN)
        .map(|diagnostic| renderer.render(&[diagnostic.group()]))
        .collect();
    if diagnostics.len() > MOST_SHOWN {
        shown.push(format!(
            "… and {} more problems",
            diagnostics.len() - MOST_SHOWN
        ));
    }
    let mut text = shown.join("\n\n");
    text.push('\n');
    text
}

/// `span`, moved to lie on character boundaries of `text`.
fn within(text: &str, span: &Range<usize>) -> Range<usize> {
    let start = text.floor_char_boundary(span.start);
    let end = text.ceil_char_boundary(span.end.max(start));
    start..end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> Arc<SourceFile> {
        Arc::new(SourceFile {
            name: "a.toml".into(),
            text: text.into(),
        })
    }

    #[test]
    fn renders_place_line_and_hints_of_each() {
        let file = file("radius = 1\nradios = 2\n");
        let problems = [
            Diagnostic::error("unknown key `radios`")
                .at(&file, 11..17)
                .hint("did you mean `radius`?"),
            Diagnostic::error("missing key `center`").at(&file, 0..6),
        ];
        let text = render(&problems, false);
        for part in [
            "error: unknown key `radios`",
            "a.toml:2:1",
            "2 | radios = 2",
            "did you mean `radius`?",
            "a.toml:1:1",
        ] {
            assert!(text.contains(part), "{part} is not in\n{text}");
        }
        assert!(!text.contains('\u{1b}'));
        assert!(render(&problems, true).contains('\u{1b}'));
    }

    #[test]
    fn spans_outside_the_text_do_no_harm() {
        for (text, span) in [
            ("", 0..0),
            ("", 5..9),
            ("é", 1..1),
            ("é\n", 0..1),
            ("a\r\nb", 2..99),
        ] {
            assert!(
                render(&[Diagnostic::error("x").at(&file(text), span)], false).contains("error: x")
            );
        }
    }

    #[test]
    fn a_diagnostic_needs_no_text() {
        let unreadable = Diagnostic::error("cannot read").about(&file(""));
        assert!(render(&[unreadable, Diagnostic::error("no scene")], false).contains("a.toml"));
    }

    #[test]
    fn many_problems_are_counted() {
        let problems = vec![Diagnostic::error("x"); MOST_SHOWN + 7];
        assert!(render(&problems, false).contains("7 more problems"));
    }
}
