//! Yaw between the poses of a recording.
//!
//! # Law
//! Between poses at t₀ and t₁ of a row that a gyroscope corrects, the yaw at t is
//!
//! ψ = ψ₀ + s (G(t − τ) − G(t₀ − τ)) + c (t − t₀)/(t₁ − t₀)
//!
//! c is what the poses turn beyond the gyroscope: its bias, and what is left of its walk.
//!
//! Nobody saw the place. It is put on the line between those of the poses, and has to count as
//! unknown.

use super::Corrected;
use super::turned::Turned;
use trackdyn_core::robust::usual_interval;
use trackdyn_core::{Pose, real};
use trackdyn_recording::recording::longest_interval;
use trackdyn_recording::{PoseSample, Recording, Run};

/// A recording with poses of a gyroscope between its own.
pub struct Filled {
    /// The recording.
    pub recording: Recording,
    /// Of each pose of each run, whether its place was measured: if not, only its yaw was.
    pub has_place: Vec<Vec<bool>>,
}

impl Corrected {
    /// The recording with poses between its own, as many as lie at least so far apart as `interval`
    /// says of their run, s.
    pub fn filled(&self, interval: impl Fn(&Run) -> f64) -> Filled {
        let runs = self.recording.runs().iter().enumerate();
        let (runs, has_place) =
            runs.map(|(index, run)| self.filled_run(index, run, interval(run))).unzip();
        Filled { recording: self.recording.with_runs(runs), has_place }
    }

    fn filled_run(&self, index: usize, run: &Run, interval: f64) -> (Run, Vec<bool>) {
        let poses = run.poses();
        let longest = longest_interval(usual_interval(poses.iter().map(|pose| pose.t)));
        let turned = Turned::of_run(run, self.min_readings);
        let of_run = self.rows.iter().filter(|(of, _)| *of == index);
        // the second of two poses that the gyroscope joins
        let joined = of_run.flat_map(|(_, row)| row.clone().skip(1));
        let joined = joined.filter(|&k| poses[k].t - poses[k - 1].t <= longest);
        let mut more: Vec<PoseSample> = Vec::new();
        for k in joined {
            more.extend(self.between(&turned, &poses[k - 1], &poses[k], interval));
        }
        if more.is_empty() {
            return (run.clone(), vec![true; poses.len()]);
        }
        more.extend(poses);
        more.sort_by(|a, b| a.t.total_cmp(&b.t));
        let mut rows = run.clone().into_rows();
        rows.poses = more.into();
        let filled = Run::new(rows, &mut Vec::new());
        let is_own =
            |sample: &PoseSample| poses.binary_search_by(|pose| pose.t.total_cmp(&sample.t));
        let has_place = filled.poses().iter().map(|sample| is_own(sample).is_ok()).collect();
        (filled, has_place)
    }

    /// Poses between two, at even times.
    fn between(
        &self,
        turned: &[Turned],
        first: &PoseSample,
        last: &PoseSample,
        interval: f64,
    ) -> Vec<PoseSample> {
        let (scale, lag) = (self.gyroscope.scale, self.gyroscope.lag);
        let covers = |of: &&Turned| {
            let [start, end] = of.span();
            start <= first.t - lag && last.t - lag <= end
        };
        let Some(turned) = turned.iter().find(covers) else { return Vec::new() };
        let angle = |t: f64| scale * turned.at(t - lag).0;
        let duration = last.t - first.t;
        let beyond = last.pose.yaw - first.pose.yaw - (angle(last.t) - angle(first.t));
        let parts = count(duration / interval);
        let pose = |part: usize| {
            let share = real(part) / real(parts);
            let t = first.t + share * duration;
            let along = |from: f64, to: f64| from + share * (to - from);
            // ψ = ψ₀ + s (G(t − τ) − G(t₀ − τ)) + c (t − t₀)/(t₁ − t₀)
            let yaw = first.pose.yaw + angle(t) - angle(first.t) + share * beyond;
            let (x, y) = (along(first.pose.x, last.pose.x), along(first.pose.y, last.pose.y));
            PoseSample { t, pose: Pose::new(x, y, yaw) }
        };
        (1..parts).map(pose).collect()
    }
}

/// How often something fits, but for rounding.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
fn count(ratio: f64) -> usize {
    (ratio + 1e-6).floor().clamp(1.0, 1e6) as usize
}
