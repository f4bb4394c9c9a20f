//! Yaw rates over time: as measured, and as a kinematic model makes them of the track speeds.
//!
//! A rate is a mean over a segment: what poses turn between its ends, and what the model makes of
//! the mean track speeds there. Times are those of the tracks, from the first reading of the run.

use crate::observations::{Observation, Observations};
use trackdyn_core::PerSide;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_recording::{Recording, Run};

/// A mean over a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Beginning of the segment, s from the first reading of the tracks.
    pub start: f64,
    /// Its end, s.
    pub end: f64,
    /// Yaw rate of the poses, rad/s.
    pub measured: f64,
    /// Yaw rate by the model, rad/s.
    pub predicted: f64,
    /// Whether it begins where the one before ends.
    pub follows: bool,
}

impl Rate {
    /// Measured minus predicted yaw rate, rad/s.
    pub fn residual(&self) -> f64 {
        self.measured - self.predicted
    }
}

/// A run over time.
#[derive(Clone, Debug, PartialEq)]
pub struct RunRates {
    /// Number of the run.
    pub run: i64,
    /// Time from the first to the last reading of the tracks, s.
    pub duration: f64,
    /// Readings of the tracks: time (s from the first), left and right speed (m/s).
    pub tracks: Vec<[f64; 3]>,
    /// Yaw rates, segment by segment.
    pub rates: Vec<Rate>,
}

/// All runs of a recording over time.
#[derive(Clone, Debug, PartialEq)]
pub struct YawRates {
    /// The runs, in the order of the recording.
    pub runs: Vec<RunRates>,
}

impl YawRates {
    /// The yaw rates of the segments of a recording. `model` makes a yaw rate (rad/s) of track
    /// speeds (m/s).
    pub fn new(
        recording: &Recording,
        observations: &Observations,
        model: &dyn Fn(PerSide<f64>) -> f64,
    ) -> Self {
        let mut runs: Vec<RunRates> = recording.runs().iter().map(RunRates::of_tracks).collect();
        for segment in observations.segments() {
            let first = recording.runs()[segment.run].tracks().first();
            let start = segment.start - observations.tau() - first.map_or(0.0, |first| first.t);
            let rate = Rate::of(observations, segment, start, model);
            runs[segment.run].rates.push(rate);
        }
        Self { runs }
    }

    /// All rates, in the order of the recording.
    pub fn rates(&self) -> impl Iterator<Item = &Rate> {
        self.runs.iter().flat_map(|run| &run.rates)
    }

    /// Standard deviation of the residuals, rad/s, by their median size; none without rates.
    pub fn deviation(&self) -> Option<f64> {
        deviation_about_zero(&mut self.rates().map(Rate::residual).collect::<Vec<_>>())
    }
}

impl Rate {
    fn of(
        observations: &Observations,
        segment: &Observation,
        start: f64,
        model: &dyn Fn(PerSide<f64>) -> f64,
    ) -> Self {
        let duration = segment.duration;
        let speeds = observations.travelled(segment).map(|distance| distance / duration);
        Self {
            start,
            end: start + duration,
            measured: segment.motion[2] / duration,
            predicted: model(speeds),
            follows: segment.follows,
        }
    }
}

impl RunRates {
    /// A run without rates.
    fn of_tracks(run: &Run) -> Self {
        let first = run.tracks().first().map_or(0.0, |first| first.t);
        let tracks = run.tracks().iter();
        let tracks = tracks.map(|reading| [reading.t - first, reading.v_left, reading.v_right]);
        Self {
            run: run.id(),
            duration: run.duration(),
            tracks: tracks.collect(),
            rates: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentOptions;
    use crate::synthetic::{Synthetic, random_steps};

    /// With late poses, times are those of the tracks, and the model that made the recording
    /// leaves nothing.
    #[test]
    fn the_model_that_made_a_recording_leaves_no_residual() {
        let synthetic = Synthetic {
            schedules: vec![random_steps(8, 2.0, 0.8, 1), random_steps(8, 2.0, 0.8, 2)],
            tau: 0.2,
            ..Synthetic::default()
        };
        let recording = synthetic.recording().expect("long enough");
        let options = SegmentOptions { tau: 0.2, ..SegmentOptions::default() };
        let observations = Observations::new(&recording, &options);
        let gap = |gap: f64| move |speeds: PerSide<f64>| (speeds.right - speeds.left) / gap;
        let found = YawRates::new(&recording, &observations, &gap(0.832));
        assert_eq!(found.runs.len(), 2);
        assert_eq!(found.rates().count(), observations.len());
        let largest = found.rates().map(|rate| rate.residual().abs()).fold(0.0, f64::max);
        assert!(largest < 1e-9, "{largest}");
        for run in &found.runs {
            let within =
                run.rates.iter().all(|of| of.start > -1e-9 && of.end < run.duration + 1e-9);
            assert!(within && run.tracks[0][0] == 0.0);
        }
        // half the distance turns twice as fast
        let wrong = YawRates::new(&recording, &observations, &gap(0.416));
        for rate in wrong.rates() {
            assert!((rate.residual() + rate.measured).abs() < 1e-9);
        }
        assert!(wrong.deviation().expect("rates") > 0.1);
    }
}
