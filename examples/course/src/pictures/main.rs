//! Draws the pictures of the course, from numbers that the library computes: `cargo run -p steradian-course -- draw`.
//! `check` compares instead, so that no picture shows what the library no longer says.

mod curves;
mod solids;
mod view;

use std::path::Path;

use anyhow::{Context, bail};
use steradian_course::{LESSONS, Lesson};

fn main() -> anyhow::Result<()> {
    let task = std::env::args().nth(1);
    let course = Path::new(env!("CARGO_MANIFEST_DIR"));
    for lesson in &LESSONS {
        let path = course.join(lesson.folder).join("picture.svg");
        let drawn = picture(lesson)?;
        match task.as_deref() {
            Some("draw") => std::fs::write(&path, drawn)
                .with_context(|| format!("cannot write {}", path.display()))?,
            Some("check") if lesson.files[0].1 == drawn => {}
            Some("check") => bail!(
                "{} is not what the library draws: run `draw`",
                path.display()
            ),
            _ => bail!("say `draw` or `check`"),
        }
    }
    Ok(())
}

fn picture(lesson: &Lesson) -> anyhow::Result<String> {
    Ok(match lesson.number {
        1 => solids::area(),
        2 => solids::direction(),
        3 => solids::solid_angle(),
        4 => solids::differential(),
        5 => curves::foreshortening()?,
        6 => curves::patch()?,
        7 => curves::energy()?,
        8 => curves::flux()?,
        9 => curves::irradiance()?,
        10 => curves::point_light()?,
        11 => curves::radiance()?,
        12 => solids::reflection(),
        other => bail!("lesson {other} has no picture"),
    })
}
