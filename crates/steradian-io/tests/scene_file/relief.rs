//! Pictures that turn the normals of a material, and normals of mesh files.

use steradian::quantity::Length;
use steradian::scene::description::*;
use steradian_io::diagnostic::render;
use steradian_io::scene_file::read_scene_str;

use crate::{describe, files, problems};

const EVERY_KEY: &str = include_str!("every-key.toml");

fn relief_of(scene: &SceneDescription, name: &str) -> Option<Relief> {
    let mut materials = scene.materials.iter();
    let found = materials.find(|material| material.name == name);
    found.and_then(|material| material.relief.clone())
}

fn bitmap(texture: &Texture) -> &Bitmap {
    match &texture.pattern {
        Pattern::Bitmap(bitmap) => bitmap,
        other => panic!("{other:?}"),
    }
}

#[test]
fn normals_and_heights_are_linear_pictures() {
    let scene = describe(EVERY_KEY);
    let Some(Relief::Normals { picture, scale }) = relief_of(&scene, "varnish") else {
        panic!("{:?}", relief_of(&scene, "varnish"))
    };
    assert_eq!((scale, bitmap(&picture).wrap), (0.5, [Wrap::Mirror; 2]));
    assert_eq!(bitmap(&picture).at([0.2, 0.3])[0], 128.5 / 256.0);
    assert_eq!(
        picture.placement,
        Placement([[2.0, 0.0, 0.5], [0.0, 3.0, 0.0]])
    );
    let Some(Relief::Height { picture, scale }) = relief_of(&scene, "plaster") else {
        panic!("{:?}", relief_of(&scene, "plaster"))
    };
    assert_eq!(scale, Length::from_metres(0.002));
    assert_eq!(
        picture.placement,
        Placement([[3.0, 0.0, 0.0], [0.0, 2.0, 0.5]])
    );
}

#[test]
fn every_model_of_one_side_takes_either() {
    let file: toml::Table = EVERY_KEY.parse().unwrap();
    let materials = file["materials"].as_table().unwrap();
    for map in [
        "normal_map = { texture = \"parts/half.hdr\" }",
        "bump_map = { texture = \"parts/half.hdr\", height = 0.01 }",
    ] {
        let map: toml::Table = map.parse().unwrap();
        let mut turned = materials.clone();
        for (_, material) in turned.iter_mut() {
            let material = material.as_table_mut().unwrap();
            let is_one_sided = !material.contains_key("front");
            material.retain(|key, _| !key.ends_with("_map"));
            material.extend(is_one_sided.then(|| map.clone()).into_iter().flatten());
        }
        let text = toml::Table::from_iter([
            ("scene".to_owned(), file["scene"].clone()),
            ("materials".to_owned(), turned.into()),
        ]);
        for material in describe(&text.to_string()).materials {
            let is_one_sided = !matches!(material.model, MaterialModel::TwoSided { .. });
            assert_eq!(material.relief.is_some(), is_one_sided, "{}", material.name);
        }
    }
}

#[test]
fn what_is_wrong_with_a_map_is_shown_at_its_line() {
    let map = "{ texture = \"parts/half.hdr\" }";
    for (lines, line, says) in [
        (
            format!(
                "normal_map = {map}\nbump_map = {{ texture = \"parts/half.hdr\", height = \"1 mm\" }}"
            ),
            5,
            "keys `normal_map` and `bump_map` of a material exclude each other",
        ),
        (
            format!("bump_map = {map}"),
            4,
            "missing key `height` of a map of heights",
        ),
        (
            "normal_map = { texture = \"none.png\" }".into(),
            4,
            "cannot read none.png: no such file",
        ),
        (
            "bump_map = { texture = \"parts/half.hdr\", height = \"2 s\" }".into(),
            4,
            "expected a length",
        ),
        ("normal_map = 1".into(), 4, "expected a table"),
    ] {
        let head = "[materials.a]\nmodel = \"lambertian\"\nreflectance = 0.5\n";
        let found = problems(&format!("{head}{lines}\n"));
        let [problem] = &found[..] else {
            panic!("{found:?}")
        };
        assert!(problem.message.contains(says), "{}", problem.message);
        let at = render(&found, false);
        assert!(at.contains(&format!("scene.toml:{line}:")), "{at}");
    }
    let two_sided = "[materials.b]\nfront = \"a\"\nback = \"a\"\nnormal_map = { texture = \"parts/half.hdr\" }\n";
    let found = problems(two_sided);
    assert!(
        found
            .iter()
            .any(|problem| problem.message == "unknown key `normal_map` of the two-sided material"),
        "{found:?}"
    );
}

#[test]
fn normals_of_a_mesh_file_are_turned_with_it() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 0 -1\nvn 0 1 0\nf 1//1 2//1 3//1\n";
    let files = files().with("smooth.obj", text);
    let scene = "[[shapes]]\nkind = \"mesh\"\nfile = \"smooth.obj\"\nunit = \"mm\"\nup = \"y\"\n";
    let scene = read_scene_str("scene.toml", scene, &files)
        .unwrap()
        .description;
    let GeometryDescription::Mesh(mesh) = &scene.shapes[0].geometry else {
        panic!("{:?}", scene.shapes[0])
    };
    // Up in the file is y, here z; lengths stay 1 whatever the unit.
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 3]);
}
