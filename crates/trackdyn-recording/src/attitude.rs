//! Whether poses belong to a robot that stands on its wheels and turns about its vertical axis.

use crate::doubt::Axes;

/// Largest tilt of a robot that drives, as its cosine: 60°.
const MIN_TILT_COSINE: f64 = 0.5;

/// One in so many poses may be tilted by more.
const MAX_PORTION: u64 = 20;

/// Least turn about the y axis, as the sine of its half: 30°, more than that of ramps.
const MIN_PITCH: f64 = 0.25;

/// Least ratio of the turn about the y axis to those about the others.
const MIN_PITCH_RATIO: f64 = 3.0;

/// Counts poses that no robot has.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Attitude {
    all: u64,
    /// Those that are tilted by more than a robot can be, and those of them upside down.
    tilted: u64,
    inverted: u64,
    /// Those that are turned about the y axis against the first, and those of them that are tilted.
    pitched: u64,
    pitched_far: u64,
    first: Option<[f64; 4]>,
}

impl Attitude {
    /// Notes the quaternion (x, y, z, w) of a pose.
    pub(crate) fn note(&mut self, quaternion: [f64; 4]) {
        let [x, y, z, w] = quaternion;
        let square = x * x + y * y + z * z + w * w;
        // Cosine of the angle between the z axes of body and world: 1 − 2 (x² + y²)
        let upright = 1.0 - 2.0 * (x * x + y * y) / square;
        if !upright.is_finite() {
            return;
        }
        self.all += 1;
        self.tilted += u64::from(upright < MIN_TILT_COSINE);
        self.inverted += u64::from(upright < -MIN_TILT_COSINE);
        let turned = turned(*self.first.get_or_insert(quaternion), quaternion);
        let [roll, pitch, yaw] = turned.map(f64::abs);
        let others = roll.max(yaw);
        let is_pitched = pitch > MIN_PITCH && pitch > MIN_PITCH_RATIO * others;
        self.pitched += u64::from(is_pitched);
        self.pitched_far += u64::from(is_pitched && upright < MIN_TILT_COSINE);
    }

    /// How many poses no robot can have, where these are too many to be single errors, and which
    /// axes explain them.
    pub(crate) fn out_of_plane(&self) -> Option<(u64, Axes)> {
        let are_many = |count: u64| MAX_PORTION * count > self.all;
        if are_many(self.tilted) {
            // a camera that turns about its y axis is upside down after half a turn
            let is_camera = 2 * self.pitched_far > self.tilted;
            let is_inverted = 2 * self.inverted > self.tilted && !is_camera;
            return Some((self.tilted, if is_inverted { Axes::Down } else { Axes::Camera }));
        }
        are_many(self.pitched).then_some((self.pitched, Axes::Camera))
    }
}

/// Sines of half the turn from one orientation to another, times its axis in the first.
fn turned([ax, ay, az, aw]: [f64; 4], [x, y, z, w]: [f64; 4]) -> [f64; 3] {
    let scale = ((ax * ax + ay * ay + az * az + aw * aw) * (x * x + y * y + z * z + w * w)).sqrt();
    // vector part of conj(a) b
    [
        (aw * x - ax * w - ay * z + az * y) / scale,
        (aw * y - ay * w - az * x + ax * z) / scale,
        (aw * z - az * w - ax * y + ay * x) / scale,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_of_a_camera_are_no_robot_and_ramps_are() {
        let tilted = |quaternion: [f64; 4]| {
            let mut attitude = Attitude::default();
            for _ in 0..100 {
                attitude.note(quaternion);
            }
            attitude.out_of_plane()
        };
        // z forward, x to the right: turned by -90° about z, then by -90° about x
        assert_eq!(tilted([-0.5, 0.5, -0.5, 0.5]), Some((100, Axes::Camera)));
        assert_eq!(tilted([0.0, 0.0, 0.7, 0.7]), None);
        let (sin, cos) = 0.3_f64.sin_cos();
        assert_eq!(tilted([0.0, 2.0 * sin, 0.0, 2.0 * cos]), None, "a ramp of 34°");
        assert_eq!(tilted([0.0; 4]), None);
        let mut once = Attitude::default();
        for step in 0..100 {
            once.note([f64::from(u8::from(step == 3)), 0.0, 0.0, 1.0]);
        }
        assert_eq!(once.out_of_plane(), None);
    }

    #[test]
    fn a_world_of_a_camera_turns_about_y_and_a_z_axis_may_point_down() {
        let driven = |of: fn(f64) -> [f64; 4]| {
            let mut attitude = Attitude::default();
            for step in 0..100 {
                attitude.note(of(0.5 * (0.1 * f64::from(step)).sin()));
            }
            attitude.out_of_plane()
        };
        // both frames are those of a camera
        let found = driven(|half| [0.0, half.sin(), 0.0, half.cos()]);
        assert!(matches!(found, Some((count, Axes::Camera)) if count > 50), "{found:?}");
        // and turn all around
        let mut around = Attitude::default();
        for step in 0..100 {
            let (sin, cos) = (0.1 * f64::from(step)).sin_cos();
            around.note([0.0, sin, 0.0, cos]);
        }
        let found = around.out_of_plane();
        assert!(matches!(found, Some((count, Axes::Camera)) if count > 50), "{found:?}");
        // yaw, as of a robot
        assert_eq!(driven(|half| [0.0, 0.0, half.sin(), half.cos()]), None);
        // turned by half a turn about x
        let found = driven(|half| [half.cos(), -half.sin(), 0.0, 0.0]);
        assert_eq!(found, Some((100, Axes::Down)));
    }
}
