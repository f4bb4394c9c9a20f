//! Squares by dead reckoning: four sides, and four quarter turns on the spot.
//!
//! Odd runs turn right: an error of the turns and one of straightness show apart in the two
//! directions (Borenstein and Feng, IEEE Trans. Robotics and Automation 12(6), 1996, 869-880).

use super::ScheduleOptions;
use super::ramp::Ramp;
use std::f64::consts::FRAC_PI_2;
use trackdyn_core::{PerSide, Schedule};

/// Standing at each corner, s.
const REST_DURATION: f64 = 0.6;
/// Turns are driven at this share of the largest speed.
const TURN_SPEED_SHARE: f64 = 0.5;

/// One square, or squares until the duration where one is asked for.
pub(super) fn schedule(options: &ScheduleOptions, run: i64) -> Schedule {
    let direction = if run % 2 == 0 { 1.0 } else { -1.0 };
    // V_r − V_l = ω (x_r − x_l), eq. (9): each track runs half of the quarter turn's arc
    let arc = direction * FRAC_PI_2 * options.icr_distance / 2.0;
    let mut ramp = Ramp::new(options);
    ramp.hold(PerSide::default(), REST_DURATION);
    loop {
        for _ in 0..4 {
            ramp.travel(PerSide::new(options.side, options.side), options.fastest);
            ramp.hold(PerSide::default(), REST_DURATION);
            ramp.travel(PerSide::new(-arc, arc), TURN_SPEED_SHARE * options.fastest);
            ramp.hold(PerSide::default(), REST_DURATION);
        }
        if options.duration.is_none_or(|duration| ramp.time() >= duration) {
            return ramp.finish();
        }
    }
}
