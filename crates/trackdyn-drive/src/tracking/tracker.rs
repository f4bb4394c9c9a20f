//! How a path is tracked.

use crate::Error;

/// How a path is tracked: pure pursuit, with turns on the spot at corners.
///
/// # Law
/// The body point p shall follow the path. The goal g is where the path leaves the circle of the
/// look-ahead L around p. At a forward speed v and a yaw rate ω the body turns about (y, v/ω) in
/// ROS axes, with y of the kinematics: the point for which |c − p| = |c − g| has
///
/// v/ω = p_y + (L²/2 − (y − p_x) Δ_x)/Δ_y,  Δ = g − p in the axes of the body.
///
/// For p between the tracks at y = 0 that is ω = v · 2 Δ_y/L², Amidi's law. With y it stays exact:
/// on a circle p runs on the circle, though the hull points aside.
///
/// # Assumes
/// p lies less than half a look-ahead behind y: linearised about a straight path, with a = y − p_x
/// and k = v/(L (L/2 − a)), offset and heading have the trace −k (L − a) and the determinant k v,
/// and settle for L > 2 a only.
///
/// # Sources
/// Amidi, Integrated Mobile Robot Control, CMU-RI-TR-90-17, 1990; Coulter, CMU-RI-TR-92-01, 1992.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracker {
    /// Time between commands, s.
    pub interval: f64,
    /// L, m. Short ones follow closely and, with delays, swing; long ones cut curves.
    pub look_ahead: f64,
    /// Forward speed on open ground, m/s.
    pub speed: f64,
    /// Change of the forward speed, m/s².
    pub acceleration: f64,
    /// Largest yaw rate, rad/s.
    pub yaw_rate: f64,
    /// Change of the yaw rate of turns on the spot, rad/s².
    pub yaw_acceleration: f64,
    /// Largest track speed, m/s. Beyond it both tracks slow down by one factor: by (7)-(9) the
    /// curvature stays.
    pub belt_speed: f64,
    /// A sharper change of direction is a corner, rad: the robot stops there and turns on the spot.
    pub corner: f64,
    /// The body point that shall follow the path, forward and left, m.
    pub point: [f64; 2],
    /// Corners and the end are reached within this distance, m.
    pub close: f64,
    /// Turns on the spot end within this angle, rad.
    pub aligned: f64,
}

impl Default for Tracker {
    /// Auriga-alpha's loop of 30 ms at half a metre per second.
    fn default() -> Self {
        Self {
            interval: 0.03,
            look_ahead: 0.5,
            speed: 0.5,
            acceleration: 0.5,
            yaw_rate: 1.0,
            yaw_acceleration: 2.0,
            belt_speed: 1.0,
            corner: 30.0_f64.to_radians(),
            point: [0.0, 0.0],
            close: 1e-3,
            aligned: 2e-3,
        }
    }
}

impl Tracker {
    /// Farthest point of the robot that follows a path, m from the middle.
    pub const MAX_POINT_DISTANCE: f64 = 100.0;

    /// Checks the values.
    ///
    /// # Errors
    /// [`Error::Option`].
    pub fn check(&self) -> Result<(), Error> {
        let positive = [
            ("interval", self.interval, 1.0),
            ("look-ahead", self.look_ahead, 1e3),
            ("speed", self.speed, 1e3),
            ("acceleration", self.acceleration, 1e4),
            ("yaw rate", self.yaw_rate, 1e3),
            ("yaw acceleration", self.yaw_acceleration, 1e4),
            ("belt speed", self.belt_speed, 1e3),
            ("corner", self.corner, 4.0),
            ("close", self.close, 1.0),
            ("aligned", self.aligned, 1.0),
        ];
        for (name, value, most) in positive {
            if !(value >= 1e-6 && value <= most) {
                let expected = format!("a positive number, at most {most}");
                return Err(Error::option(name, &value, expected));
            }
        }
        for (name, value) in [("point forward", self.point[0]), ("point left", self.point[1])] {
            if !(-Self::MAX_POINT_DISTANCE..=Self::MAX_POINT_DISTANCE).contains(&value) {
                let expected = format!("at most {} m from the middle", Self::MAX_POINT_DISTANCE);
                return Err(Error::option(name, &value, expected));
            }
        }
        Ok(())
    }
}
