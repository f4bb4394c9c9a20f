//! Where a body went.

use crate::{PerSide, Pose, Twist};

/// Pose and motion at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Time, s.
    pub t: f64,
    /// Pose in the world, REP-103.
    pub pose: Pose,
    /// Twist in the body's axes, REP-103, as it is just after `t`.
    pub twist: Twist,
    /// Speeds of the belts over the hull just after `t`, forward positive, m/s.
    pub belt_speed: PerSide<f64>,
}

/// Moments in time order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    moments: Vec<Moment>,
}

impl Trajectory {
    /// Appends a moment.
    ///
    /// # Panics
    /// Where it does not come after the last one.
    pub fn push(&mut self, moment: Moment) {
        if let Some(last) = self.moments.last() {
            assert!(moment.t > last.t, "{} s after {} s", moment.t, last.t);
        }
        self.moments.push(moment);
    }

    /// The trajectory with all its times shifted, s.
    pub fn later(mut self, by: f64) -> Self {
        self.moments.iter_mut().for_each(|moment| moment.t += by);
        self
    }

    /// The moments, in time order.
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }

    /// First and last time, s; none of an empty trajectory.
    pub fn span(&self) -> Option<[f64; 2]> {
        Some([self.moments.first()?.t, self.moments.last()?.t])
    }

    /// Pose at a time: on the arc of constant twist between two moments; the first or last pose
    /// outside.
    ///
    /// # Panics
    /// Where the trajectory is empty.
    pub fn pose_at(&self, t: f64) -> Pose {
        let (before, after) = self.around(t);
        let interval = after.t - before.t;
        if interval <= 0.0 {
            return before.pose;
        }
        let step = before.pose.relative(&after.pose).log(interval);
        before.pose.compose(&Pose::exp(&step, t - before.t))
    }

    /// Twist at a time, linear between two moments; zero outside.
    ///
    /// # Panics
    /// Where the trajectory is empty.
    pub fn twist_at(&self, t: f64) -> Twist {
        let (before, after) = self.around(t);
        let interval = after.t - before.t;
        if interval <= 0.0 {
            let inside = t == before.t;
            return if inside { before.twist } else { Twist::zero() };
        }
        let share = (t - before.t) / interval;
        let mix = |a: f64, b: f64| a + share * (b - a);
        Twist {
            v_x: mix(before.twist.v_x, after.twist.v_x),
            v_y: mix(before.twist.v_y, after.twist.v_y),
            w: mix(before.twist.w, after.twist.w),
        }
    }

    /// The moments at or before and after a time; twice the same one outside.
    fn around(&self, t: f64) -> (&Moment, &Moment) {
        assert!(!self.moments.is_empty(), "a trajectory without moments");
        let after = self.moments.partition_point(|moment| moment.t <= t);
        let last = self.moments.len() - 1;
        if after == 0 {
            (&self.moments[0], &self.moments[0])
        } else {
            (&self.moments[after - 1], &self.moments[after.min(last)])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_between_moments_lie_on_the_arc() {
        let twist = Twist { v_x: 1.0, v_y: 0.2, w: 0.7 };
        let mut trajectory = Trajectory::default();
        for t in [0.0, 0.5, 2.0] {
            let pose = Pose::exp(&twist, t);
            trajectory.push(Moment { t, pose, twist, belt_speed: PerSide::new(0.8, 1.2) });
        }
        for t in [0.0, 0.3, 0.5, 1.9, 2.0] {
            let (found, expected) = (trajectory.pose_at(t), Pose::exp(&twist, t));
            assert!((found.x - expected.x).abs() < 1e-14 && (found.y - expected.y).abs() < 1e-14);
            assert_eq!(trajectory.twist_at(t), twist);
        }
        assert_eq!(trajectory.pose_at(9.0), Pose::exp(&twist, 2.0));
        assert_eq!(trajectory.twist_at(9.0).w, 0.0);
    }
}
