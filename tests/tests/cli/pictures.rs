//! What `render` writes.

use steradian_tests::command::{Folder, steradian};

const SMALL: [&str; 4] = ["--resolution", "32x24", "--samples", "16"];

fn render(folder: &Folder, name: &str, more: &[&str]) -> Vec<u8> {
    let file = folder.path(name);
    let arguments = [
        &["render", "scenes/cornell-box.toml", "-o", &file],
        SMALL.as_slice(),
        more,
    ]
    .concat();
    steradian(&arguments).fine();
    std::fs::read(&file).unwrap()
}

#[test]
fn every_format_is_written() {
    let folder = Folder::new();
    assert!(render(&folder, "a.png", &[]).starts_with(b"\x89PNG"));
    assert!(render(&folder, "b.exr", &[]).starts_with(&[0x76, 0x2f, 0x31, 0x01]));
    assert!(render(&folder, "c.hdr", &[]).starts_with(b"#?RADIANCE"));
    assert!(render(&folder, "d.pfm", &[]).starts_with(b"PF\n32 24\n"));
    assert_eq!(
        folder.names(),
        ["a.png", "b.exr", "c.hdr", "d.error.pfm", "d.pfm"]
    );
}

#[test]
fn false_colours_have_a_legend() {
    let folder = Folder::new();
    let plain = render(&folder, "a.png", &[]);
    let coloured = render(&folder, "b.png", &["--false-colour"]);
    let width = |png: &[u8]| u32::from_be_bytes(png[16..20].try_into().unwrap());
    assert_eq!(width(&plain), 32);
    assert!(width(&coloured) > 32);
}

#[test]
fn threads_and_instruction_sets_do_not_matter() {
    let folder = Folder::new();
    let one = render(&folder, "a.exr", &["--threads", "1"]);
    for (threads, set) in [("2", "auto"), ("7", "scalar")] {
        assert!(
            render(
                &folder,
                "b.exr",
                &["--threads", threads, "--instruction-set", set]
            ) == one,
            "{threads} {set}"
        );
    }
}

#[test]
fn merged_parts_are_the_whole() {
    let folder = Folder::new();
    let whole = render(&folder, "whole.exr", &[]);
    let files = [1, 2, 3].map(|part| {
        let name = format!("part{part}");
        render(&folder, &name, &["--shard", &format!("{part}/3")]);
        folder.path(&name)
    });
    let [one, two, three] = files.each_ref().map(String::as_str);
    let merged = folder.path("merged.exr");
    steradian(&["merge", two, three, one, "-o", &merged]).fine();
    assert!(std::fs::read(merged).unwrap() == whole);
}

#[test]
fn every_camera_and_filter_makes_a_picture() {
    let folder = Folder::new();
    let file = folder.path("a.pfm");
    let cameras = [
        ("perspective", "gaussian"),
        ("lens", "box"),
        ("plan", "blackman-harris"),
        ("panorama", "gaussian"),
        ("equidistant", "blackman-harris"),
        ("equisolid", "box"),
        ("hemispherical", "gaussian"),
    ];
    for (camera, filter) in cameras {
        let chosen = ["--camera", camera, "--filter", filter, "-o", &file];
        let arguments = [
            &["render", "scenes/cameras.toml"],
            SMALL.as_slice(),
            &chosen,
        ]
        .concat();
        steradian(&arguments).fine();
        let bytes = std::fs::read(&file).unwrap();
        let header = b"PF\n32 24\n-1.0\n";
        assert!(bytes.starts_with(header), "{camera}");
        let floats = bytes[header.len()..].chunks_exact(4);
        let values: Vec<f32> = floats
            .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
            .collect();
        assert!(values.iter().all(|value| *value >= 0.0), "{camera}");
        // The circle of diameter 24 and the reach of the filters leave the two sides of 32 × 24 pixels.
        let lit = values.iter().filter(|value| **value > 0.0).count() as f64 / values.len() as f64;
        let is_circle = ["equidistant", "equisolid", "hemispherical"].contains(&camera);
        assert!(lit < 0.93 && is_circle || lit == 1.0, "{camera}: {lit}");
    }
}
