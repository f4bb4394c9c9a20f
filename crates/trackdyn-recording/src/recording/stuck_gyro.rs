//! Yaw rates of an IMU that stay the same while the poses turn otherwise: a gyroscope that is
//! stuck, or at the end of its range.
//!
//! # Law
//! Readings that are equal to the last digit are in question where they last. They are dropped
//! where the poses turn by another angle meanwhile than they tell. A gyroscope of a robot that
//! stands may show one number all the time, and one that is coarse may repeat itself.

use super::Run;
use super::finding::{Cleaning, Finding};
use crate::sample::{PoseSample, Stream};
use std::ops::Range;

/// Least time of equal readings, s.
const MIN_TIME: f64 = 0.5;

/// Least difference of the turns of poses and gyroscope, rad: more than a time between poses, a
/// delay or a drift leaves.
const MIN_TURN_DIFFERENCE: f64 = 0.35;

/// Drops the readings of stuck gyroscopes; `cleanings` takes what was found.
pub(super) fn leave_out(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    for run in runs {
        let imu = run.imu();
        let mut end = 0;
        let equal = imu.chunk_by(|a, b| a.gyro_z == b.gyro_z).map(|equal| {
            let rows = end..end + equal.len();
            end = rows.end;
            rows
        });
        let stuck: Vec<Range<usize>> = equal.filter(|rows| is_stuck(run, rows)).collect();
        let Some(first) = stuck.first() else { continue };
        let time = |rows: &Range<usize>| imu[rows.end - 1].t - imu[rows.start].t;
        let longest = stuck.iter().map(time).fold(0.0, f64::max);
        let (t, count) = (imu[first.start].t, stuck.iter().map(ExactSizeIterator::len).sum());
        let finding = Finding::StuckGyroscope { longest };
        cleanings.push(Cleaning { stream: Stream::Imu, finding, count, runs: 1, run: run.id(), t });
        let rows = 0..imu.len();
        let kept: Vec<usize> =
            rows.filter(|row| stuck.iter().all(|stuck| !stuck.contains(row))).collect();
        run.keep_imu(&kept);
    }
}

/// Whether the poses turn otherwise than these equal readings.
fn is_stuck(run: &Run, rows: &Range<usize>) -> bool {
    let imu = run.imu();
    let [from, until] = [imu[rows.start].t, imu[rows.end - 1].t];
    if until - from < MIN_TIME {
        return false;
    }
    let poses = run.poses();
    let first = poses.partition_point(|pose| pose.t < from);
    let last = poses.partition_point(|pose| pose.t <= until);
    let Some(poses @ [start, ..]) = poses.get(first..last) else { return false };
    // A turn there and back leaves nothing: any pose on the way tells.
    let rate = imu[rows.start].gyro_z;
    let off =
        |pose: &PoseSample| (pose.pose.yaw - start.pose.yaw - rate * (pose.t - start.t)).abs();
    poses.iter().any(|pose| off(pose) > MIN_TURN_DIFFERENCE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::UncheckedRun;
    use crate::sample::{ImuSample, TrackSample};
    use trackdyn_core::Pose;

    /// A minute of turning to and fro, of whose gyroscope readings are replaced.
    fn turning(shown: impl Fn(f64) -> f64) -> Vec<Cleaning> {
        let rate = |t: f64| 0.8 * (0.7 * t).sin();
        let times = |step: f64, count: u32| (0..count).map(move |k| step * f64::from(k));
        let track = |t: f64| TrackSample { t, v_left: -0.2 * rate(t), v_right: 0.2 * rate(t) };
        let pose = |t: f64| PoseSample {
            t,
            pose: Pose::new(0.0, 0.0, 0.8 / 0.7 * (1.0 - (0.7 * t).cos())),
        };
        let none = f64::NAN;
        let reading = |t: f64| {
            let gyro_z = if shown(t).is_nan() { rate(t + 0.005) } else { shown(t) };
            ImuSample { t, gyro_z, acc_x: none, acc_y: none }
        };
        let tracks: Vec<TrackSample> = times(0.02, 3000).map(track).collect();
        let poses: Vec<PoseSample> = times(0.1, 600).map(pose).collect();
        let imu: Vec<ImuSample> = times(0.01, 6000).map(reading).collect();
        let (tracks, poses, imu) = (tracks.into(), poses.into(), imu.into());
        let mut runs = [Run::new(UncheckedRun { id: 0, tracks, poses, imu }, &mut Vec::new())];
        let mut cleanings = Vec::new();
        leave_out(&mut runs, &mut cleanings);
        let count: usize = cleanings.iter().map(|cleaning| cleaning.count).sum();
        assert_eq!(runs[0].imu().len() + count, 6000);
        cleanings
    }

    #[test]
    fn readings_that_stay_while_the_robot_turns_go() {
        assert!(turning(|_| f64::NAN).is_empty(), "none is stuck");
        let zero = turning(|t| if t < 29.995 { f64::NAN } else { 0.0 });
        assert_eq!(zero.len(), 1);
        assert_eq!((zero[0].count, zero[0].t), (3000, 30.0), "{zero:?}");
        let held = turning(|t| if (20.0..26.0).contains(&t) { 0.3 } else { f64::NAN });
        assert!(matches!(held[0].finding, Finding::StuckGyroscope { longest } if longest > 5.9));
    }
}
