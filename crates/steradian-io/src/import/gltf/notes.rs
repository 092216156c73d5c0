//! What was read otherwise than the file says, told once with how often it happened.

use std::collections::BTreeSet;

/// Statements for the reader of the results.
#[derive(Default)]
pub(super) struct Notes {
    told: Vec<String>,
    counted: Vec<(&'static str, &'static str, BTreeSet<String>)>,
}

impl Notes {
    /// Says something once.
    pub fn tell(&mut self, text: impl Into<String>) {
        let text = text.into();
        if !self.told.contains(&text) {
            self.told.push(text);
        }
    }

    /// Says `text` with the number of `things` (materials, nodes …) it is true of.
    pub fn count(&mut self, things: &'static str, text: &'static str, thing: impl Into<String>) {
        let known = self.counted.iter_mut();
        let mut known = known.filter(|(what, said, _)| (*what, *said) == (things, text));
        match known.next() {
            Some((_, _, names)) => {
                names.insert(thing.into());
            }
            None => {
                let names = BTreeSet::from([thing.into()]);
                self.counted.push((things, text, names));
            }
        }
    }

    /// All of it, in the order in which it came up.
    pub fn into_warnings(self) -> Vec<String> {
        let counted = self.counted.into_iter().map(|(things, text, names)| {
            let count = names.len();
            format!("{text} ({things}: {count})")
        });
        let all = self.told.into_iter().chain(counted);
        all.map(|text| format!("glTF: {text}")).collect()
    }
}
