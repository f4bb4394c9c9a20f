//! Evidence of driving that is planned: what a drive would show.

use super::{Evidence, Origin, Sample};
use crate::settings::Settings;
use nalgebra::Vector3;
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_recording::TrackSample;
use trackdyn_recording::hold::{held, travelled};

/// Readings of the encoders in a sample, as in the paper: nine of 30 ms per 0.27 s.
pub const READINGS: usize = 9;

/// A run that is planned.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRun {
    /// Readings of the tracks, at equal intervals, whole samples of [`READINGS`]; one more ends the
    /// run.
    pub tracks: Vec<TrackSample>,
    /// Pose at the first of them.
    pub pose: Pose,
    /// Readings at which blocks begin, the first one among them, ascending.
    pub blocks: Vec<usize>,
}

impl Evidence {
    /// What runs would show. `moves` says how the robot moves in each sample; as this may hang on
    /// where it is, it is asked twice, the second time with the poses that follow from its first
    /// answer. `tau` is by how much the poses would be late, s.
    pub fn planned(
        runs: &[PlannedRun],
        noise: SegmentNoise,
        tau: f64,
        settings: &Settings,
        moves: impl Fn(&Self) -> Vec<Vector3<f64>>,
    ) -> Self {
        let mut samples = Vec::new();
        let mut blocks = 0;
        for (index, run) in runs.iter().enumerate() {
            samples.extend(samples_of(index, run, blocks, tau));
            blocks += run.blocks.len();
        }
        let still = Self {
            samples: samples.into(),
            tracks: runs.iter().map(|run| run.tracks.clone()).collect(),
            blocks,
            runs: (0..).take(runs.len()).collect(),
            tau,
            origin: Origin::Drive(noise),
            description: format!("{blocks} planned manoeuvres"),
            settings: Arc::new(settings.clone()),
        };
        let first = still.moved(runs, &moves(&still));
        first.moved(runs, &moves(&first))
    }

    /// The pose at which the last sample of a run ends.
    pub fn last_pose(&self, run: usize) -> Option<Pose> {
        let last = self.samples.iter().rfind(|sample| sample.run == run)?;
        Some(last.pose.compose(&pose(&last.motion)))
    }

    /// What it would be with these motions of the samples, one after the other from where each run
    /// begins.
    fn moved(&self, runs: &[PlannedRun], motions: &[Vector3<f64>]) -> Self {
        let mut at = Pose::default();
        let mut run = None;
        let samples = self.samples.iter().zip(motions).map(|(sample, motion)| {
            if run.replace(sample.run) != Some(sample.run) {
                at = runs[sample.run].pose;
            }
            let moved = Sample { pose: at, motion: *motion, ..*sample };
            at = at.compose(&pose(motion));
            moved
        });
        Self { samples: samples.collect(), ..self.clone() }
    }
}

fn pose(motion: &Vector3<f64>) -> Pose {
    Pose::new(motion[0], motion[1], motion[2])
}

fn samples_of(
    index: usize,
    run: &PlannedRun,
    first_block: usize,
    tau: f64,
) -> impl Iterator<Item = Sample> {
    let tracks = &run.tracks;
    (0..tracks.len().saturating_sub(1) / READINGS).map(move |k| {
        let (first, last) = (k * READINGS, (k + 1) * READINGS);
        let (start, end) = (tracks[first].t, tracks[last].t);
        let duration = end - start;
        let mut pieces = held(tracks, start, end, tau);
        let before = pieces.next().map_or(PerSide::default(), |piece| piece.speeds);
        let after = pieces.last().map_or(before, |piece| piece.speeds);
        let block = run.blocks.partition_point(|begins| *begins <= first).saturating_sub(1);
        Sample {
            run: index,
            block: first_block + block,
            start,
            duration,
            motion: Vector3::zeros(),
            pose: run.pose,
            speeds: travelled(tracks, start, end, tau).map(|distance| distance / duration),
            acceleration: PerSide::from_fn(|side| (after[side] - before[side]) / duration),
            follows: k > 0,
        }
    })
}
