//! Rows of tables after a clock that was set back.
//!
//! # Law
//! Rows step back where some in a row are earlier than as many rows above them, by more than a gap.
//! They form a new run if both stretches overlap in time, with more rows there than the usual
//! interval leaves room for, or if a gap separates them. All else is rows out of order, which
//! sorting mends.

use super::cleaning::longest_interval;
use super::run::UncheckedRun;
use super::warning::Warning;
use crate::sample::{Sample, Series};
use trackdyn_core::real;
use trackdyn_core::robust::median;

/// Rows that have to lie on either side of a step.
const WITNESSES: usize = 3;

/// Rows of two stretches over those that the usual interval leaves room for: 1 where they fill each
/// other's gaps, 2 where a clock was set back.
const MIN_CROWD: f64 = 1.5;

/// A clock is set once in so many rows at most.
const MIN_ROWS: usize = 20;

/// Divides runs of a table where the clock of all their series was set back: what follows is a run
/// of its own, with a number after all others.
pub(crate) fn divide(runs: Vec<UncheckedRun>, warnings: &mut Vec<Warning>) -> Vec<UncheckedRun> {
    let mut next = runs.iter().map(|run| run.id).max().map_or(0, |most| most.saturating_add(1));
    let mut divided = Vec::with_capacity(runs.len());
    for run in runs {
        let id = run.id;
        let parts = parts(run);
        if parts.len() > 1 {
            warnings.push(Warning::ClockSetBack { run: id, runs: parts.len() });
        }
        for (place, part) in parts.into_iter().enumerate() {
            if place == 0 {
                divided.push(part);
                continue;
            }
            divided.push(UncheckedRun { id: next, ..part });
            next = next.saturating_add(1);
        }
    }
    divided
}

/// The parts of a run between steps that all of its series show.
fn parts(run: UncheckedRun) -> Vec<UncheckedRun> {
    let [tracks, poses, imu] =
        [times(&run.tracks), times(&run.poses), times(&run.imu)].map(Times::of);
    // What is a gap to the slowest series is a step of all.
    let gap = [&tracks, &poses, &imu].map(|of| of.gap).into_iter().fold(0.0, f64::max);
    let [tracks, poses, imu] = [tracks, poses, imu].map(|of| of.steps(gap));
    let steps = tracks.len();
    let is_shown = |of: &[usize], rows: usize| rows == 0 || of.len() == steps;
    let is_of_all = is_shown(&poses, run.poses.samples.len())
        && is_shown(&imu, run.imu.samples.len())
        && !run.tracks.samples.is_empty();
    if steps == 0 || !is_of_all {
        return vec![run];
    }
    let parts = (0..=steps).map(|part| UncheckedRun {
        id: run.id,
        tracks: part_of(&run.tracks, &tracks, part),
        poses: part_of(&run.poses, &poses, part),
        imu: part_of(&run.imu, &imu, part),
    });
    parts.collect()
}

/// The rows of a part, by the rows that parts begin with.
fn part_of<S: Sample>(series: &Series<S>, begins: &[usize], part: usize) -> Series<S> {
    let all = series.samples.len();
    let from = part.checked_sub(1).map_or(0, |before| begins.get(before).copied().unwrap_or(all));
    let until = begins.get(part).copied().unwrap_or(all);
    series.part(&(from..until).collect::<Vec<_>>())
}

/// Stamps of a series, s, with their rows; those that are no number are left out.
fn times<S: Sample>(series: &Series<S>) -> Vec<(usize, f64)> {
    let stamps = series.samples.iter().map(Sample::time).enumerate();
    stamps.filter(|(_, t)| t.is_finite()).collect()
}

/// Stamps in the order of rows.
struct Times {
    stamps: Vec<(usize, f64)>,
    /// The usual interval, s.
    usual: f64,
    /// Longest interval that is no gap, s.
    gap: f64,
}

impl Times {
    fn of(stamps: Vec<(usize, f64)>) -> Self {
        let intervals = stamps.windows(2).map(|pair| pair[1].1 - pair[0].1);
        let mut forward: Vec<f64> = intervals.filter(|interval| *interval > 0.0).collect();
        let usual = median(&mut forward).unwrap_or(0.0);
        Self { stamps, usual, gap: longest_interval(usual) }
    }

    /// Rows at which the clock was set back by more than a time, s.
    fn steps(&self, least: f64) -> Vec<usize> {
        let of = |range: std::ops::Range<usize>| self.stamps[range].iter().map(|(_, t)| *t);
        let last = self.stamps.len().saturating_sub(WITNESSES);
        let is_back = |place: usize| {
            let lowest = of(place - WITNESSES..place).fold(f64::INFINITY, f64::min);
            let highest = of(place..place + WITNESSES).fold(f64::NEG_INFINITY, f64::max);
            let [before, after] = [place - 1, place].map(|at| self.stamps[at].1);
            before - after > least && lowest > highest
        };
        let back: Vec<usize> = (WITNESSES..=last).filter(|place| is_back(*place)).collect();
        let ends = [0].into_iter().chain(back.iter().copied()).chain([self.stamps.len()]);
        let ends: Vec<usize> = ends.collect();
        let anew = ends.windows(3).filter(|ends| {
            let [before, after] = [of(ends[0]..ends[1]), of(ends[1]..ends[2])];
            self.is_anew(&before.collect::<Vec<_>>(), &after.collect::<Vec<_>>())
        });
        let anew: Vec<usize> = anew.map(|ends| self.stamps[ends[1]].0).collect();
        if MIN_ROWS * anew.len() > self.stamps.len() { Vec::new() } else { anew }
    }

    /// Whether sorting would not mend the step between two stretches.
    fn is_anew(&self, before: &[f64], after: &[f64]) -> bool {
        let first = |of: &[f64]| of.iter().copied().fold(f64::INFINITY, f64::min);
        let last = |of: &[f64]| of.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (start, end) = (first(before).max(first(after)), last(before).min(last(after)));
        if end < start {
            return start - end > self.gap;
        }
        let within = |t: &&f64| (start..=end).contains(*t);
        let rows = before.iter().chain(after).filter(within).count();
        real(rows) > MIN_CROWD * ((end - start) / self.usual + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{PoseSample, TrackSample};
    use trackdyn_core::Pose;

    /// A run whose tracks and poses have these stamps.
    fn run(tracks: &[f64], poses: &[f64]) -> UncheckedRun {
        let reading = |t: &f64| TrackSample { t: *t, v_left: 0.1, v_right: 0.2 };
        let pose = |t: &f64| PoseSample { t: *t, pose: Pose::default() };
        UncheckedRun {
            id: 4,
            tracks: tracks.iter().map(reading).collect::<Vec<_>>().into(),
            poses: poses.iter().map(pose).collect::<Vec<_>>().into(),
            ..UncheckedRun::default()
        }
    }

    fn stamps(from: f64, count: u32, interval: f64) -> Vec<f64> {
        (0..count).map(|k| from + interval * f64::from(k)).collect()
    }

    /// Numbers of the parts, and their rows of tracks and poses.
    fn divided(tracks: &[f64], poses: &[f64]) -> Vec<(i64, usize, usize)> {
        let mut warnings = Vec::new();
        let parts = divide(vec![run(tracks, poses)], &mut warnings);
        assert_eq!(warnings.len(), usize::from(parts.len() > 1));
        let rows = |of: &UncheckedRun| (of.id, of.tracks.samples.len(), of.poses.samples.len());
        parts.iter().map(rows).collect()
    }

    #[test]
    fn rows_after_a_clock_was_set_back_are_another_run() {
        for back in [1e6, 40.0, 10.0, 1.0] {
            let tracks = [stamps(1e7, 1000, 0.02), stamps(1e7 + 20.0 - back, 500, 0.02)].concat();
            let poses = [stamps(1e7, 200, 0.1), stamps(1e7 + 20.0 - back, 100, 0.1)].concat();
            assert_eq!(divided(&tracks, &poses), [(4, 1000, 200), (5, 500, 100)], "{back} s");
        }
    }

    #[test]
    fn rows_out_of_order_stay_together() {
        let regular = stamps(0.0, 1000, 0.02);
        let poses = stamps(0.0, 200, 0.1);
        let mut late = regular.clone();
        let held = late.drain(300..340).collect::<Vec<_>>();
        late.splice(400..400, held);
        let turned = [&regular[500..], &regular[..500]].concat();
        let early = [&regular[..300], &[15.0, 15.1, 15.2, 15.3], &regular[300..]].concat();
        for (name, tracks) in [("late", late), ("turned", turned), ("early", early)] {
            let turned = [&poses[100..], &poses[..100]].concat();
            assert_eq!(divided(&tracks, &turned).len(), 1, "{name}");
        }
    }

    /// Where one series alone steps back, nothing says which of its rows belong to which poses.
    #[test]
    fn a_step_of_one_series_divides_nothing() {
        let tracks = [stamps(0.0, 1000, 0.02), stamps(0.0, 1000, 0.02)].concat();
        assert_eq!(divided(&tracks, &stamps(0.0, 400, 0.1)), [(4, 2000, 400)]);
    }
}
