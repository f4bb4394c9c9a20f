//! Spin test, genetic algorithm and least squares.

use crate::recovery::{GAUGE, TRUTH, drive, fit, observe, record, start};
use trackdyn_core::PerSide;
use trackdyn_estimate::genetic::GeneticOptions;
use trackdyn_estimate::least_squares::{Loss, doubts, lacks};
use trackdyn_estimate::noise::{self, noise};
use trackdyn_estimate::synthetic::{Stretch, Synthetic};
use trackdyn_estimate::{
    Doubt, Error, Free, Parameters, Weighting, genetic, least_squares, spin_test,
};
use trackdyn_recording::Recording;

/// Lever of the cost (17), m.
const LEVER: f64 = GAUGE / 2.0;

#[test]
fn least_squares_finds_the_truth_within_its_interval() {
    let estimate = fit(&drive(1), Free::IcrsAndAlphas).expect("settles");
    for (k, truth) in TRUTH.into_iter().enumerate() {
        let interval = estimate.interval(k).expect("free");
        let (name, error) = (Parameters::NAMES[k], (interval.value - truth).abs());
        assert!(error < 4.0 * interval.deviation, "{name}: {interval:?} of {truth}");
        assert!(interval.deviation < 0.01, "{name}: {interval:?}");
    }
    // Noise was measured without the model, so this is a check and not a result.
    assert!((0.7..1.4).contains(&estimate.whitened_rms), "{}", estimate.whitened_rms);
    assert_eq!(doubts(&estimate, GAUGE), []);
    assert_eq!(lacking(&drive(1), Free::IcrsAndAlphas), None);
}

#[test]
fn genetic_algorithm_and_least_squares_agree_on_the_cost() {
    let observations = observe(&drive(2));
    let weighting = Weighting::Distance { lever: LEVER };
    for free in [Free::Icrs, Free::IcrsAndAlphas] {
        let exact = least_squares(&observations, &start(), &free.into(), &weighting, Loss::Squares)
            .expect("settles");
        let options = GeneticOptions::default();
        let found = genetic(&observations, GAUGE, LEVER, free, &options, &|_| ());
        assert!(found.cost >= exact.cost * (1.0 - 1e-12), "{} below {}", found.cost, exact.cost);
        assert!(found.cost <= exact.cost * 1.01, "{} above {}", found.cost, exact.cost);
        for k in 0..3 {
            let distance = (found.parameters.0[k] - exact.parameters.0[k]).abs();
            assert!(distance < 1e-3, "{free:?} {}: {distance} m", Parameters::NAMES[k]);
        }
    }
}

#[test]
fn same_seed_same_individual_on_any_number_of_threads() {
    let observations = observe(&drive(3));
    let options = GeneticOptions { generations: 20, ..GeneticOptions::default() };
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| genetic(&observations, GAUGE, LEVER, Free::Icrs, &options, &|_| ()))
    };
    assert_eq!(run(1), run(3));
    let other = GeneticOptions { seed: 7, ..options };
    assert_ne!(run(1), genetic(&observations, GAUGE, LEVER, Free::Icrs, &other, &|_| ()));
}

fn stretch(duration: f64, left: f64, right: f64) -> Stretch {
    Stretch { duration, speeds: PerSide::new(left, right) }
}

#[test]
fn spin_test_measures_the_distance_between_the_icrs() {
    let spin = vec![stretch(9.0, -0.5, 0.5), stretch(9.0, 0.5, -0.5)];
    let result =
        spin_test(&observe(&record(vec![spin], 4)), GAUGE, &spin_test::Settings::default())
            .expect("it spins");
    // At α ≠ 1 the spin test sees the distance over the mean α.
    let seen = (TRUTH[1] - TRUTH[0]) / f64::midpoint(TRUTH[3], TRUTH[4]);
    assert!((result.gap - seen).abs() < 2e-3, "{} {seen}", result.gap);
    assert!((result.steering_efficiency - GAUGE / result.gap).abs() < 1e-15);

    let straight = vec![stretch(20.0, 0.5, 0.5)];
    let refused =
        spin_test(&observe(&record(vec![straight], 5)), GAUGE, &spin_test::Settings::default());
    assert!(matches!(refused, Err(Error::NoSpin { .. })), "{refused:?}");
}

fn lacking(recording: &Recording, free: Free) -> Option<Doubt> {
    lacks(&observe(recording), &noise(recording, 0.0, &noise::Settings::default()), free)
}

#[test]
fn straight_driving_shows_no_icr() {
    let straight = record(vec![vec![stretch(60.0, 0.5, 0.5)], vec![stretch(60.0, -0.4, -0.4)]], 6);
    assert_eq!(lacking(&straight, Free::Icrs), Some(Doubt::NoTurning));
}

/// Speeds as commanded have no noise that driving could be compared with.
#[test]
fn straight_driving_at_commanded_speeds_shows_no_icr_either() {
    let commanded = |left: f64, right: f64| {
        let schedules = vec![vec![stretch(30.0, left, right)]];
        let commanded = Synthetic { schedules, yaw_noise: 0.002, ..Synthetic::default() };
        let commanded = commanded.recording().expect("long enough");
        [Free::Icrs, Free::IcrsAndAlphas].map(|free| lacking(&commanded, free))
    };
    for speed in [0.0, 0.5] {
        let nothing = [Some(Doubt::NoTurning), Some(Doubt::OneRatio)];
        assert_eq!(commanded(speed, speed), nothing, "{speed} m/s");
    }
    assert_eq!(commanded(0.2, 0.5), [None, Some(Doubt::OneRatio)]);
}

#[test]
fn a_spin_shows_the_icrs_but_not_beside_alphas() {
    let spin = record(vec![vec![stretch(60.0, -0.5, 0.5)]], 7);
    assert_eq!(lacking(&spin, Free::IcrsAndAlphas), Some(Doubt::OneRatio));
    assert_eq!(lacking(&spin, Free::Icrs), None);
    let estimate = fit(&spin, Free::Icrs).expect("settles");
    assert_eq!(doubts(&estimate, GAUGE), []);
}

#[test]
fn few_turns_leave_wide_intervals() {
    // One short turn in a long straight run, and noise.
    let run = vec![stretch(6.0, 0.5, 0.5), stretch(0.3, 0.45, 0.55), stretch(6.0, 0.5, 0.5)];
    let estimate = fit(&record(vec![run], 9), Free::Icrs).expect("settles");
    let doubts = doubts(&estimate, GAUGE);
    assert!(matches!(doubts[..], [Doubt::Wide { .. }, ..]), "{doubts:?}");
}

#[test]
fn too_short_recordings_are_refused() {
    let short = record(vec![vec![stretch(2.0, 0.1, 0.5)]], 8);
    let weighting = Weighting::Distance { lever: LEVER };
    let refused =
        least_squares(&observe(&short), &start(), &Free::Icrs.into(), &weighting, Loss::Squares);
    let Err(Error::TooFewSegments { found, needed, each, .. }) = refused else {
        panic!("{refused:?}")
    };
    assert!(found < needed && (0.2..1.0).contains(&each), "{found} of {needed}, {each} s each");
    let error = Error::TooFewSegments { found: 15, needed: 20, parameters: 5, each: 0.5 };
    assert!(error.to_string().contains("some 3 s more of driving"), "{error}");
}

/// Poses by a clock that is farther off than offsets are searched.
#[test]
fn poses_of_another_time_are_told_with_their_offset() {
    let runs = record(vec![vec![stretch(20.0, 0.1, 0.5)]], 8);
    let runs = runs.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        for sample in &mut rows.poses.samples {
            sample.t += 400.0;
        }
        rows
    });
    let source = trackdyn_recording::Source::computed();
    let apart =
        trackdyn_recording::Recording::new("apart", "robot", runs.collect(), source, Vec::new())
            .expect("usable");
    let options = trackdyn_estimate::identification::Options::new(GAUGE);
    let refused = trackdyn_estimate::identification::icrs_alone(&apart, &options);
    let Err(error @ Error::NoCommonTime { .. }) = refused else { panic!("{refused:?}") };
    assert!(error.to_string().contains("--tau 400.0"), "{error}");
}
