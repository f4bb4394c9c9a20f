//! A small sealed trial from end to end: what holds whatever the power of the diagnosis.
//!
//! Runs are short, so that it takes minutes instead of hours; the effects are as large as they have
//! to be for the same z.

use crate::trial::KEY;
use crate::{Run, Workplace};
use std::sync::atomic::{AtomicUsize, Ordering};

const CASES: usize = 20;
const MAKE: &str =
    "trial make --cases 20 --seed 11 --duration 10 --out cases --key secret/answers.key";

/// z from which on an effect stands out far.
const FAR: f64 = 20.0;

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

/// Successes and cases of a rate.
fn rate(rates: &str, name: &str) -> (usize, usize, [f64; 2]) {
    let line = rates.lines().find(|line| line.starts_with(&format!("\"{name}"))).expect(name);
    let (_, numbers) = line.rsplit_once("\",").expect("a quoted name");
    let cells: Vec<&str> = numbers.split(',').collect();
    let number = |cell: usize| cells[cell].parse::<f64>().expect(line);
    let count = |cell: usize| cells[cell].parse::<usize>().expect(line);
    (count(0), count(1), [number(3), number(4)])
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

    // without the key nothing of the answers is there
    let sealed = place.read("cases/answers.sealed");
    let secrets = ["stratum", "concealed", "z_det", "seed"];
    for file in place.files().iter().filter(|file| file.starts_with("cases")) {
        let bytes = place.read(&file.display().to_string());
        let holds = |secret: &str| bytes.windows(secret.len()).any(|w| w == secret.as_bytes());
        assert!(!secrets.iter().any(|secret| holds(secret)), "{}", file.display());
    }

    // no diagnosis can open them: the key is nowhere while they run
    std::fs::remove_file(place.path().join("secret/answers.key")).expect("the key was there");
    diagnose(&place);
    place.write("secret/answers.key", KEY);
    done(place.run("trial score cases --key secret/answers.key --out score"));
    let (opened, rates) = (text("score/answers.toml"), text("score/rates.csv"));
    let cases = lines(&text("score/cases.csv"));
    assert_eq!(cases.len(), CASES);
    assert_eq!(opened.matches("[[case]]").count(), CASES);

    // the answers are those that were committed to, and the commitment was not touched
    assert_eq!(commitment, text("cases/commitment.txt"));
    assert_eq!(sealed, place.read("cases/answers.sealed"));

    // physics on nulls: at a rate of 1 %, two of six have a chance of 0.15 %
    let nulls: Vec<&Line> = cases.iter().filter(|case| case.stratum.ends_with("null")).collect();
    let is_physics = |set: &Vec<String>| !set.iter().any(|id| NO_PHYSICS.contains(&id.as_str()));
    let false_claims = nulls.iter().filter(|case| case.named.iter().any(is_physics)).count();
    assert!(nulls.len() >= 5 && false_claims <= 1, "{false_claims} of {}", nulls.len());

    // files do not tell: a half lies within the interval
    let (_, asked, [low, high]) = rate(&rates, "nulls told by sizes and stamps");
    assert!(asked == 2 * nulls.len() && low <= 0.5 && high >= 0.5, "{low} to {high}");

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
    let clear: Vec<&Line> = clear.filter(|case| case.z_det.is_some_and(|z| z >= FAR)).collect();
    let is_named = |case: &&&Line| case.named.iter().any(|set| set.contains(&case.concealed));
    let named = clear.iter().filter(is_named).count();
    assert!(named >= 1, "none of {} effects that stand out is named", clear.len());
}
