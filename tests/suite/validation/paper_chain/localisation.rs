//! Drives, scans, matches, poses, identification.
//!
//! Source: Martinez et al., IJRR 24(10), 2005, section 5.3: a laser of 180 degrees, one scan every
//! 0.27 s, consecutive scans matched. Goal: matches to 5 mm and 0.2 degrees; the ICRs of the
//! simulated map. Conditions: nine eights of about 20 m in a furnished room, ranges with 10 mm of
//! noise, first guess by the encoders and the ideal drive.

use super::ALPHA;
use super::errors::root_mean_square;
use super::models::{FIT_WITH_ALPHA, GAUGE};
use super::robot::{auriga, crawling_auriga, driven_icrs};
use super::scans::Drive;
use rayon::prelude::*;
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;
use trackdyn_estimate::identification::{Identification, Options, identify};
use trackdyn_estimate::{GeneticOptions, Parameters};
use trackdyn_localisation::{LocalisedPose, MatchAgainst, Status};
use trackdyn_model::Model;
use trackdyn_recording::{Recording, Source};

/// Distances (m) and angles (rad) between found and true poses.
struct Deviations {
    distances: Vec<f64>,
    angles: Vec<f64>,
}

impl Deviations {
    fn of(pairs: impl Iterator<Item = (Pose, Pose)>) -> Self {
        let (distances, angles) = pairs
            .map(|(found, truth)| {
                let distance = (found.x - truth.x).hypot(found.y - truth.y);
                (distance, wrap_angle(found.yaw - truth.yaw).abs())
            })
            .unzip();
        Self { distances, angles }
    }

    /// Root mean square, largest (mm); the same (degrees).
    fn summary(&self) -> [f64; 4] {
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        [
            1e3 * root_mean_square(&self.distances),
            1e3 * largest(&self.distances),
            root_mean_square(&self.angles).to_degrees(),
            largest(&self.angles).to_degrees(),
        ]
    }
}

fn identified(drives: &[Drive], localised: &[Vec<LocalisedPose>]) -> (Recording, Identification) {
    let runs = drives.iter().zip(localised).map(|(drive, poses)| drive.run(poses)).collect();
    let recording = Recording::new("eights", "Auriga-alpha", runs, Source::computed(), Vec::new())
        .expect("long enough");
    // Least squares does not depend on the genetic algorithm.
    let genetic = GeneticOptions { generations: 1, ..GeneticOptions::default() };
    let options = Options { genetic, ..Options::new(GAUGE) };
    let found = identify(&recording, &options, &|_| ()).expect("enough segments");
    (recording, found)
}

/// Poses against their truth: motions from scan to scan, and places on the path.
struct Accuracy {
    matches: Deviations,
    poses: Deviations,
}

impl Accuracy {
    fn of(drives: &[Drive], localised: &[Vec<LocalisedPose>]) -> Self {
        let motions = |poses: &[Pose]| -> Vec<Pose> {
            poses.windows(2).map(|pair| pair[0].relative(&pair[1])).collect()
        };
        let runs = || {
            drives.iter().zip(localised).map(|(drive, found)| {
                let found: Vec<Pose> = found.iter().map(|pose| pose.estimate.pose).collect();
                (found, drive.truth())
            })
        };
        Self {
            matches: Deviations::of(
                runs().flat_map(|(found, truth)| motions(&found).into_iter().zip(motions(&truth))),
            ),
            poses: Deviations::of(runs().flat_map(|(found, truth)| found.into_iter().zip(truth))),
        }
    }

    fn print(&self, name: &str) {
        let numbers = [self.matches.summary(), self.poses.summary()].concat();
        let cells: Vec<String> = numbers.iter().map(|value| format!("{value:.3}")).collect();
        println!("{name} | {}", cells.join(" | "));
    }
}

/// The parameters with α, against the mean ICRs of the motions that were driven; `tolerance` is
/// that of a parameter with this standard deviation.
fn check_parameters(
    model: &Model,
    drives: &[Drive],
    localised: &[Vec<LocalisedPose>],
    tolerance: impl Fn(usize, f64) -> f64,
) {
    let (recording, found) = identified(drives, localised);
    let estimate = found.fits[FIT_WITH_ALPHA].least_squares.as_ref().expect("determined");
    let driven = driven_icrs(model, &recording);
    let truth = [driven.x_left, driven.x_right, driven.y, ALPHA.left, ALPHA.right];
    println!("clock offset {:.4} s, whitened rms {:.2}", found.clock.tau(), estimate.whitened_rms);
    for (k, truth) in truth.into_iter().enumerate() {
        let (value, deviation) = (estimate.parameters.0[k], estimate.deviations()[k]);
        println!("{}: {value:.5} ({deviation:.5}), driven {truth:.5}", Parameters::NAMES[k]);
        let error = (value - truth).abs();
        assert!(error < tolerance(k, deviation), "parameter {k}: {value}, not {truth}");
    }
}

#[test]
fn laser_localisation_gives_the_map_of_a_crawling_robot_within_intervals() {
    let model = crawling_auriga();
    let drives: Vec<Drive> = (0..9_i64).into_par_iter().map(|id| Drive::new(&model, id)).collect();
    let localised: Vec<_> =
        drives.par_iter().map(|drive| drive.localised(MatchAgainst::Previous)).collect();
    check_parameters(&model, &drives, &localised, |_, deviation| 4.0 * deviation);
}

#[test]
fn laser_localisation_gives_the_parameters_of_the_motions() {
    let model = auriga();
    let drives: Vec<Drive> = (0..9_i64).into_par_iter().map(|id| Drive::new(&model, id)).collect();
    println!("against | match rms, worst [mm] | [deg] | pose rms, worst [mm] | [deg]");
    let [previous, keyframes] = [MatchAgainst::Previous, MatchAgainst::Keyframes { overlap: 0.6 }]
        .map(|against| {
            let localised: Vec<_> =
                drives.par_iter().map(|drive| drive.localised(against)).collect();
            let converged = |pose: &LocalisedPose| pose.status == Status::Converged;
            assert!(localised.iter().flatten().all(converged), "{against:?}");
            let accuracy = Accuracy::of(&drives, &localised);
            accuracy.print(&format!("{against:?}"));
            // As on the manual paths: what one triple of ICRs cannot follow.
            let tolerance = |k: usize, _| if k < 3 { 0.005 } else { 0.003 };
            check_parameters(&model, &drives, &localised, tolerance);
            accuracy
        });
    // 5 mm are three standard deviations where the room shows least: up to three in a thousand
    // beyond.
    let Deviations { distances, angles } = &previous.matches;
    let beyond = distances.iter().filter(|distance| **distance > 0.005).count();
    assert!(1000 * beyond <= 3 * distances.len(), "{beyond} of {} beyond 5 mm", distances.len());
    assert!(angles.iter().all(|angle| *angle < 0.2_f64.to_radians()));
    // What keyframes are for: errors do not add up with every scan.
    let drift = |accuracy: &Accuracy| root_mean_square(&accuracy.poses.distances);
    assert!(drift(&keyframes) < drift(&previous));
}
