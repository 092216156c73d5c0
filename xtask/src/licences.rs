//! Every dependency must be under a licence that lets anyone use Steradian under MIT or Apache-2.0.

use std::path::Path;

use crate::json::{self, Value};
use crate::steps::{cargo, output};

const ALLOWED: [&str; 13] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
    "MIT-0",
];

/// Reads `cargo metadata` and names every package whose licence is missing or not allowed.
pub fn check(root: &Path) -> Result<(), String> {
    let metadata = output(&mut cargo(
        root,
        &["metadata", "--format-version", "1", "--quiet"],
    ))?;
    let metadata = json::parse(&metadata)?;
    let packages = metadata.get("packages").map_or(&[][..], Value::items);
    if packages.is_empty() {
        return Err("cargo metadata lists no package".to_owned());
    }
    let refused: Vec<String> = packages.iter().filter_map(refusal).collect();
    if refused.is_empty() {
        Ok(())
    } else {
        Err(refused.join("\n"))
    }
}

fn refusal(package: &Value) -> Option<String> {
    let name = package.get("name")?.text()?;
    match package.get("license").and_then(Value::text) {
        Some(licence) if is_allowed(licence) => None,
        Some(licence) => Some(format!("{name}: licence {licence} is not allowed")),
        None => Some(format!("{name}: no licence is stated")),
    }
}

/// True when some choice among the alternatives of an SPDX expression consists of allowed licences only.
fn is_allowed(expression: &str) -> bool {
    let spaced = expression
        .replace('(', " ( ")
        .replace(')', " ) ")
        .replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = words.as_slice();
    alternatives(&mut rest) && rest.is_empty()
}

fn alternatives(words: &mut &[&str]) -> bool {
    let mut allowed = conjunction(words);
    while let ["OR", rest @ ..] = *words {
        *words = rest;
        allowed |= conjunction(words);
    }
    allowed
}

fn conjunction(words: &mut &[&str]) -> bool {
    let mut allowed = licence(words);
    while let ["AND", rest @ ..] = *words {
        *words = rest;
        allowed &= licence(words);
    }
    allowed
}

fn licence(words: &mut &[&str]) -> bool {
    match *words {
        ["(", rest @ ..] => {
            *words = rest;
            let allowed = alternatives(words);
            let [")", rest @ ..] = *words else {
                return false;
            };
            *words = rest;
            allowed
        }
        [name, "WITH", exception, rest @ ..] => {
            *words = rest;
            ALLOWED.contains(&format!("{name} WITH {exception}").as_str())
        }
        [name, rest @ ..] => {
            *words = rest;
            ALLOWED.contains(name)
        }
        [] => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permissive_expressions_are_allowed() {
        for expression in [
            "MIT",
            "MIT OR Apache-2.0",
            "MIT/Apache-2.0",
            "Apache-2.0 WITH LLVM-exception OR MIT",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "MIT OR GPL-3.0-only",
        ] {
            assert!(is_allowed(expression), "{expression}");
        }
    }

    #[test]
    fn copyleft_and_malformed_expressions_are_refused() {
        for expression in [
            "GPL-3.0",
            "AGPL-3.0-or-later",
            "MIT AND GPL-2.0",
            "(MIT",
            "",
            "MIT Apache-2.0",
            "LicenseRef-x",
        ] {
            assert!(!is_allowed(expression), "{expression}");
        }
    }

    #[test]
    fn a_package_without_a_licence_is_refused() {
        let package = json::parse(r#"{"name": "x", "license": null}"#).unwrap();
        assert_eq!(refusal(&package).unwrap(), "x: no licence is stated");
    }
}
