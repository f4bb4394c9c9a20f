//! Pose errors agree with the Python package `evo`, whose figures `fixtures/evo_figures.py` stored.

use serde::Deserialize;
use std::path::Path;
use trackdyn_core::Pose;
use trackdyn_estimate::odometry::pose_error::{self, Delta, Statistics};

#[derive(Deserialize)]
struct Stored {
    relative: Vec<Relative>,
    absolute: Vec<Absolute>,
}

#[derive(Deserialize)]
struct Relative {
    estimate: String,
    part: String,
    delta: f64,
    unit: String,
    all_pairs: bool,
    pairs_from_reference: bool,
    figures: Figures,
}

#[derive(Deserialize)]
struct Absolute {
    estimate: String,
    part: String,
    aligned: bool,
    figures: Figures,
}

#[derive(Deserialize)]
struct Figures {
    count: usize,
    rmse: f64,
    mean: f64,
    median: f64,
    std: f64,
    min: f64,
    max: f64,
    sse: f64,
}

impl Figures {
    /// 1e-9 m or rad: rounding in evo's matrices, far below anything that matters.
    fn agree(&self, errors: &[f64], what: &str) {
        let Statistics { count, rmse, mean, median, std, min, max, sse } =
            Statistics::of(errors).expect("errors");
        assert_eq!(count, self.count, "{what}");
        let theirs = [self.rmse, self.mean, self.median, self.std, self.min, self.max, self.sse];
        for (ours, theirs) in [rmse, mean, median, std, min, max, sse].into_iter().zip(theirs) {
            assert!((ours - theirs).abs() < 1e-9, "{what}: {ours} against {theirs}");
        }
    }
}

fn file(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/evo").join(name);
    std::fs::read_to_string(path).expect(name)
}

fn stored() -> Stored {
    toml::from_str(&file("evo.toml")).expect("figures")
}

fn path(name: &str) -> Vec<Pose> {
    file(name)
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            let row: Vec<f64> = line.split(' ').map(|n| n.parse().expect("a number")).collect();
            Pose::new(row[1], row[2], 2.0 * row[6].atan2(row[7]))
        })
        .collect()
}

fn part(errors: &[Pose], part: &str) -> Vec<f64> {
    match part {
        "translation" => pose_error::lengths(errors),
        _ => pose_error::angles(errors),
    }
}

#[test]
fn relative_errors() {
    let (reference, cases) = (path("reference.tum"), stored().relative);
    assert_eq!(cases.len(), 64);
    for case in cases {
        let estimate = path(&case.estimate);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 or 7")]
        let delta = match case.unit.as_str() {
            "frames" => Delta::Frames(case.delta as usize),
            _ => Delta::Metres(case.delta),
        };
        let pairs_of = if case.pairs_from_reference { &reference } else { &estimate };
        let pairs = pose_error::pairs(pairs_of, delta, case.all_pairs);
        let errors = pose_error::relative(&reference, &estimate, &pairs);
        let what = format!("{} {} {delta:?} all {}", case.estimate, case.part, case.all_pairs);
        case.figures.agree(&part(&errors, &case.part), &what);
    }
}

#[test]
fn absolute_errors() {
    let (reference, cases) = (path("reference.tum"), stored().absolute);
    assert_eq!(cases.len(), 8);
    for case in cases {
        let mut estimate = path(&case.estimate);
        if case.aligned {
            let alignment = pose_error::align(&reference, &estimate);
            estimate = estimate.iter().map(|pose| alignment.compose(pose)).collect();
        }
        let errors = pose_error::absolute(&reference, &estimate);
        let what = format!("{} {} aligned {}", case.estimate, case.part, case.aligned);
        case.figures.agree(&part(&errors, &case.part), &what);
    }
}
