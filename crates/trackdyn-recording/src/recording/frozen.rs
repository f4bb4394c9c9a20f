//! Poses that stay the same for long while the tracks drive: a tracker that is stuck for a while.
//!
//! # Law
//! Poses that are equal to the last digit are frozen where the tracks run while they last, without
//! their first and last second: poses may be late, and a robot stands before it drives. All but the
//! first are dropped, which leaves a gap. Poses with a yaw alone stay the same in straight driving.

use super::Run;
use super::finding::{Cleaning, Finding};
use crate::hold::travelled;
use crate::sample::Stream;
use trackdyn_core::PerSide;

/// Time at either end in which the tracks may run, s.
const MAX_DELAY: f64 = 1.0;

/// Least way of a track, m.
const MIN_WAY: f64 = 0.1;

/// Drops frozen poses; `cleanings` takes what was found.
pub(super) fn leave_out(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    for run in runs.iter_mut().filter(|run| run.has_positions()) {
        let (poses, tracks) = (run.poses(), run.tracks());
        let mut kept = Vec::with_capacity(poses.len());
        let (mut place, mut first, mut longest) = (0, None, 0.0_f64);
        for equal in poses.chunk_by(|a, b| a.pose == b.pose) {
            let rows = place..place + equal.len();
            place = rows.end;
            let (start, end) = (equal[0].t, equal[equal.len() - 1].t);
            let PerSide { left, right } =
                travelled(tracks, start + MAX_DELAY, end - MAX_DELAY, 0.0);
            if left.abs().max(right.abs()) > MIN_WAY {
                kept.push(rows.start);
                first.get_or_insert(start);
                longest = longest.max(end - start);
            } else {
                kept.extend(rows);
            }
        }
        let count = poses.len() - kept.len();
        let Some(t) = first else { continue };
        let (stream, finding) = (Stream::Poses, Finding::Frozen { longest });
        cleanings.push(Cleaning { stream, finding, count, runs: 1, run: run.id(), t });
        run.keep_poses(&kept);
    }
}
