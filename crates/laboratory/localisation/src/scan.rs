//! One scan of a planar laser.

use crate::error::{Error, finite, positive};

/// Ranges at equal angles, in the frame of the sensor (x forward, y left).
///
/// The fields are those of ROS' `sensor_msgs/LaserScan`; as there, a range that is no finite number
/// is no return (REP-117).
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    stamp: f64,
    first_angle: f64,
    angle_step: f64,
    ranges: Vec<f64>,
}

/// A beam that came back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// Index of the beam, from 0.
    pub beam: usize,
    /// Its direction u = (cos, sin) in the sensor's frame.
    pub direction: [f64; 2],
    /// Its range ρ, m.
    pub range: f64,
}

impl Scan {
    /// A scan at `stamp` (s), its beam 0 at `first_angle`, the others `angle_step` apart
    /// counter-clockwise (rad), with ranges in m.
    ///
    /// # Errors
    /// [`Error::Value`] for a stamp or angle that is not finite, and a step that is not positive or
    /// leads beyond a full turn; [`Error::Range`] for a range that is zero or negative.
    pub fn new(
        stamp: f64,
        first_angle: f64,
        angle_step: f64,
        ranges: Vec<f64>,
    ) -> Result<Self, Error> {
        finite("stamp", stamp)?;
        finite("first_angle", first_angle)?;
        positive("angle_step", angle_step)?;
        check_turn(angle_step, ranges.len())?;
        let wrong = |range: &f64| range.is_finite() && *range <= 0.0;
        if let Some(beam) = ranges.iter().position(wrong) {
            return Err(Error::Range { beam, range: ranges[beam] });
        }
        Ok(Self { stamp, first_angle, angle_step, ranges })
    }

    /// Its time, s.
    pub fn stamp(&self) -> f64 {
        self.stamp
    }

    /// Bearing of beam 0, rad.
    pub fn first_angle(&self) -> f64 {
        self.first_angle
    }

    /// Bearing from one beam to the next, rad.
    pub fn angle_step(&self) -> f64 {
        self.angle_step
    }

    /// Range of each beam, m; no finite number where nothing came back.
    pub fn ranges(&self) -> &[f64] {
        &self.ranges
    }

    /// The beams that came back.
    pub fn returns(&self) -> impl Iterator<Item = Return> {
        let returned = |(beam, &range): (usize, &f64)| {
            let (sin, cos) = self.bearing(beam).sin_cos();
            range.is_finite().then_some(Return { beam, direction: [cos, sin], range })
        };
        self.ranges.iter().enumerate().filter_map(returned)
    }

    #[expect(clippy::cast_precision_loss, reason = "beams are few")]
    fn bearing(&self, beam: usize) -> f64 {
        self.first_angle + self.angle_step * beam as f64
    }
}

/// Beams must not lap: `count` of them must fit into a full turn.
#[expect(clippy::cast_precision_loss, reason = "beams are few")]
pub(crate) fn check_turn(angle_step: f64, count: usize) -> Result<(), Error> {
    if angle_step * count.saturating_sub(1) as f64 > std::f64::consts::TAU + 1e-9 {
        let expected = "a step in rad with which all beams fit into a full turn";
        return Err(Error::Value { name: "angle_step", value: angle_step, expected });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_no_return() {
        let ranges = vec![1.0, f64::NAN, f64::INFINITY, 2.0, f64::NEG_INFINITY];
        let scan = Scan::new(0.0, 0.0, 0.1, ranges).expect("a scan");
        let beams: Vec<usize> = scan.returns().map(|hit| hit.beam).collect();
        assert_eq!(beams, [0, 3]);
    }

    #[test]
    fn nonsense_is_refused() {
        let error =
            |step, ranges| Scan::new(0.0, 0.0, step, ranges).expect_err("refused").to_string();
        assert!(error(0.1, vec![1.0, -2.0]).contains("beam 1: range -2 m"));
        assert!(error(0.0, vec![1.0]).contains("angle_step = 0"));
        assert!(error(1.0, vec![1.0; 9]).contains("full turn"));
        assert!(Scan::new(f64::NAN, 0.0, 0.1, vec![]).is_err());
    }
}
