//! Poses that repeat the one before while the tracks drive: a tracker that is stuck for a while, or
//! a link that sends more often than it measures.
//!
//! # Law
//! A pose that repeats the one before to the last digit was not measured again if the tracks have
//! run since; it is dropped. Poses may be late, so the travel of the tracks is taken earlier by the
//! delay of the poses. Where the robot stands at the first of equal poses, the error of that delay
//! is allowed for. Poses with a yaw alone stay the same in straight driving.

use super::Run;
use super::cleaning::MIN_GAP_RATIO;
use super::finding::{Cleaning, Finding};
use super::motion::{DELAY_STEP, Following};
use crate::hold::travelled;
use crate::sample::{PoseSample, Stream, TrackSample};
use trackdyn_core::PerSide;
use trackdyn_core::robust::usual_interval;

/// Largest way of a track, m, that a pose sensor may overlook.
const MAX_STANDING_WAY: f64 = 0.005;

/// Drops repeated poses; `cleanings` takes what was found.
pub(super) fn leave_out(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    let has_repeated = |run: &Run| run.poses().windows(2).any(|two| two[0].pose == two[1].pose);
    if !runs.iter().any(has_repeated) {
        return;
    }
    let stuck: Vec<Vec<[f64; 2]>> = runs.iter().map(long_repeats).collect();
    let following = Following::of(runs, &|run, piece, _| {
        stuck[run].iter().any(|[from, until]| *from < piece.end && piece.start < *until)
    });
    let delay = following.map_or(0.0, |following| following.delay);
    for run in runs.iter_mut().filter(|run| run.has_positions()) {
        let (poses, tracks) = (run.poses(), run.tracks());
        let mut kept = Vec::with_capacity(poses.len());
        let (mut place, mut first, mut longest) = (0, None, 0.0_f64);
        for equal in poses.chunk_by(|a, b| a.pose == b.pose) {
            let rows = place..place + equal.len();
            place = rows.end;
            if equal.len() == 1 {
                kept.push(rows.start);
                continue;
            }
            let limit = allowed(equal, tracks, delay);
            let is_measured = |row: &usize| {
                let way = largest(travelled(tracks, equal[0].t, poses[*row].t, delay));
                *row == rows.start || way <= limit
            };
            let measured: Vec<usize> = rows.clone().filter(is_measured).collect();
            if measured.len() < equal.len() {
                first.get_or_insert(equal[0].t);
                longest = longest.max(equal[equal.len() - 1].t - equal[0].t);
            }
            kept.extend(measured);
        }
        // A run whose poses are all the same shows nothing of how often they are measured.
        let count = poses.len() - kept.len();
        let Some(t) = first.filter(|_| kept.len() > 1) else { continue };
        let (stream, finding) = (Stream::Poses, Finding::Frozen { longest });
        cleanings.push(Cleaning { stream, finding, count, runs: 1, run: run.id(), t });
        run.keep_poses(&kept);
    }
}

/// The times of a run in which poses stay the same for longer than they usually do, s.
fn long_repeats(run: &Run) -> Vec<[f64; 2]> {
    let equals = || run.poses().chunk_by(|a, b| a.pose == b.pose);
    let usual = usual_interval(equals().map(|equal| equal[0].t));
    let times = equals().map(|equal| [equal[0].t, equal[equal.len() - 1].t]);
    times.filter(|[from, until]| until - from > MIN_GAP_RATIO * usual).collect()
}

/// Way that a track may run while poses stay the same, m.
fn allowed(equal: &[PoseSample], tracks: &[TrackSample], delay: f64) -> f64 {
    let (start, end) = (equal[0].t, equal[equal.len() - 1].t);
    let stands = largest(travelled(tracks, start - 2.0 * DELAY_STEP, start, delay)) == 0.0;
    // By the clock of the tracks the poses are measured a delay earlier, which is no exact number.
    let (from, until) = (start - delay.max(0.0), end - delay.min(0.0));
    let at = |time: f64| tracks.partition_point(|reading| reading.t < time);
    let readings = tracks[at(from)..at(until)].iter();
    let fastest = readings.map(|reading| largest(reading.speeds())).fold(0.0, f64::max);
    if stands { MAX_STANDING_WAY + fastest * DELAY_STEP } else { MAX_STANDING_WAY }
}

fn largest(of: PerSide<f64>) -> f64 {
    of.left.abs().max(of.right.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::UncheckedRun;
    use trackdyn_core::Pose;

    #[test]
    fn poses_that_are_sent_again_while_the_tracks_move_go() {
        // 0.5 m/s from 1 s on; a pose every 20 ms, measured every 60 ms
        let drive = [(0.0, 0.0), (1.0, 0.5), (2.0, 0.5)];
        let drive = drive.map(|(t, v)| TrackSample { t, v_left: v, v_right: v });
        let pose = |step: u32| {
            let t = 0.02 * f64::from(step);
            let measured = 0.06 * f64::from(step / 3);
            let x = 0.5 * (measured - 1.0).max(0.0);
            PoseSample { t, pose: Pose::new(x, 0.0, 0.0) }
        };
        let samples: Vec<PoseSample> = (0..=100).map(pose).collect();
        let (tracks, poses) = (drive.to_vec().into(), samples.into());
        let rows = UncheckedRun { id: 0, tracks, poses, ..UncheckedRun::default() };
        let mut runs = [Run::new(rows, &mut Vec::new())];
        let mut cleanings = Vec::new();
        leave_out(&mut runs, &mut cleanings);
        // a robot that stands may say so again; the poses of step 51 on are told three times, the
        // last one twice
        assert!(matches!(cleanings[0].finding, Finding::Frozen { .. }), "{cleanings:?}");
        assert_eq!((cleanings[0].count, runs[0].poses().len()), (33, 68));
        assert!((cleanings[0].t - 1.02).abs() < 1e-9, "{}", cleanings[0].t);
    }
}
