//! Times of a recording as stamps of a bag.

use std::collections::BTreeMap;
use trackdyn_recording::{Recording as Motion, Run};

/// Nanoseconds of a second.
const SECOND: i64 = 1_000_000_000;

/// Unix time of each run of a recording, by its number.
///
/// Runs of a bag keep their time. A run that begins before the one before it has ended, as where
/// each run of a folder begins at 0, is moved by whole seconds to the time after that.
pub(crate) struct Timeline {
    runs: BTreeMap<i64, Start>,
}

/// The time of a run.
struct Start {
    /// Unix time of t = 0, ns.
    zero: i64,
    /// Time by which it is moved, s.
    shift: i64,
}

impl Timeline {
    /// The times of the runs of a recording.
    pub(crate) fn new(motion: &Motion) -> Self {
        let epoch = motion.source().epoch_ns.unwrap_or(0);
        let mut end: i64 = 0;
        let runs = motion.runs().iter().map(|run| {
            let [first, last] = ends(run).map(|t| epoch.saturating_add(nanoseconds(t)));
            let late = end.saturating_sub(first);
            let shift = if late > 0 { (late - 1) / SECOND + 1 } else { 0 };
            let moved = shift.saturating_mul(SECOND);
            // A stamp that two runs share would be of both.
            end = last.saturating_add(moved).saturating_add(1);
            (run.id(), Start { zero: epoch.saturating_add(moved), shift })
        });
        Self { runs: runs.collect() }
    }

    /// The stamp of a time of the run of this number: Unix time in nanoseconds.
    pub(crate) fn stamp(&self, run: i64, t: f64) -> u64 {
        let zero = self.runs.get(&run).map_or(0, |start| start.zero);
        u64::try_from(zero.saturating_add(nanoseconds(t))).unwrap_or_default()
    }

    /// Times by which runs are moved, s, in words; empty where no run is.
    pub(crate) fn moved(&self) -> String {
        let moved = self.runs.iter().filter(|(_, start)| start.shift != 0);
        let moved: Vec<String> =
            moved.map(|(run, start)| format!("run {run} by {} s", start.shift)).collect();
        moved.join(", ")
    }
}

/// First and last time of a run, s.
fn ends(run: &Run) -> [f64; 2] {
    let tracks = run.tracks().iter().map(|sample| sample.t);
    let times = tracks.chain(run.poses().iter().map(|sample| sample.t));
    let ends =
        times.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(t), high.max(t)]);
    if ends[0] <= ends[1] { ends } else { [0.0; 2] }
}

/// A time in nanoseconds.
#[expect(clippy::cast_possible_truncation, reason = "larger times end at the bounds")]
fn nanoseconds(t: f64) -> i64 {
    (t * 1e9).round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::Pose;
    use trackdyn_recording::{PoseSample, Series, Source, TrackSample, UncheckedRun};

    fn recording(runs: &[[f64; 2]], epoch_ns: Option<i64>) -> Motion {
        let runs = runs.iter().zip(0..).map(|(ends, id)| UncheckedRun {
            id,
            tracks: Series::from(
                ends.map(|t| TrackSample { t, v_left: 0.1, v_right: 0.2 }).to_vec(),
            ),
            poses: Series::from(
                ends.map(|t| PoseSample { t, pose: Pose::new(t, 0.0, 0.0) }).to_vec(),
            ),
            ..UncheckedRun::default()
        });
        let source = Source { epoch_ns, ..Source::computed() };
        Motion::new("drive", "robot", runs.collect(), source, Vec::new()).expect("a recording")
    }

    #[test]
    fn a_log_keeps_its_time_to_the_nanosecond() {
        let epoch = 1_700_000_000_123_456_789;
        let motion = recording(&[[0.0, 9.5], [12.0, 12_345.678_901_234]], Some(epoch));
        let timeline = Timeline::new(&motion);
        assert_eq!(timeline.stamp(0, 0.000_000_001), 1_700_000_000_123_456_790);
        assert_eq!(timeline.stamp(1, 12_345.678_901_234), 1_700_012_345_802_358_023);
        assert_eq!(timeline.moved(), "");
    }

    #[test]
    fn runs_that_begin_anew_follow_each_other() {
        let motion = recording(&[[-0.5, 9.5], [0.0, 2.0], [13.0, 14.0], [13.5, 15.0]], None);
        let timeline = Timeline::new(&motion);
        let starts = [(0, -0.5), (1, 0.0), (2, 13.0), (3, 13.5)];
        let starts = starts.map(|(run, t)| timeline.stamp(run, t));
        assert_eq!(starts, [500_000_000, 11_000_000_000, 14_000_000_000, 15_500_000_000]);
        let moved = "run 0 by 1 s, run 1 by 11 s, run 2 by 1 s, run 3 by 2 s";
        assert_eq!(timeline.moved(), moved);
    }
}
