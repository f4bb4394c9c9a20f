//! Runs that are copies of another run: a bag was played twice while it was recorded.
//!
//! # Law
//! A run is a copy if another run has nearly all of its readings and poses, with the same stamps
//! and the same numbers to the last bit. Noise never repeats.

use crate::recording::{UncheckedRun, Warning};
use crate::sample::Sample;
use std::collections::HashSet;
use trackdyn_core::real;

/// Share of the rows of a copy that stand in the other run: what was lost on the way differs.
const MIN_SHARE: f64 = 0.9;

/// Fewest readings and poses of a copy.
const MIN_ROWS: usize = 10;

/// Leaves out the runs that are copies of one before.
pub(super) fn leave_out(runs: &mut Vec<UncheckedRun>, warnings: &mut Vec<Warning>) {
    let mut kept: Vec<UncheckedRun> = Vec::with_capacity(runs.len());
    for run in runs.drain(..) {
        match kept.iter().find(|other| is_copy(&run, other)) {
            Some(other) => warnings.push(Warning::Chosen {
                what: "runs",
                taken: format!(
                    "all but run {}, which has the readings and poses of run {} again, as of a \
                     bag that was played twice",
                    run.id, other.id
                ),
            }),
            None => kept.push(run),
        }
    }
    *runs = kept;
}

fn is_copy(run: &UncheckedRun, of: &UncheckedRun) -> bool {
    repeats(&run.tracks.samples, &of.tracks.samples)
        && repeats(&run.poses.samples, &of.poses.samples)
}

/// Whether nearly all rows stand among others.
fn repeats<S: Sample>(rows: &[S], others: &[S]) -> bool {
    // Other stamps at the beginning need no search.
    let bits = |row: &S| -> Vec<u64> {
        let mut columns = Vec::new();
        row.push_columns(&mut columns);
        columns.into_iter().map(f64::to_bits).collect()
    };
    let is_within = |row: &S| others.iter().any(|other| other.time() == row.time());
    if rows.len() < MIN_ROWS || !rows.iter().take(MIN_ROWS).any(is_within) {
        return false;
    }
    let others: HashSet<Vec<u64>> = others.iter().map(bits).collect();
    let again = rows.iter().filter(|row| others.contains(&bits(row))).count();
    real(again) >= MIN_SHARE * real(rows.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{PoseSample, TrackSample};
    use trackdyn_core::Pose;

    fn run(id: i64, rows: std::ops::Range<u32>, off: f64) -> UncheckedRun {
        let tracks = rows.clone().map(|k| {
            let t = 0.1 * f64::from(k);
            TrackSample { t, v_left: t.sin(), v_right: 0.3 }
        });
        let poses = rows.map(|k| {
            let t = 0.1 * f64::from(k);
            PoseSample { t, pose: Pose::new(t.cos() + off, 0.0, 0.0) }
        });
        let (tracks, poses) = (tracks.collect::<Vec<_>>(), poses.collect::<Vec<_>>());
        UncheckedRun { id, tracks: tracks.into(), poses: poses.into(), ..Default::default() }
    }

    #[test]
    fn copies_are_left_out_and_other_drives_stay() {
        // whole, a part of it, the same commands elsewhere, later
        let all = [(0..100, 0.0), (0..100, 0.0), (5..60, 0.0), (0..100, 0.01), (200..300, 0.0)];
        let mut runs: Vec<UncheckedRun> =
            (0..).zip(all).map(|(id, (rows, off))| run(id, rows, off)).collect();
        let mut warnings = Vec::new();
        leave_out(&mut runs, &mut warnings);
        assert_eq!(runs.iter().map(|run| run.id).collect::<Vec<_>>(), [0, 3, 4]);
        assert_eq!(warnings.len(), 2);
        assert!(warnings[0].to_string().contains("run 1, which has the readings"));
    }
}
