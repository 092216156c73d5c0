//! Runs that end before their time.

use std::process::{Command, Stdio};
use steradian_tests::command::{program, root};

fn start(arguments: &[&str]) -> std::process::Child {
    let mut command = Command::new(program());
    command
        .current_dir(root())
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command.spawn().unwrap()
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_what_there_is() {
    let arguments = [
        "measure",
        "scenes/closed-room.toml",
        "--rel-error",
        "1e-7",
        "--format",
        "json",
    ];
    let child = start(&arguments);
    std::thread::sleep(std::time::Duration::from_secs(1));
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(
        output.status.code(),
        Some(1),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(result["converged"], false);
    assert!(String::from_utf8_lossy(&output.stderr).contains("Ctrl-C"));
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let mut child = start(&["help", "scene"]);
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
