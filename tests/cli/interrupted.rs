//! A diagnosis that is broken off, and recordings with too little in them: nothing half done is
//! left.

use crate::Workplace;
use std::path::PathBuf;

/// Driving of this many runs and seconds.
fn drive(place: &Workplace, options: &str) {
    let run = place.run(&format!("simulate --quasi-static {options} --out drive"));
    assert_eq!(run.status, 0, "{}", run.stderr);
}

/// Files below a folder; none where there is no folder.
fn files_in(place: &Workplace, folder: &str) -> Vec<PathBuf> {
    place.files().into_iter().filter(|file| file.starts_with(folder)).collect()
}

#[cfg(unix)]
mod signals {
    use super::{drive, files_in};
    use crate::Workplace;
    use crate::trial::{tool, trial};
    use std::os::unix::process::ExitStatusExt;
    use std::process::{Child, Command, ExitStatus, Stdio};
    use std::time::{Duration, Instant};

    const DIAGNOSE: &str = "diagnose drive --vehicle drive/vehicle.toml --out found";

    fn start(place: &Workplace, command: &str) -> Child {
        place
            .command(command)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts")
    }

    /// Sends a signal to a process; whether there is one. `-0` only asks.
    fn kill(signal: &str, id: &str) -> bool {
        Command::new("kill").args([signal, id]).output().expect("kill").status.success()
    }

    /// Presses Ctrl-C; gives how the process ended.
    fn interrupt(child: &mut Child) -> ExitStatus {
        assert!(kill("-INT", &child.id().to_string()));
        child.wait().expect("an end")
    }

    /// Waits until something is so, at most a minute.
    fn wait_until(is_so: impl Fn() -> bool) {
        let start = Instant::now();
        while !is_so() {
            assert!(start.elapsed() < Duration::from_secs(60), "it never came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn a_diagnosis_that_is_broken_off_leaves_no_file() {
        let place = Workplace::new();
        // Seconds of computing lie between the folder and the first file.
        drive(&place, "--runs 27");
        let before = place.files();
        let mut child = start(&place, DIAGNOSE);
        wait_until(|| place.path().join("found").exists());
        let status = interrupt(&mut child);
        assert!(!status.success(), "it was done already: {status}");
        assert_eq!(place.files(), before);
    }

    #[test]
    fn files_of_a_diagnosis_that_is_broken_off_while_it_writes_are_whole() {
        let place = Workplace::new();
        drive(&place, "--runs 2");
        let mut child = start(&place, DIAGNOSE);
        wait_until(|| place.path().join("found/diagnosis.toml").exists());
        interrupt(&mut child);
        for file in files_in(&place, "found") {
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            assert!(!name.starts_with('.'), "{name} is half written");
            let bytes = place.read(&file.to_string_lossy());
            match file.extension().and_then(|end| end.to_str()) {
                Some("toml") => {
                    let text = String::from_utf8(bytes).expect("text");
                    text.parse::<toml::Table>().expect("TOML to its end");
                }
                Some("png") => assert!(bytes.ends_with(b"IEND\xaeB`\x82"), "{name}"),
                Some("html") => assert!(bytes.trim_ascii_end().ends_with(b"</html>"), "{name}"),
                _ => panic!("{name} is none of a diagnosis"),
            }
        }
    }

    #[test]
    fn a_signal_ends_the_program_between_two_files() {
        // Some of these moments are in the middle of one of the nine files.
        let mut ended_by_signal = 0;
        for milliseconds in 0..30 {
            let place = Workplace::new();
            let command = "simulate --quasi-static --runs 40 --duration 5 --out drive";
            let mut child = start(&place, command);
            wait_until(|| !files_in(&place, "drive").is_empty());
            std::thread::sleep(Duration::from_millis(milliseconds));
            let status = interrupt(&mut child);
            let is_by_signal = status.signal() == Some(2);
            assert!(is_by_signal || status.success(), "{status}");
            ended_by_signal += u32::from(is_by_signal);
            for file in files_in(&place, "drive") {
                let name = file.file_name().expect("a name").to_string_lossy().into_owned();
                assert!(!name.starts_with('.'), "{name} is half written");
            }
        }
        assert!(ended_by_signal > 0, "no signal came before the end");
    }

    #[test]
    fn a_trial_that_is_broken_off_ends_its_process_and_leaves_no_room() {
        let place = trial();
        let (rooms, pid) = (place.path().join("rooms"), place.path().join("pid"));
        std::fs::create_dir(&rooms).expect("a folder");
        let slow = tool(&place, &format!("echo $$ > {}\nexec sleep 60", pid.display()));
        let mut process = place
            .command(&format!("trial run cases --program {slow}"))
            .env("TMPDIR", &rooms)
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let number = || std::fs::read_to_string(&pid).unwrap_or_default();
        wait_until(|| number().ends_with('\n'));
        assert!(kill("-0", number().trim()) && rooms.read_dir().expect("readable").count() == 1);
        assert_eq!(interrupt(&mut process).signal(), Some(2));
        assert!(!kill("-0", number().trim()), "the process of the case goes on");
        assert_eq!(rooms.read_dir().expect("readable").count(), 0);
    }
}

#[test]
fn a_recording_with_too_little_in_it_is_refused_with_what_is_missing() {
    for (options, held_out) in [
        ("--runs 1 --duration 3", ""),
        ("--runs 1 --duration 2", ""),
        ("--runs 2 --duration 6", "--held-out 0"),
    ] {
        let place = Workplace::new();
        drive(&place, options);
        let before = place.files();
        let vehicle = "--vehicle drive/vehicle.toml";
        let run = place.run(&format!("diagnose drive {vehicle} {held_out} --out found"));
        assert_eq!(run.status, 1, "{options}: {}", run.stdout);
        let message = "segments to learn from: expected at least 60, that is, some ";
        assert!(run.stderr.contains(message), "{options}: {}", run.stderr);
        let way = " s more of driving with turns both ways and changes of speed";
        assert!(run.stderr.contains(way), "{options}: {}", run.stderr);
        assert!(run.stdout.is_empty(), "{}", run.stdout);
        assert_eq!(place.files(), before, "{options}");
        // A folder is made where there is something to diagnose at all.
        assert_eq!(place.path().join("found").exists(), !held_out.is_empty(), "{options}");
    }
}
