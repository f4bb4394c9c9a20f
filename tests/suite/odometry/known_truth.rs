//! Replays of synthetic recordings, whose parameters and noise are known.

use trackdyn_core::PerSide;
use trackdyn_estimate::clock;
use trackdyn_estimate::odometry::{Comparison, Error, ParameterSet, Span};
use trackdyn_estimate::synthetic::{Stretch, Synthetic, random_steps};
use trackdyn_model::{Icrs, Kinematics};
use trackdyn_recording::Recording;

const POSITION_NOISE: f64 = 0.004;
const YAW_NOISE: f64 = 0.003;

/// Twelve runs of a minute on Auriga-alpha's printed centres, with noise and late poses.
fn noisy() -> Recording {
    let synthetic = Synthetic {
        schedules: (0..12).map(|seed| random_steps(10, 6.0, 1.0, seed)).collect(),
        position_noise: POSITION_NOISE,
        yaw_noise: YAW_NOISE,
        tau: 0.12,
        seed: 7,
        ..Synthetic::default()
    };
    synthetic.recording().expect("a recording")
}

fn truth() -> ParameterSet {
    let icrs = Icrs { x_left: -0.375, x_right: 0.457, y: 0.0492 };
    ParameterSet::new("truth", Kinematics::new(icrs))
}

fn compare(recording: &Recording, sets: Vec<ParameterSet>, tau: f64) -> Comparison {
    Comparison::new(recording, sets, tau).expect("it moves")
}

#[test]
fn true_parameters_leave_noise() {
    let recording = noisy();
    let tau = clock::clock_offset(&recording, &clock::Settings::default()).expect("turning");
    let result = compare(&recording, vec![ParameterSet::ideal(0.42), truth()], tau.tau);
    let segments = result.segments().expect("segments");
    // Twelve runs, each cut into four blocks.
    assert_eq!(segments.blocks, 48);
    let [ideal, truth] = segments.sets[..] else { panic!("two sets") };
    // An increment has the noise of two poses; yaw noise of the first turns the motion in a
    // segment, up to 0.3 m, so that along and across may have some more. 5 %: 2400 segments, and τ.
    let yaw = truth.yaw.rms.value / (YAW_NOISE * 2.0_f64.sqrt());
    assert!((yaw - 1.0).abs() < 0.05, "{yaw}");
    for component in [truth.along, truth.across] {
        let ratio = component.rms.value / (POSITION_NOISE * 2.0_f64.sqrt());
        assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
        let [low, high] = component.mean.interval().expect("blocks");
        // Three of the half-widths of 95 %: one in some million.
        let slack = high - low;
        assert!(low - slack < 0.0 && high + slack > 0.0, "{component:?}");
    }
    assert!(ideal.yaw.rms.value > 5.0 * truth.yaw.rms.value);
    let [_, high] = truth.yaw.over_first.expect("second").interval().expect("blocks");
    assert!(high < 0.2, "{high}");
}

#[test]
fn without_noise_the_true_path_is_found() {
    let recording = Synthetic::default().recording().expect("a recording");
    let result = compare(&recording, vec![truth()], 0.0);
    let errors = result.paths[0].errors(0).expect("a path");
    // 60 s of rounding.
    assert!(errors.absolute.max < 1e-9 && errors.absolute_yaw.max < 1e-9, "{errors:?}");
    assert!(errors.aligned.max < 1e-9 && errors.relative.expect("far").max < 1e-9);
}

#[test]
fn a_gauge_that_is_too_small_turns_too_far_and_drift_is_constant() {
    // Truth: x_r − x_l = 0.5 m; replayed with 0.4 m, every turn is predicted 1.25 times too large.
    let speeds = PerSide::new(0.45, 0.55);
    let schedules = vec![vec![Stretch { duration: 100.0, speeds }]];
    let kinematics = trackdyn_estimate::synthetic::ConstantIcr {
        x_left: -0.25,
        x_right: 0.25,
        y: 0.0,
        alpha: PerSide::new(1.0, 1.0),
    };
    let synthetic = Synthetic { kinematics, schedules, ..Synthetic::default() };
    let recording = synthetic.recording().expect("a recording");
    let result = compare(&recording, vec![ParameterSet::ideal(0.4)], 0.0);
    let metre = result.over(Span::Distance(1.0)).expect("50 m");
    // ω: true 0.2, predicted 0.25 rad/s; 1 m takes 2 s, or 2.1 s in segments of 0.3 s.
    let yaw = &metre.sets[0].yaw;
    assert!((yaw.mean.value + 0.05 * metre.mean_duration).abs() < 1e-9, "{yaw:?}");
    assert!((yaw.per_metre.expect("it moves").value - 0.1).abs() < 1e-9);
    // One run is cut into 48 blocks of 2.08 s that all say the same; 47 pieces of 2.1 s begin in 47
    // of them.
    assert_eq!((result.blocks.count(), metre.blocks), (48, 47));
    assert!(yaw.mean.half_width.expect("blocks") < 1e-9);
    let last = result.paths[0].errors(0).expect("a path").last;
    assert!((last.yaw + 5.0).abs() < 1e-9, "{last:?}");
}

#[test]
fn standing_and_too_short_recordings_are_refused() {
    let of = |duration: f64, speed: f64| {
        let drive = Stretch { duration, speeds: PerSide::new(speed, speed) };
        let schedules = vec![vec![drive]];
        let recording = Synthetic { schedules, ..Synthetic::default() }.recording().expect("runs");
        Comparison::new(&recording, vec![truth()], 0.0).expect_err("nothing to compare")
    };
    assert!(matches!(of(5.0, 0.0), Error::Standing { runs: 1, .. }));
    assert!(matches!(of(0.2, 1.0), Error::NoSegments { runs: 1, .. }));
}
