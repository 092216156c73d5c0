//! Radiometry in twelve lessons.
//!
//! A lesson is a folder: `lesson.md` (an equation, the commands that compute it with what they print, an exercise and its
//! answer), `picture.svg`, and the files that its commands read. The program `steradian learn` carries them all, so that a
//! reader needs nothing else; a test runs every command and compares what it prints.
//!
//! ```
//! let lesson = &steradian_course::LESSONS[2];
//! assert_eq!((lesson.number, lesson.title()), (3, "Solid angle"));
//! let first = steradian_course::commands(lesson.text).next().expect("a command");
//! assert!(first.line.starts_with("steradian solid-angle"));
//! ```

mod commands;

pub use commands::{Example, commands};

/// One lesson.
#[derive(Clone, Copy, Debug)]
pub struct Lesson {
    /// From 1.
    pub number: usize,
    /// The name of its folder.
    pub folder: &'static str,
    /// `lesson.md`.
    pub text: &'static str,
    /// All its other files, the picture first: name and text.
    pub files: &'static [(&'static str, &'static str)],
}

impl Lesson {
    /// The words of the first line, without mark and number.
    pub fn title(&self) -> &'static str {
        let heading = self.text.lines().next().unwrap_or_default();
        heading.trim_start_matches(|c: char| c == '#' || c == ' ' || c.is_ascii_digit())
    }
}

macro_rules! lessons {
    ($($number:literal $folder:literal [$($file:literal),*];)*) => {
        [$(Lesson {
            number: $number,
            folder: $folder,
            text: include_str!(concat!("../", $folder, "/lesson.md")),
            files: &[
                ("picture.svg", include_str!(concat!("../", $folder, "/picture.svg"))),
                $(($file, include_str!(concat!("../", $folder, "/", $file)))),*
            ],
        }),*]
    };
}

/// All lessons, in order.
pub const LESSONS: [Lesson; 12] = lessons! {
    1 "01-area" [];
    2 "02-spherical-coordinates" [];
    3 "03-solid-angle" [];
    4 "04-differential-solid-angle" [];
    5 "05-foreshortening" [];
    6 "06-infinitesimal-patch" [];
    7 "07-energy" ["lamp.csv"];
    8 "08-flux" ["meter.csv"];
    9 "09-irradiance" ["square.toml"];
    10 "10-point-light" ["lamp.toml"];
    11 "11-radiance" ["disc.toml"];
    12 "12-reflection" ["lambertian.toml", "sky.toml"];
};
