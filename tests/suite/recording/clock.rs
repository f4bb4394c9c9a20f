//! The clock offset of synthetic recordings, over seeds.

use trackdyn_core::PerSide;
use trackdyn_estimate::Error;
use trackdyn_estimate::clock::{self, clock_offset};
use trackdyn_estimate::synthetic::{ConstantIcr, Stretch, Synthetic, random_steps};
use trackdyn_recording::{Recording, Source};

/// Noise as in lidar odometry of a small robot: 5 mm, 2 mrad, 5 % of the speed.
fn noisy(tau: f64, seed: u64) -> Synthetic {
    Synthetic {
        schedules: (0..3).map(|run| random_steps(30, 3.0, 1.0, 100 * seed + run)).collect(),
        encoder_noise: 0.05,
        position_noise: 0.005,
        yaw_noise: 0.002,
        tau,
        seed,
        ..Synthetic::default()
    }
}

fn refusal(recording: &Recording) -> String {
    let error = clock_offset(recording, &clock::Settings::default()).expect_err("refused");
    let expected =
        matches!(error, Error::NotEstimable { .. } | Error::Unlike { .. } | Error::Swapped { .. });
    assert!(expected, "{error}");
    error.to_string()
}

#[test]
fn the_offset_is_recovered_within_its_error() {
    let mut squares = 0.0;
    let mut within_two = 0_u32;
    let seeds = 60_u32;
    for seed in 0..seeds {
        let tau = 0.3 - 0.01 * f64::from(seed);
        let recording = noisy(tau, u64::from(seed)).recording().expect("long enough");
        let found = clock_offset(&recording, &clock::Settings::default()).expect("turning");
        // 1/(x_r − x_l), less the attenuation by encoder noise
        assert!((found.yaw_per_difference - 1.0 / 0.832).abs() < 0.02);
        assert!(found.standard_error < 0.01, "{found:?}");
        let score = (found.tau - tau) / found.standard_error;
        squares += score * score;
        within_two += u32::from(score.abs() < 2.0);
    }
    // 95 % of 60 is 57; 51 or fewer has a chance below 1 %. The mean square is 1 ± 0.18: from 0.5
    // to 1.6 is beyond three deviations on either side.
    let mean_square = squares / f64::from(seeds);
    println!("{within_two} of {seeds} within two standard errors, mean square {mean_square:.2}");
    assert!(within_two > 51, "{within_two} of {seeds}");
    assert!((0.5..1.6).contains(&mean_square), "{mean_square}");
}

/// Between two poses of a motion capture the robot turns less than its yaw is off.
#[test]
fn quick_poses_with_coarse_yaw_show_the_offset() {
    let tau = -0.08;
    let synthetic = Synthetic { pose_interval: 1.0 / 170.0, yaw_noise: 0.011, ..noisy(tau, 3) };
    let recording = synthetic.recording().expect("long enough");
    let found = clock_offset(&recording, &clock::Settings::default()).expect("turning");
    let off = (found.tau - tau).abs();
    assert!(found.standard_error < 0.01 && off < 4.0 * found.standard_error, "{found:?}");
}

#[test]
fn without_noise_the_offset_is_exact() {
    for tau in [-0.31, 0.0, 0.275, 0.7] {
        let recording = Synthetic { tau, ..Synthetic::default() }.recording().expect("long enough");
        let found = clock_offset(&recording, &clock::Settings::default()).expect("turning");
        // 10 µs: the golden section ends at 1 µs, on a minimum that rounding flattens.
        assert!((found.tau - tau).abs() < 1e-5, "{found:?}");
    }
}

#[test]
fn straight_or_steady_driving_is_refused() {
    let straight = |speeds: PerSide<f64>| {
        let schedule = vec![Stretch { duration: 60.0, speeds }];
        let synthetic = Synthetic { schedules: vec![schedule], ..noisy(0.2, 5) };
        refusal(&synthetic.recording().expect("long enough"))
    };
    for speeds in [PerSide::new(0.5, 0.5), PerSide::new(0.2, 0.6), PerSide::default()] {
        let text = straight(speeds);
        assert!(text.contains("no turning that encoders and poses both show"), "{text}");
    }
}

#[test]
fn swapped_sides_short_recordings_and_far_offsets_are_refused() {
    let swapped = ConstantIcr { x_left: 0.4, x_right: -0.4, ..Synthetic::default().kinematics };
    let synthetic = Synthetic { kinematics: swapped, ..Synthetic::default() };
    let text = refusal(&synthetic.recording().expect("long enough"));
    assert!(text.contains("left and right are swapped"), "{text}");

    let short = Synthetic { schedules: vec![random_steps(1, 1.0, 1.0, 0)], ..Synthetic::default() };
    let text = refusal(&short.recording().expect("long enough"));
    assert!(text.contains("pose intervals with readings, 20 needed"), "{text}");

    let recording =
        Synthetic { tau: 0.9, ..Synthetic::default() }.recording().expect("long enough");
    let search = clock::Settings {
        earliest: -0.5,
        latest: 0.5,
        farthest: 0.7,
        last: 0.7,
        ..clock::Settings::default()
    };
    let error = clock_offset(&recording, &search).expect_err("refused");
    assert!(matches!(error, Error::ClockFar { farthest: 0.7, .. }), "{error}");
}

/// A clock that is seconds off is found as well as one that is a tenth off.
#[test]
fn the_search_goes_as_far_as_it_has_to() {
    for tau in [-14.3, -1.5, -0.5, 1.0, 2.5, 37.0] {
        let recording = noisy(tau, 6).recording().expect("long enough");
        let found = clock_offset(&recording, &clock::Settings::default()).expect("turning");
        let off = (found.tau - tau).abs();
        assert!(off < 4.0 * found.standard_error && off < 0.02, "{tau}: {found:?}");
    }
}

/// A clock that was set by hand.
#[test]
fn a_clear_peak_beyond_the_search_is_taken() {
    for late in [65.0, -80.0] {
        let recording = noisy(0.2, 6).recording().expect("long enough");
        let runs = recording.runs().iter().cloned().map(|run| {
            let mut rows = run.into_rows();
            rows.poses.samples.iter_mut().for_each(|sample| sample.t += late);
            rows
        });
        let late_runs = Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new());
        let search = clock::Settings::default();
        let found = clock_offset(&late_runs.expect("long enough"), &search).expect("turning");
        assert!((found.tau - 0.2 - late).abs() < 0.02, "{late}: {found:?}");
    }
}

#[test]
fn outlying_poses_widen_the_error_and_do_not_hide_the_offset() {
    let recording = noisy(0.25, 3).recording().expect("long enough");
    let clean = clock_offset(&recording, &clock::Settings::default()).expect("turning");
    let runs = recording.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        for sample in rows.poses.samples.iter_mut().step_by(13) {
            sample.pose.yaw += 0.1;
        }
        rows
    });
    let hurt = Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new());
    let hurt =
        clock_offset(&hurt.expect("long enough"), &clock::Settings::default()).expect("turning");
    assert!(hurt.standard_error > 2.0 * clean.standard_error);
    assert!((hurt.tau - 0.25).abs() < 4.0 * hurt.standard_error, "{hurt:?}");
}

/// Two readings in three seconds say when the robot turned to a quarter of the time between them.
#[test]
fn rare_readings_have_an_offset() {
    let whole = noisy(0.2, 4).recording().expect("long enough");
    let runs = whole.runs().iter().cloned().map(|run| {
        let mut rows = run.into_rows();
        let mut next = f64::NEG_INFINITY;
        rows.tracks.samples.retain(|sample| {
            let is_due = sample.t >= next;
            if is_due {
                next = sample.t + 1.5;
            }
            is_due
        });
        rows
    });
    let rare = Recording::new("n", "r", runs.collect(), Source::computed(), Vec::new());
    let found = clock_offset(&rare.expect("long enough"), &clock::Settings::default());
    let tau = found.expect("turning").tau;
    assert!((tau - 0.2).abs() < 1.5 / 4.0, "{tau}");
}

/// Where no reading came nobody knows what the tracks did: two seconds of every six pull the offset
/// by a fifth of a second if the last reading is taken to hold on.
#[test]
fn times_without_readings_do_not_count() {
    for seed in 0..5 {
        let tau = 0.03 * f64::from(u32::try_from(seed).expect("small"));
        let whole = noisy(tau, seed).recording().expect("long enough");
        let runs = whole.runs().iter().cloned().map(|run| {
            let mut rows = run.into_rows();
            rows.tracks.samples.retain(|sample| sample.t.rem_euclid(6.0) < 4.0);
            rows
        });
        let recording =
            Recording::new("gaps", "robot", runs.collect(), Source::computed(), Vec::new());
        let recording = recording.expect("usable");
        let found = clock_offset(&recording, &clock::Settings::default()).expect("turning");
        let off = (found.tau - tau).abs();
        assert!(off < 4.0 * found.standard_error && off < 0.02, "{tau}: {found:?}");
    }
}
