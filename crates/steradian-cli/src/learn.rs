//! `steradian learn`: the course in radiometry that the program carries.

use std::path::{Path, PathBuf};

use clap::Args;
use steradian_course::{LESSONS, Lesson};

use crate::output;
use crate::status::{Failure, Outcome, remark};

/// Learn radiometry in twelve lessons, from area to the reflection integral
///
/// Without a number it lists the lessons. A lesson states an equation, the commands that compute it with what they print, and
/// an exercise with its answer. `--files` writes its picture, and the scenes that its commands read.
#[derive(Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// Which lesson, from 1
    #[arg(value_parser = clap::value_parser!(u8).range(1..=LESSONS.len() as i64))]
    number: Option<u8>,
    /// Write the lesson with its picture and its scenes into this folder, instead of printing it
    #[arg(long, value_name = "FOLDER", requires = "number")]
    files: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  steradian learn
  steradian learn 3
  steradian learn 10 --files lesson";

/// Prints the list or a lesson, or writes a lesson's files.
pub fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let lesson = arguments
        .number
        .and_then(|number| LESSONS.get(usize::from(number) - 1));
    match (lesson, &arguments.files) {
        (None, _) => output::print(&list())?,
        (Some(lesson), None) => output::print(lesson.text)?,
        (Some(lesson), Some(folder)) => write(lesson, folder)?,
    }
    Ok(Outcome::Fine)
}

fn list() -> String {
    let line = |lesson: &Lesson| format!("{:>3}  {}\n", lesson.number, lesson.title());
    let lessons: String = LESSONS.iter().map(line).collect();
    format!("{lessons}\nsteradian learn N prints lesson N.\n")
}

fn write(lesson: &Lesson, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)?;
    for (name, text) in [("lesson.md", lesson.text)].iter().chain(lesson.files) {
        let path = folder.join(name);
        output::write(text.as_bytes(), Some(&path))?;
        remark(&format!("wrote {}", path.display()));
    }
    Ok(())
}
