//! What contradicts a fit is said, and what does not is left alone.

use crate::recovery::{GAUGE, drive};
use rayon::prelude::*;
use trackdyn_core::PerSide;
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
