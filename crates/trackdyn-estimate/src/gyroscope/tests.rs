//! A gyroscope beside poses that are made with known errors.

use super::*;
use crate::identification::{Options, icrs_alone};
use crate::synthetic::{Stretch, Synthetic, random_steps};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use trackdyn_core::PerSide;
use trackdyn_recording::{ImuSample, PoseSample};

const YAW_NOISE: f64 = 0.01;
const BIAS: f64 = 0.02;
const SCALE: f64 = 1.03;
const DELAY: f64 = 0.04;

fn by_gyroscope(recording: &Recording) -> Result<Corrected, Unfit> {
    with_gyroscope(recording, 0.0, &Settings::default())
}

/// Two drives of a minute with poses of this noise.
fn synthetic(yaw_noise: f64, seed: u64) -> Synthetic {
    Synthetic {
        schedules: vec![random_steps(30, 2.0, 0.8, seed), random_steps(30, 2.0, 0.8, seed + 100)],
        position_noise: yaw_noise / 5.0,
        yaw_noise,
        encoder_noise: if yaw_noise > 0.0 { 0.002 } else { 0.0 },
        seed,
        ..Synthetic::default()
    }
}

/// What a gyroscope at 100 Hz measures, with this noise (rad/s), beside poses late by [`DELAY`].
fn with_readings(synthetic: &Synthetic, noise: f64, unit: f64) -> Recording {
    let recording = synthetic.recording().expect("long enough");
    let exact =
        Synthetic { encoder_noise: 0.0, position_noise: 0.0, yaw_noise: 0.0, ..synthetic.clone() };
    let exact = exact.recording().expect("long enough");
    let mut random = ChaCha8Rng::seed_from_u64(synthetic.seed + 7);
    let runs = recording.runs().iter().zip(exact.runs()).map(|(run, exact)| {
        let tracks = exact.tracks();
        let mut rows = run.clone().into_rows();
        for pose in &mut rows.poses.samples {
            pose.t += DELAY;
        }
        let count = (tracks.len() - 1) * 5;
        let reading = |k: usize| {
            let t = tracks[0].t + 0.01 * real(k);
            // A reading holds from its stamp on.
            let at = tracks.partition_point(|reading| reading.t <= t) - 1;
            let rate = synthetic.kinematics.twist(tracks[at].speeds()).w;
            let error: f64 = StandardNormal.sample(&mut random);
            let gyro_z = unit * (rate / SCALE + BIAS + noise * error);
            ImuSample { t, gyro_z, ..ImuSample::default() }
        };
        rows.imu = (0..count).map(reading).collect::<Vec<_>>().into();
        Run::new(rows, &mut Vec::new())
    });
    recording.with_runs(runs.collect())
}

/// Root mean square error of the yaw of all poses, from their own mean in each run, rad.
fn error(recording: &Recording, synthetic: &Synthetic) -> f64 {
    let exact =
        Synthetic { encoder_noise: 0.0, position_noise: 0.0, yaw_noise: 0.0, ..synthetic.clone() };
    let exact = exact.recording().expect("long enough");
    let (mut squares, mut count) = (0.0, 0.0);
    for (run, exact) in recording.runs().iter().zip(exact.runs()) {
        let pairs = run.poses().iter().zip(exact.poses());
        let off: Vec<f64> = pairs.map(|(a, b)| a.pose.yaw - b.pose.yaw).collect();
        let mean = off.iter().sum::<f64>() / real(off.len());
        squares += off.iter().map(|off| (off - mean).powi(2)).sum::<f64>();
        count += real(off.len());
    }
    (squares / count).sqrt()
}

#[test]
fn yaw_is_better_with_a_gyroscope_whose_errors_are_found() {
    let synthetic = synthetic(YAW_NOISE, 1);
    let raw = with_readings(&synthetic, 0.002, 1.0);
    let Corrected { recording: fused, gyroscope: found, .. } =
        by_gyroscope(&raw).expect("it serves");
    assert!((found.scale / SCALE - 1.0).abs() < 0.003, "{found:?}");
    // Between two readings the rate is taken as linear: a step in it seems 5 ms early.
    assert!((found.lag - DELAY - 0.005).abs() < 0.002, "{found:?}");
    // Two poses, each off by its noise; a second of readings, each off by 0.002 rad/s for 10 ms.
    assert!((found.error_of_poses / (2.0_f64.sqrt() * YAW_NOISE)).ln().abs() < 0.15, "{found:?}");
    assert!((found.error_with_it / 2e-4).ln().abs() < 0.2, "{found:?}");
    let [before, after] = [&raw, &fused].map(|recording| error(recording, &synthetic));
    assert!(after < before / 5.0, "{before} {after}");
    assert!(found.poses > 1100, "{found:?}");
}

/// A robot with fixes alone takes the yaw of its poses from its gyroscope.
#[test]
fn a_gyroscope_that_made_the_yaw_of_the_poses_tells_what_lies_between() {
    let rare = Synthetic { pose_interval: 1.0, ..synthetic(0.0, 12) };
    let raw = with_readings(&rare, 0.002, 1.0);
    let runs = raw.runs().iter().map(|run| {
        let turned = Turned::of_run(run, 8);
        let mut rows = run.clone().into_rows();
        rows.poses.samples.retain(|pose| {
            let [start, end] = turned[0].span();
            (start..end).contains(&(pose.t - DELAY))
        });
        for pose in &mut rows.poses.samples {
            pose.pose.yaw = turned[0].at(pose.t - DELAY).0;
        }
        Run::new(rows, &mut Vec::new())
    });
    let own = raw.with_runs(runs.collect());
    let corrected = by_gyroscope(&own).expect("it serves");
    let filled = corrected.filled(|_| 0.1).recording;
    let count = |of: &Recording| of.runs().iter().map(|run| run.poses().len()).sum::<usize>();
    assert!(count(&filled) > 9 * count(&own), "{} {}", count(&filled), count(&own));
    for (own, run) in own.runs().iter().zip(corrected.recording.runs()) {
        for (before, after) in own.poses().iter().zip(run.poses()) {
            assert!((before.pose.yaw - after.pose.yaw).abs() < 1e-3, "{before:?} {after:?}");
        }
    }
}

/// Noise of 1 rad/s: a second of it is off by 0.1 rad.
#[test]
fn a_gyroscope_that_is_worse_than_the_poses_is_left_out() {
    let raw = with_readings(&synthetic(0.002, 2), 1.0, 1.0);
    let refused = by_gyroscope(&raw).expect_err("worse");
    assert!(matches!(refused, Unfit::NoBetter { .. }), "{refused:?}");
}

#[test]
fn a_gyroscope_in_degrees_and_one_upside_down_are_refused() {
    let synthetic = synthetic(YAW_NOISE, 3);
    for unit in [57.3, -1.0] {
        let raw = with_readings(&synthetic, 0.002, unit);
        let refused = by_gyroscope(&raw);
        let Err(Unfit::Scale { scale }) = refused else { panic!("{unit}: {refused:?}") };
        assert!((scale * unit / SCALE - 1.0).abs() < 0.1, "{unit}: {scale}");
    }
    let without = by_gyroscope(&synthetic.recording().expect("long enough"));
    assert_eq!(without.expect_err("no gyroscope"), Unfit::NoReadings);
}

/// A loop is closed in the middle of each run: the map turns by six degrees.
#[test]
fn a_jump_of_the_poses_stays_where_it_is() {
    const YAW_JUMP: f64 = 0.1;
    let synthetic = synthetic(0.002, 4);
    let raw = with_readings(&synthetic, 0.002, 1.0);
    let runs = raw.runs().iter().map(|run| {
        let mut rows = run.clone().into_rows();
        let middle = rows.poses.samples.len() / 2;
        for pose in &mut rows.poses.samples[middle..] {
            pose.pose.yaw += YAW_JUMP;
        }
        Run::new(rows, &mut Vec::new())
    });
    let jumped = raw.with_runs(runs.collect());
    let fused = by_gyroscope(&jumped).expect("it serves").recording;
    for (run, jumped) in fused.runs().iter().zip(jumped.runs()) {
        let middle = run.poses().len() / 2;
        for k in middle - 20..middle + 20 {
            let moved = run.poses()[k].pose.yaw - jumped.poses()[k].pose.yaw;
            assert!(moved.abs() < 4.0 * 0.002, "{k}: {moved}");
        }
    }
}

/// Stamps of poses on a grid of 0.1 s, some a step late, while the robot turns: none of it is a
/// jump.
#[test]
fn late_stamps_are_no_jumps() {
    let synthetic = synthetic(0.002, 5);
    let raw = with_readings(&synthetic, 0.002, 1.0);
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let runs = raw.runs().iter().map(|run| {
        let mut rows = run.clone().into_rows();
        let poses = rows.poses.samples.clone();
        for k in 1..poses.len() {
            let late: f64 = StandardNormal.sample(&mut random);
            if late > 0.5 {
                rows.poses.samples[k].pose = poses[k - 1].pose;
            }
        }
        Run::new(rows, &mut Vec::new())
    });
    let late = raw.with_runs(runs.collect());
    let Corrected { gyroscope, .. } = by_gyroscope(&late).expect("it serves");
    let of: usize = late.runs().iter().map(|run| run.poses().len()).sum();
    assert!(gyroscope.poses + 4 >= of, "{gyroscope:?} of {of}");
    assert!(gyroscope.error_with_it < 0.1 * gyroscope.error_of_poses, "{gyroscope:?}");
}

/// Windows of two seconds, cut from a drive, are too short to judge a gyroscope by.
#[test]
fn short_rows_say_so() {
    let short = Synthetic {
        schedules: (0..60).map(|seed| random_steps(4, 0.25, 0.8, seed)).collect(),
        ..synthetic(0.002, 8)
    };
    let refused = by_gyroscope(&with_readings(&short, 0.002, 1.0)).expect_err("too short");
    assert!(matches!(refused, Unfit::ShortRows { .. }), "{refused:?}");
}

/// With its scale unknown, a gyroscope says little of the distance of the ICRs that the total
/// turning of the poses does not say. What it says must have an honest interval.
#[test]
fn the_interval_of_the_distance_holds_the_error_of_the_scale() {
    const DRIVES: u32 = 24;
    let (mut ratio, mut squares, mut without) = (0.0, 0.0, 0.0);
    for seed in 0..DRIVES {
        let raw = with_readings(&synthetic(YAW_NOISE, 10 + u64::from(seed)), 0.002, 1.0);
        let Corrected { recording: fused, gyroscope: found, .. } =
            by_gyroscope(&raw).expect("it serves");
        let gap = |recording: &Recording, yaw_scale: f64| {
            let options = Options { yaw_scale, ..Options::new(0.42) };
            icrs_alone(recording, &options).expect("it turns").gap()
        };
        let [before, after] = [gap(&raw, 0.0), gap(&fused, found.scale_deviation)];
        ratio += after.deviation / before.deviation / f64::from(DRIVES);
        squares += ((after.value - 0.832) / after.deviation).powi(2) / f64::from(DRIVES);
        without += ((before.value - 0.832) / before.deviation).powi(2) / f64::from(DRIVES);
    }
    assert!(ratio < 2.0, "standard errors with and without it: {ratio}");
    // A mean square of 24 normal deviates lies below 1.9 but once in a hundred times.
    assert!(squares < 1.9 && without < 1.9, "errors over deviations: {squares}, {without}");
}

/// Poses once a second, beside a gyroscope at 100 Hz.
#[test]
fn yaw_between_rare_poses_is_that_of_the_gyroscope() {
    let rare = Synthetic { pose_interval: 1.0, ..synthetic(0.002, 6) };
    let corrected = by_gyroscope(&with_readings(&rare, 0.002, 1.0)).expect("it serves");
    let Filled { recording, has_place } = corrected.filled(|_| 0.1);
    let often = Synthetic { pose_interval: 0.1, position_noise: 0.0, yaw_noise: 0.0, ..rare };
    let exact = often.recording().expect("long enough");
    let mut seen = 0;
    for ((run, exact), has_place) in recording.runs().iter().zip(exact.runs()).zip(&has_place) {
        assert_eq!(run.poses().len(), has_place.len());
        for (pose, has_place) in run.poses().iter().zip(has_place) {
            let at = |exact: &PoseSample| (exact.t - pose.t + DELAY).abs() < 1e-9;
            let k = exact.poses().iter().position(at).expect("at even times");
            assert_eq!(*has_place, k.is_multiple_of(10), "{k}");
            let off = pose.pose.yaw - exact.poses()[k].pose.yaw;
            // The poses' own noise, and a lag that is known to some milliseconds, at up to 1 rad/s.
            assert!(off.abs() < 0.012, "{k}: {off}");
            seen += 1;
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// A robot that stands most of the time: poses at rest, ten times as good as on the way, must not
/// pass for what a turn is known to.
#[test]
fn poses_at_rest_do_not_tell_how_well_the_scale_is_known() {
    const DRIVES: u32 = 24;
    let mut squares = 0.0;
    for seed in 0..u64::from(DRIVES) {
        let rest = Stretch { duration: 90.0, speeds: PerSide::new(0.0, 0.0) };
        let schedule = |seed: u64| [vec![rest], random_steps(20, 2.0, 0.8, seed)].concat();
        let drives = Synthetic {
            schedules: vec![schedule(2 * seed), schedule(2 * seed + 1)],
            yaw_noise: 0.001,
            position_noise: 0.001,
            seed,
            ..Synthetic::default()
        };
        let recording = with_readings(&drives, 0.002, 1.0);
        let mut random = ChaCha8Rng::seed_from_u64(seed + 11);
        let runs = recording.runs().iter().cloned().map(|run| {
            let mut rows = run.into_rows();
            for sample in rows.poses.samples.iter_mut().filter(|sample| sample.t > rest.duration) {
                let error: f64 = StandardNormal.sample(&mut random);
                sample.pose.yaw += 0.01 * error;
            }
            Run::new(rows, &mut Vec::new())
        });
        let noisy = recording.with_runs(runs.collect());
        let found = by_gyroscope(&noisy).expect("it serves").gyroscope;
        squares += ((found.scale - SCALE) / found.scale_deviation).powi(2) / f64::from(DRIVES);
    }
    // A mean square of 24 normal deviates lies below 1.9 but once in a hundred times.
    assert!(squares < 1.9, "errors over deviations: {squares}");
}
