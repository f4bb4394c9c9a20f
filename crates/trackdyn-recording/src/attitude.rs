//! Whether poses belong to a robot that stands on its wheels.

/// Largest tilt of a robot that drives, as its cosine: 60°.
const MIN_UPRIGHT: f64 = 0.5;

/// One in so many poses may be tilted by more.
const MAX_PORTION: u64 = 20;

/// Counts poses that are tilted by more than a robot can be.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Attitude {
    all: u64,
    tilted: u64,
}

impl Attitude {
    /// Notes the quaternion (x, y, z, w) of a pose.
    pub(crate) fn note(&mut self, [x, y, z, w]: [f64; 4]) {
        let square = x * x + y * y + z * z + w * w;
        // Cosine of the angle between the z axes of body and world: 1 − 2 (x² + y²)
        let upright = 1.0 - 2.0 * (x * x + y * y) / square;
        if upright.is_finite() {
            self.all += 1;
            self.tilted += u64::from(upright < MIN_UPRIGHT);
        }
    }

    /// Poses that are tilted by more than 60°, where these are too many for single wrong ones.
    pub(crate) fn tilted(&self) -> Option<u64> {
        (MAX_PORTION * self.tilted > self.all).then_some(self.tilted)
    }
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
            attitude.tilted()
        };
        // z forward, x to the right: turned by -90° about z, then by -90° about x
        assert_eq!(tilted([-0.5, 0.5, -0.5, 0.5]), Some(100));
        assert_eq!(tilted([0.0, 0.0, 0.7, 0.7]), None);
        let (sin, cos) = 0.3_f64.sin_cos();
        assert_eq!(tilted([0.0, 2.0 * sin, 0.0, 2.0 * cos]), None, "a ramp of 34°");
        assert_eq!(tilted([0.0; 4]), None);
        let mut once = Attitude::default();
        for step in 0..100 {
            once.note([f64::from(u8::from(step == 3)), 0.0, 0.0, 1.0]);
        }
        assert_eq!(once.tilted(), None);
    }
}
