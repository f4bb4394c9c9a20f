//! Pose sensor: the reported motion of the hull.

use trackdyn_core::frames::{paper_twist_from_ros, ros_from_paper, ros_twist_from_paper};
use trackdyn_core::{Moment, Pose, Trajectory, Twist};

/// Mount and errors of the pose sensor, in the paper's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensor {
    /// Position on the hull: right and forward of the origin, m.
    pub lever: [f64; 2],
    /// Heading relative to the hull, counter-clockwise, rad.
    pub yaw: f64,
    /// Yaw rate reported at rest, rad/s.
    pub yaw_rate_bias: f64,
    /// Delay of its stamps, s.
    pub delay: f64,
}

impl Sensor {
    /// Reported twist, in the sensor's axes, for a twist of the hull.
    pub fn reported(&self, twist: &Twist) -> Twist {
        self.reporting()(twist)
    }

    /// [`Sensor::reported`], for many twists.
    pub fn reporting(&self) -> impl Fn(&Twist) -> Twist + use<> {
        let Self { lever, yaw_rate_bias, .. } = *self;
        let (sin, cos) = self.yaw.sin_cos();
        move |twist| {
            let [v_x, v_y] = twist.velocity_at(lever);
            Twist {
                v_x: cos * v_x + sin * v_y,
                v_y: cos * v_y - sin * v_x,
                w: twist.w + yaw_rate_bias,
            }
        }
    }

    /// Pose of the sensor on the hull, REP-103.
    pub fn mount(&self) -> Pose {
        let [x, y] = ros_from_paper(self.lever);
        Pose::new(x, y, self.yaw)
    }

    /// Reported path for a path of the hull: the sensor's poses, integrated from reported twists,
    /// with late stamps. Belt speeds keep their times.
    pub fn reported_path(&self, path: &Trajectory) -> Trajectory {
        let mut reported = Trajectory::default();
        let mut pose = None;
        let mut before: Option<Moment> = None;
        for moment in path.moments() {
            let mounted = moment.pose.compose(&self.mount());
            let next = match (pose, before) {
                (Some(pose), Some(before)) if self.yaw_rate_bias != 0.0 => {
                    let duration = moment.t - before.t;
                    let start: Pose = before.pose.compose(&self.mount());
                    let mut step = start.relative(&mounted).log(duration);
                    step.w += self.yaw_rate_bias;
                    Pose::compose(&pose, &Pose::exp(&step, duration))
                }
                _ => mounted,
            };
            let twist = self.reported(&paper_twist_from_ros(&moment.twist));
            reported.push(Moment {
                t: moment.t + self.delay,
                pose: next,
                twist: ros_twist_from_paper(&twist),
                belt_speed: moment.belt_speed,
            });
            pose = Some(next);
            before = Some(*moment);
        }
        reported
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_in_front_moves_sideways_in_a_left_turn() {
        let sensor = Sensor { lever: [0.0, 0.5], ..Sensor::default() };
        let reported = sensor.reported(&Twist { v_x: 0.0, v_y: 1.0, w: 2.0 });
        assert_eq!(reported, Twist { v_x: -1.0, v_y: 1.0, w: 2.0 });
    }

    #[test]
    fn a_sensor_turned_left_sees_the_robot_drift_to_the_right() {
        let sensor = Sensor { yaw: 0.1, ..Sensor::default() };
        let reported = sensor.reported(&Twist { v_x: 0.0, v_y: 1.0, w: 0.0 });
        assert!((reported.v_x - 0.1_f64.sin()).abs() < 1e-15);
    }
}
