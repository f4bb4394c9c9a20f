//! Prediction errors on held-out runs.

use super::before;
use super::judged::Judged;
use crate::evidence::Evidence;
use crate::held_out::{HeldOut, Unseen, errors, judged as judged_on};
use crate::resampling::Resampling;

/// Prediction errors of the models before and after.
pub(super) struct Tested {
    /// Errors before and after.
    pub errors: HeldOut,
    /// Residuals of held-out runs; none where none were held out.
    pub unseen: Option<Unseen>,
}

impl Tested {
    /// Errors on held-out runs, or else on the fitted ones.
    pub fn of(judged: &Judged, unseen: Option<&Evidence>, resampling: Resampling) -> Self {
        let (seen, base) = (&judged.search.evidence, &judged.search.base);
        let fits = [before(base, &judged.missing), &base.fit, &judged.best.fit];
        match unseen {
            Some(unseen) => {
                let (errors, unseen) = judged_on(unseen, seen, fits, resampling);
                Self { errors, unseen: Some(unseen) }
            }
            None => Self { errors: errors(seen, fits, resampling), unseen: None },
        }
    }
}
