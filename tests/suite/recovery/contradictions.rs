//! What contradicts a fit is said, and what does not is left alone.

use crate::recovery::{GAUGE, drive, record};
use rayon::prelude::*;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::Contradiction;
use trackdyn_estimate::genetic::GeneticOptions;
use trackdyn_estimate::identification::{Identification, Options, identify};
use trackdyn_estimate::synthetic::{ConstantIcr, Synthetic, random_steps};
use trackdyn_recording::{Recording, Run, Source};

fn identified(recording: &Recording, gauge: f64) -> Identification {
    let genetic = GeneticOptions { population: 20, generations: 20, ..GeneticOptions::default() };
    let options = Options { genetic, ..Options::new(gauge) };
    identify(recording, &options, &|_| ()).expect("long enough")
}

fn contradictions(recording: &Recording, gauge: f64) -> Vec<Contradiction> {
    let [icrs, _] = identified(recording, gauge).fits;
    icrs.contradictions
}

#[test]
fn nothing_contradicts_a_drive_as_it_was() {
    let found: Vec<_> =
        (0..20).into_par_iter().flat_map_iter(|seed| contradictions(&drive(seed), GAUGE)).collect();
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn icrs_between_the_tracks_are_refused() {
    let found = contradictions(&drive(1), 1.2);
    assert!(matches!(found[..], [Contradiction::Efficiency { chi }] if chi > 1.3), "{found:?}");
}

/// Miles per hour in place of m/s: less than what makes a reader doubt, and no slip.
#[test]
fn a_unit_that_a_reader_lets_pass_contradicts_both_fits() {
    let mut runs: Vec<_> = drive(2).runs().iter().cloned().map(Run::into_rows).collect();
    for reading in runs.iter_mut().flat_map(|run| &mut run.tracks.samples) {
        reading.v_left *= 2.237;
        reading.v_right *= 2.237;
    }
    let recording = Recording::new("mph", "robot", runs, Source::computed(), Vec::new());
    let [icrs, with_alphas] = identified(&recording.expect("long enough"), GAUGE).fits;
    for fit in [icrs, with_alphas] {
        let text = fit.contradictions.iter().map(ToString::to_string).collect::<String>();
        assert!(text.contains("--speed-unit mph"), "{text}");
    }
}

/// A drive whose poses or readings are changed: forward and left (m), yaw (rad); or both speeds.
fn changed(
    seed: u64,
    pose: impl Fn(Pose) -> Pose,
    speeds: impl Fn(PerSide<f64>) -> PerSide<f64>,
) -> Recording {
    let mut runs: Vec<_> = drive(seed).runs().iter().cloned().map(Run::into_rows).collect();
    for run in &mut runs {
        for sample in &mut run.poses.samples {
            sample.pose = pose(sample.pose);
        }
        for reading in &mut run.tracks.samples {
            let PerSide { left, right } = speeds(reading.speeds());
            (reading.v_left, reading.v_right) = (left, right);
        }
    }
    let recording = Recording::new("changed", "robot", runs, Source::computed(), Vec::new());
    recording.expect("long enough")
}

fn texts(found: &[Contradiction]) -> String {
    found.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// A diameter in place of a radius: the ICRs would take all of it for slip.
#[test]
fn track_speeds_that_are_wrong_by_a_factor_contradict_both_fits() {
    for factor in [0.5, 0.7, 1.4, 2.0] {
        let recording = changed(3, |pose| pose, |speeds| speeds.map(|v| factor * v));
        for fit in identified(&recording, GAUGE).fits {
            let is_named = |found: &Contradiction| matches!(found, Contradiction::Alpha { .. });
            assert!(fit.contradictions.iter().any(is_named), "{factor}: {:?}", fit.contradictions);
        }
    }
}

/// Poses in mm and speeds in mm/s agree with each other, and with no robot.
#[test]
fn one_wrong_unit_of_all_lengths_is_named() {
    let scaled = |pose: Pose| Pose { x: 1e3 * pose.x, y: 1e3 * pose.y, ..pose };
    let recording = changed(4, scaled, |speeds| speeds.map(|v| 1e3 * v));
    let found = contradictions(&recording, GAUGE);
    assert!(found.iter().any(|one| matches!(one, Contradiction::Apart { .. })), "{found:?}");
    assert!(texts(&found).contains("units of poses"), "{}", texts(&found));
}

/// So do poses in feet and speeds in feet per second, by less.
#[test]
fn feet_of_all_lengths_are_named() {
    let scaled = |pose: Pose| Pose { x: pose.x / 0.3048, y: pose.y / 0.3048, ..pose };
    let recording = changed(4, scaled, |speeds| speeds.map(|v| v / 0.3048));
    let found = contradictions(&recording, GAUGE);
    assert!(texts(&found).contains("which in feet would make it 0.5"), "{}", texts(&found));
}

/// A sensor that looks to the side shows the turns, and each ICR in the wrong place.
#[test]
fn a_turned_sensor_is_named_with_its_angle() {
    for degrees in [-90.0_f64, 30.0, 90.0] {
        let turned = |pose: Pose| Pose { yaw: pose.yaw + degrees.to_radians(), ..pose };
        let found = contradictions(&changed(5, turned, |speeds| speeds), GAUGE);
        let mount = found.iter().find_map(|one| match one {
            Contradiction::Way { mount, .. } => *mount,
            _ => None,
        });
        let mount = mount.unwrap_or_else(|| panic!("{degrees}: {found:?}"));
        assert!((mount.to_degrees() - degrees).abs() < 5.0, "{mount} rad for {degrees} degrees");
        assert!(texts(&found).contains("--mount-yaw"), "{}", texts(&found));
    }
}

/// A tracker that loses itself for more than half of a log.
#[test]
fn the_time_in_which_poses_go_astray_is_named() {
    let schedule = random_steps(60, 1.98, 0.8, 8);
    let recording = record(vec![schedule], 8);
    let mut runs: Vec<_> = recording.runs().iter().cloned().map(Run::into_rows).collect();
    for sample in &mut runs[0].poses.samples {
        if (20.0..95.0).contains(&sample.t) {
            let wild = (1e3 * sample.t).sin();
            sample.pose.x += 0.3 * wild;
            sample.pose.y += 0.3 * (777.0 * sample.t).sin();
        }
    }
    let recording = Recording::new("astray", "robot", runs, Source::computed(), Vec::new());
    let text = texts(&contradictions(&recording.expect("long enough"), GAUGE));
    assert!(text.contains("from 20 s to 9") && text.contains("--time"), "{text}");
}

/// Positions that a filter made up beside a heading that is right.
#[test]
fn positions_without_a_measurement_are_named() {
    for pose in [
        |pose: Pose| Pose { x: 0.0, y: 0.0, ..pose },
        |pose: Pose| Pose { x: pose.y, y: pose.x, ..pose },
        |pose: Pose| Pose { y: -pose.y, ..pose },
    ] {
        let found = contradictions(&changed(6, pose, |speeds| speeds), GAUGE);
        // Poses that stand still look like tracks without grip.
        let is_named = |one: &Contradiction| match one {
            Contradiction::Way { mount, .. } => mount.is_none(),
            Contradiction::Alpha { alpha, .. } => *alpha < 0.01,
            _ => false,
        };
        assert!(found.iter().any(is_named), "{found:?}");
    }
}

/// Poses of an ideal drive, as a controller computes them; with slip they are those of a robot.
#[test]
fn wheel_odometry_is_told_from_poses() {
    let computed = |half: f64, y: f64| {
        let alpha = PerSide::new(1.0, 1.0);
        let kinematics = ConstantIcr { x_left: -half, x_right: half, y, alpha };
        let schedules = vec![random_steps(40, 2.0, 0.8, 5)];
        let synthetic = Synthetic { kinematics, schedules, ..Synthetic::default() };
        synthetic.recording().expect("long enough")
    };
    let found = contradictions(&computed(0.5 * GAUGE, 0.0), GAUGE);
    assert!(matches!(found[..], [Contradiction::WheelOdometry { .. }]), "{found:?}");
    let text = found[0].to_string();
    assert!(text.contains("computed from the tracks"), "{text}");
    assert!(contradictions(&computed(0.4, 0.05), GAUGE).is_empty());
}

/// Odometry that a driver rounds, delays or fuses with a gyroscope is still odometry: its ICRs are
/// on the centre-lines of the tracks, or it never moves to the side.
#[test]
fn wheel_odometry_with_errors_is_told_from_poses() {
    let computed = |[x_left, x_right]: [f64; 2], position_noise: f64| {
        let alpha = PerSide::new(1.0, 1.0);
        let kinematics = ConstantIcr { x_left, x_right, y: 0.0, alpha };
        let schedules = vec![random_steps(150, 2.0, 0.8, 5)];
        let yaw_noise = position_noise;
        let synthetic =
            Synthetic { kinematics, schedules, position_noise, yaw_noise, ..Synthetic::default() };
        contradictions(&synthetic.recording().expect("long enough"), GAUGE)
    };
    for found in [
        computed([-0.5 * GAUGE, 0.5 * GAUGE], 0.005),
        computed([-0.495 * GAUGE, 0.505 * GAUGE], 0.0),
        computed([-0.4, 0.45], 0.0),
    ] {
        assert!(matches!(found[..], [Contradiction::WheelOdometry { .. }]), "{found:?}");
    }
    assert!(computed([-0.4, 0.45], 0.005).is_empty());
}

/// A wheel radius that is wrong is no slip: the fit with factors is right, the other one is not.
#[test]
fn factors_that_explain_what_is_left_contradict_the_fit_without_them() {
    let off = changed(3, |pose| pose, |speeds| speeds.map(|speed| 1.2 * speed));
    let [icrs, with_alphas] = identified(&off, GAUGE).fits;
    let is_of_factors = |of: &Contradiction| matches!(of, Contradiction::Factors { .. });
    assert!(icrs.contradictions.iter().any(is_of_factors), "{:?}", icrs.contradictions);
    assert!(with_alphas.contradictions.is_empty(), "{:?}", with_alphas.contradictions);
}
