//! The lines of OBJ and MTL files.

/// Lines with their numbers, comments cut off; a line that ends in a backslash goes on in the next.
pub(super) fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, String)> {
    let mut lines = bytes.split(|byte| *byte == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (index, first) = lines.next()?;
        let mut text = without_comment(first);
        while text.ends_with('\\') {
            text.pop();
            let Some((_, next)) = lines.next() else { break };
            text.push(' ');
            text.push_str(&without_comment(next));
        }
        Some((index + 1, text))
    })
}

fn without_comment(line: &[u8]) -> String {
    let text = line.split(|byte| *byte == b'#').next().unwrap_or_default();
    String::from_utf8_lossy(text).trim().to_owned()
}

/// The statement of a line, and what follows it.
pub(super) fn statement(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim())
}

/// Finite numbers; `None` if any word is none.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    text.split_whitespace().map(number).collect()
}
