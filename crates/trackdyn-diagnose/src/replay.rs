//! Dead reckoning: the paths that track speeds alone lead along by a vehicle file.

use crate::evidence::Evidence;
use crate::hypothesis::Hypothesis;
use crate::mechanics::{Instruments, Mechanics};
use nalgebra::Vector3;
use std::ops::Range;
use trackdyn_core::Pose;
use trackdyn_model::{Sensor, VehicleFile};

/// The motion of every sample with a vehicle file, seen from its beginning; none where it has no
/// motion in time. Where the file states no delay, poses come late by the time that suits its
/// turning best. The recording's own offset does not serve: it also includes the time by which
/// inertia delays the robot.
pub fn motions(evidence: &Evidence, file: &VehicleFile) -> Option<Vec<Pose>> {
    let hypothesis = Hypothesis::filed(file, &evidence.settings().prior);
    let mechanics = Mechanics::new(&hypothesis, evidence);
    let moves = mechanics.failure().is_none();
    moves.then(|| by(&mechanics, &Instruments::of(&hypothesis), evidence))
}

fn by(mechanics: &Mechanics, instruments: &Instruments, evidence: &Evidence) -> Vec<Pose> {
    let moved = |delay: f64| {
        let sensor = Sensor { delay, ..instruments.sensor };
        mechanics.predict(&Instruments { sensor, ..*instruments }, evidence)
    };
    let motions = if instruments.sensor.delay == 0.0 {
        let all = delays(evidence).map(moved);
        let all = all.map(|motions| (turned_apart(evidence, &motions), motions));
        all.min_by(|a, b| a.0.total_cmp(&b.0)).map_or_else(Vec::new, |best| best.1)
    } else {
        moved(instruments.sensor.delay)
    };
    motions.iter().map(pose).collect()
}

/// Delays of poses that are tried, s: those that the readings of all samples cover, around the
/// recording's own offset.
fn delays(evidence: &Evidence) -> impl Iterator<Item = f64> {
    let settings = evidence.settings();
    let (step, margin) = (settings.drift.delay_step, settings.evidence.clock_margin);
    let own = evidence.tau();
    let [first, last] = [own.min(0.0) - margin, own.max(0.0) + margin];
    let [back, on] = [first, last].map(|end| ((end - own) / step).trunc());
    let steps = std::iter::successors(Some(back), |k| Some(k + 1.0));
    steps.take_while(move |k| *k <= on).map(move |k| own + k * step)
}

/// Sum of the errors of yaw, rad.
fn turned_apart(evidence: &Evidence, motions: &[Vector3<f64>]) -> f64 {
    let samples = evidence.samples().iter().zip(motions);
    samples.map(|(sample, motion)| (sample.motion[2] - motion[2]).abs()).sum()
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
