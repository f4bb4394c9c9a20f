//! Readings and poses that come more often than a robot changes its motion.
//!
//! # Law
//! n readings in a row become one, with the stamp of the first and the mean speed of all, so that
//! the tracks run as far:
//!
//! v̄ = Σ v_k h_k / Σ h_k,   h_k the time that reading k holds
//!
//! n poses in a row become their mean at the mean t̄ of their stamps, each moved there by the twist
//! u that leads from the first to the last: without that, a mean lies inside of an arc.
//!
//! p̄ = Σ p_k exp(u (t̄ − t_k))/n

use std::borrow::Cow;
use trackdyn_core::pose::wrap_angle;
use trackdyn_core::robust::usual_interval;
use trackdyn_core::{Pose, real};
use trackdyn_recording::recording::longest_interval;
use trackdyn_recording::{PoseSample, Recording, Run, TrackSample, UncheckedRun};

/// Part of an interval that is rounding.
const INTERVAL_ROUNDING: f64 = 1e-6;

/// This recording with fewer readings of the tracks: as many are put together as usually fit into
/// the interval, s. The fingerprint stays.
pub fn with_readings_every(recording: &Recording, interval: f64) -> Cow<'_, Recording> {
    let stamps = |run: &Run| run.tracks().iter().map(|reading| reading.t).collect();
    with_fewer(recording, interval, stamps, |rows, usual, count| {
        let firsts: Vec<usize> = (0..rows.tracks.samples.len()).step_by(count).collect();
        let samples = together(&rows.tracks.samples, usual, count);
        rows.tracks = rows.tracks.part(&firsts);
        rows.tracks.samples = samples;
    })
}

/// This recording with fewer poses: as many are averaged as usually fit into the interval, s. Rows
/// that a gap or the end of a run cuts short are left out. The fingerprint stays.
pub fn with_poses_every(recording: &Recording, interval: f64) -> Cow<'_, Recording> {
    let stamps = |run: &Run| run.poses().iter().map(|sample| sample.t).collect();
    with_fewer(recording, interval, stamps, |rows, usual, count| {
        let (firsts, means) = averaged(&rows.poses.samples, usual, count).into_iter().unzip();
        let firsts: Vec<usize> = firsts;
        rows.poses = rows.poses.part(&firsts);
        rows.poses.samples = means;
    })
}

/// This recording with fewer samples in the runs where several fit into the interval, s. `fewer`
/// puts so many of them together, which usually come at an interval, s.
fn with_fewer(
    recording: &Recording,
    interval: f64,
    stamps: impl Fn(&Run) -> Vec<f64>,
    fewer: impl Fn(&mut UncheckedRun, f64, usize),
) -> Cow<'_, Recording> {
    let fitting = |run: &Run| {
        let stamps = stamps(run);
        let usual = usual_interval(stamps.iter().copied());
        (usual, fitting(stamps.len(), usual, interval))
    };
    let fitting: Vec<(f64, usize)> = recording.runs().iter().map(fitting).collect();
    if fitting.iter().all(|(_, count)| *count == 1) {
        return Cow::Borrowed(recording);
    }
    let thinned = |(run, &(usual, count)): (&Run, &(f64, usize))| {
        if count == 1 {
            return run.clone();
        }
        let mut rows: UncheckedRun = run.clone().into_rows();
        fewer(&mut rows, usual, count);
        Run::new(rows, &mut Vec::new())
    };
    Cow::Owned(recording.with_runs(recording.runs().iter().zip(&fitting).map(thinned).collect()))
}

/// How many of some readings fit into a time, s, at their usual interval; one at least.
fn fitting(readings: usize, usual: f64, time: f64) -> usize {
    let fits = |count: &usize| real(*count) * usual <= time * (1.0 + INTERVAL_ROUNDING);
    (1..=readings).take_while(fits).last().unwrap_or(1)
}

/// The readings with so many of them in a row put together; the last one holds for the usual
/// interval, s.
fn together(readings: &[TrackSample], usual: f64, count: usize) -> Vec<TrackSample> {
    let held = |k: usize| readings.get(k + 1).map_or(usual, |next| next.t - readings[k].t);
    let group = |group: &[usize]| {
        let time: f64 = group.iter().map(|&k| held(k)).sum();
        let mean = |speed: fn(&TrackSample) -> f64| {
            group.iter().map(|&k| speed(&readings[k]) * held(k)).sum::<f64>() / time
        };
        TrackSample {
            t: readings[group[0]].t,
            v_left: mean(|reading| reading.v_left),
            v_right: mean(|reading| reading.v_right),
        }
    };
    let indices: Vec<usize> = (0..readings.len()).collect();
    indices.chunks(count).map(group).collect()
}

/// The means of so many poses in a row, each with the index of its first pose; `usual` is their
/// interval, s.
fn averaged(poses: &[PoseSample], usual: f64, count: usize) -> Vec<(usize, PoseSample)> {
    let is_gap = |pair: &[PoseSample]| pair[1].t - pair[0].t > longest_interval(usual);
    let mut rows = Vec::new();
    let mut first = 0;
    while let Some(row) = poses.get(first..first + count) {
        if let Some(before) = row.windows(2).rposition(is_gap) {
            first += before + 1;
        } else {
            rows.push((first, mean(row)));
            first += count;
        }
    }
    rows
}

/// The mean of some poses at the mean of their stamps.
fn mean(row: &[PoseSample]) -> PoseSample {
    let count = real(row.len());
    let t = row.iter().map(|sample| sample.t).sum::<f64>() / count;
    let [first, last] = [row[0], row[row.len() - 1]];
    let moved = first.pose.relative(&last.pose);
    let moved = Pose::new(moved.x, moved.y, wrap_angle(moved.yaw));
    let twist = moved.log(last.t - first.t);
    // p̄ = Σ p_k exp(u (t̄ − t_k))/n
    let mut sum = [0.0; 3];
    for sample in row {
        let there = sample.pose.compose(&Pose::exp(&twist, t - sample.t));
        sum[0] += there.x;
        sum[1] += there.y;
        sum[2] += wrap_angle(there.yaw - first.pose.yaw);
    }
    let [x, y, turned] = sum.map(|sum| sum / count);
    PoseSample { t, pose: Pose::new(x, y, first.pose.yaw + turned) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_recording::Source;
    use trackdyn_recording::hold::travelled;

    /// A run whose encoders report at these times, s.
    fn recording(stamps: &[f64]) -> Recording {
        let reading = |(k, t): (usize, &f64)| TrackSample {
            t: *t,
            v_left: (0.7 * real(k)).sin(),
            v_right: 0.3,
        };
        let tracks: Vec<TrackSample> = stamps.iter().enumerate().map(reading).collect();
        let poses = [0.0, 1.0].map(|t| PoseSample { t, pose: Pose::default() });
        let rows = UncheckedRun {
            tracks: tracks.into(),
            poses: poses.to_vec().into(),
            ..UncheckedRun::default()
        };
        Recording::new("dense", "robot", vec![rows], Source::computed(), Vec::new()).expect("a run")
    }

    #[test]
    fn tracks_run_as_far_by_a_tenth_of_the_readings() {
        // some come in pairs, and the bus is silent for a while
        let stamps: Vec<f64> = (0..1000)
            .map(|k| 1e-3 * f64::from(k - k % 2) + 4e-4 * f64::from(k % 2))
            .map(|t| if t < 0.5 { t } else { t + 0.3 })
            .collect();
        let stamps: Vec<f64> = stamps.into_iter().filter(|t| !(0.2..0.25).contains(t)).collect();
        let dense = recording(&stamps);
        let thinned = with_readings_every(&dense, 0.01);
        let [before, after] = [&dense, &*thinned].map(|one| one.runs()[0].tracks());
        assert!(after.len() < before.len() / 9, "{} of {}", after.len(), before.len());
        for pair in after.windows(2) {
            let [there, here] = [before, after].map(|of| travelled(of, pair[0].t, pair[1].t, 0.0));
            assert!((there.left - here.left).abs() < 1e-12, "{there:?} {here:?}");
            assert!((there.right - here.right).abs() < 1e-12, "{there:?} {here:?}");
        }
        assert_eq!(dense.fingerprint(), thinned.fingerprint());
    }

    #[test]
    fn readings_that_are_rare_enough_stay() {
        for interval in [0.01, 0.05, 3.0] {
            let stamps: Vec<f64> = (0..40).map(|k| interval * f64::from(k)).collect();
            let rare = recording(&stamps);
            assert!(matches!(with_readings_every(&rare, 0.01), Cow::Borrowed(_)), "{interval}");
        }
        let alone = recording(&[0.0]);
        assert!(matches!(with_readings_every(&alone, 0.01), Cow::Borrowed(_)));
    }

    /// A run with poses at these times, s.
    fn seen(poses: Vec<PoseSample>) -> Recording {
        let reading = |t| TrackSample { t, v_left: 0.0, v_right: 0.3 };
        let tracks: Vec<TrackSample> = (0..100).map(|k| reading(0.05 * f64::from(k))).collect();
        let rows =
            UncheckedRun { tracks: tracks.into(), poses: poses.into(), ..UncheckedRun::default() };
        Recording::new("dense", "robot", vec![rows], Source::computed(), Vec::new()).expect("a run")
    }

    /// Yaw passes the half turn, where its sign may change, and the source is silent for a while.
    #[test]
    fn poses_on_an_arc_become_means_that_lie_on_it() {
        let pose = |t: f64| {
            let yaw = 3.0 + 0.8 * t;
            PoseSample { t, pose: Pose::new(2.0 * yaw.sin(), -2.0 * yaw.cos(), wrap_angle(yaw)) }
        };
        let times = (0..400).map(|k| 0.01 * f64::from(k)).filter(|t| !(1.03..1.48).contains(t));
        let dense = seen(times.map(pose).collect());
        let thinned = with_poses_every(&dense, 0.1);
        let poses = thinned.runs()[0].poses();
        assert!((30..=36).contains(&poses.len()), "{}", poses.len());
        for sample in poses {
            let off = pose(sample.t).pose.relative(&sample.pose);
            assert!(off.x.abs() < 1e-9 && off.y.abs() < 1e-9, "{off:?}");
            assert!(wrap_angle(off.yaw).abs() < 1e-9, "{off:?}");
        }
        assert!(!poses.windows(2).any(|pair| pair[1].t - pair[0].t < 0.099));
        assert_eq!(dense.fingerprint(), thinned.fingerprint());
        assert!(matches!(with_poses_every(&dense, 0.015), Cow::Borrowed(_)));
    }
}
