//! Evidence of recordings of driving.

use super::{Evidence, Sample, Whitening};
use crate::error::Error;
use nalgebra::Vector3;
use std::sync::Arc;
use trackdyn_core::{PerSide, Pose, Side, real};
use trackdyn_identify::observations::Observations;
use trackdyn_identify::spin_test;
use trackdyn_identify::weighting::{SegmentNoise, Weighting, Whitener};
use trackdyn_recording::hold::travelled;
use trackdyn_recording::noise::noise;
use trackdyn_recording::{Clock, Recording, SegmentOptions};

/// How far a fitted clock offset may go beyond the one that the recording shows by itself, s.
const TAU_MARGIN: f64 = 0.15;

/// Fewer segments than this are no evidence.
const FEWEST: usize = 60;

/// Times over which travel is compared, s.
const WINDOWS: [f64; 3] = [0.3, 0.6, 1.2];

/// Triples of windows that a scatter needs.
const FEWEST_TRIPLES: usize = 30;

/// Variance per second of the travel that an encoder shows while its track runs steadily, m²/s: of the
/// middle of three windows against the mean of the outer two, over windows of several lengths, the least.
/// None without enough of them.
fn travel_walk(recording: &Recording, side: Side) -> Option<f64> {
    /// Mean of the smaller four fifths of the squares of a normal distribution. A median would say nothing
    /// of counters, whose differences are zero more often than not.
    const SMALLER_FOUR_FIFTHS: f64 = 0.437_7;
    let walk = |window: f64| {
        let mut squares = Vec::new();
        for run in recording.runs() {
            let tracks = run.tracks();
            let (Some(first), Some(last)) = (tracks.first(), tracks.last()) else { continue };
            let mut start = first.t;
            while start + 3.0 * window <= last.t {
                let travel = [0.0, 1.0, 2.0].map(|k| {
                    let from = start + k * window;
                    travelled(tracks, from, from + window, 0.0)[side]
                });
                if travel[1] != 0.0 {
                    squares.push((travel[1] - f64::midpoint(travel[0], travel[2])).powi(2));
                }
                start += window;
            }
        }
        squares.sort_by(f64::total_cmp);
        let smaller = &squares[..4 * squares.len() / 5];
        let mean = smaller.iter().sum::<f64>() / real(smaller.len().max(1));
        // Var (b − (a + c)/2) = 3/2 of that of one window
        (squares.len() >= FEWEST_TRIPLES).then_some(mean / SMALLER_FOUR_FIFTHS / 1.5 / window)
    };
    WINDOWS.into_iter().filter_map(walk).min_by(f64::total_cmp).filter(|walk| *walk > 0.0)
}

impl Evidence {
    /// The segments of a recording, with the noise that the recording shows without any model.
    ///
    /// `gauge` (m) turns the noise of the encoders into noise of the yaw where the robot never spins.
    ///
    /// # Errors
    /// Too few segments, or no noise measured or stated.
    pub fn of_recording(recording: &Recording, gauge: f64) -> Result<Self, Error> {
        let clock = Clock::of(recording, None);
        // Cut so that readings are there for every offset from none at all to beyond that of the clock.
        let tau = clock.tau();
        let options = SegmentOptions {
            tau: tau / 2.0,
            tau_margin: tau.abs() / 2.0 + TAU_MARGIN,
            ..SegmentOptions::default()
        };
        let observations = Observations::new(recording, &options).at(tau);
        if observations.len() < FEWEST {
            return Err(Error::TooFewSegments { found: observations.len(), needed: FEWEST });
        }
        let mut measured = noise(recording, tau);
        for side in Side::BOTH {
            if let Some(encoder) = &mut measured.encoders[side]
                && let Some(walk) = travel_walk(recording, side)
            {
                // Readings of a counter err against each other: travel errs less than their scatter says.
                let deviation = (walk / encoder.update_interval).sqrt();
                encoder.deviation = encoder.deviation.min(deviation);
            }
        }
        let gap = spin_test(&observations, gauge).map_or(1.5 * gauge, |spin| spin.gap);
        let stated = recording.stated_noise().map(|stated| {
            let position = stated.position * stated.position;
            SegmentNoise { pose: [position, position, stated.yaw * stated.yaw], walk: [0.0; 3] }
        });
        let (noise, origin) = match (SegmentNoise::measured(&measured, gap), stated) {
            (Some(noise), _) => (noise, "measured without a model"),
            (None, Some(noise)) => (noise, "as the recording states it"),
            (None, None) => return Err(Error::NoNoise),
        };
        let whitener = Whitener::new(&Weighting::Noise(noise), &observations);
        let blocks = observations.blocks();
        let mut samples = Vec::with_capacity(observations.len());
        for segment in observations.segments() {
            let run = &recording.runs()[segment.run];
            let first = run.poses().partition_point(|pose| pose.t < segment.start);
            let travelled = observations.travelled(segment);
            let pieces = observations.pieces(segment);
            let change = |speed: fn(&trackdyn_identify::observations::Piece) -> f64| {
                let (first, last) =
                    (pieces.first().map_or(0.0, speed), pieces.last().map_or(0.0, speed));
                (last - first) / segment.duration
            };
            samples.push(Sample {
                run: segment.run,
                block: blocks.of(segment.run, segment.start).unwrap_or(0),
                start: segment.start,
                duration: segment.duration,
                motion: Vector3::from(segment.motion),
                pose: run.poses().get(first).map_or(Pose::default(), |sample| sample.pose),
                speeds: travelled.map(|distance| distance / segment.duration),
                acceleration: PerSide::new(
                    change(|piece| piece.v_left),
                    change(|piece| piece.v_right),
                ),
            });
        }
        Ok(Self {
            samples,
            tracks: recording.runs().iter().map(|run| run.tracks().to_vec()).collect(),
            whitening: Whitening::Segments(Arc::new(whitener)),
            blocks: blocks.count(),
            runs: recording.runs().iter().map(trackdyn_recording::Run::id).collect(),
            tau,
            is_steady: false,
            description: format!("{}; noise {origin}", blocks.description()),
        })
    }
}
