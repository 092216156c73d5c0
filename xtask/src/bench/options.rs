//! The command line of `cargo xtask bench`.

use std::path::PathBuf;

/// A part of the suite: a program of `benchmarks/suite` and what it is told.
#[derive(Debug, PartialEq, Eq)]
pub struct Part {
    pub name: &'static str,
    pub program: &'static str,
    pub arguments: &'static [&'static str],
    pub about: &'static str,
}

const fn suite(
    name: &'static str,
    program: &'static str,
    arguments: &'static [&'static str],
    about: &'static str,
) -> Part {
    Part {
        name,
        program,
        arguments,
        about,
    }
}

const PICTURES: &str = "pictures.py";
const SCALING: &str = "scaling.py";

pub const PARTS: [Part; 13] = [
    suite(
        "kernel",
        "kernel.py",
        &[],
        "rays per second, build time, bytes per triangle; Embree",
    ),
    suite(
        "cornell",
        PICTURES,
        &["--scenes", "cornell"],
        "1/(relMSE·CPU s) of the Cornell box; Mitsuba, Cycles",
    ),
    suite(
        "veach-mis",
        PICTURES,
        &["--scenes", "veach_mis"],
        "the same of glossy plates under lamps of many sizes; Mitsuba",
    ),
    suite(
        "bathroom",
        PICTURES,
        &["--scenes", "bathroom"],
        "the same of a room of 380 000 triangles, by --bathroom; Mitsuba",
    ),
    suite(
        "hall",
        PICTURES,
        &["--scenes", "hall"],
        "the same of a hall under 1 000 panels; Mitsuba",
    ),
    suite(
        "glass",
        PICTURES,
        &["--scenes", "glass_ball"],
        "the same of a glass ball and its caustic; Mitsuba",
    ),
    suite(
        "sky",
        PICTURES,
        &["--scenes", "sky_room"],
        "the same of a room lit through a window; Mitsuba",
    ),
    suite(
        "grid",
        "grid.py",
        &[],
        "seconds to 1 % of irradiance at 20 x 20 points; Radiance, Mitsuba",
    ),
    suite(
        "threads",
        SCALING,
        &["--of", "threads"],
        "two threads beside one",
    ),
    suite(
        "triangles",
        SCALING,
        &["--of", "triangles"],
        "build time and memory from 10 000 to 10 million; Embree",
    ),
    suite(
        "lights",
        SCALING,
        &["--of", "lights"],
        "time to 2 % under 10 to 10 000 lamps",
    ),
    suite(
        "sensors",
        SCALING,
        &["--of", "sensors"],
        "time and memory of 1 000 to 1 million points",
    ),
    suite(
        "memory",
        SCALING,
        &["--of", "memory"],
        "peak memory of a picture; Mitsuba",
    ),
];

/// A flag with a value, the variable that stands for it, and the value's name and meaning.
const PATHS: [(&str, &str, &str); 5] = [
    (
        "--mitsuba",
        "STERADIAN_MITSUBA",
        "PYTHON      a Python that has mitsuba and numpy; runs all programs of the suite",
    ),
    (
        "--radiance",
        "STERADIAN_RADIANCE",
        "FOLDER      Radiance's programs oconv, rtrace, genbox, xform",
    ),
    (
        "--embree",
        "STERADIAN_EMBREE",
        "FILE.c      the program told in benchmarks/embree/README.md",
    ),
    (
        "--cycles",
        "STERADIAN_CYCLES",
        "PYTHON      a Python that has bpy",
    ),
    (
        "--bathroom",
        "STERADIAN_BATHROOM",
        "FILE.glb    the scene told in benchmarks/README.md",
    ),
];

/// What a run of the suite is told.
#[derive(Debug, PartialEq, Eq)]
pub struct Options {
    pub parts: Vec<&'static Part>,
    pub rounds: u32,
    pub quick: bool,
    /// Flags and values to pass on.
    paths: Vec<(&'static str, PathBuf)>,
}

impl Options {
    /// Reads the words after `bench`; what is not given there may be in the environment.
    pub fn read(
        words: &[&str],
        environment: impl Fn(&str) -> Option<PathBuf>,
    ) -> Result<Self, String> {
        let mut options = Self {
            parts: Vec::new(),
            rounds: 5,
            quick: false,
            paths: Vec::new(),
        };
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let mut value = || {
                words
                    .next()
                    .ok_or(format!("{word} wants a value\n\n{}", usage()))
            };
            if word == "--quick" {
                options.quick = true;
            } else if word == "--rounds" {
                options.rounds = rounds(value()?)?;
            } else if let Some((flag, ..)) = PATHS.iter().find(|(flag, ..)| *flag == word) {
                options.paths.push((flag, value()?.into()));
            } else {
                options.parts.push(part(word)?);
            }
        }
        for (flag, variable, _) in PATHS {
            if let Some(path) = environment(variable).filter(|_| options.path(flag).is_none()) {
                options.paths.push((flag, path));
            }
        }
        if options.parts.is_empty() {
            options.parts = PARTS.iter().collect();
        }
        Ok(options)
    }

    /// The value of one of the flags that hold a path.
    pub fn path(&self, flag: &str) -> Option<&PathBuf> {
        let found = self.paths.iter().find(|(name, _)| *name == flag);
        found.map(|(_, path)| path)
    }
}

fn rounds(word: &str) -> Result<u32, String> {
    let number = word.parse().ok().filter(|&number| number > 0);
    number.ok_or_else(|| format!("--rounds wants a whole number above 0, not {word}"))
}

fn part(word: &str) -> Result<&'static Part, String> {
    let found = PARTS.iter().find(|part| part.name == word);
    found.ok_or_else(|| format!("no part of the suite is called {word}\n\n{}", usage()))
}

/// The help text.
pub fn usage() -> String {
    let parts: Vec<String> = PARTS
        .iter()
        .map(|part| format!("  {:10} {}\n", part.name, part.about))
        .collect();
    let paths: Vec<String> = PATHS
        .iter()
        .map(|(flag, variable, about)| format!("  {flag:10} {about} (or {variable})\n"))
        .collect();
    format!(
        "Usage: cargo xtask bench [PART …] [--rounds 5] [--quick] [FLAG VALUE …]\n\nParts (all unless named):\n{}\nPeers (none is downloaded):\n{}\n\
         bench stages [FILTER] runs the benchmarks of single functions instead, which need no peer.\n",
        parts.concat(),
        paths.concat()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(words: &[&str]) -> Result<Options, String> {
        Options::read(words, |_| None)
    }

    #[test]
    fn all_parts_unless_some_are_named() {
        assert_eq!(read(&[]).unwrap().parts.len(), PARTS.len());
        let options = read(&["hall", "kernel"]).unwrap();
        let names: Vec<&str> = options.parts.iter().map(|part| part.name).collect();
        assert_eq!(names, ["hall", "kernel"]);
    }

    #[test]
    fn flags_and_their_values() {
        let options = read(&["--quick", "cornell", "--rounds", "7", "--embree", "x.c"]).unwrap();
        assert!(options.quick);
        assert_eq!(options.rounds, 7);
        assert_eq!(options.path("--embree"), Some(&PathBuf::from("x.c")));
        assert_eq!(options.path("--mitsuba"), None);
    }

    #[test]
    fn the_environment_fills_in_what_is_not_said() {
        let environment = |name: &str| (name == "STERADIAN_MITSUBA").then(|| "env".into());
        let path = |words: &[&str]| {
            Options::read(words, environment)
                .unwrap()
                .path("--mitsuba")
                .unwrap()
                .clone()
        };
        assert_eq!(path(&[]), PathBuf::from("env"));
        assert_eq!(path(&["--mitsuba", "said"]), PathBuf::from("said"));
    }

    #[test]
    fn refuses_what_it_does_not_know() {
        for words in [
            &["cornel"][..],
            &["--rounds"],
            &["--rounds", "0"],
            &["--mitsuba"],
        ] {
            assert!(read(words).is_err(), "{words:?}");
        }
    }

    #[test]
    fn parts_have_names_of_their_own() {
        for part in &PARTS {
            let same = PARTS.iter().filter(|other| other.name == part.name);
            assert_eq!(same.count(), 1, "{}", part.name);
        }
    }
}
