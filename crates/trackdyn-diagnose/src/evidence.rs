//! What was seen, in one form for drives and for tables of steady motion.
//!
//! A sample is a motion over a time in which the track speeds are known. A steady operating point is one of a
//! microsecond: what moves so shortly moves by its velocity, and the same prediction serves both.

pub mod planned;
mod points;
mod series;
mod ticks;

pub use series::FEWEST;

use crate::huber;
use crate::normal::{Columns, Normal};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::regular::regularise;
use trackdyn_estimate::weighting::{Seen, SegmentNoise, Weighting, Whitener};
use trackdyn_recording::TrackSample;

/// One observed motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Index of its run.
    pub run: usize,
    /// Index of the block that it belongs to: blocks are independent of one another.
    pub block: usize,
    /// Time at which it begins, s of the pose clock since the recording began.
    pub start: f64,
    /// How long it lasts, s.
    pub duration: f64,
    /// Motion seen from its first pose: forward (m), left (m), yaw (rad).
    pub motion: Vector3<f64>,
    /// Pose at which it begins, in the frame of its run.
    pub pose: Pose,
    /// Mean track speeds, m/s.
    pub speeds: PerSide<f64>,
    /// Change of the track speeds over it, per its length, m/s².
    pub acceleration: PerSide<f64>,
    /// Whether its first pose is the last one of the sample before it.
    pub follows: bool,
}

/// The samples of recordings or of a table, and what their residuals weigh.
#[derive(Clone)]
pub struct Evidence {
    samples: Vec<Sample>,
    tracks: Vec<Vec<TrackSample>>,
    whitening: Whitening,
    /// By what the whitened residuals of each channel are larger than the noise says.
    scale: [f64; 3],
    blocks: usize,
    /// Number of each run in the recording.
    runs: Vec<i64>,
    tau: f64,
    is_steady: bool,
    description: String,
}

#[derive(Clone)]
enum Whitening {
    /// Neighbours share a noisy pose.
    Segments { noise: SegmentNoise, whitener: Arc<Whitener>, lost: Arc<[bool]> },
    /// Inverse standard deviations of the channels; zero where one was not measured.
    Points(Vec<Vector3<f64>>),
}

impl Whitening {
    fn of(noise: SegmentNoise, samples: &[Sample]) -> Self {
        Self::without(noise, samples, vec![false; samples.len()].into())
    }

    /// The same without the samples that are lost: they tell nothing, nor of their neighbours.
    fn without(noise: SegmentNoise, samples: &[Sample], lost: Arc<[bool]>) -> Self {
        let seen = samples.iter().enumerate().map(|(index, sample)| Seen {
            motion: sample.motion.into(),
            duration: sample.duration,
            run: sample.run,
            is_lost: lost[index],
            follows: sample.follows && !(index > 0 && lost[index - 1]),
        });
        let whitener = Arc::new(Whitener::of_motions(&Weighting::Noise(noise), seen));
        Self::Segments { noise, whitener, lost }
    }
}

impl Evidence {
    /// The samples, runs in a row.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Readings of the tracks of each run; none of a run without samples.
    pub fn tracks(&self) -> &[Vec<TrackSample>] {
        &self.tracks
    }

    /// Number of each run in the recording.
    pub fn runs(&self) -> &[i64] {
        &self.runs
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// What counts as independent and what the noise is taken from, in words.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Clock offset of the poses against the encoders that the recording itself shows, s.
    pub fn tau(&self) -> f64 {
        self.tau
    }

    /// Whether it is a table of steady motions: without places, headings, times and transients.
    pub fn is_steady(&self) -> bool {
        self.is_steady
    }

    /// The largest track speed, m/s.
    pub fn fastest(&self) -> f64 {
        let speeds = self.tracks.iter().flatten();
        speeds.fold(0.0, |most, track| most.max(track.v_left.abs()).max(track.v_right.abs()))
    }

    /// Noise of the segments of a recording; none of a table.
    pub fn noise(&self) -> Option<&SegmentNoise> {
        match &self.whitening {
            Whitening::Segments { noise, .. } => Some(noise),
            Whitening::Points(_) => None,
        }
    }

    /// The same samples with another noise of their segments.
    pub fn with_noise(&self, noise: SegmentNoise) -> Self {
        let lost = match &self.whitening {
            Whitening::Segments { lost, .. } => Arc::clone(lost),
            Whitening::Points(_) => vec![false; self.samples.len()].into(),
        };
        Self { whitening: Whitening::without(noise, &self.samples, lost), ..self.clone() }
    }

    /// The same with white residuals of each channel this much smaller: they are larger than the noise says.
    pub fn with_scale(&self, scale: [f64; 3]) -> Self {
        Self { scale, ..self.clone() }
    }

    /// By what the whitened residuals of each channel are taken to be larger than the noise says.
    pub fn scale(&self) -> [f64; 3] {
        self.scale
    }

    /// The same with readings at regular times: stamps of a clock that ticks evenly, and is read late by chance.
    pub fn with_regular_stamps(&self) -> Self {
        let mut tracks = self.tracks.clone();
        for run in &mut tracks {
            regularise(run, |reading| &mut reading.t);
        }
        Self { tracks, ..self.clone() }
    }

    /// Steps in which the encoders' speeds come for the ticks that they count, m/s.
    pub fn steps(&self) -> PerSide<f64> {
        ticks::steps(&self.tracks)
    }

    /// The same with even speeds between the ticks of encoders whose speeds come in such steps, m/s.
    pub fn with_speeds_between_ticks(&self, steps: PerSide<f64>) -> Self {
        Self { tracks: ticks::smoothed(&self.tracks, steps), ..self.clone() }
    }

    /// The same without some samples of a recording.
    pub fn without(&self, samples: &[usize]) -> Self {
        let Whitening::Segments { noise, lost, .. } = &self.whitening else { return self.clone() };
        let mut lost = lost.to_vec();
        for &sample in samples {
            lost[sample] = true;
        }
        Self { whitening: Whitening::without(*noise, &self.samples, lost.into()), ..self.clone() }
    }

    /// The same with all samples of a recording again.
    pub fn with_all(&self) -> Self {
        let Whitening::Segments { noise, .. } = &self.whitening else { return self.clone() };
        Self { whitening: Whitening::of(*noise, &self.samples), ..self.clone() }
    }

    /// What these runs show, by whether each of all is one of them.
    pub fn of_runs(&self, runs: &[bool]) -> Self {
        fn kept<T: Clone>(all: &[T], kept: &[usize]) -> Vec<T> {
            kept.iter().map(|&index| all[index].clone()).collect()
        }
        let indices: Vec<usize> =
            (0..self.samples.len()).filter(|&index| runs[self.samples[index].run]).collect();
        let mut samples = kept(&self.samples, &indices);
        let blocks: BTreeSet<usize> = samples.iter().map(|sample| sample.block).collect();
        let numbers: BTreeMap<usize, usize> = blocks.into_iter().zip(0..).collect();
        for sample in &mut samples {
            sample.block = numbers[&sample.block];
        }
        let whitening = match &self.whitening {
            Whitening::Segments { noise, lost, .. } => {
                Whitening::without(*noise, &samples, kept(lost, &indices).into())
            }
            Whitening::Points(inverse) => Whitening::Points(kept(inverse, &indices)),
        };
        let tracks = self.tracks.iter().zip(runs);
        let tracks = tracks.map(|(run, kept)| if *kept { run.clone() } else { Vec::new() });
        Self { tracks: tracks.collect(), whitening, blocks: numbers.len(), samples, ..self.clone() }
    }

    /// Makes a column of residuals or of their derivatives white by the noise, in place: unit variance, no correlation.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments { whitener, lost, .. } => {
                for (value, _) in column.iter_mut().zip(lost.iter()).filter(|(_, lost)| **lost) {
                    *value = Vector3::zeros();
                }
                whitener.whiten(column);
                for (value, _) in column.iter_mut().zip(lost.iter()).filter(|(_, lost)| **lost) {
                    *value = Vector3::zeros();
                }
            }
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse) {
                    value.component_mul_assign(inverse);
                }
            }
        }
    }

    /// A column of residuals or of their derivatives, whitened and scaled.
    pub fn white(&self, mut column: Vec<Vector3<f64>>) -> Vec<Vector3<f64>> {
        self.whiten(&mut column);
        let inverse = Vector3::from(self.scale.map(f64::recip));
        for value in &mut column {
            value.component_mul_assign(&inverse);
        }
        column
    }

    /// The white residual of a prediction.
    pub fn residual(&self, prediction: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let samples = self.samples.iter().zip(prediction);
        self.white(samples.map(|(sample, motion)| sample.motion - motion).collect())
    }

    /// The normal equations of a white residual and white columns, by blocks.
    pub fn normal(&self, residual: &[Vector3<f64>], columns: &[Vec<Vector3<f64>>]) -> Normal {
        let blocks: Vec<usize> = self.samples.iter().map(|sample| sample.block).collect();
        let (weights, count) = (&huber::weights(residual), self.blocks);
        Normal::new(&Columns { residual, columns, weights, blocks: &blocks, count })
    }

    /// By what a white residual is larger in each channel than the noise says, from its median: one where nothing is left
    /// but noise.
    pub fn residual_scale(&self, residual: &[Vector3<f64>]) -> [f64; 3] {
        std::array::from_fn(|channel| {
            let measured = residual.iter().enumerate();
            let measured = measured.filter(|(index, _)| self.is_measured(*index, channel));
            let mut values: Vec<f64> =
                measured.map(|(_, z)| z[channel] * self.scale[channel]).collect();
            deviation_about_zero(&mut values).unwrap_or(1.0)
        })
    }

    /// Gives a white column the noise's correlations, in place: the inverse of [`Evidence::whiten`].
    pub fn colour(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments { whitener, .. } => whitener.colour(column),
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse) {
                    value.component_div_assign(&inverse.map(|i| if i > 0.0 { i } else { 1.0 }));
                }
            }
        }
    }

    /// Logarithms of the determinants of what whitens each sample, given those before it; none of a table.
    pub fn ln_determinants(&self) -> Vec<f64> {
        match &self.whitening {
            Whitening::Segments { whitener, .. } => whitener.ln_determinants().collect(),
            Whitening::Points(_) => Vec::new(),
        }
    }

    /// Numbers that were measured: of each sample up to three.
    pub fn measured(&self) -> usize {
        let is_measured =
            |sample| (0..3).filter(|&channel| self.is_measured(sample, channel)).count();
        (0..self.samples.len()).map(is_measured).sum()
    }

    /// Whether a channel of a sample was measured.
    pub fn is_measured(&self, sample: usize, channel: usize) -> bool {
        match &self.whitening {
            Whitening::Segments { lost, .. } => !lost[sample],
            Whitening::Points(inverse) => inverse[sample][channel] > 0.0,
        }
    }
}
