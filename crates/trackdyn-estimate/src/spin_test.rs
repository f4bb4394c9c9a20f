//! The spin test: χ from turning on the spot, eq. (16).

use crate::error::Error;
use crate::observations::Observations;
use crate::{Blocks, Interval};
use std::f64::consts::PI;
use std::ops::Range;
use trackdyn_core::settings_group;

settings_group! {
    /// Which driving tells the distance of the ICRs by itself.
    Settings {
        /// Smallest total yaw.
        min_yaw: f64 = PI, "rad", [0.01, 1e4],
            "Half a turn.",
            "Lower: noise of the poses sets the distance.";
        /// Smallest ratio of the slower to the faster track.
        min_speed_ratio: f64 = 0.5, "", [0.0, 1.0],
            "Tracks never match exactly.",
            "Lower: turns count as spins.";
    }
}

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
    fn of(observations: &Observations, segments: Range<usize>, min_speed_ratio: f64) -> Self {
        let mut sums = Self::default();
        for segment in &observations.segments()[segments] {
            let travelled = observations.travelled(segment);
            let (left, right) = (travelled.left, travelled.right);
            let against = left * right < 0.0;
            if against
                && left.abs().min(right.abs()) >= min_speed_ratio * left.abs().max(right.abs())
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
/// [`Error::NoSpin`] where they turn too little in all.
pub fn spin_test(
    observations: &Observations,
    gauge: f64,
    settings: &Settings,
) -> Result<SpinTest, Error> {
    let &Settings { min_yaw, min_speed_ratio } = settings;
    let ranges = observations.ranges(&observations.blocks(Blocks::MIN_WHOLE_RUNS)).into_iter();
    let sums = |segments: Range<usize>| Sums::of(observations, segments, min_speed_ratio);
    let parts: Vec<Sums> = ranges.map(sums).collect();
    let Sums { difference, yaw, segments } = sums(0..observations.len());
    if yaw < min_yaw {
        return Err(Error::NoSpin { found_rad: yaw, needed_rad: min_yaw });
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
