use std::path::Path;

use proptest::prelude::*;
use steradian::geometry::Point;
use steradian::scene::description::{LaneValues, MaterialModel, MeshData};

use super::{ObjFault, read as read_file};
use crate::files::MemoryFiles;
use crate::import::mesh_file::MeshFile;
use crate::import::normals;

fn read(bytes: &[u8]) -> Result<MeshFile, super::ObjError> {
    read_with(bytes, "")
}

fn read_with(bytes: &[u8], library: &str) -> Result<MeshFile, super::ObjError> {
    let files = MemoryFiles::default().with("dir/a.mtl", library);
    read_file(bytes, Path::new("dir"), &files)
}

fn mesh(text: &str) -> MeshData {
    let file = read(text.as_bytes()).unwrap();
    assert_eq!(file.parts.len(), 1);
    MeshData::clone(&file.parts[0].mesh)
}

fn fault(text: &str) -> (usize, ObjFault) {
    let error = read(text.as_bytes()).unwrap_err();
    (error.line, error.fault)
}

#[test]
fn corners_are_counted_from_either_end() {
    let text = "o part\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1\nf -3 -2 -1\n";
    let mesh = mesh(text);
    assert_eq!(mesh.vertices[1], Point::new(1.0, 0.0, 0.0));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 2]]);
    assert!(mesh.texture_coordinates.is_empty() && mesh.colors.is_empty());
}

#[test]
fn a_vertex_is_split_where_its_texture_coordinates_differ() {
    let mesh =
        mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0 0\nvt 0.5\nf 1/1 2/2 3/3\nf 1/1 3/3 2/1\n");
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.vertices[3], mesh.vertices[1]);
    assert_eq!(
        mesh.texture_coordinates,
        [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [0.0, 0.0]]
    );
}

#[test]
fn a_vertex_is_split_where_its_normals_differ() {
    let text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 0 3 4\nf 1//1 2//1 3//1\nf 1//1 3//-1 2//1\n";
    let mesh = mesh(text);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 3, 1]]);
    assert_eq!(mesh.vertices[3], mesh.vertices[2]);
    let up = [0.0, 0.0, 1.0];
    assert_eq!(mesh.normals, [up, up, up, [0.0, 0.6, 0.8]]);
}

#[test]
fn normals_are_left_out_unless_every_corner_has_one() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
    for rest in [
        "f 1//1 2//1 3\n",
        "vn 0 0 0\nf 1//1 2//1 3//2\n",
        "vn 0 0 nan\nf 1//1 2//1 3//2\n",
        "vn 0 1\nf 1//1 2//1 3//2\n",
    ] {
        let file = read(format!("{points}{rest}").as_bytes()).unwrap();
        let mesh = &file.parts[0].mesh;
        assert!(
            mesh.normals.is_empty() && mesh.vertices.len() == 3,
            "{rest}"
        );
        assert_eq!(file.warnings, [normals::LEFT_OUT]);
    }
}

#[test]
fn lines_are_continued_and_comments_cut() {
    let text = b"v 0 0 0 # \xff origin\r\nv 1 0 0\r\nv 0 \\\r\n1 0\r\nf 1 2 \\\n 3";
    let file = read(text).unwrap();
    let mesh = &file.parts[0].mesh;
    assert_eq!(mesh.vertices[2], Point::new(0.0, 1.0, 0.0));
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn colours_of_vertices_are_made_linear() {
    let file = read(b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0.5 0.5 0.5\nf 1 2 3\n").unwrap();
    let colors = &file.parts[0].mesh.colors;
    assert_eq!(colors[0], [1.0, 0.0, 0.0, 1.0]);
    // ((.5 + .055)/1.055)^2.4
    assert!((colors[2][1] - 0.214_041_14).abs() < 1e-7);
    assert_eq!(file.parts[0].material, Some(0));
    assert_eq!(file.warnings, ["vertex colours are read as sRGB"]);
}

const TWO_MATERIALS: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\ng one\nf 1 2 3\nusemtl lamp\nf 3 2 1\n\
g two\nusemtl red\nf 2 3 1\nusemtl none\n";

#[test]
fn faces_of_one_material_are_one_mesh() {
    let library = "newmtl lamp\nKd 0 0 0\nKe 2 4 6\nnewmtl red\nKd 0.5 0.25 0.25\nKs 1 1 1\n";
    let file = read_with(TWO_MATERIALS.as_bytes(), library).unwrap();
    let names: Vec<_> = file
        .parts
        .iter()
        .map(|part| {
            part.material
                .map(|index| file.materials[index].material.name.as_str())
        })
        .collect();
    assert_eq!(names, [None, Some("red"), Some("lamp")]);
    assert_eq!(file.parts[1].mesh.triangles, [[0, 1, 2], [1, 2, 0]]);
    let MaterialModel::Lambertian { reflectance } = &file.materials[0].material.model else {
        panic!("not Lambertian")
    };
    assert_eq!(reflectance.factor, LaneValues::Rgb([0.5, 0.25, 0.25]));
    let emission = file.materials[1].emission.as_ref().unwrap();
    assert_eq!(emission.spectrum, Some(LaneValues::Rgb([2.0, 4.0, 6.0])));
    assert_eq!(
        file.warnings,
        ["gloss (Ks) is left out, the reflection is diffuse: red"]
    );
    let alone = read(TWO_MATERIALS.as_bytes()).unwrap();
    assert!(alone.materials.is_empty());
    assert_eq!(
        alone.warnings,
        [
            "no material library defines `red`",
            "no material library defines `lamp`"
        ]
    );
    let absent = read(TWO_MATERIALS.replace("a.mtl", "b.mtl").as_bytes()).unwrap();
    assert_eq!(
        absent.warnings[0],
        "cannot read the material library b.mtl: no such file"
    );
}

#[test]
fn errors_of_a_library_name_it() {
    let error = read_with(TWO_MATERIALS.as_bytes(), "newmtl red\nKd 1 2\n").unwrap_err();
    assert_eq!(
        error.to_string(),
        "a.mtl, line 2: expected a colour of one or three numbers, 0 or more, found \"Kd 1 2\""
    );
}

#[test]
fn errors_name_their_line() {
    for (text, line, expected) in [
        ("v 0 0\n", 1, ObjFault::Vertex("v 0 0".into())),
        ("v 0 0 nan\n", 1, ObjFault::Vertex("v 0 0 nan".into())),
        ("v 0 x 0\n", 1, ObjFault::Vertex("v 0 x 0".into())),
        (
            "\nvt 1e99 0\n",
            2,
            ObjFault::Coordinates("vt 1e99 0".into()),
        ),
        (
            "\n\n\nf 1 2\n",
            4,
            ObjFault::NoSuchVertex {
                number: 1,
                vertices: 0,
            },
        ),
        ("curv 0 1 1 2\n", 1, ObjFault::FreeForm("curv".into())),
        ("# nothing\n\n", 3, ObjFault::NoFace),
    ] {
        assert_eq!(fault(text), (line, expected), "{text}");
    }
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let missing = |number| ObjFault::NoSuchVertex {
        number,
        vertices: 3,
    };
    for (face, expected) in [
        ("f 1 2", ObjFault::TooFewCorners(2)),
        ("f 1 2 4", missing(4)),
        ("f 0 1 2", missing(0)),
        ("f -4 1 2", missing(-4)),
        ("f 1 2 /3", ObjFault::Corner("/3".into())),
        (
            "f 1 2 3//1",
            ObjFault::NoSuchNormal {
                number: 1,
                normals: 0,
            },
        ),
        (
            "f 1 2 3/1",
            ObjFault::NoSuchCoordinates {
                number: 1,
                coordinates: 0,
            },
        ),
    ] {
        assert_eq!(
            fault(&format!("{vertices}{face}\n")),
            (4, expected),
            "{face}"
        );
    }
}

proptest! {
    #[test]
    fn any_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), library in ".{0,80}") {
        let _ = read_with(&bytes, &library);
    }

    #[test]
    fn any_statements_give_indices_in_range(
        lines in prop::collection::vec("(v|f|vt|vn|usemtl|curv)( (-?[0-9]{1,2}|1e999|x|/|1/2/3|2/1)){0,6}", 0..20),
        library in prop::collection::vec("(newmtl|Kd|Ke|Ks|d|Tr|illum|map_Kd)( (-?[0-9]{1,2}|1e999|x|-s)){0,4}", 0..20),
    ) {
        let text = format!("mtllib a.mtl\n{}", lines.join("\n"));
        if let Ok(file) = read_with(text.as_bytes(), &library.join("\n")) {
            for part in &file.parts {
                let mesh = &part.mesh;
                prop_assert!(mesh.triangles.iter().flatten().all(|index| (*index as usize) < mesh.vertices.len()));
                prop_assert!(mesh.vertices.iter().all(|vertex| vertex.is_finite()));
                prop_assert!(part.material.is_none_or(|material| material < file.materials.len()));
                let coordinates = mesh.texture_coordinates.len();
                prop_assert!(coordinates == 0 || coordinates == mesh.vertices.len());
                prop_assert!(mesh.normals.is_empty() || mesh.normals.len() == mesh.vertices.len());
            }
        }
    }
}
