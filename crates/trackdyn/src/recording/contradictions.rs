//! What contradicts itself within a recording.

use super::Recording;
use crate::{Error, Gauge};
use trackdyn_estimate::Contradiction;
use trackdyn_estimate::identification::{Options, contradictions};

impl Recording {
    /// What contradicts constant ICRs between the tracks of a vehicle, be it a `&Vehicle` or a
    /// gauge, as [`identify`](crate::identify()) finds it: poses that are computed from the tracks,
    /// or units that are mixed up. Empty where it has too little in it to tell, and of a table of
    /// steady points. `tau` is the time by which poses lag behind the track speeds, s, where it is
    /// known.
    pub fn contradictions(
        &self,
        vehicle: impl Into<Gauge>,
        tau: Option<f64>,
    ) -> Vec<Contradiction> {
        self.contradicted(&Options { tau, ..Options::new(vehicle.into().metres()) })
    }

    fn contradicted(&self, options: &Options) -> Vec<Contradiction> {
        let motion = self.motion().filter(|motion| motion.has_positions());
        motion.map_or(Vec::new(), |motion| contradictions(motion, options).unwrap_or_default())
    }

    /// These [contradictions](Self::contradictions), for a use that needs poses of something else
    /// than the tracks.
    ///
    /// # Errors
    /// [`Error::NoReference`].
    pub(crate) fn expect_reference(&self, options: &Options) -> Result<Vec<Contradiction>, Error> {
        let found = self.contradicted(options);
        let is_computed = |of: &&Contradiction| matches!(of, Contradiction::WheelOdometry { .. });
        match found.iter().find(is_computed) {
            Some(cause) => Err(Error::NoReference { recording: self.place(), cause: *cause }),
            None => Ok(found),
        }
    }
}
