//! What a recording says whose poses have a yaw alone.

use super::sourced::Sourced;
use crate::Provenance;
use trackdyn_estimate::{Contradiction, Interval, Turning};
use trackdyn_model::kinematics::SeparationFile;

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
        Contradiction::of_efficiency(&efficiency).into_iter().collect()
    }

    /// The distance, unless something contradicts it.
    pub(super) fn separation(&self, provenance: &Provenance) -> Option<SeparationFile> {
        let Sourced { gauge, force, .. } = self.sourced;
        if !self.contradictions().is_empty() && !force {
            return None;
        }
        let Interval { value, low, high, .. } = self.found.separation.gap;
        Some(SeparationFile::new(value, [low, high], gauge, self.sourced.source(provenance)))
    }
}
