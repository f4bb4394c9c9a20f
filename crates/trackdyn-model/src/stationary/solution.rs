//! What a solve returns.

use super::{Linearised, Near};
use crate::icr::Icrs;
use trackdyn_core::{PerSide, Side, Twist};

/// A stationary motion, or why there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// What kind of motion it is; read it before the numbers.
    pub status: Status,
    /// Track speeds as the encoders show them, m/s.
    pub track_speed: PerSide<f64>,
    /// Speeds of the belts over the hull, m/s: the same, unless an effect acts between the two.
    pub belt_speed: PerSide<f64>,
    /// Twist of the hull, paper's frame.
    pub twist: Twist,
    /// The ICRs of the tracks by the speeds α V that odometry knows, which a belt that slips on its
    /// sprocket does not reach; none where one track holds the robot, or both do. At equal speeds
    /// of belts that do not slip they are the limit of a vanishing turn.
    pub icrs: Option<Icrs>,
    /// Norm of the sum of forces over the weight and moments over weight times gauge.
    pub residual: f64,
    /// Newton steps.
    pub iterations: usize,
    /// Where a search for what a similar model does at these speeds starts; none where no
    /// derivatives were found.
    pub linearised: Option<Linearised>,
}

impl Solution {
    /// Where the search for a motion that is nearly this one starts; none where none was found.
    pub fn near(&self) -> Option<Near> {
        match self.status {
            Status::Turning | Status::Straight => self.icrs.map(Near::Turning),
            Status::Holds(side) => Some(Near::Held(side)),
            Status::Lifts | Status::NotConverged => None,
        }
    }
}

/// Kind of stationary motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The robot turns, and both tracks slip about their ICRs.
    Turning,
    /// Both tracks stick, and the robot drives straight: the track speeds are equal, or belts that
    /// slip on their sprockets take up the difference.
    Straight,
    /// The track speeds differ, but this track holds the robot straight while the other one slips.
    Holds(Side),
    /// The forces balance only where part of the contact pulls: the patch lifts.
    Lifts,
    /// No balance was found.
    NotConverged,
}

impl Status {
    /// The kinds, in the order in which summaries list them.
    pub const NAMES: [&'static str; 5] = ["turning", "straight", "held", "lifts", "not converged"];

    /// Position in [`Status::NAMES`].
    pub fn index(self) -> usize {
        match self {
            Self::Turning => 0,
            Self::Straight => 1,
            Self::Holds(_) => 2,
            Self::Lifts => 3,
            Self::NotConverged => 4,
        }
    }
}
