//! The same scene and seed give the same bytes, however the work was split.

use steradian_tests::command::{Folder, steradian};

const SCENE: &str = "scenes/closed-room.toml";

fn bytes(scene: &str, more: &[&str]) -> String {
    let arguments = [&["measure", scene, "--format", "json"], more].concat();
    steradian(&arguments).fine()
}

#[test]
fn threads_do_not_matter() {
    for stop in [&["--samples", "8192"], &["--rel-error", "5%"]] {
        let one = bytes(SCENE, &[stop.as_slice(), &["--threads", "1"]].concat());
        for threads in ["2", "7"] {
            assert_eq!(
                bytes(SCENE, &[stop.as_slice(), &["--threads", threads]].concat()),
                one,
                "{threads} threads"
            );
        }
    }
}

#[test]
fn instruction_sets_do_not_matter() {
    let plain = bytes(SCENE, &["--samples", "8192", "--instruction-set", "scalar"]);
    assert_eq!(
        bytes(SCENE, &["--samples", "8192", "--instruction-set", "auto"]),
        plain
    );
}

#[test]
fn a_seed_matters() {
    let zero = bytes(SCENE, &["--samples", "1024"]);
    assert_eq!(bytes(SCENE, &["--samples", "1024", "--seed", "0"]), zero);
    assert_ne!(bytes(SCENE, &["--samples", "1024", "--seed", "1"]), zero);
}

fn merged_equals_whole(scene: &str, stop: &[&str]) {
    let folder = Folder::new();
    let files = [1, 2, 3].map(|part| {
        let (file, part) = (folder.path(&format!("part{part}")), format!("{part}/3"));
        let arguments = [&["measure", scene, "--shard", &part, "-o", &file], stop].concat();
        steradian(&arguments).fine();
        file
    });
    let whole = folder.path("whole.json");
    let [one, two, three] = files.each_ref().map(String::as_str);
    steradian(&["merge", three, one, two, "-o", &whole]).fine();
    assert_eq!(std::fs::read_to_string(&whole).unwrap(), bytes(scene, stop));
}

#[test]
fn merged_parts_are_the_whole() {
    merged_equals_whole(SCENE, &["--samples", "8192"]);
    merged_equals_whole("scenes/furnace.toml", &["--rel-error", "1%"]);
}
