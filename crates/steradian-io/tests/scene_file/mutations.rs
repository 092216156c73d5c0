//! Files that are no scenes, or no longer: never a panic, and always a message.

use proptest::prelude::*;
use steradian_io::diagnostic::render;
use steradian_io::scene_file::read_scene_str;

use crate::files;

const EVERY_KEY: &str = include_str!("every-key.toml");

/// Reads `text`; what cannot be read gives at least one message, which can be shown.
fn read(text: &str) {
    if let Err(problems) = read_scene_str("scene.toml", text, &files()) {
        assert!(!problems.is_empty());
        assert!(render(&problems, false).contains("error: "));
    }
}

/// What a careless edit puts in the place of a piece of the file.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        prop::sample::select(vec![
            "",
            "\"",
            "[",
            "]",
            "{",
            "}",
            "=",
            "\n",
            "#",
            "nan",
            "-inf",
            "1e400",
            "0x7fffffffffffffff",
            "\"5 kg\"",
            "[]",
            "{}",
            "true",
            "1979-05-27",
            "'\u{0}'",
            "\u{feff}",
            "é",
            "kind",
            "[[shapes]]",
            "[scene]",
            "99999999999999999999",
        ])
        .prop_map(str::to_owned),
        "\\PC{0,12}",
    ]
}

fn boundaries() -> Vec<usize> {
    EVERY_KEY.char_indices().map(|(at, _)| at).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn mutated_scenes_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..40_usize, piece()), 1..4),
    ) {
        let boundaries = boundaries();
        let mut text = EVERY_KEY.to_owned();
        for (at, length, piece) in edits {
            let start = text.floor_char_boundary(boundaries[at.index(boundaries.len())].min(text.len()));
            let end = text.ceil_char_boundary((start + length).min(text.len()));
            text.replace_range(start..end, &piece);
        }
        read(&text);
    }

    /// Values of one key moved to another.
    #[test]
    fn swapped_values_never_panic(from in any::<prop::sample::Index>(), to in any::<prop::sample::Index>()) {
        let lines: Vec<&str> = EVERY_KEY.lines().collect();
        let pairs: Vec<(usize, &str, &str)> = lines
            .iter()
            .enumerate()
            .filter_map(|(number, line)| line.split_once(" = ").map(|(key, value)| (number, key, value)))
            .collect();
        let ((number, key, _), (_, _, value)) = (pairs[to.index(pairs.len())], pairs[from.index(pairs.len())]);
        let line = format!("{key} = {value}");
        let swapped: Vec<&str> =
            lines.iter().enumerate().map(|(at, old)| if at == number { line.as_str() } else { *old }).collect();
        read(&swapped.join("\n"));
    }

    #[test]
    fn any_text_never_panics(text in "\\PC*") {
        read(&text);
    }
}

#[test]
fn deep_nesting_is_refused() {
    for open in ["[", "{ a = "] {
        let text = format!("[scene]\nname = {}", open.repeat(100_000));
        assert!(read_scene_str("scene.toml", &text, &files()).is_err());
    }
}
