//! A small sealed trial from end to end: two cases without concealed physics, and two with an
//! effect.
//!
//! Runs are short, so that it takes a minute instead of hours. The effects are as large as they
//! have to be for the same z.

use crate::trial::{KEY, answers};
use crate::{Run, Workplace};
use std::sync::atomic::{AtomicUsize, Ordering};

const CASES: usize = 4;
const MAKE: &str =
    "trial make --cases 4 --seed 11 --duration 10 --out cases --key secret/answers.key";

/// Smallest z of an effect that no diagnosis may miss.
const MIN_CLEAR_Z: f64 = 20.0;

/// What nulls may have beside physics: errors of encoders, clock and pose sensor, and the constants
/// that an owner's vehicle file may have wrong. All but plain ones have some, by design.
const NO_PHYSICS: [&str; 13] = [
    "bulldozing",
    "cog-shift",
    "cohesion",
    "drivetrain-lag",
    "encoder-scale",
    "friction-anisotropy",
    "friction-gradient",
    "friction-split",
    "heading-drift",
    "pressure-concentration",
    "sensor-lever-arm",
    "sensor-yaw",
    "time-offset",
];

/// A line of `cases.csv`.
struct Line {
    stratum: String,
    concealed: String,
    z_det: Option<f64>,
    status: String,
    /// Named sets.
    named: Vec<Vec<String>>,
}

fn lines(csv: &str) -> Vec<Line> {
    let line = |text: &str| {
        let cells: Vec<&str> = text.split(',').collect();
        let set = |set: &str| set.split('|').map(str::to_owned).collect();
        Line {
            stratum: cells[1].to_owned(),
            concealed: cells[2].to_owned(),
            z_det: cells[3].parse().ok(),
            status: cells[6].to_owned(),
            named: cells[7].split_whitespace().map(set).collect(),
        }
    };
    csv.lines().skip(1).map(line).collect()
}

/// Diagnoses all cases by two processes at a time, each of which takes the next one.
fn diagnose(place: &Workplace) {
    let next = AtomicUsize::new(1);
    let work = || {
        let cases = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        for case in cases.take_while(|case| *case <= CASES) {
            let shard = format!("trial run cases --shard {case}/{CASES}");
            let run = place.run_with_threads(&shard, 1);
            assert_eq!(run.status, 0, "{}", run.stderr);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(work);
        }
    });
}

#[test]
fn a_small_sealed_trial() {
    let place = Workplace::new();
    std::fs::create_dir(place.path().join("secret")).expect("a folder");
    let text = |name: &str| String::from_utf8(place.read(name)).expect("text");
    let done = |run: Run| assert_eq!(run.status, 0, "{}", run.stderr);
    place.write("secret/answers.key", KEY);
    done(place.run(MAKE));
    let commitment = text("cases/commitment.txt");

    // nothing of the answers is in the folder of the trial
    let secrets = ["stratum", "concealed", "z_det", "seed"];
    for file in place.files().iter().filter(|file| file.starts_with("cases")) {
        let bytes = place.read(&file.display().to_string());
        let holds = |secret: &str| bytes.windows(secret.len()).any(|w| w == secret.as_bytes());
        assert!(!secrets.iter().any(|secret| holds(secret)), "{}", file.display());
    }

    // no diagnosis can read them: they are nowhere while it runs, and neither is the key
    let answers = answers(&place);
    let sealed = place.read(&answers);
    std::fs::remove_dir_all(place.path().join("secret")).expect("they were there");
    diagnose(&place);
    let run = place.run("trial score cases --key secret/answers.key --out score");
    assert!(run.status == 1 && run.stderr.contains(&answers), "{}", run.stderr);
    std::fs::create_dir(place.path().join("secret")).expect("a folder");
    std::fs::write(place.path().join(&answers), sealed).expect("written");
    place.write("secret/answers.key", KEY);
    done(place.run("trial score cases --key secret/answers.key --out score"));
    let (opened, rates) = (text("score/answers.toml"), text("score/rates.csv"));
    let cases = lines(&text("score/cases.csv"));
    assert_eq!(cases.len(), CASES);
    assert_eq!(opened.matches("[[case]]").count(), CASES);

    // the answers are those that were committed to, and the commitment was not touched
    assert_eq!(commitment, text("cases/commitment.txt"));

    // no physics is named on nulls
    let nulls: Vec<&Line> = cases.iter().filter(|case| case.stratum.ends_with("null")).collect();
    let is_physics = |set: &Vec<String>| !set.iter().any(|id| NO_PHYSICS.contains(&id.as_str()));
    let false_claims = nulls.iter().filter(|case| case.named.iter().any(is_physics)).count();
    assert!(nulls.len() == 2 && false_claims == 0, "{false_claims} of {}", nulls.len());

    // scores are well-formed
    for line in rates.lines().skip(1) {
        let (_, numbers) = line.rsplit_once("\",").expect("a quoted name");
        let numbers: Vec<f64> = numbers.split(',').filter_map(|cell| cell.parse().ok()).collect();
        match numbers.as_slice() {
            [_, cases] => assert_eq!(*cases, 0.0, "{line}"),
            [successes, cases, share, low, high] => {
                assert!(successes <= cases && (share - successes / cases).abs() < 1e-4, "{line}");
                assert!(0.0 <= *low && low <= share && share <= high && *high <= 1.0, "{line}");
            }
            _ => panic!("{line}"),
        }
    }
    let statuses = ["explained", "nothing-missing", "ambiguous", "unexplained"];
    assert!(cases.iter().all(|case| statuses.contains(&case.status.as_str())), "none failed");

    // what stands out far is named
    let clear = cases.iter().filter(|case| case.stratum == "single");
    let is_clear = |case: &&Line| case.z_det.is_some_and(|z| z >= MIN_CLEAR_Z);
    let clear: Vec<&Line> = clear.filter(is_clear).collect();
    let is_named = |case: &&&Line| case.named.iter().any(|set| set.contains(&case.concealed));
    let named = clear.iter().filter(is_named).count();
    assert!(named >= 1 && named == clear.len(), "{named} of {}", clear.len());
}
