//! Runs whose poses have a yaw alone, as a compass or an integrated gyro writes them.

use crate::sample::{PoseSample, TrackSample};

/// Least way forward of the tracks, m, before constant positions count for none.
const MIN_TRAVEL: f64 = 1.0;

/// Least portion of the way of the tracks that leads forward: a robot may turn about the very point
/// that is measured.
const MIN_FORWARD_PORTION: f64 = 0.1;

/// Least change of yaw in all, rad, that shows that poses are measured.
const MIN_TURN: f64 = 0.5;

/// Sets x and y to 0 where they are not known, and says whether they are.
///
/// They are not known where all rows with a yaw lack them, and where they never change while the
/// tracks travel and yaw turns.
pub(super) fn settle(poses: &mut [PoseSample], tracks: &[TrackSample]) -> bool {
    let has_yaw = |sample: &&PoseSample| sample.pose.yaw.is_finite();
    let position = |sample: &PoseSample| [sample.pose.x, sample.pose.y];
    let mut with_yaw = poses.iter().filter(has_yaw).map(position).peekable();
    let Some(&first) = with_yaw.peek() else { return true };
    let is_known = if first.iter().all(|value| value.is_finite()) {
        with_yaw.any(|position| position != first) || !travels(tracks) || !turns(poses)
    } else {
        with_yaw.any(|position| position.iter().all(|value| value.is_finite()))
    };
    if !is_known {
        for sample in poses.iter_mut().filter(|sample| sample.pose.yaw.is_finite()) {
            (sample.pose.x, sample.pose.y) = (0.0, 0.0);
        }
    }
    is_known
}

/// Whether the tracks drive somewhere.
fn travels(tracks: &[TrackSample]) -> bool {
    let way = |of: fn(&TrackSample) -> f64| -> f64 {
        let steps = tracks.windows(2).map(|pair| of(&pair[0]) * (pair[1].t - pair[0].t));
        steps.filter(|step| step.is_finite() && *step > 0.0).sum()
    };
    let forward = way(|sample| 0.5 * (sample.v_left + sample.v_right).abs());
    let all = way(|sample| 0.5 * (sample.v_left.abs() + sample.v_right.abs()));
    forward >= MIN_TRAVEL.max(MIN_FORWARD_PORTION * all)
}

/// Whether yaw changes.
fn turns(poses: &[PoseSample]) -> bool {
    let steps = poses.windows(2).map(|pair| (pair[1].pose.yaw - pair[0].pose.yaw).abs());
    steps.filter(|step| step.is_finite()).sum::<f64>() >= MIN_TURN
}
