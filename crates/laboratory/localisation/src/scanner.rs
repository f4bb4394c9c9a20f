//! A simulated planar laser.

use crate::error::{Error, finite, not_negative, positive};
use crate::room::{Fan, Room};
use crate::scan::{Scan, check_turn};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::FRAC_PI_2;
use trackdyn_core::Pose;

/// A planar laser and where it sits on the robot.
///
/// # Law
/// range = distance to the first segment + `range_noise` · ε, ε standard normal and independent
/// from beam to beam.
///
/// # Assumes
/// Beams without width, segments that reflect from every angle, a level robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Scanner {
    /// Bearing of beam 0, rad.
    pub first_angle: f64,
    /// Bearing from one beam to the next, counter-clockwise, rad.
    pub angle_step: f64,
    /// Number of beams.
    pub beams: usize,
    /// Range beyond which nothing comes back, m.
    pub max_range: f64,
    /// Standard deviation of a range, m.
    pub range_noise: f64,
    /// Time from one scan to the next, s.
    pub period: f64,
    /// Time from the first beam of a scan to its last, s. At zero a scan is a snapshot; else the
    /// robot's motion distorts it.
    pub sweep: f64,
    /// Pose of the sensor on the robot (x forward, y left), m and rad.
    pub robot_from_sensor: Pose,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Scanner {
    /// A laser like the paper's: 180 degrees in steps of half a degree, 8 m, 10 mm, a scan every
    /// 0.27 s, at the robot's origin.
    fn default() -> Self {
        Self {
            first_angle: -FRAC_PI_2,
            angle_step: FRAC_PI_2 / 180.0,
            beams: 361,
            max_range: 8.0,
            range_noise: 0.01,
            period: 0.27,
            sweep: 0.0,
            robot_from_sensor: Pose::default(),
            seed: 0,
        }
    }
}

impl Scanner {
    /// Scans a room at time `stamp` (s), where the robot is at `room_from_robot(t)` at time t (s).
    ///
    /// The noise is that of stream `index` of the seed: it does not depend on the scans before.
    ///
    /// # Errors
    /// [`Error::Value`] for a scanner, or a pose, that cannot be.
    pub fn scan(
        &self,
        room: &Room,
        stamp: f64,
        index: u64,
        room_from_robot: impl Fn(f64) -> Pose,
    ) -> Result<Scan, Error> {
        self.check()?;
        let sensor_at = |t: f64| -> Result<Pose, Error> {
            let pose = room_from_robot(t).compose(&self.robot_from_sensor);
            finite("pose of the sensor, x", pose.x)?;
            finite("pose of the sensor, y", pose.y)?;
            finite("pose of the sensor, yaw", pose.yaw)?;
            Ok(pose)
        };
        let fan =
            Fan { first_angle: self.first_angle, angle_step: self.angle_step, count: self.beams };
        let mut ranges = if self.sweep == 0.0 {
            room.ranges(&sensor_at(stamp)?, &fan)
        } else {
            let mut ranges = Vec::with_capacity(self.beams);
            for beam in 0..self.beams {
                let pose = sensor_at(stamp + self.sweep * self.share(beam))?;
                let hit = room.range([pose.x, pose.y], pose.yaw + fan.bearing(beam));
                ranges.push(hit.unwrap_or(f64::INFINITY));
            }
            ranges
        };
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(index);
        for range in &mut ranges {
            let normal: f64 = StandardNormal.sample(&mut random);
            let noisy = *range + self.range_noise * normal;
            // Beyond its range, and too near to tell, a laser gives no return.
            let seen = *range <= self.max_range && noisy > 0.0;
            *range = if seen { noisy } else { f64::INFINITY };
        }
        Scan::new(stamp, self.first_angle, self.angle_step, ranges)
    }

    /// Part of the sweep that lies before a beam.
    #[expect(clippy::cast_precision_loss, reason = "beams are few")]
    fn share(&self, beam: usize) -> f64 {
        beam as f64 / self.beams.saturating_sub(1).max(1) as f64
    }

    fn check(&self) -> Result<(), Error> {
        finite("first_angle", self.first_angle)?;
        positive("angle_step", self.angle_step)?;
        check_turn(self.angle_step, self.beams)?;
        positive("max_range", self.max_range)?;
        not_negative("range_noise", self.range_noise)?;
        positive("period", self.period)?;
        not_negative("sweep", self.sweep)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn middle(_: f64) -> Pose {
        Pose::new(5.0, 4.0, 0.0)
    }

    #[test]
    fn a_scan_sees_the_walls_where_they_are() {
        let scanner = Scanner { range_noise: 0.0, ..Scanner::default() };
        let scan = scanner.scan(&Room::furnished(), 1.5, 0, middle).expect("a scan");
        assert_eq!((scan.stamp(), scan.ranges().len()), (1.5, 361));
        // Straight ahead lies the corridor, whose end at 8.5 m is out of range; to the right the
        // near wall, 4 m away. 1e-12 m is rounding.
        assert_eq!(scan.ranges()[180], f64::INFINITY);
        assert!((scan.ranges()[0] - 4.0).abs() < 1e-12);
    }

    #[test]
    fn the_mount_moves_the_sensor() {
        let robot_from_sensor = Pose::new(0.4, -0.1, FRAC_PI_2);
        let mounted = Scanner { robot_from_sensor, range_noise: 0.0, ..Scanner::default() };
        let scan = mounted.scan(&Room::furnished(), 0.0, 0, middle).expect("a scan");
        // Beam 0 looks along the robot's x axis, from (5.4, 3.9): into the corridor, whose end is
        // 8.1 m away.
        assert_eq!(scan.ranges()[0], f64::INFINITY);
        // Beam 180 looks along y to the far wall at y = 8.
        assert!((scan.ranges()[180] - 4.1).abs() < 1e-12);
    }

    #[test]
    fn equal_seeds_give_equal_scans_and_streams_differ() {
        let scanner = Scanner::default();
        let scan = |index| scanner.scan(&Room::furnished(), 0.0, index, middle).expect("a scan");
        assert_eq!(scan(3), scan(3));
        assert_ne!(scan(3), scan(4));
    }

    #[test]
    fn a_sweep_without_motion_distorts_nothing() {
        let still = Scanner::default();
        let sweeping = Scanner { sweep: 0.013, ..Scanner::default() };
        let scan = |scanner: &Scanner| scanner.scan(&Room::furnished(), 0.0, 0, middle);
        assert_eq!(scan(&still).expect("a scan"), scan(&sweeping).expect("a scan"));
    }

    #[test]
    fn nonsense_is_refused() {
        let room = Room::furnished();
        let lost = Scanner::default().scan(&room, 0.0, 0, |_| Pose::new(f64::NAN, 0.0, 0.0));
        assert!(lost.expect_err("refused").to_string().contains("pose of the sensor, x = NaN"));
        let noisy = Scanner { range_noise: -0.01, ..Scanner::default() };
        let error = noisy.scan(&room, 0.0, 0, middle).expect_err("refused").to_string();
        assert!(error.contains("range_noise = -0.01"));
    }
}
