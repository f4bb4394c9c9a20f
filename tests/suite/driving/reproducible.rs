//! One seed gives one sequence of bytes.

use crate::driving::plant::auriga;
use trackdyn_core::{Plant, Trajectory};
use trackdyn_drive::sensors::{Outlier, PoseSensor, Preset};
use trackdyn_drive::{ScheduleKind, ScheduleOptions, Sensors, schedules, truth};
use trackdyn_recording::folder;

fn driven() -> Vec<(i64, Trajectory)> {
    let options = ScheduleOptions { runs: Some(3), ..ScheduleOptions::default() };
    let runs = ScheduleKind::Manual.generate(&options).expect("valid");
    runs.iter().map(|run| (run.id, auriga().follow(&run.schedule).expect("it rolls"))).collect()
}

/// Bytes of all tables of a recording.
fn bytes(sensors: &Sensors, runs: &[(i64, Trajectory)], seed: u64) -> Vec<Vec<u8>> {
    let place = tempfile::tempdir().expect("a temporary folder");
    let runs = || runs.iter().map(|(id, trajectory)| (*id, trajectory));
    let recording = sensors.record("n", "r", runs(), seed).expect("long enough");
    folder::write(&recording, place.path()).expect("written");
    truth::write(place.path(), runs()).expect("written");
    let back = folder::read(place.path()).expect("the truth is passed over");
    assert_eq!(back.fingerprint(), recording.fingerprint());
    ["tracks.csv", "poses.csv", "imu.csv", "truth.csv"]
        .map(|file| std::fs::read(place.path().join(file)).expect("readable"))
        .into()
}

#[test]
fn the_same_seed_gives_the_same_bytes_in_any_order() {
    let options = ScheduleOptions::default();
    for kind in ScheduleKind::ALL {
        let text =
            |options: &ScheduleOptions| schedules::text(&kind.generate(options).expect("valid"));
        assert_eq!(text(&options), text(&options));
        let other = text(&ScheduleOptions { seed: 2, ..ScheduleOptions::default() });
        assert_eq!(text(&options) == other, kind == ScheduleKind::Square);
    }
    let (sensors, runs) = (Preset::Field.sensors(), driven());
    let first = bytes(&sensors, &runs, 4);
    let backwards: Vec<_> = runs.iter().rev().cloned().collect();
    assert_eq!(first[..3], bytes(&sensors, &backwards, 4)[..3]);
    assert_ne!(first[0], bytes(&sensors, &runs, 5)[0]);
}

#[test]
fn one_noise_does_not_change_another() {
    let (sensors, runs) = (Preset::Field.sensors(), driven());
    let outlier = Outlier::default();
    let without = Sensors { pose: PoseSensor { outlier, ..sensors.pose }, ..sensors.clone() };
    let of = |sensors: &Sensors| sensors.observe(1, &runs[1].1, 4).expect("a motion");
    let (with, without) = (of(&sensors), of(&without));
    assert_eq!((&with.tracks, &with.imu), (&without.tracks, &without.imu));
    let same =
        with.poses.samples.iter().zip(&without.poses.samples).filter(|(a, b)| a == b).count();
    // 0.5 % are outliers
    assert!(same < with.poses.samples.len() && same > with.poses.samples.len() * 97 / 100);
}

#[test]
fn a_motion_without_moments_is_refused() {
    let error = Sensors::default().observe(3, &Trajectory::default(), 0).expect_err("no motion");
    assert_eq!(error.to_string(), "run 3 has no motion to observe");
}
