//! The paths that start at `crate` or `super` in a Rust source text.

/// Every such path, with the groups of a `use` written out: `crate::{a::b, c}` is `crate::a::b` and `crate::c`.
pub fn paths(text: &str) -> Vec<Vec<String>> {
    let tokens = tokens(&without_comments_and_texts(text));
    let starts =
        (0..tokens.len()).filter(|&at| is_root(&tokens[at]) && (at == 0 || tokens[at - 1] != "::"));
    let mut found = Vec::new();
    for start in starts {
        follow(&tokens, start, &mut Vec::new(), &mut found);
    }
    found
}

fn is_root(token: &str) -> bool {
    token == "crate" || token == "super"
}

/// Follows the path at `at`, adds what it leads to, and returns where it ends.
fn follow(
    tokens: &[String],
    mut at: usize,
    path: &mut Vec<String>,
    found: &mut Vec<Vec<String>>,
) -> usize {
    let outer = path.len();
    loop {
        match tokens.get(at).map(String::as_str) {
            Some("{") => {
                at = follow_group(tokens, at + 1, path, found);
                break;
            }
            Some(token) if token != "}" && token != "," => path.push(token.to_owned()),
            _ => break,
        }
        at += 1;
        if tokens.get(at).map(String::as_str) != Some("::") {
            found.push(path.clone());
            break;
        }
        at += 1;
    }
    path.truncate(outer);
    at
}

fn follow_group(
    tokens: &[String],
    mut at: usize,
    path: &mut Vec<String>,
    found: &mut Vec<Vec<String>>,
) -> usize {
    while let Some(token) = tokens.get(at) {
        match token.as_str() {
            "}" => return at + 1,
            "," => at += 1,
            _ => at = follow(tokens, at, path, found).max(at + 1),
        }
    }
    at
}

/// Names, `::`, and single signs.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        let length = if is_name(first) {
            rest.find(|c| !is_name(c)).unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        tokens.push(rest[..length].to_owned());
        rest = rest[length..].trim_start();
    }
    tokens
}

/// The text with each comment and each string replaced by a space.
fn without_comments_and_texts(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = skipped_length(rest);
        if length > 0 {
            kept.push(' ');
            rest = &rest[length..];
        } else {
            kept.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    kept
}

/// Length of the comment, string or character that starts here; 0 if none does.
fn skipped_length(rest: &str) -> usize {
    if rest.starts_with("//") {
        rest.find('\n').unwrap_or(rest.len())
    } else if rest.starts_with("/*") {
        block_comment_length(rest)
    } else if rest.starts_with("r\"") || rest.starts_with("r#") {
        raw_string_length(rest)
    } else if rest.starts_with('"') {
        string_length(rest)
    } else if rest.starts_with("'\"'") {
        3
    } else if rest.starts_with("'\\\"'") {
        4
    } else {
        0
    }
}

fn block_comment_length(rest: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < rest.len() {
        let here = &rest.as_bytes()[at..];
        if here.starts_with(b"/*") {
            depth += 1;
            at += 2;
        } else if here.starts_with(b"*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    rest.len()
}

fn raw_string_length(rest: &str) -> usize {
    let signs = rest[1..].bytes().take_while(|&byte| byte == b'#').count();
    if rest.as_bytes().get(1 + signs) != Some(&b'"') {
        return 0;
    }
    let end = format!("\"{}", "#".repeat(signs));
    let start = 2 + signs;
    rest[start..]
        .find(&end)
        .map_or(rest.len(), |at| start + at + end.len())
}

fn string_length(rest: &str) -> usize {
    let mut escaped = false;
    for (at, byte) in rest.bytes().enumerate().skip(1) {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = true,
            b'"' => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(text: &str) -> Vec<String> {
        paths(text).iter().map(|path| path.join("::")).collect()
    }

    #[test]
    fn groups_are_written_out() {
        let found = joined("use crate::{a::{b, c::d}, e};\nuse crate::f;");
        assert_eq!(
            found,
            ["crate::a::b", "crate::a::c::d", "crate::e", "crate::f"]
        );
    }

    #[test]
    fn paths_in_code_are_found() {
        assert_eq!(
            joined("let x = crate::a::f(super::super::b::C);"),
            ["crate::a::f", "super::super::b::C"]
        );
    }

    #[test]
    fn quotes_do_not_hide_code() {
        assert_eq!(
            joined(r##"let c = '"'; let s = "\""; let r = r#"crate::x""#; crate::a::b"##),
            ["crate::a::b"]
        );
    }
}
