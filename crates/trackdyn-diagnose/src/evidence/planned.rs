//! Evidence of planned driving: the samples that a drive would give.

use super::{Evidence, Origin, Sample};
use crate::settings::Settings;
use nalgebra::Vector3;
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_recording::TrackSample;
use trackdyn_recording::hold::{held, travelled};

/// Encoder readings in a sample, as in the paper: nine of 30 ms per 0.27 s.
pub const READINGS: usize = 9;

/// A planned run.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedRun {
    /// Track readings at equal intervals, whole samples of [`READINGS`], plus one that ends the
    /// run.
    pub tracks: Vec<TrackSample>,
    /// Pose at the first reading.
    pub pose: Pose,
    /// Indices of the readings at which blocks begin, ascending, starting with the first.
    pub blocks: Vec<usize>,
}

impl Evidence {
    /// Samples of planned runs. `moves` predicts the motion of each sample. As motion may depend on
    /// the pose, it is called twice, the second time with poses integrated from its first answer.
    /// `tau` is the delay of the poses, s.
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
            begin: 0.0,
            has_world: true,
            origin: Origin::Drive(noise),
            starts: None,
            gyroscope: None,
            description: format!("{blocks} planned manoeuvres"),
            settings: Arc::new(settings.clone()),
        };
        let first = still.moved(runs, &moves(&still));
        first.moved(runs, &moves(&first))
    }

    /// Pose at the end of the last sample of a run.
    pub fn last_pose(&self, run: usize) -> Option<Pose> {
        let last = self.samples.iter().rfind(|sample| sample.run == run)?;
        Some(last.pose.compose(&pose(&last.motion)))
    }

    /// The evidence with these motions, with poses integrated from the start of each run.
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
            has_place: [true; 2],
        }
    })
}
