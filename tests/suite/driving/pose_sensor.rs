//! What a pose sensor reports, and its clock.

use crate::driving::plant::{AURIGA, auriga};
use trackdyn_core::{Plant, Pose, Trajectory};
use trackdyn_drive::sensors::{
    Dropout, Encoder, Mount, Outlier, PoseFrame, PoseSensor, Preset, StampAt, Walk, White,
};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, Sensors};
use trackdyn_estimate::clock::{self, clock_offset};
use trackdyn_estimate::noise::{self, noise};
use trackdyn_recording::{PoseSample, Recording};

/// Driving with rests, some twelve minutes in three runs.
fn designed() -> Vec<(i64, Trajectory)> {
    let options = ScheduleOptions::default();
    let runs = ScheduleKind::Designed.generate(&options).expect("valid");
    runs.iter().map(|run| (run.id, auriga().follow(&run.schedule).expect("it rolls"))).collect()
}

fn record(sensors: &Sensors, runs: &[(i64, Trajectory)], seed: u64) -> Recording {
    let runs = runs.iter().map(|(id, trajectory)| (*id, trajectory));
    sensors.record("simulated", "Auriga-alpha", runs, seed).expect("long enough")
}

fn perfect(pose: PoseSensor) -> Sensors {
    Sensors { pose, imu: None, ..Preset::Perfect.sensors() }
}

fn poses(trajectory: &Trajectory, pose: PoseSensor, seed: u64) -> Vec<PoseSample> {
    perfect(pose).observe(0, trajectory, seed).expect("a motion").poses.samples
}

#[test]
fn perfect_poses_are_the_truth_and_need_no_cleaning() {
    let runs = designed();
    let recording = record(&Preset::Perfect.sensors(), &runs, 0);
    assert!(recording.warnings().is_empty(), "{:?}", recording.warnings());
    for (run, (_, trajectory)) in recording.runs().iter().zip(&runs) {
        for sample in run.poses() {
            let truth = trajectory.pose_at(sample.t);
            assert!((sample.pose.x - truth.x).abs() < 1e-12);
            assert!((sample.pose.yaw - truth.yaw).abs() < 1e-12);
        }
    }
}

#[test]
fn the_noise_that_is_configured_is_found() {
    let runs = designed();
    let white = White { position: 0.006, yaw: 0.003 };
    let quiet = Walk { position: 0.0, yaw: 0.0, memory: None };
    let pose = PoseSensor { white, ..Preset::Perfect.sensors().pose };
    for seed in 0..3 {
        let found = noise(
            &record(&perfect(PoseSensor { walk: quiet, ..pose }), &runs, seed),
            0.0,
            &noise::Settings::default(),
        );
        // Some thousand triples that overlap tell a deviation to 2 %: 10 % is five times that.
        let moving = found.moving.expect("driving");
        assert!((moving.forward.white / 0.006 - 1.0).abs() < 0.1, "{moving:?}");
        assert!((moving.lateral.white / 0.006 - 1.0).abs() < 0.1, "{moving:?}");
        assert!((moving.yaw.white / 0.003 - 1.0).abs() < 0.1, "{moving:?}");
        // Rests of seven poses hardly tell white noise from a walk: together they are right.
        let standing = found.standing.expect("rests");
        for (component, white) in
            [(standing.forward, 0.006), (standing.lateral, 0.006), (standing.yaw, 0.003)]
        {
            let variance = 1.5 * component.white.powi(2) + 0.045 * component.walk.powi(2);
            assert!((variance / (1.5 * white * white) - 1.0).abs() < 0.3, "{standing:?}");
        }
    }
    // A walk of 15 mm/√s makes 4.5 mm in an interval of 90 ms, against 3 mm of white noise.
    let white = White { position: 0.003, yaw: 0.001 };
    let walk = Walk { position: 0.015, yaw: 0.005, memory: None };
    let found = noise(
        &record(&perfect(PoseSensor { white, walk, ..pose }), &runs, 3),
        0.0,
        &noise::Settings::default(),
    );
    let moving = found.moving.expect("driving");
    for (component, expected) in
        [(moving.forward, 0.015), (moving.lateral, 0.015), (moving.yaw, 0.005)]
    {
        assert!((component.walk / expected - 1.0).abs() < 0.15, "{moving:?}");
    }
}

#[test]
fn errors_against_the_truth_have_the_stated_deviations() {
    let runs = designed();
    let trajectory = &runs[0].1;
    let of = |white, walk| {
        let pose = PoseSensor { white, walk, ..Preset::Perfect.sensors().pose };
        let mut squares = [0.0; 3];
        let mut count = 0.0;
        for sample in poses(trajectory, pose, 21) {
            let (seen, truth) = (sample.pose, trajectory.pose_at(sample.t));
            let errors = [seen.x - truth.x, seen.y - truth.y, seen.yaw - truth.yaw];
            for (square, error) in squares.iter_mut().zip(errors) {
                *square += error * error;
            }
            count += 1.0;
        }
        squares.map(|square: f64| (square / count).sqrt())
    };
    let (silent, still) =
        (White { position: 0.0, yaw: 0.0 }, Walk { position: 0.0, yaw: 0.0, memory: None });
    // Some 3000 poses tell a deviation to 1.3 %.
    let white = of(White { position: 0.006, yaw: 0.003 }, still);
    for (found, stated) in white.into_iter().zip([0.006, 0.006, 0.003]) {
        assert!((found / stated - 1.0).abs() < 0.06, "{white:?}");
    }
    // With a memory of 0.2 s the deviation is √(q τ/2); neighbours are related over four poses:
    // 3 %.
    let walk = of(silent, Walk { position: 0.02, yaw: 0.01, memory: Some(0.2) });
    for (found, strength) in walk.into_iter().zip([0.02, 0.02, 0.01]) {
        assert!((found / (strength * 0.1_f64.sqrt()) - 1.0).abs() < 0.12, "{walk:?}");
    }
}

#[test]
fn the_clock_offset_is_recovered_with_ticks_jitter_and_noise() {
    let runs = designed();
    for (stamp_at, encoder_delay, delay) in [
        (StampAt::End, 0.0, 0.0),
        (StampAt::End, 0.02, 0.15),
        (StampAt::Start, 0.0, 0.27),
        (StampAt::Start, 0.1, 0.0),
    ] {
        let encoder = Encoder {
            stamp_at,
            delay: encoder_delay,
            tick: 5e-4,
            jitter: 2e-3,
            ..Encoder::default()
        };
        let pose = PoseSensor { delay, jitter: 3e-3, ..PoseSensor::default() };
        let sensors = Sensors { encoder, pose, imu: None, ..Sensors::default() };
        let recording = record(&sensors, &runs, 11);
        let found = clock_offset(&recording, &clock::Settings::default()).expect("turning");
        let expected = sensors.clock_offset();
        // four standard errors, and a millisecond for what stamps that scatter do to held readings
        let allowed = 4.0 * found.standard_error + 1e-3;
        assert!(found.standard_error < 5e-3, "{found:?}");
        assert!((found.tau - expected).abs() < allowed, "{found:?}, expected {expected}");
        assert!((found.yaw_per_difference * (AURIGA.x_right - AURIGA.x_left) - 1.0).abs() < 0.01);
    }
}

#[test]
fn a_sensor_off_centre_reports_its_own_pose() {
    let runs = designed();
    let mount = Mount { forward: 0.3, left: -0.1, yaw: 0.2 };
    let pose = PoseSensor { mount, ..Preset::Perfect.sensors().pose };
    for sample in poses(&runs[0].1, pose, 0) {
        let back = sample.pose.compose(&mount.pose().inverse());
        let truth = runs[0].1.pose_at(sample.t);
        assert!((back.x - truth.x).hypot(back.y - truth.y) < 1e-12);
    }
}

#[test]
fn frames_move_poses_rigidly() {
    let runs = designed();
    let of = |frame| poses(&runs[0].1, PoseSensor { frame, ..Preset::Perfect.sensors().pose }, 7);
    let world = of(PoseFrame::World);
    let start = of(PoseFrame::Start);
    let random = of(PoseFrame::Random);
    assert_eq!(start[0].pose, Pose::default());
    assert!(random[0].pose.x.hypot(random[0].pose.y) > 1e-3);
    for index in [1, 100, 1500] {
        let steps = [&world, &start, &random].map(|p| p[0].pose.relative(&p[index].pose));
        for step in steps {
            assert!((step.x - steps[0].x).hypot(step.y - steps[0].y) < 1e-11);
            assert!((step.yaw - steps[0].yaw).abs() < 1e-11);
        }
    }
    // another run lies elsewhere
    let sensors =
        perfect(PoseSensor { frame: PoseFrame::Random, ..Preset::Perfect.sensors().pose });
    let other = sensors.observe(1, &runs[0].1, 7).expect("a motion");
    assert!(other.poses.samples[0].pose != random[0].pose);
}

#[test]
fn outliers_and_gaps_have_their_shares() {
    let runs = designed();
    let (trajectory, sound) = (&runs[0].1, Preset::Perfect.sensors().pose);
    let outlier = Outlier { share: 0.03, position: 0.5, yaw: 0.2 };
    let dropout = Dropout { share: 0.2, duration: 0.9 };
    let [mut wrong, mut seen, mut gaps, mut all] = [0.0; 4];
    for seed in 0..20 {
        let full = poses(trajectory, sound, seed);
        let hurt = poses(trajectory, PoseSensor { outlier, ..sound }, seed);
        let off = |(a, b): &(&PoseSample, &PoseSample)| (a.pose.x - b.pose.x).abs() > 1e-9;
        wrong += f64::from(u32::try_from(full.iter().zip(&hurt).filter(off).count()).expect("few"));
        let left = poses(trajectory, PoseSensor { dropout, ..sound }, seed);
        seen += f64::from(u32::try_from(left.len()).expect("few"));
        let gap = |pair: &&[PoseSample]| pair[1].t - pair[0].t > 1.5 * sound.interval;
        gaps += f64::from(u32::try_from(left.windows(2).filter(gap).count()).expect("few"));
        all += f64::from(u32::try_from(full.len()).expect("few"));
    }
    // Some 60 000 poses tell a share of 3 % to 0.07 %; of some 1300 gaps of 0.9 s, their share of a
    // fifth is known to 0.7 %.
    assert!((wrong / all - 0.03).abs() < 0.003, "{}", wrong / all);
    assert!((seen / all - 0.8).abs() < 0.03, "{}", seen / all);
    // Absences between two poses do not show: in continuous time a gap comes every 4.5 s.
    let time = all * sound.interval;
    let expected = time / (0.9 / 0.2) * (-sound.interval / (2.0 * 0.9)).exp();
    assert!((gaps / expected - 1.0).abs() < 0.12, "{gaps} of {expected}");
}
