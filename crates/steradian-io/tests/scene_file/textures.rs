//! Textures of reflectance, emission and opacity; materials of mesh files.

use std::path::Path;
use std::sync::Arc;

use steradian::scene::description::*;
use steradian_io::diagnostic::render;
use steradian_io::scene_file::{read_scene, read_scene_str};

use crate::{describe, files, problems};

const EVERY_KEY: &str = include_str!("every-key.toml");

fn material(name: &str) -> MaterialDescription {
    let materials = describe(EVERY_KEY).materials;
    let found = materials.into_iter().find(|material| material.name == name);
    found.unwrap_or_else(|| panic!("no material {name}"))
}

fn reflectance(name: &str) -> Varying {
    match material(name).model {
        MaterialModel::Lambertian { reflectance } => reflectance,
        model => panic!("{model:?}"),
    }
}

#[test]
fn a_picture_is_laid_and_multiplied() {
    let Varying { factor, textures } = reflectance("pictured");
    assert_eq!(factor, LaneValues::Uniform(0.5));
    let [
        Texture {
            pattern: Pattern::Bitmap(picture),
            placement,
        },
    ] = &textures[..]
    else {
        panic!("{textures:?}")
    };
    assert_eq!(
        picture.at([0.2, 0.3]),
        [128.5 / 256.0, 128.5 / 256.0, 128.5 / 256.0, 1.0]
    );
    assert_eq!(picture.wrap, [Wrap::Mirror; 2]);
    assert_eq!(picture.interpolation, Interpolation::Nearest);
    assert_eq!(*placement, Placement([[2.0, 0.0, 0.5], [0.0, 3.0, 0.0]]));
}

#[test]
fn squares_and_vertices_have_colours() {
    let bands = LaneValues::Bands(vec![("visible".into(), 0.5), ("nir".into(), 0.0)]);
    let squares = reflectance("checked");
    assert_eq!(
        squares.textures[0].pattern,
        Pattern::Checkerboard([bands, LaneValues::Uniform(0.25)])
    );
    assert_eq!(squares.textures[0].placement.at([0.25, 1.0]), [2.0, 8.0]);
    assert_eq!(
        reflectance("coloured").textures[0].pattern,
        Pattern::VertexColor
    );
    assert_eq!(reflectance("coloured").factor, LaneValues::Uniform(0.5));
}

#[test]
fn opacity_is_a_number_or_the_grey_of_a_picture() {
    let plain = material("plain").opacity.unwrap();
    assert_eq!(
        (plain.factor, plain.textures.len(), plain.cutoff),
        (0.5, 0, None)
    );
    let pictured = material("shiny").opacity.unwrap();
    assert_eq!((pictured.factor, pictured.cutoff), (0.5, Some(0.25)));
    let Pattern::Bitmap(picture) = &pictured.textures[0].pattern else {
        panic!("{pictured:?}")
    };
    assert_eq!(picture.at([0.0, 0.0])[3], 128.5 / 256.0);
    assert_eq!(picture.wrap, [Wrap::Clamp; 2]);
}

#[test]
fn emission_varies_too() {
    let shapes = describe(EVERY_KEY).shapes;
    let pattern = |index: usize| {
        let emission = shapes[index].emission.as_ref().unwrap();
        emission.textures[0].pattern.clone()
    };
    assert!(matches!(pattern(1), Pattern::Bitmap(_)));
    assert!(matches!(pattern(2), Pattern::Checkerboard(_)));
    assert_eq!(pattern(5), Pattern::VertexColor);
}

#[test]
fn what_is_wrong_with_a_texture_is_shown_at_its_key() {
    let scene = |reflectance: &str, opacity: &str| {
        format!(
            "[materials.a]\nmodel = \"lambertian\"\nreflectance = {reflectance}\nopacity = {opacity}\n"
        )
    };
    for (reflectance, opacity, at, says) in [
        (
            "{ texture = \"none.png\" }",
            "1",
            "\"none.png\"",
            "cannot read none.png: no such file",
        ),
        (
            "{ texture = \"broken.obj\" }",
            "1",
            "\"broken.obj\"",
            "broken.obj: expected a PNG, JPEG, OpenEXR or Radiance HDR picture",
        ),
        (
            "{ texture = \"parts/half.hdr\", scale = [1, 2, 3] }",
            "1",
            "[1, 2, 3]",
            "expected an array of 2",
        ),
        (
            "{ texture = \"parts/half.hdr\", wrap = \"clamped\" }",
            "1",
            "\"clamped\"",
            "expected one of \"repeat\", \"mirror\", \"clamp\"",
        ),
        (
            "{ texture = \"parts/half.hdr\", encoding = \"gamma\" }",
            "1",
            "\"gamma\"",
            "expected one of \"srgb\", \"linear\"",
        ),
        (
            "{ checkerboard = [1, 0], wrap = \"clamp\" }",
            "1",
            "wrap",
            "unknown key `wrap` of a checkerboard",
        ),
        (
            "{ checkerboard = [1] }",
            "1",
            "[1]",
            "expected an array of 2",
        ),
        ("{ vertex_color = false }", "1", "false", "expected true"),
        (
            "1",
            "\"half\"",
            "\"half\"",
            "expected a number without a unit",
        ),
        (
            "1",
            "{ texture = \"parts/half.hdr\", encoding = \"srgb\" }",
            "encoding",
            "unknown key `encoding`",
        ),
        (
            "1",
            "{ cutoff = 0.5 }",
            "{ cutoff = 0.5 }",
            "missing key `texture`",
        ),
    ] {
        let text = scene(reflectance, opacity);
        let found = problems(&text);
        assert_eq!(
            found.len(),
            1,
            "{reflectance} {opacity}: {}",
            render(&found, false)
        );
        assert_eq!(
            &text[found[0].span.clone().unwrap()],
            at,
            "{}",
            found[0].message
        );
        assert!(found[0].message.contains(says), "{}", found[0].message);
    }
}

#[test]
fn sides_have_an_opacity_each() {
    let found = problems("[materials.a]\nfront = \"b\"\nback = \"b\"\nopacity = 0.5\n");
    assert_eq!(found.len(), 1, "{}", render(&found, false));
    assert!(
        found[0]
            .message
            .contains("unknown key `opacity` of the two-sided material")
    );
}

const HOUSE: &str = "mtllib house.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wall\nf 1/1 2/1 3/1\nusemtl lamp\nf 3/1 2/1 1/1\n";
const HOUSE_MTL: &str = "newmtl wall\nKd 0.5 0.5 0.5\nmap_Kd -s 2 2 half.hdr\nmap_d half.hdr\nnewmtl lamp\nKd 0 0 0\nKe 3 3 3\nmap_Ke none.png\n";

fn house(rest: &str) -> SceneDescription {
    let files = files()
        .with("parts/house.obj", HOUSE)
        .with("parts/house.mtl", HOUSE_MTL);
    let text = format!(
        "[[shapes]]\nkind = \"mesh\"\nname = \"house\"\nfile = \"parts/house.obj\"\n{rest}"
    );
    read_scene_str("scene.toml", &text, &files)
        .unwrap_or_else(|problems| panic!("{}", render(&problems, false)))
        .description
}

#[test]
fn a_mesh_without_material_takes_those_of_its_file() {
    let scene = house("unit = \"mm\"\n");
    let of =
        |shape: &ShapeDescription| (shape.name.clone().unwrap(), shape.material.clone().unwrap());
    assert_eq!(
        scene.shapes.iter().map(of).collect::<Vec<_>>(),
        [
            ("house/wall".to_owned(), "parts/house.obj: wall".to_owned()),
            ("house/lamp".to_owned(), "parts/house.obj: lamp".to_owned())
        ]
    );
    assert_eq!(scene.materials.len(), 2);
    let MaterialModel::Lambertian { reflectance } = &scene.materials[0].model else {
        panic!("{:?}", scene.materials[0])
    };
    assert_eq!(reflectance.factor, LaneValues::Uniform(0.5));
    assert_eq!(reflectance.textures[0].placement.at([1.0, 0.0]), [2.0, 0.0]);
    assert_eq!(
        scene.materials[0].opacity.as_ref().unwrap().textures.len(),
        1
    );
    let emission = scene.shapes[1].emission.as_ref().unwrap();
    let Ok(radiance) = "3 W/(m2 sr)".parse() else {
        panic!("a radiance")
    };
    assert_eq!(emission.amount, EmissionAmount::Radiance(radiance));
    assert_eq!(
        scene.warnings,
        ["parts/house.obj: the texture none.png is left out: no such file"]
    );
}

#[test]
fn a_material_of_the_scene_covers_the_whole_mesh() {
    let scene =
        house("material = \"grey\"\n[materials.grey]\nmodel = \"lambertian\"\nreflectance = 0.5\n");
    let [shape] = &scene.shapes[..] else {
        panic!("{:?}", scene.shapes)
    };
    let GeometryDescription::Mesh(mesh) = &shape.geometry else {
        panic!("{shape:?}")
    };
    assert_eq!(
        (mesh.triangles.len(), mesh.texture_coordinates.len()),
        (2, 6)
    );
    assert_eq!(
        (shape.emission.is_none(), shape.name.as_deref()),
        (true, Some("house"))
    );
    assert_eq!(scene.materials.len(), 1);
}

#[test]
fn one_mesh_file_is_read_once() {
    let scene = house(
        "unit = \"m\"\n[[shapes]]\nkind = \"mesh\"\nfile = \"parts/house.obj\"\nunit = \"m\"\n",
    );
    assert_eq!((scene.shapes.len(), scene.materials.len()), (4, 2));
    let mesh = |index: usize| match &scene.shapes[index].geometry {
        GeometryDescription::Mesh(mesh) => Arc::clone(mesh),
        other => panic!("{other:?}"),
    };
    assert!(Arc::ptr_eq(&mesh(0), &mesh(2)) && !Arc::ptr_eq(&mesh(0), &mesh(1)));
}

#[test]
fn a_mesh_file_is_a_scene_by_itself() {
    let files = files()
        .with("house.obj", HOUSE)
        .with("house.mtl", HOUSE_MTL)
        .with("half.hdr", crate::HALF);
    let scene = read_scene(Path::new("house.obj"), &files)
        .unwrap()
        .description;
    let names: Vec<_> = scene
        .shapes
        .iter()
        .map(|shape| shape.name.as_deref())
        .collect();
    assert_eq!(names, [Some("wall"), Some("lamp")]);
    assert_eq!(scene.spectrum, SpectrumMode::Rgb);
    // One emits, so that no default light is added.
    assert!(scene.lights.is_empty() && scene.sensors.len() == 1);
    assert!(scene.warnings[0].starts_with("OBJ has no unit: its numbers are read as metres, y up"));
}
