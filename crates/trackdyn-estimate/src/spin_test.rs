//! The spin test: χ from turning on the spot, eq. (16).

use crate::Interval;
use crate::error::Error;
use crate::observations::Observations;
use std::ops::Range;

/// Smallest yaw of a spin test in all, rad: half a turn.
const MIN_YAW: f64 = std::f64::consts::PI;

/// Smallest ratio of the slower to the faster track in a spin.
const MIN_SPEED_RATIO: f64 = 0.5;

/// Result of the spin test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinTest {
    /// Distance between the ICRs, x_r − x_l, m.
    pub gap: f64,
    /// Its interval, from the scatter between blocks; none where fewer than two of them spin.
    pub interval: Option<Interval>,
    /// χ = L/(x_r − x_l).
    pub steering_efficiency: f64,
    /// Segments that spin.
    pub segments: usize,
    /// Yaw in these, rad.
    pub yaw: f64,
}

/// What segments that spin add up to.
#[derive(Clone, Copy, Default)]
struct Sums {
    /// ∫ |V_r − V_l| dt, m.
    difference: f64,
    /// |φ|, rad.
    yaw: f64,
    segments: usize,
}

impl Sums {
    fn of(observations: &Observations, segments: Range<usize>) -> Self {
        let mut sums = Self::default();
        for segment in &observations.segments()[segments] {
            let travelled = observations.travelled(segment);
            let (left, right) = (travelled.left, travelled.right);
            let against = left * right < 0.0;
            if against
                && left.abs().min(right.abs()) >= MIN_SPEED_RATIO * left.abs().max(right.abs())
            {
                let sense = (right - left).signum();
                sums.difference += sense * (right - left);
                sums.yaw += sense * segment.motion[2];
                sums.segments += 1;
            }
        }
        sums
    }
}

/// Distance between the ICRs from the segments in which the tracks run against each other.
///
/// # Assumes
/// A symmetric vehicle: x_l = −x_r. Both senses of turning count.
///
/// # Errors
/// [`Error::NoSpin`] where they turn by less than half a turn in all.
pub fn spin_test(observations: &Observations, gauge: f64) -> Result<SpinTest, Error> {
    let ranges = observations.ranges(&observations.blocks());
    let parts: Vec<Sums> =
        ranges.into_iter().map(|segments| Sums::of(observations, segments)).collect();
    let Sums { difference, yaw, segments } = Sums::of(observations, 0..observations.len());
    if yaw < MIN_YAW {
        return Err(Error::NoSpin { found_rad: yaw, needed_rad: MIN_YAW });
    }
    // χ = L φ / ∫ (V_r − V_l) dt, eq. (16)
    let gap = difference / yaw;
    let without: Vec<f64> = parts
        .iter()
        .filter(|part| part.segments > 0)
        .map(|part| (difference - part.difference) / (yaw - part.yaw))
        .collect();
    let interval = Interval::of_jackknife(gap, &without);
    Ok(SpinTest { gap, interval, steering_efficiency: gauge / gap, segments, yaw })
}
