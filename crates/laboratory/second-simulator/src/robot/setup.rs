//! How finely, from where and with which draw a robot is simulated.

use crate::error::Error;
use trackdyn_core::Pose;

/// Settings of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Lengthwise strips of each contact.
    pub strips: u32,
    /// Shoes of each strip that are on the ground at once.
    pub shoes: u32,
    /// Deflection at which a shoe begins to slide, m.
    pub elastic_range: f64,
    /// Shortest step, s, that of a start; numerical trouble may enforce shorter ones.
    pub shortest_step: f64,
    /// Step of a motion that hardly changes, s.
    pub longest_step: f64,
    /// Change of speed in a step, m/s, at which steps neither grow nor shrink.
    pub speed_change: f64,
    /// Share of the mass that follows Newton's law where no mechanism puts all of it there. It
    /// gives the equations a solution where all shoes slide alike; the robot follows a jump of v in
    /// v/(μ g) times this share, some 0.1 ms for 1 m/s and the default.
    pub residual_mass: f64,
    /// Seed of the shoes' places.
    pub seed: u64,
    /// Pose at the start, REP-103.
    pub start: Pose,
    /// Time at the start, s.
    pub start_time: f64,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            strips: 8,
            shoes: 28,
            elastic_range: 5e-6,
            shortest_step: 5e-4,
            longest_step: 0.01,
            speed_change: 5e-3,
            residual_mass: 1e-3,
            seed: 0,
            start: Pose::new(0.0, 0.0, 0.0),
            start_time: 0.0,
        }
    }
}

impl Setup {
    pub(crate) fn check(&self) -> Result<(), Error> {
        let refuse = |key, value, expected| Err(Error::Setup { key, value, expected });
        if self.strips == 0 || self.shoes < 2 {
            return refuse("shoes", f64::from(self.shoes), "at least a strip of two shoes");
        }
        let lengths = [
            ("elastic_range", self.elastic_range),
            ("shortest_step", self.shortest_step),
            ("longest_step", self.longest_step),
            ("speed_change", self.speed_change),
            ("residual_mass", self.residual_mass),
        ];
        for (key, value) in lengths {
            if !(value.is_finite() && value > 0.0) {
                return refuse(key, value, "a positive number");
            }
        }
        if self.longest_step < self.shortest_step {
            return refuse("longest_step", self.longest_step, "at least the shortest step");
        }
        let Pose { x, y, yaw } = self.start;
        if !(x + y + yaw + self.start_time).is_finite() {
            return refuse("start", x + y + yaw + self.start_time, "finite numbers");
        }
        Ok(())
    }
}
