//! The spin test: χ from turning on the spot, eq. (16).

use crate::error::Error;
use crate::observations::Observations;

/// Yaw that a spin test needs in all, rad: half a turn.
const NEEDED: f64 = std::f64::consts::PI;

/// Slower over faster track, in a spin, at least.
const BALANCE: f64 = 0.5;

/// Result of the spin test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinTest {
    /// Distance between the ICRs, x_r − x_l, m.
    pub gap: f64,
    /// χ = L/(x_r − x_l).
    pub steering_efficiency: f64,
    /// Segments that spin.
    pub segments: usize,
    /// Yaw in these, rad.
    pub yaw: f64,
}

/// Distance between the ICRs from the segments in which the tracks run against each other.
///
/// # Assumes
/// A symmetric vehicle: x_l = −x_r. Both senses of turning count.
///
/// # Errors
/// [`Error::NoSpin`] where they turn by less than half a turn in all.
pub fn spin_test(observations: &Observations, gauge: f64) -> Result<SpinTest, Error> {
    let (mut difference, mut yaw, mut segments) = (0.0, 0.0, 0);
    for segment in observations.segments() {
        let travelled = observations.travelled(segment);
        let (left, right) = (travelled.left, travelled.right);
        let against = left * right < 0.0;
        if against && left.abs().min(right.abs()) >= BALANCE * left.abs().max(right.abs()) {
            let sense = (right - left).signum();
            difference += sense * (right - left);
            yaw += sense * segment.motion[2];
            segments += 1;
        }
    }
    if yaw < NEEDED {
        return Err(Error::NoSpin { found_rad: yaw, needed_rad: NEEDED });
    }
    // χ = L φ / ∫ (V_r − V_l) dt, eq. (16)
    let gap = difference / yaw;
    Ok(SpinTest { gap, steering_efficiency: gauge / gap, segments, yaw })
}
