//! What a recording says whose poses have a yaw alone.

use super::sourced::Sourced;
use trackdyn_estimate::{Contradiction, Turning};

/// What a recording says whose poses have a yaw alone, as those of a gyroscope: the distance of the
/// ICRs.
#[derive(Clone, Debug)]
pub struct TurningFit {
    /// What was found.
    pub found: Turning,
    pub(super) sourced: Sourced,
}

impl TurningFit {
    /// What contradicts the distance.
    pub fn contradictions(&self) -> Vec<Contradiction> {
        let efficiency = self.found.separation.steering_efficiency(self.sourced.gauge);
        let following = self.found.response.as_ref().and_then(Contradiction::of_following);
        Contradiction::of_efficiency(&efficiency).into_iter().chain(following).collect()
    }
}
