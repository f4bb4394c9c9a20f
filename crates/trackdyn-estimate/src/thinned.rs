//! Readings of encoders that report more often than a robot changes its motion.
//!
//! # Law
//! n readings in a row become one, with the stamp of the first and the mean speed of all, so that
//! the tracks run as far:
//!
//! v̄ = Σ v_k h_k / Σ h_k,   h_k the time that reading k holds

use std::borrow::Cow;
use trackdyn_core::real;
use trackdyn_core::robust::usual_interval;
use trackdyn_recording::{Recording, Run, TrackSample, UncheckedRun};

/// Part of an interval that is rounding.
const INTERVAL_ROUNDING: f64 = 1e-6;

/// This recording with fewer readings of the tracks: as many are put together as usually fit into
/// the interval, s. The fingerprint stays.
pub fn with_readings_every(recording: &Recording, interval: f64) -> Cow<'_, Recording> {
    let runs = recording.runs();
    let usual = |run: &Run| usual_interval(run.tracks().iter().map(|reading| reading.t));
    let usual: Vec<f64> = runs.iter().map(usual).collect();
    let counts = runs.iter().zip(&usual);
    let counts: Vec<usize> =
        counts.map(|(run, usual)| fitting(run.tracks().len(), *usual, interval)).collect();
    if counts.iter().all(|count| *count == 1) {
        return Cow::Borrowed(recording);
    }
    let thinned = |((run, &usual), &count): ((&Run, &f64), &usize)| {
        if count == 1 {
            return run.clone();
        }
        let mut rows: UncheckedRun = run.clone().into_rows();
        let firsts: Vec<usize> = (0..run.tracks().len()).step_by(count).collect();
        rows.tracks = rows.tracks.part(&firsts);
        rows.tracks.samples = together(run.tracks(), usual, count);
        Run::new(rows, &mut Vec::new())
    };
    Cow::Owned(recording.with_runs(runs.iter().zip(&usual).zip(&counts).map(thinned).collect()))
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

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::Pose;
    use trackdyn_recording::hold::travelled;
    use trackdyn_recording::{PoseSample, Source};

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
}
