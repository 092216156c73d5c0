//! Points with normals from a CSV file: columns x, y, z in metres and nx, ny, nz of any length.
//!
//! A first line that is not numbers is a heading and is skipped; so are empty lines and lines that begin with `#`.

use std::path::Path;
use std::sync::Arc;

use steradian::geometry::{Point, Vector};

use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::Files;

const EXPECTED: &str = "expected six numbers x,y,z,nx,ny,nz: a point in metres and its normal";

/// Position and normal of each line.
///
/// # Errors
/// Every line that is not a point, or a file that cannot be read or has no points.
pub fn read_points(
    path: &Path,
    files: &dyn Files,
) -> Result<Vec<(Point, Vector)>, Vec<Diagnostic>> {
    let source = |text: String| {
        Arc::new(SourceFile {
            name: path.display().to_string(),
            text,
        })
    };
    let refuse = |message: String| vec![Diagnostic::error(message).about(&source(String::new()))];
    let bytes = files
        .read(path)
        .map_err(|error| refuse(format!("cannot read the points: {error}")))?;
    let text =
        String::from_utf8(bytes).map_err(|_| refuse("the points are not UTF-8 text".to_owned()))?;
    let file = source(text);
    let (mut points, mut problems) = (Vec::new(), Vec::new());
    for (number, (start, line)) in content(&file.text).enumerate() {
        match point(line) {
            Some(point) => points.push(point),
            None if number == 0 && is_heading(line) => {}
            None => problems.push(Diagnostic::error(EXPECTED).at(&file, start..start + line.len())),
        }
    }
    if points.is_empty() && problems.is_empty() {
        problems
            .push(Diagnostic::error(format!("the file has no points: {EXPECTED}")).about(&file));
    }
    if problems.is_empty() {
        Ok(points)
    } else {
        Err(problems)
    }
}

/// The lines that are neither empty nor comments, with the byte each begins at.
fn content(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let starts = text.split_inclusive('\n').scan(0, |next, line| {
        let start = *next;
        *next += line.len();
        Some((start, line.trim_end()))
    });
    starts.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

fn point(line: &str) -> Option<(Point, Vector)> {
    let numbers: Result<Vec<f64>, _> = line
        .split(',')
        .map(|field| field.trim().parse::<f64>())
        .collect();
    let [x, y, z, nx, ny, nz] = numbers.ok()?.try_into().ok()?;
    let finite = [x, y, z, nx, ny, nz]
        .iter()
        .all(|number| number.is_finite());
    (finite && [nx, ny, nz] != [0.0; 3]).then(|| (Point::new(x, y, z), Vector::new(nx, ny, nz)))
}

/// A heading has no numbers at all.
fn is_heading(line: &str) -> bool {
    line.split(',')
        .all(|field| field.trim().parse::<f64>().is_err())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::render;
    use crate::files::MemoryFiles;

    fn read(text: &str) -> Result<Vec<(Point, Vector)>, Vec<Diagnostic>> {
        read_points(
            Path::new("p.csv"),
            &MemoryFiles::default().with("p.csv", text),
        )
    }

    #[test]
    fn points_are_read_with_or_without_a_heading() {
        let expected = vec![(Point::new(1.0, 2.0, 3.0), Vector::new(0.0, 0.0, 1.0))];
        for text in [
            "1,2,3,0,0,1",
            "x,y,z,nx,ny,nz\r\n1, 2, 3, 0, 0, 1\r\n",
            "# desk\n\n1,2,3,0,0,1\n",
        ] {
            assert_eq!(read(text).unwrap(), expected, "{text}");
        }
    }

    #[test]
    fn every_bad_line_is_shown() {
        let problems =
            read("0,0,0,0,0,1\n1,2,3\n0,0,0,0,0,0\n0,0,nan,0,0,1\nx,0,0,0,0,1\n").unwrap_err();
        assert_eq!(problems.len(), 4);
        let text = render(&problems, false);
        assert!(
            text.contains("p.csv:2:1") && text.contains("p.csv:5:1"),
            "{text}"
        );
    }

    #[test]
    fn no_file_and_no_points_are_errors() {
        assert!(
            read("x,y,z,nx,ny,nz\n").unwrap_err()[0]
                .message
                .contains("no points")
        );
        let missing = read_points(Path::new("q.csv"), &MemoryFiles::default()).unwrap_err();
        assert!(missing[0].message.contains("cannot read"));
    }
}
