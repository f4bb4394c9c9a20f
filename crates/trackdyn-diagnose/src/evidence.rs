//! Observed motion, in one form for recordings and for tables of steady motion.
//!
//! A sample is a motion over a time in which the track speeds are known. A steady operating point
//! is a sample of a microsecond, whose motion is velocity times time: one prediction serves both.

mod held;
pub mod planned;
mod points;
mod series;
mod ticks;

use crate::error::Error;
use crate::settings::Settings;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose, Twist};
use trackdyn_estimate::gyroscope::{Gyroscope, Unfit};
use trackdyn_estimate::regular::regularise;
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_recording::TrackSample;

/// One observed motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Index of its run.
    pub run: usize,
    /// Index of its block: blocks are statistically independent.
    pub block: usize,
    /// Time at which it begins, s of the pose clock since the recording began.
    pub start: f64,
    /// Duration, s.
    pub duration: f64,
    /// Motion seen from its first pose: forward (m), left (m), yaw (rad).
    pub motion: Vector3<f64>,
    /// Pose at which it begins, in the frame of its run.
    pub pose: Pose,
    /// Mean track speeds, m/s.
    pub speeds: PerSide<f64>,
    /// Change of the track speeds over the sample, divided by its duration, m/s².
    pub acceleration: PerSide<f64>,
    /// Whether its first pose is the last one of the sample before it.
    pub follows: bool,
    /// Whether the places of its first and last pose were measured: if not, only their yaw was, by
    /// a gyroscope.
    pub has_place: [bool; 2],
}

/// The samples of each run, by their indices.
pub(crate) fn run_ranges(samples: &[Sample]) -> impl Iterator<Item = Range<usize>> + '_ {
    ranges(samples.chunk_by(|a, b| a.run == b.run))
}

/// The samples from each measured place to the next, by their indices: one sample, or several where
/// a gyroscope measures the yaw in between.
pub(crate) fn between_places(samples: &[Sample]) -> impl Iterator<Item = Range<usize>> + '_ {
    ranges(samples.chunk_by(|a, b| b.follows && !a.has_place[1]))
}

/// Indices of slices that follow each other.
fn ranges<'a>(
    slices: impl Iterator<Item = &'a [Sample]> + 'a,
) -> impl Iterator<Item = Range<usize>> + 'a {
    slices.scan(0, |end, slice| {
        let begin = *end;
        *end += slice.len();
        Some(begin..*end)
    })
}

/// Checks that samples are as many as are needed, from one place to the next.
///
/// # Errors
/// [`Error::TooFewSegments`].
pub(crate) fn check_number(samples: &[Sample], needed: usize) -> Result<(), Error> {
    let duration = |range: Range<usize>| samples[range].iter().map(|sample| sample.duration).sum();
    let durations: Vec<f64> = between_places(samples).map(duration).collect();
    if durations.len() < needed {
        return Err(Error::too_few_segments(durations.into_iter(), needed));
    }
    Ok(())
}

/// Readings of a run with these speeds of each track at each reading, m/s.
fn with_speeds(run: &[TrackSample], speeds: &PerSide<Vec<f64>>) -> Vec<TrackSample> {
    let of_sides = speeds.left.iter().zip(&speeds.right);
    let readings = run.iter().zip(of_sides);
    readings
        .map(|(reading, (&v_left, &v_right))| TrackSample { v_left, v_right, ..*reading })
        .collect()
}

/// Kind of samples, with their noise measured without a model.
#[derive(Clone, Debug)]
pub enum Origin {
    /// Segments of a drive, whose neighbours share a noisy pose, with the noise measured on the
    /// recording.
    Drive(SegmentNoise),
    /// Points of steady motion, without places, headings, times and transients, with the inverse
    /// standard deviation of each channel; zero where not measured.
    SteadyPoints(Arc<[Vector3<f64>]>),
}

impl Origin {
    /// Word for its samples, in the plural.
    pub fn samples(&self) -> &'static str {
        match self {
            Self::Drive(_) => "segments",
            Self::SteadyPoints(_) => "points",
        }
    }

    /// Word for what is held out as a whole, in the plural.
    pub fn runs(&self) -> &'static str {
        match self {
            Self::Drive(_) => "runs",
            Self::SteadyPoints(_) => "points",
        }
    }
}

/// Samples of recordings or of a table, and the settings of their diagnosis. Immutable; noise and
/// weights are in [`Weighted`](crate::weighted::Weighted).
#[derive(Clone)]
pub struct Evidence {
    samples: Arc<[Sample]>,
    tracks: Arc<[Vec<TrackSample>]>,
    blocks: usize,
    /// Number of each run in the recording.
    runs: Vec<i64>,
    tau: f64,
    /// Stamp of the recording at which the times of samples and readings begin, s.
    begin: f64,
    /// Whether places and headings are those of one world.
    has_world: bool,
    origin: Origin,
    /// Departure of the twist (paper's frame) from the stationary one with which each run begins;
    /// none where all begin in stationary motion.
    starts: Option<Arc<[Twist]>>,
    /// What the gyroscope tells of the yaw of the poses; none where it was not asked.
    gyroscope: Option<Result<Gyroscope, Unfit>>,
    description: String,
    settings: Arc<Settings>,
}

impl Evidence {
    /// The samples, in order of their runs.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// The samples, to be kept.
    pub(crate) fn shared_samples(&self) -> &Arc<[Sample]> {
        &self.samples
    }

    /// Track readings of each run; empty for a run without samples.
    pub fn tracks(&self) -> &Arc<[Vec<TrackSample>]> {
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

    /// How blocks were formed and noise measured, in words.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Clock offset of the poses against the encoders, as given or estimated from the recording, s.
    pub fn tau(&self) -> f64 {
        self.tau
    }

    /// Stamp of the recording at which the times of samples and readings begin, s; 0 of a table.
    pub fn begin(&self) -> f64 {
        self.begin
    }

    /// Whether its samples have places and headings in one world: a table has none, and runs with a
    /// frame each share none.
    pub fn has_world(&self) -> bool {
        self.has_world
    }

    /// Kind of its samples: segments of a drive, or points of steady motion.
    pub fn origin(&self) -> &Origin {
        &self.origin
    }

    /// What its gyroscope tells of the yaw of its poses, or why it does not serve; none where it
    /// was not asked.
    pub fn gyroscope(&self) -> Option<&Result<Gyroscope, Unfit>> {
        self.gyroscope.as_ref()
    }

    /// The gyroscope that corrects the yaw of its poses.
    pub(crate) fn serving_gyroscope(&self) -> Option<&Gyroscope> {
        self.gyroscope().and_then(|found| found.as_ref().ok())
    }

    /// Settings by which it was made and is diagnosed.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Departure of the twist (paper's frame) from the stationary one with which each run begins;
    /// none where all begin in stationary motion.
    pub fn starts(&self) -> Option<&Arc<[Twist]>> {
        self.starts.as_ref()
    }

    /// The evidence with runs that begin in a motion of their own.
    pub fn with_starts(&self, starts: impl Into<Arc<[Twist]>>) -> Self {
        Self { starts: Some(starts.into()), ..self.clone() }
    }

    /// The largest track speed, m/s.
    pub fn fastest(&self) -> f64 {
        let speeds = self.tracks.iter().flatten();
        speeds.fold(0.0, |most, track| most.max(track.v_left.abs()).max(track.v_right.abs()))
    }

    /// The evidence with track readings at regular times: corrects stamps that are late by chance.
    pub fn with_regular_stamps(&self) -> Self {
        let mut tracks = self.tracks.to_vec();
        for run in &mut tracks {
            regularise(run, |reading| &mut reading.t, &self.settings.stamps);
        }
        Self { tracks: tracks.into(), ..self.clone() }
    }

    /// The evidence with lines between the updates of encoder speeds that are held.
    pub fn with_held_readings_joined(&self) -> Self {
        let tracks = held::joined(&self.tracks, &self.settings.evidence);
        Self { tracks: tracks.into(), ..self.clone() }
    }

    /// Quantisation step of the encoder speeds, m/s.
    pub fn steps(&self) -> PerSide<f64> {
        ticks::steps(&self.tracks, &self.settings.evidence)
    }

    /// The evidence with encoder speeds smoothed between ticks of the given quantisation steps,
    /// m/s.
    pub fn with_speeds_between_ticks(&self, steps: PerSide<f64>) -> Self {
        let tracks = ticks::smoothed(&self.tracks, steps, &self.settings);
        Self { tracks: tracks.into(), ..self.clone() }
    }

    /// The evidence of some runs: `runs` says of each whether it is kept.
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
