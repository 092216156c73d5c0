use proptest::prelude::*;
use steradian::geometry::Point;

use super::read;
use crate::import::mesh_file::MeshFile;
use crate::import::normals;

const TYPES: &str = "property float x\nproperty double y\nproperty short z\nproperty float s\nproperty float t\n\
property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty list char ushort more\n";

fn header(format: &str, vertices: u32, faces: u32) -> String {
    format!(
        "ply\r\nformat {format} 1.0\ncomment of the maker\nelement vertex {vertices}\n{TYPES}element extra 2\n\
property list uchar double weights\nelement face {faces}\nproperty uchar flags\nproperty list uchar int vertex_indices\n\
element empty 4000000000\nend_header\n"
    )
}

/// A square of side 2, a quarter of which is at z = −3.
fn ascii() -> Vec<u8> {
    let body = "0 0 0 0 0 255 0 0 255 0\n2 0 0 1 0 0 188 0 51 2 7 8\n2 2 -3 1 1 0 0 0 0 0\n0 2 0 0 1 9 9 9 9 0\n\
0\n1 0.5\n7 4 0 1 2 3\n7 2 0 1\n";
    [header("ascii", 4, 2).as_bytes(), body.as_bytes()].concat()
}

fn binary(big: bool) -> Vec<u8> {
    let mut bytes = header(
        if big {
            "binary_big_endian"
        } else {
            "binary_little_endian"
        },
        4,
        2,
    )
    .into_bytes();
    let mut push = |little: &[u8]| {
        let mut number = little.to_vec();
        if big {
            number.reverse();
        }
        bytes.extend(number);
    };
    type Row<'a> = (f32, f64, i16, [f32; 2], [u8; 4], &'a [u16]);
    let rows: [Row<'_>; 4] = [
        (0.0, 0.0, 0, [0.0, 0.0], [255, 0, 0, 255], &[]),
        (2.0, 0.0, 0, [1.0, 0.0], [0, 188, 0, 51], &[7, 8]),
        (2.0, 2.0, -3, [1.0, 1.0], [0; 4], &[]),
        (0.0, 2.0, 0, [0.0, 1.0], [9; 4], &[]),
    ];
    for (x, y, z, [s, t], colour, more) in rows {
        push(&x.to_le_bytes());
        push(&y.to_le_bytes());
        push(&z.to_le_bytes());
        push(&s.to_le_bytes());
        push(&t.to_le_bytes());
        colour.iter().for_each(|code| push(&[*code]));
        push(&[more.len() as u8]);
        more.iter().for_each(|number| push(&number.to_le_bytes()));
    }
    push(&[0]);
    push(&[1]);
    push(&0.5_f64.to_le_bytes());
    for face in [&[0_i32, 1, 2, 3][..], &[0, 1]] {
        push(&[7]);
        push(&[face.len() as u8]);
        face.iter().for_each(|corner| push(&corner.to_le_bytes()));
    }
    bytes
}

#[test]
fn all_encodings_say_the_same() {
    let text = read(&ascii()).unwrap();
    for big in [false, true] {
        assert_eq!(
            read(&binary(big)).unwrap().parts[0].mesh,
            text.parts[0].mesh
        );
    }
    let mesh = &text.parts[0].mesh;
    assert_eq!(mesh.vertices[2], Point::new(2.0, 2.0, -3.0));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.texture_coordinates[3], [0.0, 1.0]);
    assert_eq!(mesh.colors[0], [1.0, 0.0, 0.0, 1.0]);
    // Of sRGB 188: .502886; of alpha, 51/255.
    assert!((mesh.colors[1][1] - 0.502_886).abs() < 1e-6 && mesh.colors[1][3] == 0.2);
    assert_eq!(text.parts[0].material, Some(0));
    assert_eq!(
        text.warnings,
        [
            "vertex colours of integers are read as sRGB",
            "1 faces have fewer than three corners and are passed over"
        ]
    );
}

fn plain(rest: &str) -> Vec<u8> {
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    format!("{header}{rest}").into_bytes()
}

const VERTICES: &str = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";

#[test]
fn strips_keep_their_side() {
    let strips = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    let file = read(&plain(&format!("{strips}{VERTICES}8 0 1 2 3 -1 3 1 2\n"))).unwrap();
    assert_eq!(
        file.parts[0].mesh.triangles,
        [[0, 1, 2], [2, 1, 3], [3, 1, 2]]
    );
}

#[test]
fn linear_colours_stay_as_they_are() {
    let file = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
property float red\nproperty float green\nproperty float blue\nelement face 1\nproperty list uchar int vertex_index\n\
end_header\n0 0 0 0.5 1 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2";
    assert_eq!(
        read(file.as_bytes()).unwrap().parts[0].mesh.colors[0],
        [0.5, 1.0, 0.0, 1.0]
    );
    let negative = file.replace("0.5 1 0", "0.5 -1 0");
    assert_eq!(
        refused(negative.as_bytes()),
        "vertex 1 is not finite, or of a negative colour"
    );
}

fn refused(bytes: &[u8]) -> String {
    read(bytes).unwrap_err().to_string()
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let good = format!("{faces}{VERTICES}3 0 1 2\n");
    for (from, to, message) in [
        (
            "0 1 0\n",
            "0 nan 0\n",
            "vertex 3 is not finite, or of a negative colour",
        ),
        (
            "0 1 0\n",
            "0 inf 0\n",
            "vertex 3 is not finite, or of a negative colour",
        ),
        (
            "0 1 0\n",
            "0 one 0\n",
            "vertex 3: expected a number, found \"one\"",
        ),
        (
            "3 0 1 2",
            "3 0 1 4",
            "face 1: there is no vertex 4; they are numbered from 0 to 3",
        ),
        (
            "3 0 1 2",
            "3 0 1 -1",
            "face 1: there is no vertex -1; they are numbered from 0 to 3",
        ),
        (
            "3 0 1 2",
            "3 0 1 0.5",
            "face 1: there is no vertex 0.5; they are numbered from 0 to 3",
        ),
        ("3 0 1 2", "9 0 1 2", "the file ends within face 1"),
        ("3 0 1 2", "2 0 1", "no face in the whole file"),
        (
            "face 1",
            "face 99999999999",
            "the header says 99999999999 of element face, which need 199999999998 bytes or more, but the file has 8 left",
        ),
        (
            "face 1",
            "face -1",
            "line 7: expected a number of elements, found \"element face -1\"",
        ),
        (
            "int vertex",
            "int32 x vertex",
            "line 8: expected property TYPE NAME or property list",
        ),
        (
            "uchar int",
            "float int",
            "line 8: expected property TYPE NAME or property list",
        ),
        (
            "end_header",
            "end",
            "line 9: expected format, element, property",
        ),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        let error = refused(&plain(&text));
        assert!(error.starts_with(message), "{error}");
    }
    assert_eq!(
        refused(b"solid"),
        "not a PLY file: its first line is not \"ply\""
    );
    assert_eq!(
        refused(b"ply\nformat ascii 1.0\n"),
        "the header has no line end_header"
    );
    assert_eq!(
        refused(b"ply\nend_header\n"),
        "line 2: expected a format before end_header, found \"end_header\""
    );
    let first = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nend_header\n3 0 1 2\n";
    assert_eq!(
        refused(first.as_bytes()),
        "no element vertex before the faces"
    );
}

fn with_normals(third: &str) -> MeshFile {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let body = format!("0 0 0 0 0 2\n1 0 0 0 3 4\n0 1 0 {third}\n3 0 1 2\n");
    read(format!("{header}{body}").as_bytes()).unwrap()
}

#[test]
fn normals_are_made_as_long_as_one() {
    let file = with_normals("0 0 -1");
    let expected = [[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.0, 0.0, -1.0]];
    assert_eq!(file.parts[0].mesh.normals, expected);
    for third in ["0 0 0", "0 nan 0"] {
        let file = with_normals(third);
        assert!(file.parts[0].mesh.normals.is_empty());
        assert_eq!(file.warnings, [normals::LEFT_OUT]);
    }
}

fn is_sound(file: &MeshFile) -> bool {
    file.parts.iter().all(|part| {
        let mesh = &part.mesh;
        let corners = mesh.triangles.iter().flatten();
        let count = mesh.vertices.len();
        corners.into_iter().all(|corner| (*corner as usize) < count)
            && mesh.vertices.iter().all(|vertex| vertex.is_finite())
            && [
                mesh.colors.len(),
                mesh.texture_coordinates.len(),
                mesh.normals.len(),
            ]
            .iter()
            .all(|n| *n == 0 || *n == count)
    })
}

proptest! {
    #[test]
    fn any_bytes_after_a_header_are_read_or_refused(
        format in prop::sample::select(vec!["ascii", "binary_little_endian", "binary_big_endian"]),
        counts: [u32; 2],
        body in prop::collection::vec(any::<u8>(), 0..300),
    ) {
        let [vertices, faces] = counts;
        for (vertices, faces) in [(vertices, faces), (vertices % 8, faces % 8)] {
            let bytes = [header(format, vertices, faces).as_bytes(), &body].concat();
            if let Ok(file) = read(&bytes) {
                prop_assert!(is_sound(&file));
            }
        }
    }

    #[test]
    fn any_part_of_a_file_is_read_or_refused(kind in 0..3, keep in 0_usize..700, damage: u8, at in 0_usize..700) {
        let mut bytes = match kind { 0 => ascii(), 1 => binary(false), _ => binary(true) };
        bytes.truncate(keep);
        if let Some(byte) = bytes.get_mut(at) {
            *byte = damage;
        }
        if let Ok(file) = read(&bytes) {
            prop_assert!(is_sound(&file));
        }
    }
}
