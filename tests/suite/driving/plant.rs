//! The robot of these tests.

use trackdyn_core::Pose;
use trackdyn_drive::Rolling;
use trackdyn_model::{Icrs, Kinematics};

/// Auriga-alpha's ICRs as the paper prints them, m.
pub const AURIGA: Icrs = Icrs { x_left: -0.375, x_right: 0.457, y: 0.0492 };

/// A robot of these ICRs at the origin.
pub fn auriga() -> Rolling {
    Rolling::new(Kinematics::new(AURIGA), Pose::default())
}
