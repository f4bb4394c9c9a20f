//! The path that a parameter set predicts.

use crate::odometry::covered::covered;
use crate::odometry::{Error, ParameterSet, in_time};
use trackdyn_core::Pose;
use trackdyn_recording::{Run, hold};

/// A predicted path, with poses at the stamps of the recorded ones.
#[derive(Clone, Debug, PartialEq)]
pub struct DeadReckoning {
    /// Index of its first pose in the run; one pose of the run follows the other from there.
    pub first: usize,
    /// Stamps, s of the pose clock.
    pub stamps: Vec<f64>,
    /// `world_from_body` in the frame of the run; yaw is not wrapped.
    pub poses: Vec<Pose>,
}

/// Dead reckoning over a run, from its first recorded pose that the readings of the tracks cover at
/// the clock offset `tau`, s, to the last one; the recording begins at `begin`, s.
///
/// # Law
/// pₖ₊₁ = pₖ exp(twist Δt), one factor for each time over which the track speeds are held; see
/// [`in_time`] for forces.
///
/// # Assumes
/// A reading holds until the next one ([`hold`]), also over a gap: a run is continuous.
///
/// # Errors
/// [`Error::NotCovered`]; of forces [`Error::Stopped`].
pub fn replay(run: &Run, set: &ParameterSet, tau: f64, begin: f64) -> Result<DeadReckoning, Error> {
    let range = covered(run, tau);
    let [start, .., _] = &run.poses()[range.clone()] else {
        let (poses, all) = (range.len(), run.poses().len());
        return Err(Error::NotCovered { run: run.id(), poses, all, tau });
    };
    if let Some(forces) = set.forces() {
        let seen = &run.poses()[range.clone()];
        let stopped = |cause| Error::Stopped { run: run.id(), cause };
        let poses = in_time::poses(run, seen, &forces.file, forces.delay, begin);
        let poses = poses.map_err(stopped)?;
        let stamps = seen.iter().map(|pose| pose.t).collect();
        return Ok(DeadReckoning { first: range.start, stamps, poses });
    }
    let mut trajectory = DeadReckoning {
        first: range.start,
        stamps: Vec::with_capacity(range.len()),
        poses: Vec::with_capacity(range.len()),
    };
    let (mut t, mut pose) = (start.t, start.pose);
    for sample in &run.poses()[range] {
        let step = hold::integrate(run.tracks(), t, sample.t, tau, |speed| set.steady(speed).1);
        (t, pose) = (sample.t, pose.compose(&step));
        trajectory.stamps.push(t);
        trajectory.poses.push(pose);
    }
    Ok(trajectory)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic::{ConstantIcr, Stretch, Synthetic};
    use trackdyn_core::PerSide;
    use trackdyn_recording::Recording;

    fn recording(speeds: PerSide<f64>, tau: f64) -> Recording {
        let kinematics =
            ConstantIcr { x_left: -0.25, x_right: 0.25, y: 0.0, alpha: PerSide::new(1.0, 1.0) };
        let schedules = vec![vec![Stretch { duration: 8.0, speeds }]];
        let synthetic = Synthetic { kinematics, schedules, tau, ..Synthetic::default() };
        synthetic.recording().expect("a recording")
    }

    #[test]
    fn a_straight_line_is_as_long_as_speed_times_time() {
        let run = &recording(PerSide::new(0.7, 0.7), 0.0).runs()[0].clone();
        let path = replay(run, &ParameterSet::ideal(0.5), 0.0, 0.0).expect("covered");
        let end = path.poses[path.poses.len() - 1];
        // 0.7 m/s over 8 s; 1e-12 m is rounding.
        assert!((end.x - 5.6).abs() < 1e-12 && end.y.abs() < 1e-12 && end.yaw == 0.0, "{end:?}");
        assert_eq!(path.stamps.len(), run.poses().len());
    }

    #[test]
    fn a_circle_closes() {
        // ω = (0.6 − 0.4)/0.5 = 0.4 rad/s, radius 0.5/0.4 = 1.25 m
        let run = &recording(PerSide::new(0.4, 0.6), 0.0).runs()[0].clone();
        let path = replay(run, &ParameterSet::ideal(0.5), 0.0, 0.0).expect("covered");
        for (t, pose) in path.stamps.iter().zip(&path.poses) {
            let angle: f64 = 0.4 * t;
            let (x, y) = (1.25 * angle.sin(), 1.25 * (1.0 - angle.cos()));
            assert!((pose.x - x).abs() < 1e-12 && (pose.y - y).abs() < 1e-12);
            assert!((pose.yaw - angle).abs() < 1e-12);
        }
    }

    #[test]
    fn poses_without_readings_are_left_out() {
        let run = &recording(PerSide::new(0.4, 0.6), 0.0).runs()[0].clone();
        let all = run.poses().len();
        let late = replay(run, &ParameterSet::ideal(0.5), 1.0, 0.0).expect("covered");
        assert_eq!((late.first, late.poses.len()), (10, all - 10));
        assert_eq!(late.poses[0], run.poses()[10].pose);
        let early = replay(run, &ParameterSet::ideal(0.5), -1.0, 0.0).expect("covered");
        assert_eq!((early.first, early.poses.len()), (0, all - 10));
        let error =
            replay(run, &ParameterSet::ideal(0.5), 99.0, 0.0).expect_err("nothing in common");
        assert_eq!(error, Error::NotCovered { run: 0, poses: 0, all, tau: 99.0 });
    }
}
