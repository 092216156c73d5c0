//! The commands of a lesson, and whether they print what the lesson says.
//!
//! They stand in fences marked `console`: a line that begins with `$ ` is a command, the lines up to the next one are what
//! it prints. A line `…` stands for any number of lines, and `…` within a line for any text.

/// A command of a lesson with what it prints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Example<'a> {
    /// Without the `$`.
    pub line: &'a str,
    /// What the lesson shows.
    pub printed: Vec<&'a str>,
}

/// The commands of a lesson, in order.
pub fn commands(lesson: &str) -> impl Iterator<Item = Example<'_>> {
    let mut inside = false;
    let mut examples: Vec<Example> = Vec::new();
    for line in lesson.lines() {
        match (line.strip_prefix("$ "), line.starts_with("```")) {
            (_, true) => inside = line == "```console",
            (Some(command), _) if inside => examples.push(Example {
                line: command,
                printed: Vec::new(),
            }),
            (None, _) if inside => {
                if let Some(example) = examples.last_mut() {
                    example.printed.push(line);
                }
            }
            _ => {}
        }
    }
    examples.into_iter()
}

impl Example<'_> {
    /// The words of the command; double quotes hold words together.
    pub fn words(&self) -> Vec<String> {
        let mut words: Vec<String> = Vec::new();
        for (index, part) in self.line.split('"').enumerate() {
            if index % 2 == 1 {
                words.push(part.to_owned());
            } else {
                words.extend(part.split_whitespace().map(str::to_owned));
            }
        }
        words
    }

    /// Whether it printed this.
    pub fn agrees(&self, output: &str) -> bool {
        let lines: Vec<&str> = output.trim_end().lines().map(str::trim_end).collect();
        let shown = match self.printed.iter().rposition(|line| !line.is_empty()) {
            Some(last) => &self.printed[..=last],
            None => &[],
        };
        lines_agree(shown, &lines)
    }
}

fn lines_agree(shown: &[&str], lines: &[&str]) -> bool {
    match (shown.split_first(), lines.split_first()) {
        (None, None) => true,
        (Some((&"…", rest)), _) => {
            (0..=lines.len()).any(|skip| lines_agree(rest, &lines[skip..]))
        }
        (Some((first, rest)), Some((line, others))) => {
            line_agrees(first.trim_end(), line) && lines_agree(rest, others)
        }
        _ => false,
    }
}

fn line_agrees(shown: &str, line: &str) -> bool {
    let Some((before, after)) = shown.split_once('…') else {
        return shown == line;
    };
    line.strip_prefix(before).is_some_and(|rest| {
        let mut ends = rest.char_indices().map(|(end, _)| end).chain([rest.len()]);
        ends.any(|end| line_agrees(after, &rest[end..]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LESSON: &str = "# 1 Title\n$ not this\n```console\n$ steradian area \"a b\" 2\nA  3 m2\n…\nend\n\n$ steradian x\n```\n";

    fn example(printed: &[&'static str]) -> Example<'static> {
        Example {
            line: "steradian",
            printed: printed.to_vec(),
        }
    }

    #[test]
    fn commands_are_found_with_what_they_print() {
        let found: Vec<Example> = commands(LESSON).collect();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].words(), ["steradian", "area", "a b", "2"]);
        assert_eq!(found[0].printed, ["A  3 m2", "…", "end", ""]);
        assert_eq!(found[1].words(), ["steradian", "x"]);
    }

    #[test]
    fn an_ellipsis_stands_for_lines_or_for_a_part_of_one() {
        assert!(example(&["a", "…", "z"]).agrees("a\nb\nc\nz\n"));
        assert!(example(&["a", "…", "z"]).agrees("a\nz"));
        assert!(example(&["scene … seed …, end"]).agrees("scene 12 seed 3, end\n"));
        assert!(example(&[]).agrees(""));
    }

    #[test]
    fn anything_else_must_be_the_same() {
        assert!(!example(&["a", "…", "z"]).agrees("a\nb\n"));
        assert!(!example(&["1.5"]).agrees("1.50"));
        assert!(!example(&["a"]).agrees("a\nb"));
        assert!(!example(&["a", "b"]).agrees("a"));
        assert!(!example(&["x … y"]).agrees("x z"));
    }
}
