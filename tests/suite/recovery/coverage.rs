//! Intervals hold what they promise.

use crate::recovery::{GAUGE, TRUTH, drive, fit, record, shares};
use trackdyn_estimate::identification::{Options, icrs_alone};
use trackdyn_estimate::noise::{self, noise};
use trackdyn_estimate::synthetic::random_steps;
use trackdyn_estimate::{Free, Parameters};
use trackdyn_recording::{Recording, Run};

/// Shares of `count` recordings whose 95 % interval holds the truth, one per parameter.
fn coverage(count: u32, seed: u64) -> [f64; 5] {
    shares(count, seed, |seed| {
        let estimate = fit(&drive(seed), Free::IcrsAndAlphas).expect("settles");
        std::array::from_fn(|k| {
            let interval = estimate.interval(k).expect("free");
            (interval.low..=interval.high).contains(&TRUTH[k])
        })
    })
}

#[test]
fn intervals_cover_the_truth() {
    let shares = coverage(200, 1_000);
    println!("{:?}: {shares:?}", Parameters::NAMES);
    // Four standard deviations of a share of 0.95 among 200.
    let allowed = 4.0 * (0.95_f64 * 0.05 / 200.0).sqrt();
    assert!(shares.iter().all(|share| (share - 0.95).abs() < allowed), "{shares:?}");
}

/// A minute whose speeds change three times a second, with poses at 4 Hz: nothing rests or drives
/// steadily, so no noise is known without a model.
#[test]
fn a_minute_that_never_drives_steadily_has_intervals_that_cover_the_truth() {
    const COUNT: u32 = 200;
    let restless = |seed: u64| -> Recording {
        let drive = record(vec![random_steps(200, 0.3, 0.8, seed)], seed);
        let run = drive.runs()[0].clone();
        let mut rows = run.into_rows();
        rows.poses = rows.poses.samples.iter().copied().step_by(3).collect::<Vec<_>>().into();
        drive.with_runs(vec![Run::new(rows, &mut Vec::new())])
    };
    let shares = shares(COUNT, 3_000, |seed| {
        let recording = restless(seed);
        let measured = noise(&recording, 0.0, &noise::Settings::default());
        assert!(measured.moving.is_none() && measured.standing.is_none(), "{measured:?}");
        let estimate = icrs_alone(&recording, &Options::new(GAUGE)).expect("settles");
        // α of the tracks make the ICRs of their speeds differ: x_r - x_l is divided by their mean.
        let [left, right, _, alpha_left, alpha_right] = TRUTH;
        let gap = (right - left) / f64::midpoint(alpha_left, alpha_right);
        let [low, high] = [estimate.gap().low, estimate.gap().high];
        [(low..=high).contains(&gap)]
    });
    println!("{shares:?}");
    let allowed = 4.0 * (0.95_f64 * 0.05 / f64::from(COUNT)).sqrt();
    assert!((shares[0] - 0.95).abs() < allowed, "{shares:?}");
}

#[test]
#[ignore = "a thousand recordings: cargo test --release -p trackdyn-tests -- --ignored"]
fn intervals_cover_93_to_97_percent_of_a_thousand() {
    let shares = coverage(1_000, 10_000);
    println!("{:?}: {shares:?}", Parameters::NAMES);
    assert!(shares.iter().all(|share| (0.93..=0.97).contains(share)), "{shares:?}");
}
