//! As much of a JSON reader (RFC 8259) as `cargo metadata` needs.

use std::iter::Peekable;
use std::str::Chars;

/// A JSON value; numbers are kept as text.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Null,
    Boolean(bool),
    Number(String),
    Text(String),
    List(Vec<Value>),
    Object(Vec<(String, Value)>),
}

impl Value {
    /// The value of a key of an object.
    pub fn get(&self, key: &str) -> Option<&Value> {
        let Value::Object(entries) = self else {
            return None;
        };
        entries
            .iter()
            .find(|(name, _)| name == key)
            .map(|(_, value)| value)
    }

    /// The text of a string.
    pub fn text(&self) -> Option<&str> {
        if let Value::Text(text) = self {
            Some(text)
        } else {
            None
        }
    }

    /// The items of a list; none for anything else.
    pub fn items(&self) -> &[Value] {
        if let Value::List(items) = self {
            items
        } else {
            &[]
        }
    }
}

/// Reads one value and nothing after it.
pub fn parse(text: &str) -> Result<Value, String> {
    let mut reader = Reader {
        characters: text.chars().peekable(),
    };
    let value = reader.value()?;
    reader.space();
    match reader.characters.next() {
        None => Ok(value),
        Some(character) => Err(format!("JSON: {character:?} after the end")),
    }
}

struct Reader<'a> {
    characters: Peekable<Chars<'a>>,
}

impl Reader<'_> {
    fn space(&mut self) {
        while self
            .characters
            .next_if(|c| c.is_ascii_whitespace())
            .is_some()
        {}
    }

    fn next(&mut self) -> Result<char, String> {
        self.characters
            .next()
            .ok_or_else(|| "JSON: the text ends too early".to_owned())
    }

    fn expect(&mut self, wanted: &str) -> Result<(), String> {
        for wanted in wanted.chars() {
            let found = self.next()?;
            if found != wanted {
                return Err(format!("JSON: expected {wanted:?}, found {found:?}"));
            }
        }
        Ok(())
    }

    fn accept(&mut self, wanted: char) -> bool {
        self.space();
        self.characters.next_if_eq(&wanted).is_some()
    }

    fn value(&mut self) -> Result<Value, String> {
        self.space();
        match self.characters.peek() {
            Some('{') => self.object(),
            Some('[') => self.list(),
            Some('"') => Ok(Value::Text(self.string()?)),
            Some('n') => self.expect("null").map(|()| Value::Null),
            Some('t') => self.expect("true").map(|()| Value::Boolean(true)),
            Some('f') => self.expect("false").map(|()| Value::Boolean(false)),
            _ => self.number(),
        }
    }

    fn number(&mut self) -> Result<Value, String> {
        let mut text = String::new();
        while let Some(c) = self
            .characters
            .next_if(|c| c.is_ascii_digit() || "+-.eE".contains(*c))
        {
            text.push(c);
        }
        match text.parse::<f64>() {
            Ok(_) => Ok(Value::Number(text)),
            Err(_) => Err(format!("JSON: expected a value, found {text:?}")),
        }
    }

    fn list(&mut self) -> Result<Value, String> {
        self.expect("[")?;
        let mut items = Vec::new();
        if self.accept(']') {
            return Ok(Value::List(items));
        }
        loop {
            items.push(self.value()?);
            if !self.accept(',') {
                self.expect("]")?;
                return Ok(Value::List(items));
            }
        }
    }

    fn object(&mut self) -> Result<Value, String> {
        self.expect("{")?;
        let mut entries = Vec::new();
        if self.accept('}') {
            return Ok(Value::Object(entries));
        }
        loop {
            self.space();
            let key = self.string()?;
            self.space();
            self.expect(":")?;
            entries.push((key, self.value()?));
            if !self.accept(',') {
                self.expect("}")?;
                return Ok(Value::Object(entries));
            }
        }
    }

    fn string(&mut self) -> Result<String, String> {
        self.expect("\"")?;
        let mut text = String::new();
        loop {
            match self.next()? {
                '"' => return Ok(text),
                '\\' => text.push(self.escape()?),
                character => text.push(character),
            }
        }
    }

    fn escape(&mut self) -> Result<char, String> {
        Ok(match self.next()? {
            'n' => '\n',
            't' => '\t',
            'r' => '\r',
            'b' => '\u{8}',
            'f' => '\u{c}',
            'u' => self.code_point()?,
            other => other,
        })
    }

    fn code_point(&mut self) -> Result<char, String> {
        let first = self.four_digits()?;
        if !(0xd800..0xdc00).contains(&first) {
            return Ok(char::from_u32(first).unwrap_or(char::REPLACEMENT_CHARACTER));
        }
        self.expect("\\u")?;
        let second = self.four_digits()?.wrapping_sub(0xdc00);
        let combined = 0x10000 + ((first - 0xd800) << 10) + (second & 0x3ff);
        Ok(char::from_u32(combined).unwrap_or(char::REPLACEMENT_CHARACTER))
    }

    fn four_digits(&mut self) -> Result<u32, String> {
        let mut code = 0;
        for _ in 0..4 {
            let digit = self.next()?;
            code = code * 16
                + digit
                    .to_digit(16)
                    .ok_or_else(|| format!("JSON: {digit:?} is not a digit"))?;
        }
        Ok(code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_every_kind_of_value() {
        let value =
            parse(r#" {"a": [1, -2.5e3, true, false, null], "b": {"c": "x"}, "d": [], "e": {}} "#)
                .unwrap();
        assert_eq!(value.get("a").unwrap().items().len(), 5);
        assert_eq!(
            value.get("a").unwrap().items()[1],
            Value::Number("-2.5e3".to_owned())
        );
        assert_eq!(value.get("b").unwrap().get("c").unwrap().text(), Some("x"));
        assert_eq!(value.get("d").unwrap().items(), []);
    }

    #[test]
    fn reads_escapes() {
        let value = parse(r#""a\n\"\\\u00e9\ud83d\ude00""#).unwrap();
        assert_eq!(value.text(), Some("a\n\"\\é😀"));
    }

    #[test]
    fn refuses_what_is_not_json() {
        for text in [
            "",
            "{",
            "[1,]",
            "{\"a\" 1}",
            "nul",
            "1 2",
            "\"open",
            "{1: 2}",
            "[1 2]",
        ] {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
