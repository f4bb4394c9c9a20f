//! `trackdyn trial`: what a diagnosis sees of a trial, and what it does not.

use crate::Workplace;
use crate::plan::diagnosis;
use std::path::Path;
use std::time::SystemTime;

const MAKE: &str =
    "trial make --cases 2 --seed 424242 --duration 10 --out cases --key secret/answers.key";

/// A key.
pub const KEY: &str = "4b6579206f6620612074657374207472696c3a206e6f20736563726574206174";

/// Two nulls, which take the least time.
pub fn trial() -> Workplace {
    let place = Workplace::new();
    std::fs::create_dir(place.path().join("secret")).expect("a folder");
    place.write("secret/answers.key", KEY);
    let run = place.run(MAKE);
    assert_eq!(run.status, 0, "{}", run.stderr);
    place
}

fn text(place: &Workplace, name: &str) -> String {
    String::from_utf8(place.read(name)).expect("text")
}

/// A program in the place of the diagnosis, called `tool`, with this body; `$7` is the folder for
/// what it writes.
#[cfg(unix)]
pub fn tool(place: &Workplace, body: &str) -> String {
    use std::os::unix::fs::PermissionsExt;
    place.write("tool.sh", &format!("#!/bin/sh\n{body}\n"));
    let path = place.path().join("tool.sh");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("a program");
    path.display().to_string()
}

/// The answers of the trial `cases`, beside the key.
pub fn answers(place: &Workplace) -> String {
    let commitment = text(place, "cases/commitment.txt");
    let hash = commitment.split('"').nth(1).expect("a hash");
    format!("secret/answers.key.{}.toml", &hash[..8])
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
    let answers = answers(&place);
    assert!(text(&place, &answers).contains("stratum"), "they lie beside the key");

    let (again, other) = (Workplace::new(), Workplace::new());
    again.write("answers.key", KEY);
    for place in [&again, &other] {
        let run = place.run_with_threads(&MAKE.replace("secret/", ""), 1);
        assert_eq!(run.status, 0, "{}", run.stderr);
    }
    assert!(made(&place, "cases") == made(&again, "cases"));
    assert_eq!(place.read(&answers), again.read(answers.trim_start_matches("secret/")));
    let vehicle = |place: &Workplace| text(place, "cases/case-0001/vehicle.toml");
    assert_ne!(vehicle(&place), vehicle(&other), "a seed without its key leads to no case");
    assert_ne!(text(&other, "answers.key").trim(), KEY);
}

#[cfg(unix)]
#[test]
fn a_diagnosis_reaches_nothing_of_the_trial_and_is_scored_by_the_sealed_answers() {
    let place = trial();
    // what a process can know of where it is goes to the diagnosis' folder
    let spy = tool(
        &place,
        "{ pwd; echo \"$@\"; env; ls -aR; } > $7/seen.txt\n\
                            echo 'status = \"nothing-missing\"' > $7/diagnosis.toml",
    );
    let run = place.run(&format!("trial run cases --program {spy}"));
    assert_eq!((run.status, run.stdout.contains("2 diagnosed now")), (0, true), "{}", run.stderr);
    for case in ["case-0001", "case-0002"] {
        let seen = text(&place, &format!("cases/{case}/diagnosis.tool/seen.txt"));
        let here = place.path().display().to_string();
        assert!(
            !["case-", "answers", "secret", "424242", &here].iter().any(|w| seen.contains(w)),
            "{seen}"
        );
    }
    let run = place.run(&format!("trial run cases --program {spy}"));
    assert!(run.stdout.contains("0 diagnosed now, 0 failed, 2 before"), "{}", run.stdout);
    assert!(!run.stderr.contains("within reach"), "{}", run.stderr);

    // a key where a process may look for it is said to be there, and of what is not committed to
    // yet nothing is diagnosed
    place.write("cases.key", KEY);
    let run = place.run(&format!("trial run cases --program {spy}"));
    assert!(run.status == 0 && run.stderr.contains("cases.key is within reach"), "{}", run.stderr);
    std::fs::remove_file(place.path().join("cases.key")).expect("removed");
    let (there, away) = (place.path().join("cases/commitment.txt"), place.path().join("away"));
    std::fs::rename(&there, &away).expect("moved");
    let run = place.run(&format!("trial run cases --retry --program {spy}"));
    assert!(run.status == 1 && run.stderr.contains("commitment.txt"), "{}", run.stderr);
    std::fs::rename(away, there).expect("moved back");

    // the key is not where it would be looked for
    let run = place.run("trial score cases --name tool");
    assert!(run.status == 1 && run.stderr.contains("cases.key: no key"), "{}", run.stderr);
    let run = place.run("trial score cases --name tool --key secret/answers.key");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("| false claim: nulls | 0 of 2 |"), "{}", run.stdout);
    let commitment = text(&place, "cases/commitment.txt");
    let hash = commitment.split('"').nth(1).expect("a hash");
    assert!(run.stdout.ends_with(&format!("Answers: SHA-256 {hash}.\n")), "{}", run.stdout);
    let score = "trial score cases --name tool --key secret/answers.key --commitment";
    assert_eq!(place.run(&format!("{score} {hash}")).status, 0);
    let run = place.run(&format!("{score} {}", hash.chars().rev().collect::<String>()));
    assert!(run.status == 1 && run.stderr.contains("committed to elsewhere"), "{}", run.stderr);

    // another vehicle, another recording, and another commitment, do not pass
    let vehicle = text(&place, "cases/case-0002/vehicle.toml");
    place.write("cases/case-0002/vehicle.toml", &vehicle.replacen("mass_kg = ", "mass_kg = 1", 1));
    let run = place.run("trial score cases --name tool --key secret/answers.key");
    assert!(run.status == 1 && run.stderr.contains("case-0002"), "{}", run.stderr);
    assert!(run.stderr.contains("fingerprint"), "{}", run.stderr);
    place.write("cases/case-0002/vehicle.toml", &vehicle);
    let poses = text(&place, "cases/case-0001/recording/poses.csv");
    place.write("cases/case-0001/recording/poses.csv", &poses.replacen("0,0.", "0,1.", 1));
    let run = place.run("trial score cases --name tool --key secret/answers.key");
    assert!(run.status == 1 && run.stderr.contains("fingerprint"), "{}", run.stderr);
    place.write("cases/case-0001/recording/poses.csv", &poses);
    let (file, sealed) = (answers(&place), text(&place, &answers(&place)));
    place.write(&file, &sealed.replacen("plain-null", "hard-null", 1));
    let run = place.run("trial score cases --name tool --key secret/answers.key");
    assert!(run.status == 1 && run.stderr.contains("SHA-256"), "{}", run.stderr);
    place.write(&file, &sealed);
    assert_eq!(place.run("trial score cases --name tool --key secret/answers.key").status, 0);
    place.write(
        "cases/commitment.txt",
        &commitment.replacen("answers_sha256 = \"", "answers_sha256 = \"0", 1),
    );
    let run = place.run("trial score cases --name tool --key secret/answers.key");
    assert!(run.status == 1 && run.stderr.contains("SHA-256"), "{}", run.stderr);
}

#[cfg(unix)]
#[test]
fn a_process_that_fails_is_recorded_and_can_be_run_again() {
    let place = trial();
    let broken = tool(&place, "echo 'last words' >&2\nexit 3");
    let run = place.run(&format!("trial run cases --shard 2/2 --program {broken}"));
    assert!(run.stdout.contains("tool: 1 cases: 0 diagnosed now, 1 failed"), "{}", run.stdout);
    let failure = text(&place, "cases/case-0002/failure.tool.txt");
    assert!(failure.contains("exit status: 3") && failure.contains("last words"), "{failure}");
    // what the process has started ends with it
    let pid = place.path().join("pid");
    let slow = tool(&place, &format!("sleep 20 &\necho $! > {}\nwait", pid.display()));
    let run = place.run(&format!("trial run cases --shard 2/2 --retry --limit 1 --program {slow}"));
    assert!(run.stderr.contains("ended after 1 s"), "{}", run.stderr);
    let started = text(&place, "pid");
    let state = std::fs::read_to_string(format!("/proc/{}/stat", started.trim()));
    assert!(state.is_err() || state.is_ok_and(|state| state.contains(") Z ")), "it goes on");
    // links and pipes stay behind
    let odd = "echo 'status = \"ambiguous\"' > $7/diagnosis.toml\n\
               ln -s . $7/loop\nln -s nowhere $7/dangling\nmkfifo $7/pipe";
    let odd = tool(&place, odd);
    let run = place.run(&format!("trial run cases --shard 2/2 --retry --limit 20 --program {odd}"));
    assert!(run.stdout.contains("1 diagnosed now"), "{}{}", run.stdout, run.stderr);
    let taken = place.path().join("cases/case-0002/diagnosis.tool");
    assert!(taken.join("diagnosis.toml").exists() && !taken.join("loop").exists());
    std::fs::remove_dir_all(taken).expect("removed");
    let works = tool(&place, "echo 'status = \"ambiguous\"' > $7/diagnosis.toml");
    let run = place.run(&format!("trial run cases --retry --program {works}"));
    assert!(run.stdout.contains("2 diagnosed now"), "{}", run.stdout);
    assert!(!place.path().join("cases/case-0002/failure.tool.txt").exists());
}

/// The files of a trial's cases with their bytes, and the hash of its answers.
fn made(place: &Workplace, folder: &str) -> (Vec<(String, Vec<u8>)>, String) {
    let names = place.files().into_iter().map(|file| file.display().to_string());
    let cases = names.filter(|name| name.starts_with(&format!("{folder}/case-")));
    let files = cases.map(|name| (name[folder.len()..].to_owned(), place.read(&name)));
    let commitment = text(place, &format!("{folder}/commitment.txt"));
    (files.collect(), commitment.lines().next().expect("a hash").to_owned())
}

#[test]
fn an_interrupted_trial_is_taken_up_and_is_the_same_as_any_other() {
    const MAKE: &str = "trial make --cases 3 --seed 31 --duration 10 --out";
    let place = Workplace::new();
    place.write("whole.key", KEY);
    place.write("cases.key", KEY);
    assert_eq!(place.run_with_threads(&format!("{MAKE} whole"), 1).status, 0);
    let mut process = place
        .command(&format!("{MAKE} cases"))
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the program starts");
    let draft = place.path().join("cases.key.making");
    let is_there = |number: u32| draft.join(format!("case-000{number}")).exists();
    while !(1..=3).any(is_there) && process.try_wait().expect("a process").is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    process.kill().expect("it runs");
    process.wait().expect("it ends");
    let kept = (1..=3).filter(|number| is_there(*number)).count();
    // killed between the first case and the last
    assert!((1..3).contains(&kept), "{kept} cases");
    assert!(
        !place.files().iter().any(|file| file.starts_with("cases")),
        "nothing is there by halves"
    );

    for other in ["--cases 3 --seed 32", "--cases 4 --seed 31", "--cases 3 --seed 31"] {
        let run = place.run(&format!("trial make {other} --out cases"));
        assert!(
            run.status == 1 && run.stderr.contains("begun for 3 cases with seed 31"),
            "{}",
            run.stderr
        );
    }
    let run = place.run(&format!("{MAKE} cases"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stderr.contains(&format!("{kept} of 3 cases were there")), "{}", run.stderr);
    assert!(made(&place, "cases") == made(&place, "whole"));
    assert!(!draft.exists(), "answers do not lie about");
    let home = place.path().join("cases");
    assert_eq!(stamp(&home.join("case-0001")), stamp(&home.join("case-0003/vehicle.toml")));
}

#[cfg(unix)]
#[test]
fn several_programs_are_scored_side_by_side() {
    let place = trial();
    let says = |words: &str| tool(&place, &format!("echo '{words}' > $7/diagnosis.toml"));
    let nothing = says("status = \"nothing-missing\"");
    assert_eq!(place.run(&format!("trial run cases --name silent --program {nothing}")).status, 0);
    // as little as a program may write
    let slope = "schema = \"trackdyn.diagnosis/1\"\nstatus = \"explained\"\n[[missing]]\n\
                 effect = \"slope\"\none_of = [\"slope\"]\n\
                 parameters = [{ name = \"angle_deg\", value = 2 }]\n[fit]";
    let slope = says(slope);
    assert_eq!(place.run(&format!("trial run cases --name bold --program {slope}")).status, 0);
    let nonsense = says("status = \"perhaps\"");
    let run = place.run(&format!("trial run cases --name odd --program {nonsense}"));
    assert!(run.stdout.contains("odd: 2 cases: 0 diagnosed now, 2 failed"), "{}", run.stdout);
    assert_eq!(run.status, 2, "nothing came of it");
    let run = place.run(&format!("trial run cases --name odd --program {nonsense}"));
    assert!(run.stdout.contains("2 before (2 of them failed)"), "{}", run.stdout);
    let run = place.run("trial run cases --name x --program nowhere");
    assert!(run.status == 1 && run.stderr.contains("nowhere"), "{}", run.stderr);

    let run = place
        .run("trial score cases --key secret/answers.key --name silent --name bold --out both");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let row = run.stdout.lines().find(|line| line.contains("false claim: nulls |")).expect("a row");
    assert!(row.contains("| 0.0 % of 2 ") && row.contains("| 100.0 % of 2 "), "{row}");
    for file in ["power.png", "rates.png", "coverage.png", "bold/confusion.png"] {
        let png = place.read(&format!("both/{file}"));
        assert!(png.starts_with(b"\x89PNG"), "{file}");
    }
    assert!(text(&place, "both/bold/cases.csv").contains(",explained,slope,,true"));
    // a name that was never run may be mistyped, and opens nothing
    let run = place.run("trial score cases --key secret/answers.key --name slient");
    assert!(run.status == 1 && run.stderr.contains("answers stay sealed"), "{}", run.stderr);
    assert!(!place.path().join("cases/score.slient").exists());
    let run = place.run("trial score cases --key secret/answers.key --name odd");
    assert!(run.stdout.contains("| process failed | 2 of 2 |"), "{}", run.stdout);
}

#[cfg(unix)]
#[test]
fn several_trials_count_as_one() {
    let place = Workplace::new();
    for (seed, time, out) in [(3, 10, "first"), (4, 10, "second"), (5, 11, "longer")] {
        let make = format!("trial make --cases 2 --seed {seed} --duration {time} --out {out}");
        assert_eq!(place.run(&make).status, 0);
    }
    let silent = tool(&place, "echo 'status = \"nothing-missing\"' > $7/diagnosis.toml");
    for trial in ["first", "second", "longer"] {
        assert_eq!(place.run(&format!("trial run {trial} --program {silent}")).status, 0);
    }
    let run = place.run("trial score first second --name tool --out both");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("| false claim: nulls | 0 of 4 |"), "{}", run.stdout);
    let cases = text(&place, "both/cases.csv");
    // answers and cases are told apart by the hash that was committed to
    let (_, hash) = made(&place, "second");
    let hash = hash.split('"').nth(1).map(|hash| hash[..8].to_owned()).expect("a hash");
    assert!(place.path().join(format!("both/answers-{hash}.toml")).exists());
    assert!(cases.contains(&format!("\n{hash}/case-0002,")), "{cases}");
    assert_eq!(cases.lines().count(), 1 + 4);

    for (asked, words) in [
        ("first second", "--out DIR"),
        ("first second --key first.key --out x", "2 trials, 1 times --key"),
        ("first second --commitment 12 --out x", "2 trials, 1 times --commitment"),
        ("nowhere --out x", "nowhere: "),
        ("first first --out x", "trial = first: expected each trial once"),
        ("first longer --out x", "trial = longer: expected trials with runs of one length"),
        ("first second --key second.key --key first.key --out x", "SHA-256"),
    ] {
        let run = place.run(&format!("trial score {asked} --name tool"));
        assert!(run.status == 1 && run.stderr.contains(words), "{}", run.stderr);
    }
    assert!(!place.path().join("x").exists());
}

#[test]
fn what_a_diagnosis_leaves_open_is_driven_for() {
    let place = Workplace::new();
    place.write("cases.key", KEY);
    let run = place.run("trial make --cases 2 --seed 9 --duration 10 --out cases");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let run = place.run("trial drive cases");
    assert!(run.status == 2 && run.stdout.contains("nothing to drive for"), "{}", run.stderr);

    // a set that driving splits, and one of constants, which none does
    let sets: [&[&str]; 2] = [&["drivetrain-lag", "time-offset"], &["cog-shift", "friction-split"]];
    for (case, set) in ["case-0001", "case-0002"].into_iter().zip(sets) {
        let home = format!("cases/{case}");
        std::fs::create_dir(place.path().join(&home).join("diagnosis")).expect("a folder");
        place.write(&format!("{home}/diagnosis/diagnosis.toml"), &diagnosis("ambiguous", set));
        let vehicle = text(&place, &format!("{home}/vehicle.toml"));
        place.write(&format!("{home}/diagnosis/vehicle.corrected.toml"), &vehicle);
    }
    let run = place.run("trial drive cases --duration 20 --out driven");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("| a plan to drive: open sets | 1 of 1 |"), "{}", run.stdout);
    assert!(run.stdout.contains("failed: driven | 0 of 1 |"), "{}", run.stdout);
    let written = ["plan/plan.csv", "again/poses.csv", "diagnosis/diagnosis.toml"];
    let read = || written.map(|file| place.read(&format!("driven/case-0001/{file}")));
    let first = read();
    // what was driven is not driven again
    assert_eq!(place.run("trial drive cases --duration 20 --out driven").stdout, run.stdout);
    assert!(first == read() && !place.path().join("driven/case-0002").exists());
    let run = place.run("trial drive cases --duration 30 --out driven");
    assert!(run.status == 1 && run.stderr.contains("expected --duration 20"), "{}", run.stderr);
}

#[test]
fn a_trial_is_not_made_twice_and_its_key_not_into_its_folder() {
    let place = Workplace::new();
    let run = place.run("trial make --cases 1 --seed 1 --out cases --key cases/answers.key");
    assert!(run.status == 1 && run.stderr.contains("outside"), "{}", run.stderr);
    std::fs::create_dir(place.path().join("sub")).expect("a folder");
    let run = place.run("trial make --cases 1 --seed 1 --out cases --key sub/../cases/x.key");
    assert!(run.status == 1 && run.stderr.contains("outside"), "{}", run.stderr);
    std::fs::create_dir(place.path().join("cases")).expect("a folder");
    place.write("cases/commitment.txt", "");
    let run = place.run("trial make --cases 1 --seed 1 --out cases");
    assert!(run.status == 1 && run.stderr.contains("made once"), "{}", run.stderr);
    assert_eq!(place.run("trial run cases").status, 1);
    // nor is what was begun for one folder put over another trial
    std::fs::create_dir(place.path().join("other.key.making")).expect("a folder");
    let order = format!(
        "version = \"{}\"\nseed = 1\ncases = 1\nrun_time_s = 54.0\n\
         forms = \"drawn\"\n",
        env!("CARGO_PKG_VERSION")
    );
    place.write("other.key.making/order.toml", &order);
    place.write("other.key", KEY);
    let run = place.run("trial make --cases 1 --seed 1 --out cases --key other.key");
    assert!(run.status == 1 && run.stderr.contains("made once"), "{}", run.stderr);
    assert!(place.read("cases/commitment.txt").is_empty());
}
