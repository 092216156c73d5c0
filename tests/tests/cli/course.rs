//! The course: every command of every lesson prints what the lesson says, with the files that `learn --files` writes.

use std::path::Path;

use steradian_course::{Example, LESSONS, Lesson, commands};
use steradian_tests::command::{Folder, steradian, steradian_in};

fn run(example: &Example, folder: &Path) -> Result<(), String> {
    let words = example.words();
    assert_eq!(words[0], "steradian");
    let arguments: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let ran = steradian_in(folder, &arguments);
    if example.agrees(&ran.stdout()) {
        return Ok(());
    }
    let shown = example.printed.join("\n");
    let (found, errors) = (ran.stdout(), ran.stderr());
    Err(format!(
        "{}\n--- shown\n{shown}\n--- found\n{found}{errors}",
        example.line
    ))
}

fn faults(lesson: &Lesson) -> Vec<String> {
    let folder = Folder::new();
    let path = folder.path("lesson");
    steradian(&["learn", &lesson.number.to_string(), "--files", &path]).fine();
    commands(lesson.text)
        .filter_map(|example| run(&example, Path::new(&path)).err())
        .map(|fault| format!("lesson {}: {fault}", lesson.number))
        .collect()
}

#[test]
fn every_command_prints_what_its_lesson_says() {
    let faults: Vec<String> = LESSONS.iter().flat_map(faults).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}

#[test]
fn every_lesson_has_an_equation_a_command_a_picture_an_exercise_and_its_answer() {
    for (index, lesson) in LESSONS.iter().enumerate() {
        assert_eq!(lesson.number, index + 1);
        for part in [
            "## Equation",
            "## Compute it",
            "](picture.svg)",
            "## Exercise",
            "## Answer",
        ] {
            assert!(
                lesson.text.contains(part),
                "lesson {} lacks {part}",
                lesson.number
            );
        }
        assert!(commands(lesson.text).count() > 0);
        assert!(lesson.files[0].1.starts_with("<svg"));
    }
}

#[test]
fn learn_lists_the_lessons_and_prints_one() {
    let list = steradian(&["learn"]).fine();
    assert!(LESSONS.iter().all(|lesson| list.contains(&format!(
        "{:>3}  {}\n",
        lesson.number,
        lesson.title()
    ))));
    assert_eq!(steradian(&["learn", "3"]).fine(), LESSONS[2].text);
    assert!(steradian(&["learn", "13"]).error().contains("1..=12"));
}
