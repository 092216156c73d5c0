//! The text of a file and its numbers, with their places.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::{Files, reason};

/// Largest file in bytes; a table of 361 × 181 intensities has half a million.
const LARGEST_FILE: usize = 64 << 20;

/// A text that is read from its beginning to its end.
pub(super) struct Source {
    pub file: Arc<SourceFile>,
    place: usize,
}

impl Source {
    pub fn read(path: &Path, files: &dyn Files) -> Result<Self, Diagnostic> {
        let file = |text: String| {
            Arc::new(SourceFile {
                name: path.display().to_string(),
                text,
            })
        };
        let refuse = |message: String| Diagnostic::error(message).about(&file(String::new()));
        let bytes = files
            .read(path)
            .map_err(|error| refuse(format!("cannot read the luminaire: {}", reason(&error))))?;
        if bytes.len() > LARGEST_FILE {
            let message = format!("larger than the limit of {LARGEST_FILE} bytes");
            return Err(refuse(message));
        }
        Ok(Self {
            file: file(decode(bytes)),
            place: 0,
        })
    }

    /// A diagnostic about these bytes.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(message).at(&self.file, span)
    }

    /// How far it was read, in bytes.
    pub fn place(&self) -> usize {
        self.place
    }

    /// The next line without its end and outer blanks; `None` at the end of the file.
    pub fn line(&mut self) -> Option<(Range<usize>, &str)> {
        let start = self.place;
        let rest = self
            .file
            .text
            .get(start..)
            .filter(|rest| !rest.is_empty())?;
        let length = rest.find(['\n', '\r']).unwrap_or(rest.len());
        let end = &rest[length..];
        let step = if end.starts_with("\r\n") {
            2
        } else {
            usize::from(!end.is_empty())
        };
        self.place = start + length + step;
        let line = &rest[..length];
        let from = start + (line.len() - line.trim_start().len());
        let line = line.trim();
        Some((from..from + line.len(), line))
    }

    /// The next number; numbers stand apart by blanks, commas or line ends.
    pub fn number(&mut self, what: &str) -> Result<(Range<usize>, f64), Diagnostic> {
        let text = &self.file.text;
        let apart = |c: char| c.is_whitespace() || c == ',' || c == '\u{1a}';
        let rest = &text[self.place..];
        let start = self.place + (rest.len() - rest.trim_start_matches(apart).len());
        let length = text[start..].find(apart).unwrap_or(text.len() - start);
        let (span, word) = (start..start + length, &text[start..start + length]);
        if word.is_empty() {
            let end = text.trim_end().len();
            let message = format!("expected {what}, found the end of the file");
            return Err(self.error(end.saturating_sub(1)..end, message));
        }
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.place = span.end;
                Ok((span, number))
            }
            _ => {
                let message = format!("expected {what}, found \"{}\"", shortened(word));
                Err(self.error(span, message))
            }
        }
    }

    /// What is left but blanks.
    pub fn rest(&self) -> Option<Range<usize>> {
        let rest = self.file.text.get(self.place..)?;
        let rest_trimmed = rest.trim_matches(|c: char| c.is_whitespace() || c == '\u{1a}');
        let start = self.place + rest.find(rest_trimmed).unwrap_or(0);
        (!rest_trimmed.is_empty()).then(|| start..start + rest_trimmed.len())
    }
}

/// UTF-8, or else Latin-1, in which every byte is a character.
fn decode(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap_or_else(|error| {
        let bytes = error.into_bytes();
        bytes.into_iter().map(char::from).collect()
    })
}

/// The beginning of a word that may be a whole binary file.
pub(super) fn shortened(word: &str) -> String {
    const MOST: usize = 40;
    if word.chars().count() <= MOST {
        return word.to_owned();
    }
    word.chars().take(MOST).chain(['…']).collect()
}
