//! Dead reckoning: the paths that track speeds alone lead along by a vehicle file.

use crate::evidence::Evidence;
use crate::hypothesis::Hypothesis;
use crate::mechanics::{Instruments, Mechanics};
use nalgebra::Vector3;
use std::ops::Range;
use trackdyn_core::Pose;
use trackdyn_model::VehicleFile;

/// The motion of every sample with a vehicle file, moved by the recording's clock where the file
/// says nothing of it, seen from its beginning.
pub fn motions(evidence: &Evidence, file: &VehicleFile) -> Vec<Pose> {
    let hypothesis = Hypothesis::filed(file, &evidence.settings().prior);
    let mut instruments = Instruments::of(&hypothesis);
    if instruments.sensor.delay == 0.0 {
        instruments.sensor.delay = evidence.tau();
    }
    let motions = Mechanics::new(&hypothesis, evidence).predict(&instruments, evidence);
    motions.iter().map(pose).collect()
}

/// A motion as a pose, seen from its beginning.
pub fn pose(motion: &Vector3<f64>) -> Pose {
    Pose::new(motion[0], motion[1], motion[2])
}

/// Observed poses at the beginning of each of some samples, which follow each other in one run, and
/// at the end of the last.
pub fn observed(evidence: &Evidence, chosen: Range<usize>) -> Vec<Pose> {
    let samples = &evidence.samples()[chosen];
    let end = samples.last().map(|last| last.pose.compose(&pose(&last.motion)));
    samples.iter().map(|sample| sample.pose).chain(end).collect()
}

/// Times of these poses, s as those of the samples.
pub fn times(evidence: &Evidence, chosen: Range<usize>) -> Vec<f64> {
    let samples = &evidence.samples()[chosen];
    let end = samples.last().map(|last| last.start + last.duration);
    samples.iter().map(|sample| sample.start).chain(end).collect()
}

/// Predicted motions in a row, from the first observed pose on. Where samples leave a gap, the
/// observed motion bridges it.
pub fn chained(evidence: &Evidence, chosen: Range<usize>, motions: &[Pose]) -> Vec<Pose> {
    let samples = evidence.samples();
    let mut path: Vec<Pose> =
        samples[chosen.clone()].first().map(|first| first.pose).into_iter().collect();
    let Some(mut at) = path.first().copied() else { return path };
    for index in chosen.clone() {
        at = at.compose(&motions[index]);
        let next = index + 1;
        if chosen.contains(&next) && !samples[next].follows {
            let end = samples[index].pose.compose(&pose(&samples[index].motion));
            at = at.compose(&end.relative(&samples[next].pose));
        }
        path.push(at);
    }
    path
}
