//! Intervals hold what they promise.

use crate::recovery::{TRUTH, drive, fit, shares};
use trackdyn_estimate::{Free, Parameters};

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

#[test]
#[ignore = "a thousand recordings: cargo test --release -p trackdyn-tests -- --ignored"]
fn intervals_cover_93_to_97_percent_of_a_thousand() {
    let shares = coverage(1_000, 10_000);
    println!("{:?}: {shares:?}", Parameters::NAMES);
    assert!(shares.iter().all(|share| (0.93..=0.97).contains(share)), "{shares:?}");
}
