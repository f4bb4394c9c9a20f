//! An examination of prepared recordings, for a comparison of two.

use super::Prepared;
use crate::{Error, Observer, Progress, Provenance};
use trackdyn_diagnose::Resampling;
use trackdyn_diagnose::diagnosis::{Examination, STAGES, examine};
use trackdyn_model::kinematics::Source;

impl Prepared {
    /// Diagnoses and keeps the search; parts are counted after `done` earlier ones of `total`.
    pub(crate) fn examined(
        &self,
        observer: &Observer,
        done: usize,
        total: usize,
    ) -> Result<Examination, Error> {
        let progress = |at: trackdyn_diagnose::Progress| {
            observer(Progress { stage: at.stage.name(), done: done + at.done, total })
        };
        let examined = examine(&self.evidence, self.vehicle.file(), &self.options, &progress);
        examined.map_err(|cause| self.failed(cause))
    }

    /// Parts of an examination.
    pub(crate) const PARTS: usize = STAGES;

    /// What was seen, as a source of a file.
    pub(crate) fn seen(&self, provenance: &Provenance) -> Source {
        let Resampling { draws, seed } = self.options.resampling;
        Source { draws: Some(draws), seed: Some(seed), ..self.source(provenance) }
    }

    /// Name of what was diagnosed.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }
}
