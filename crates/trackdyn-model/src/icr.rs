//! The ICRs of both tracks.

use trackdyn_core::{PerSide, Twist};

/// Instantaneous centres of rotation of the two tracks in the paper's frame, m.
///
/// Both lie on one line across the vehicle: their y is that of the hull's ICR.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Icrs {
    /// x of the left track's ICR, x_l; negative in ordinary motion.
    pub x_left: f64,
    /// x of the right track's ICR, x_r.
    pub x_right: f64,
    /// y of both ICRs and of the hull's.
    pub y: f64,
}

impl Icrs {
    /// x_l, x_r, y: names in tables and files, in the order of [`Icrs::to_array`].
    pub const NAMES: [&'static str; 3] = ["x_l", "x_r", "y"];

    /// The triple [x_l, x_r, y].
    pub fn from_array([x_left, x_right, y]: [f64; 3]) -> Self {
        Self { x_left, x_right, y }
    }

    /// The triple [x_l, x_r, y].
    pub fn to_array(self) -> [f64; 3] {
        [self.x_left, self.x_right, self.y]
    }

    /// ICRs of a hull with this twist and belts with these speeds (m/s); none without turning.
    pub fn of_motion(belt_speed: PerSide<f64>, twist: &Twist) -> Option<Self> {
        // x = (V − v_y)/w, y = v_x/w
        let x = |speed: f64| (speed - twist.v_y) / twist.w;
        (twist.w != 0.0).then(|| Self {
            x_left: x(belt_speed.left),
            x_right: x(belt_speed.right),
            y: twist.v_x / twist.w,
        })
    }

    /// Steering efficiency χ for this gauge: 1 for an ideal differential drive.
    pub fn steering_efficiency(&self, gauge: f64) -> f64 {
        // χ = L/(x_r − x_l), eq. (12)
        gauge / (self.x_right - self.x_left)
    }

    /// Eccentricity e: 0 for ICRs symmetric about the middle, positive where their centre is to the
    /// right.
    pub fn eccentricity(&self) -> f64 {
        // e = (x_r + x_l)/(x_r − x_l), eq. (13)
        (self.x_right + self.x_left) / (self.x_right - self.x_left)
    }
}

#[cfg(test)]
mod tests {
    use super::Icrs;

    #[test]
    fn ideal_differential_drive_has_efficiency_one_and_no_eccentricity() {
        let ideal = Icrs { x_left: -0.21, x_right: 0.21, y: 0.0 };
        assert_eq!(ideal.steering_efficiency(0.42), 1.0);
        assert_eq!(ideal.eccentricity(), 0.0);
    }
}
