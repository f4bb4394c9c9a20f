//! What was seen, in one form for drives and for tables of steady motion.
//!
//! A sample is a motion over a time in which the track speeds are known. A steady operating point
//! is one of a microsecond: what moves so shortly moves by its velocity, and the same prediction
//! serves both.

pub mod planned;
mod points;
mod series;
mod ticks;

use crate::settings::Settings;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose};
use trackdyn_estimate::regular::regularise;
use trackdyn_estimate::weighting::SegmentNoise;
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

/// What samples are, and how noisy they are by themselves, before any model is asked.
#[derive(Clone, Debug)]
pub enum Origin {
    /// Segments of a drive, whose neighbours share a noisy pose, with the noise that was measured
    /// on the recording.
    Drive(SegmentNoise),
    /// Points of steady motion, without places, headings, times and transients, with the inverse
    /// standard deviation of each channel of each; zero where one was not measured.
    SteadyPoints(Arc<[Vector3<f64>]>),
}

impl Origin {
    /// What one sample is, in the plural.
    pub fn samples(&self) -> &'static str {
        match self {
            Self::Drive(_) => "segments",
            Self::SteadyPoints(_) => "points",
        }
    }

    /// What is held out as a whole, in the plural.
    pub fn runs(&self) -> &'static str {
        match self {
            Self::Drive(_) => "runs",
            Self::SteadyPoints(_) => "points",
        }
    }
}

/// The samples of recordings or of a table, and the settings by which they are diagnosed. It does
/// not change; what its residuals weigh is [`Weighted`](crate::weighted::Weighted)'s to say.
#[derive(Clone)]
pub struct Evidence {
    samples: Arc<[Sample]>,
    tracks: Vec<Vec<TrackSample>>,
    blocks: usize,
    /// Number of each run in the recording.
    runs: Vec<i64>,
    tau: f64,
    origin: Origin,
    description: String,
    settings: Arc<Settings>,
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

    /// What its samples are: segments of a drive, or points of steady motion.
    pub fn origin(&self) -> &Origin {
        &self.origin
    }

    /// The settings by which it was made and is diagnosed.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The largest track speed, m/s.
    pub fn fastest(&self) -> f64 {
        let speeds = self.tracks.iter().flatten();
        speeds.fold(0.0, |most, track| most.max(track.v_left.abs()).max(track.v_right.abs()))
    }

    /// The evidence with readings at regular times: stamps of a clock that ticks evenly, and is
    /// read late by chance.
    pub fn with_regular_stamps(&self) -> Self {
        let mut tracks = self.tracks.clone();
        for run in &mut tracks {
            regularise(run, |reading| &mut reading.t);
        }
        Self { tracks, ..self.clone() }
    }

    /// Steps in which the encoders' speeds come for the ticks that they count, m/s.
    pub fn steps(&self) -> PerSide<f64> {
        ticks::steps(&self.tracks, &self.settings.evidence)
    }

    /// The evidence with even speeds between the ticks of encoders whose speeds come in such steps,
    /// m/s.
    pub fn with_speeds_between_ticks(&self, steps: PerSide<f64>) -> Self {
        Self {
            tracks: ticks::smoothed(&self.tracks, steps, &self.settings.evidence),
            ..self.clone()
        }
    }

    /// What these runs show, by whether each of all is one of them.
    pub fn of_runs(&self, runs: &[bool]) -> Self {
        let indices: Vec<usize> =
            (0..self.samples.len()).filter(|&index| runs[self.samples[index].run]).collect();
        let mut samples: Vec<Sample> = indices.iter().map(|&index| self.samples[index]).collect();
        let blocks: BTreeSet<usize> = samples.iter().map(|sample| sample.block).collect();
        let numbers: BTreeMap<usize, usize> = blocks.into_iter().zip(0..).collect();
        for sample in &mut samples {
            sample.block = numbers[&sample.block];
        }
        let origin = match &self.origin {
            Origin::Drive(noise) => Origin::Drive(*noise),
            Origin::SteadyPoints(inverse) => {
                Origin::SteadyPoints(indices.iter().map(|&index| inverse[index]).collect())
            }
        };
        let tracks = self.tracks.iter().zip(runs);
        let tracks = tracks.map(|(run, kept)| if *kept { run.clone() } else { Vec::new() });
        Self {
            samples: samples.into(),
            tracks: tracks.collect(),
            blocks: numbers.len(),
            origin,
            ..self.clone()
        }
    }
}
