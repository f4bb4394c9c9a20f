//! Pose intervals and what the encoders did in them.

use super::Settings;
use super::regression::{Fit, Sums};
use crate::gaps::Gaps;
use crate::thinned::with_poses_every;
use trackdyn_core::robust::{median, usual_interval};
use trackdyn_recording::hold::holding;
use trackdyn_recording::recording::longest_interval;
use trackdyn_recording::{Recording, Run, TrackSample};

/// The pose intervals of all runs.
pub(super) struct Intervals {
    pub(super) runs: Vec<RunIntervals>,
    /// Median time between readings, s.
    pub(super) track_interval: f64,
    /// Median time between readings that differ, s.
    pub(super) update_interval: f64,
}

/// The pose intervals of one run.
pub(super) struct RunIntervals {
    pub(super) turns: Vec<Turn>,
    tracks: Vec<TrackSample>,
    gaps: Gaps,
    /// ∫ (Vᵣ − Vₗ) dt from the first reading to each, m.
    sums: Vec<f64>,
}

/// The time between neighbouring poses, s, and the yaw between them, rad.
pub(super) struct Turn {
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) yaw: f64,
}

impl Intervals {
    pub(super) fn new(recording: &Recording, settings: &Settings) -> Self {
        let recording = with_poses_every(recording, settings.min_pose_interval);
        let mut intervals = Vec::new();
        let mut updates = Vec::new();
        for run in recording.runs() {
            let tracks = run.tracks();
            intervals.extend(tracks.windows(2).map(|pair| pair[1].t - pair[0].t));
            let same =
                |a: &TrackSample, b: &TrackSample| a.v_left == b.v_left && a.v_right == b.v_right;
            let firsts: Vec<f64> = tracks.chunk_by(same).map(|held| held[0].t).collect();
            updates.extend(firsts.windows(2).map(|pair| pair[1] - pair[0]));
        }
        let track_interval = median(&mut intervals).unwrap_or(0.0);
        // Without noise, speeds change only where they are told to, unless readings are rarer.
        let update_interval = median(&mut updates).unwrap_or(0.0);
        let update_interval = update_interval.min(settings.max_update_interval).max(track_interval);
        let runs = recording.runs().iter().map(RunIntervals::new).collect();
        Self { runs, track_interval, update_interval }
    }

    /// Number of pose intervals.
    pub(super) fn count(&self) -> usize {
        self.runs.iter().map(|run| run.turns.len()).sum()
    }

    /// Least squares at one offset, by every `stride`-th pose interval.
    pub(super) fn fit(&self, tau: f64, stride: usize) -> Fit {
        let mut sums = Sums::default();
        for run in &self.runs {
            let turns = run.turns.iter().step_by(stride);
            for turn in turns.filter(|turn| run.covers(turn, [tau, tau])) {
                sums.add([run.difference(turn, tau), turn.end - turn.start], turn.yaw);
            }
        }
        sums.fit()
    }
}

impl RunIntervals {
    fn new(run: &Run) -> Self {
        let poses = run.poses();
        let longest = longest_interval(usual_interval(poses.iter().map(|sample| sample.t)));
        let turns = poses.windows(2).filter(|pair| pair[1].t - pair[0].t <= longest);
        let turns = turns
            .map(|pair| Turn {
                start: pair[0].t,
                end: pair[1].t,
                yaw: pair[1].pose.yaw - pair[0].pose.yaw,
            })
            .collect();
        let tracks = run.tracks().to_vec();
        let mut sum = 0.0;
        let mut sums = Vec::with_capacity(tracks.len());
        for (index, sample) in tracks.iter().enumerate() {
            sums.push(sum);
            let until = tracks.get(index + 1).map_or(sample.t, |next| next.t);
            sum += (until - sample.t) * (sample.v_right - sample.v_left);
        }
        let gaps = Gaps::of(&tracks);
        Self { turns, tracks, gaps, sums }
    }

    /// Whether there are readings, without a gap, for all offsets between these two.
    pub(super) fn covers(&self, turn: &Turn, [least, most]: [f64; 2]) -> bool {
        let (from, until) = (turn.start - most, turn.end - least);
        match self.tracks.as_slice() {
            [first, .., last] => from >= first.t && until <= last.t && !self.gaps.meet(from, until),
            _ => false,
        }
    }

    /// D at an offset, m.
    pub(super) fn difference(&self, turn: &Turn, tau: f64) -> f64 {
        self.integral(turn.end - tau) - self.integral(turn.start - tau)
    }

    /// ∫ (Vᵣ − Vₗ) dt from the first reading to `t`.
    fn integral(&self, t: f64) -> f64 {
        let index = holding(&self.tracks, t).unwrap_or(0);
        let Some(sample) = self.tracks.get(index) else { return 0.0 };
        self.sums[index] + (t - sample.t) * (sample.v_right - sample.v_left)
    }
}
