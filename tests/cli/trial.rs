//! `trackdyn trial`: what a diagnosis sees of a trial, and what it does not.

use crate::Workplace;
use std::path::Path;
use std::time::SystemTime;

const MAKE: &str = "trial make --cases 2 --seed 424242 --out cases --key secret/answers.key";

/// Two nulls, which take the least time.
fn trial() -> Workplace {
    let place = Workplace::new();
    std::fs::create_dir(place.path().join("secret")).expect("a folder");
    let run = place.run(MAKE);
    assert_eq!(run.status, 0, "{}", run.stderr);
    place
}

fn text(place: &Workplace, name: &str) -> String {
    String::from_utf8(place.read(name)).expect("text")
}

/// A program in the place of the diagnosis, with this body; `$8` is the folder for what it writes.
#[cfg(unix)]
fn tool(place: &Workplace, body: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    place.write("tool.sh", &format!("#!/bin/sh\nmkdir -p $8\n{body}\n"));
    let path = place.path().join("tool.sh");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("a program");
    path.display().to_string()
}

fn stamp(path: &Path) -> SystemTime {
    std::fs::metadata(path).and_then(|file| file.modified()).expect("a stamp")
}

#[test]
fn cases_are_alike_outside_and_the_same_on_any_number_of_threads() {
    let place = trial();
    let files = place.files();
    let of = |case: &str| {
        let inside = files.iter().filter_map(|file| file.strip_prefix("cases").ok());
        let names = inside.filter_map(|file| file.strip_prefix(case).ok());
        names.map(|name| name.display().to_string()).collect::<Vec<_>>()
    };
    let expected =
        ["recording/poses.csv", "recording/recording.toml", "recording/tracks.csv", "vehicle.toml"];
    for case in ["case-0001", "case-0002"] {
        assert_eq!(of(case), expected);
        let home = place.path().join("cases").join(case);
        let first = stamp(&place.path().join("cases/case-0001/vehicle.toml"));
        assert!(expected.iter().all(|name| stamp(&home.join(name)) == first));
        assert_eq!(stamp(&home), first);
        for table in ["poses.csv", "tracks.csv"] {
            let table = text(&place, &format!("cases/{case}/recording/{table}"));
            let cells = table.lines().skip(1).flat_map(|line| line.split(','));
            let digits = cells.filter_map(|cell| Some(cell.split_once('.')?.1.len()));
            assert!(digits.max() == Some(6), "all numbers end with the same digit");
        }
        for file in expected {
            let text = text(&place, &format!("cases/{case}/{file}"));
            assert!(!["424242", "null", "seed", "secret"].iter().any(|word| text.contains(word)));
        }
    }
    let sealed = place.read("cases/answers.sealed");
    assert!(!sealed.windows(7).any(|part| part == b"stratum"));

    let again = Workplace::new();
    let run = again.run_with_threads(&MAKE.replace("secret/", ""), 1);
    assert_eq!(run.status, 0, "{}", run.stderr);
    for case in ["case-0001", "case-0002"] {
        for file in expected {
            let file = format!("cases/{case}/{file}");
            assert_eq!(place.read(&file), again.read(&file), "{file}");
        }
    }
    let hash = |place: &Workplace| {
        text(place, "cases/commitment.txt").lines().next().map(str::to_owned).expect("a hash")
    };
    assert_eq!(hash(&place), hash(&again));
    assert_ne!(sealed, again.read("cases/answers.sealed"), "no seed leads to the key");
}

#[cfg(unix)]
#[test]
fn a_diagnosis_reaches_nothing_of_the_trial_and_is_scored_by_the_sealed_answers() {
    let place = trial();
    // what a process can know of where it is goes to the diagnosis' folder
    let spy = tool(
        &place,
        "{ pwd; echo \"$@\"; env; ls -aR; } > $8/seen.txt\n\
                            echo 'status = \"nothing-missing\"' > $8/diagnosis.toml",
    );
    let run = place.run(&format!("trial run cases --tool {spy}"));
    assert_eq!((run.status, run.stdout.contains("2 diagnosed now")), (0, true), "{}", run.stderr);
    for case in ["case-0001", "case-0002"] {
        let seen = text(&place, &format!("cases/{case}/diagnosis/seen.txt"));
        let here = place.path().display().to_string();
        assert!(
            !["case-", "answers", "secret", "424242", &here].iter().any(|w| seen.contains(w)),
            "{seen}"
        );
    }
    let run = place.run(&format!("trial run cases --tool {spy}"));
    assert!(run.stdout.contains("0 diagnosed now, 0 failed, 2 before"), "{}", run.stdout);

    assert_eq!(
        place.run("trial score cases").status,
        1,
        "the key is not where it would be looked for"
    );
    let run = place.run("trial score cases --key secret/answers.key");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("| false claim: nulls | 0 of 2 |"), "{}", run.stdout);

    // another recording, and another commitment, do not pass
    let poses = text(&place, "cases/case-0001/recording/poses.csv");
    place.write("cases/case-0001/recording/poses.csv", &poses.replacen("0,0.", "0,1.", 1));
    let run = place.run("trial score cases --key secret/answers.key");
    assert!(run.status == 1 && run.stderr.contains("fingerprint"), "{}", run.stderr);
    let commitment = text(&place, "cases/commitment.txt");
    place.write(
        "cases/commitment.txt",
        &commitment.replacen("answers_sha256 = \"", "answers_sha256 = \"0", 1),
    );
    let run = place.run("trial score cases --key secret/answers.key");
    assert!(run.status == 1 && run.stderr.contains("SHA-256"), "{}", run.stderr);
}

#[cfg(unix)]
#[test]
fn a_process_that_fails_is_recorded_and_can_be_run_again() {
    let place = trial();
    let broken = tool(&place, "echo 'last words' >&2\nexit 3");
    let run = place.run(&format!("trial run cases --shard 2/2 --tool {broken}"));
    assert!(run.stdout.contains("1 cases: 0 diagnosed now, 1 failed"), "{}", run.stdout);
    let failure = text(&place, "cases/case-0002/failure.txt");
    assert!(failure.contains("exit status: 3") && failure.contains("last words"), "{failure}");
    let slow = tool(&place, "sleep 20");
    let run = place.run(&format!("trial run cases --shard 2/2 --retry --limit 1 --tool {slow}"));
    assert!(run.stderr.contains("ended after 1 s"), "{}", run.stderr);
    let works = tool(&place, "echo 'status = \"ambiguous\"' > $8/diagnosis.toml");
    let run = place.run(&format!("trial run cases --retry --tool {works}"));
    assert!(run.stdout.contains("2 diagnosed now"), "{}", run.stdout);
    assert!(!place.path().join("cases/case-0002/failure.txt").exists());
}

#[test]
fn a_trial_is_not_made_twice_and_its_key_not_into_its_folder() {
    let place = Workplace::new();
    let run = place.run("trial make --cases 1 --seed 1 --out cases --key cases/answers.key");
    assert!(run.status == 1 && run.stderr.contains("outside"), "{}", run.stderr);
    std::fs::create_dir(place.path().join("cases")).expect("a folder");
    place.write("cases/answers.sealed", "");
    let run = place.run("trial make --cases 1 --seed 1 --out cases");
    assert!(run.status == 1 && run.stderr.contains("made once"), "{}", run.stderr);
    assert_eq!(place.run("trial run cases").status, 1);
}
