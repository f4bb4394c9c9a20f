//! What was seen, in one form for drives and for tables of steady motion.
//!
//! A sample is a motion over a time in which the track speeds are known. A steady operating point is one of a
//! microsecond: what moves so shortly moves by its velocity, and the same prediction serves both.

pub mod planned;
mod points;
mod series;

use nalgebra::Vector3;
use trackdyn_core::{PerSide, Pose};
use trackdyn_identify::weighting::Whitener;
use trackdyn_recording::TrackSample;

/// One observed motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Index of its run.
    pub run: usize,
    /// Index of the block that it belongs to: blocks are independent of one another.
    pub block: usize,
    /// Time at which it begins, s of the pose clock.
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
}

/// The samples of recordings or of a table, and what their residuals weigh.
#[derive(Clone)]
pub struct Evidence {
    samples: Vec<Sample>,
    tracks: Vec<Vec<TrackSample>>,
    whitening: Whitening,
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
    Segments(std::sync::Arc<Whitener>),
    /// Inverse standard deviations of the channels; zero where one was not measured.
    Points(Vec<Vector3<f64>>),
}

impl Evidence {
    /// The samples, runs in a row.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Readings of the tracks of each run.
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

    /// Makes a column of residuals or of their derivatives white, in place: unit variance, no correlation.
    pub fn whiten(&self, column: &mut [Vector3<f64>]) {
        match &self.whitening {
            Whitening::Segments(whitener) => whitener.whiten(column),
            Whitening::Points(inverse) => {
                for (value, inverse) in column.iter_mut().zip(inverse) {
                    value.component_mul_assign(inverse);
                }
            }
        }
    }

    /// Whether a channel of a sample was measured.
    pub fn is_measured(&self, sample: usize, channel: usize) -> bool {
        match &self.whitening {
            Whitening::Segments(_) => true,
            Whitening::Points(inverse) => inverse[sample][channel] > 0.0,
        }
    }
}
