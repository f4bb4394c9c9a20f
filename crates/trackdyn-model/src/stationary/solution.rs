//! Result of a stationary solve.

use super::{Linearised, Near};
use crate::icr::Icrs;
use trackdyn_core::{PerSide, Side, Twist};

/// A stationary motion, or the failure to find one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Kind of motion; check it first.
    pub status: Status,
    /// Encoder speeds of the tracks, m/s.
    pub track_speed: PerSide<f64>,
    /// Belt speeds relative to the hull, m/s: equal to the encoders' unless an effect acts in
    /// between.
    pub belt_speed: PerSide<f64>,
    /// Twist of the hull, paper's frame.
    pub twist: Twist,
    /// ICRs of the tracks for the speeds α V known to odometry, which a slipping belt does not
    /// reach; none where one or both tracks hold the robot. For equal speeds of belts that do not
    /// slip, the limit of a vanishing turn.
    pub icrs: Option<Icrs>,
    /// Norm of force over weight and moment over weight times gauge.
    pub residual: f64,
    /// Whether part of the contact has lifted, and the rest bears the load.
    pub is_lifted: bool,
    /// Number of Newton steps.
    pub iterations: usize,
    /// Start for a solve of a similar model at these speeds; none without an inverse Jacobian.
    pub linearised: Option<Linearised>,
}

impl Solution {
    /// Start for a solve of a similar motion; none without one.
    pub fn near(&self) -> Option<Near> {
        match self.status {
            Status::Turning | Status::Straight => self.icrs.map(Near::Turning),
            Status::Holds(side) => Some(Near::Held(side)),
            Status::Tips | Status::NotConverged => None,
        }
    }
}

/// Kind of stationary motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The robot turns, and both tracks slip.
    Turning,
    /// Both tracks stick, and the robot drives straight: the track speeds are equal, or slip of
    /// belts on sprockets takes up the difference.
    Straight,
    /// The track speeds differ, but this track holds the robot straight while the other slips.
    Holds(Side),
    /// The load lies outside the contact: the robot tips over.
    Tips,
    /// No balance was found.
    NotConverged,
}

impl Status {
    /// Names of the kinds, in the order of summaries.
    pub const NAMES: [&'static str; 5] = ["turning", "straight", "held", "tips", "not converged"];

    /// Index in [`Status::NAMES`].
    pub fn index(self) -> usize {
        match self {
            Self::Turning => 0,
            Self::Straight => 1,
            Self::Holds(_) => 2,
            Self::Tips => 3,
            Self::NotConverged => 4,
        }
    }
}
