//! One run with all its predicted paths.

use crate::Extent;
use crate::odometry::pose_error::{self, Delta, Statistics};
use crate::odometry::{DeadReckoning, Residual};
use trackdyn_core::Pose;
use trackdyn_core::pose::wrap_angle;
use trackdyn_recording::{Run, hold};

/// A run: what was recorded and what each parameter set predicts, pose by pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Index of the run in the recording.
    pub index: usize,
    /// Number of the run.
    pub run: i64,
    /// Stamps, s of the pose clock.
    pub stamps: Vec<f64>,
    /// Recorded poses.
    pub recorded: Vec<Pose>,
    /// Distance travelled up to each pose, m, as in
    /// [`Stretch::distance`](crate::odometry::Stretch::distance).
    pub travelled: Vec<f64>,
    /// Predictions in the order of the parameter sets.
    pub trajectories: Vec<DeadReckoning>,
    /// Whether both tracks stand all the time.
    pub(super) rests: bool,
}

/// Errors of one parameter set over a whole run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathErrors {
    /// Observed minus predicted motion from the first to the last pose; yaw without turns that no
    /// pose shows.
    pub last: Residual,
    /// Absolute error of the places, m; both paths start at the same pose.
    pub absolute: Statistics,
    /// Absolute error of the yaw, rad.
    pub absolute_yaw: Statistics,
    /// Absolute error of the places after alignment of the whole path, m.
    pub aligned: Statistics,
    /// Relative error of the places over 1 m of the recorded path, pairs one after the other, m;
    /// none where the path is shorter.
    pub relative: Option<Statistics>,
    /// Relative error of the yaw over the same pairs, rad.
    pub relative_yaw: Option<Statistics>,
}

impl Path {
    pub(super) fn new(index: usize, run: &Run, trajectories: &[DeadReckoning], tau: f64) -> Self {
        let (first, stamps) = trajectories
            .first()
            .map_or((0, Vec::new()), |trajectory| (trajectory.first, trajectory.stamps.clone()));
        let recorded = run.poses()[first..].iter().take(stamps.len()).map(|sample| sample.pose);
        let mut sum = 0.0;
        let mut rests = true;
        let mut travelled = vec![0.0; stamps.len().min(1)];
        for pair in stamps.windows(2) {
            for piece in hold::held(run.tracks(), pair[0], pair[1], tau) {
                let speeds = piece.speeds;
                sum += f64::midpoint(speeds.left, speeds.right).abs() * piece.duration;
                rests &= speeds.left == 0.0 && speeds.right == 0.0;
            }
            travelled.push(sum);
        }
        Self {
            index,
            run: run.id(),
            recorded: recorded.collect(),
            stamps,
            travelled,
            trajectories: trajectories.to_vec(),
            rests,
        }
    }

    /// When it begins and how long it lasts.
    pub(super) fn extent(&self) -> Extent {
        let (start, duration) = match self.stamps.as_slice() {
            [first, .., last] => (*first, last - first),
            _ => (0.0, 0.0),
        };
        Extent { run: self.index, start, duration }
    }

    /// Distance travelled, m.
    pub fn length(&self) -> f64 {
        self.travelled.last().copied().unwrap_or(0.0)
    }

    /// Time from the first to the last pose, s.
    pub fn duration(&self) -> f64 {
        self.extent().duration
    }

    /// Errors of a parameter set over the whole run; none for a set that is not there.
    pub fn errors(&self, set: usize) -> Option<PathErrors> {
        let estimate = &self.trajectories.get(set)?.poses;
        let ([start, .., end], [from, .., to]) = (self.recorded.as_slice(), estimate.as_slice())
        else {
            return None;
        };
        let absolute = pose_error::absolute(&self.recorded, estimate);
        let alignment = pose_error::align(&self.recorded, estimate);
        let aligned: Vec<Pose> = estimate.iter().map(|pose| alignment.compose(pose)).collect();
        let aligned = pose_error::absolute(&self.recorded, &aligned);
        let pairs = pose_error::pairs(&self.recorded, Delta::Metres(1.0), false);
        let relative = pose_error::relative(&self.recorded, estimate, &pairs);
        // Turns that no pose shows are no error: what adds up is the error from pose to pose.
        let steps = self.recorded.windows(2).zip(estimate.windows(2));
        let yaw = steps.map(|(seen, predicted)| {
            wrap_angle((seen[1].yaw - seen[0].yaw) - (predicted[1].yaw - predicted[0].yaw))
        });
        let last = Residual::new(&start.relative(end), &from.relative(to));
        Some(PathErrors {
            last: Residual { yaw: yaw.sum(), ..last },
            absolute: Statistics::of(&pose_error::lengths(&absolute))?,
            absolute_yaw: Statistics::of(&pose_error::angles(&absolute))?,
            aligned: Statistics::of(&pose_error::lengths(&aligned))?,
            relative: Statistics::of(&pose_error::lengths(&relative)),
            relative_yaw: Statistics::of(&pose_error::angles(&relative)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A robot spins on while no pose is seen: the turns that the poses cannot show are no error,
    /// those of a drive that turns too fast all the time are.
    #[test]
    fn turns_that_no_pose_shows_are_no_error() {
        let path = |recorded: [f64; 4], predicted: [f64; 4]| Path {
            index: 0,
            run: 0,
            stamps: vec![0.0, 1.0, 2.0, 3.0],
            recorded: recorded.map(|yaw| Pose::new(0.0, 0.0, yaw)).into(),
            travelled: vec![0.0, 1.0, 2.0, 3.0],
            trajectories: vec![DeadReckoning {
                first: 0,
                stamps: vec![0.0, 1.0, 2.0, 3.0],
                poses: predicted.map(|yaw| Pose::new(0.0, 0.0, yaw)).into(),
            }],
            rests: false,
        };
        let yaw = |path: Path| path.errors(0).expect("a path").last.yaw;
        let gap = path([0.0, 1.0, 1.2, 2.2], [0.0, 1.01, 1.21 + TAU, 2.22 + TAU]);
        assert!((yaw(gap) + 0.02).abs() < 1e-12);
        let fast = path([0.0, 1.0, 2.0, 3.0], [0.0, 3.5, 7.0, 10.5]);
        assert!((yaw(fast) + 7.5).abs() < 1e-12);
    }
}
