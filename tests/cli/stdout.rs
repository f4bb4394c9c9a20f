//! Results and talk behind a closed pipe or on a full disk: no panic, and nothing that was asked
//! for is lost.

use crate::Workplace;
use std::path::PathBuf;
use std::process::{Output, Stdio};

/// Runs `trackdyn` with this for stdout, or with a pipe that nobody reads.
fn run(place: &Workplace, arguments: &str, stdout: Option<Stdio>) -> Output {
    let is_closed = stdout.is_none();
    let mut child = place
        .command(arguments)
        .stdout(stdout.unwrap_or_else(Stdio::piped))
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    if is_closed {
        drop(child.stdout.take());
    }
    child.wait_with_output().expect("an end")
}

/// What a command writes beside what it prints.
const FILES: [(&str, &[&str]); 3] = [
    ("map --grid 3 --out out", &["out/icr_map.png", "out/kinematics.toml"]),
    ("effects --markdown", &[]),
    ("completions bash", &[]),
];

#[test]
fn a_reader_that_leaves_costs_no_file() {
    for (command, files) in FILES {
        let place = Workplace::new();
        let output = run(&place, command, None);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{command}: {stderr}");
        assert!(!stderr.contains("panic"), "{command}: {stderr}");
        assert_eq!(place.files(), files.iter().map(PathBuf::from).collect::<Vec<_>>());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_costs_no_file() {
    for (command, files) in FILES {
        let place = Workplace::new();
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full disk");
        let output = run(&place, command, Some(full.into()));
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{command}: {stderr}");
        assert!(stderr.contains("error: stdout: "), "{command}: {stderr}");
        assert_eq!(place.files(), files.iter().map(PathBuf::from).collect::<Vec<_>>());
    }
}

/// Notes and errors that nobody hears cost neither a file nor the status.
#[cfg(target_os = "linux")]
#[test]
fn talk_on_a_full_disk_is_dropped() {
    let map = ["out/icr_map.png", "out/kinematics.toml"];
    for (command, status, files) in
        [("map --grid 3 --out out", 0, &map[..]), ("map --grid 0 --out out", 1, &[])]
    {
        let place = Workplace::new();
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full disk");
        let run = place.command(command).stderr(full).output().expect("the program starts");
        assert_eq!(run.status.code(), Some(status), "{command}");
        assert_eq!(place.files(), files.iter().map(PathBuf::from).collect::<Vec<_>>());
    }
}

/// The command line stands in files; a path that is no text does not end the program.
#[cfg(unix)]
#[test]
fn a_path_that_is_no_text_is_a_path() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let place = Workplace::new();
    let output = place
        .command("map --grid 3 --out")
        .arg(OsStr::from_bytes(b"nu\xff"))
        .output()
        .expect("the program starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(place.files().len(), 2);
}
