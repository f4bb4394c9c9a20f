//! Prediction errors before and after, on held-out runs where there are any.

use crate::evidence::Evidence;
use crate::fit::Fit;
use crate::form::Forms;
use crate::locate::{Residual, excess, icr_columns};
use crate::noise::without_outliers;
use crate::resampling::Resampling;
use crate::starts::with_own_starts;
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_core::real;

/// Residuals of held-out runs, on which nothing was fitted or chosen.
#[derive(Clone)]
pub struct Unseen {
    /// Evidence of these runs.
    pub evidence: Weighted,
    /// Whitened residuals of the model before.
    pub before: Vec<Vector3<f64>>,
    /// Whitened residuals of the corrected model.
    pub after: Vec<Vector3<f64>>,
}

/// Prediction errors: weighted rms of the whitened residuals, in units of the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldOut {
    /// Error of the model before.
    pub before: f64,
    /// Error of the base: with constants, encoders and pose sensor fitted.
    pub instruments: f64,
    /// Error of the corrected model.
    pub after: f64,
    /// Noise floor: error that remains when all contrasts of the ICRs and the instruments are
    /// fitted.
    pub noise_floor: f64,
    /// Whether the runs were held out; otherwise they are those of the fit.
    pub are_held_out: bool,
}

impl HeldOut {
    /// A sentence where held-out runs contradict claims other than constants; none where the
    /// corrected model predicts better than the models without them.
    pub(crate) fn contradiction(&self, claims: bool, claims_physics: bool) -> Option<String> {
        let Self { before, instruments, after, are_held_out, .. } = *self;
        if !are_held_out {
            None
        } else if claims && after >= before {
            Some(format!(
                "What is claimed does not help there: the error is {after:.3} with it and \
                 {before:.3} without. It may be true of what it was learned from alone: drive on \
                 without it."
            ))
        } else if claims_physics && after >= instruments {
            Some(format!(
                "The physics that is claimed does not help there: the error is {after:.3} with it \
                 and {instruments:.3} with encoders, pose sensor and constants at their best \
                 alone. It may be true of what it was learned from alone."
            ))
        } else {
            None
        }
    }

    /// Share of the squared excess over the noise floor that the corrected model explains; none
    /// where there is no excess.
    pub fn excess_explained(&self) -> Option<f64> {
        /// Smallest excess of which there is a share, in the squared noise floor: a guard against
        /// a ratio of nothing to nothing.
        const MIN_EXCESS: f64 = 1e-3;
        let excess = self.before.powi(2) - self.noise_floor.powi(2);
        (excess > MIN_EXCESS * self.noise_floor.powi(2))
            .then(|| (self.before.powi(2) - self.after.powi(2)) / excess)
    }
}

/// Errors of three fits on their own evidence.
pub(crate) fn errors(
    evidence: &Weighted,
    [before, instruments, after]: [&Fit; 3],
    resampling: Resampling,
) -> HeldOut {
    let [before, instruments, error] =
        [before, instruments, after].map(|fit| excess(evidence, &fit.residual));
    let icrs = icr_columns(evidence, after);
    let residual = Residual { evidence, fit: after, forms: &Forms::default(), icrs: &icrs };
    let flexible = residual.locate(resampling.once());
    let count = real(evidence.measured().max(1));
    let floor = error * error - flexible.explicable.max(0.0) / count;
    let noise_floor = floor.max(0.0).sqrt().min(error);
    HeldOut { before, instruments, after: error, noise_floor, are_held_out: false }
}

/// Errors of three fits (model before, base, best hypothesis) on held-out runs, weighed with the
/// noise of `seen`.
pub(crate) fn judged(
    unseen: &Evidence,
    seen: &Weighted,
    [before, instruments, best]: [&Fit; 3],
    resampling: Resampling,
) -> (HeldOut, Unseen) {
    let unseen = seen.weigh(unseen);
    // Where runs begin in a motion of their own, so do these.
    let own = seen.starts().and_then(|_| with_own_starts(&unseen, &best.hypothesis));
    let unseen = own.unwrap_or(unseen);
    let there = best.on(&unseen);
    let unseen = unseen.moving_as(&there.prediction(&unseen));
    let evidence = without_outliers(&unseen, &there);
    let [before, instruments, after] = [before, instruments, best].map(|fit| fit.on(&evidence));
    let errors = errors(&evidence, [&before, &instruments, &after], resampling);
    let (before, after) = (before.residual, after.residual);
    (HeldOut { are_held_out: true, ..errors }, Unseen { evidence, before, after })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_out_runs_contradict_what_does_no_better_than_what_was_there_before() {
        let errors = |before, instruments, after| HeldOut {
            before,
            instruments,
            after,
            noise_floor: 1.0,
            are_held_out: true,
        };
        assert_eq!(errors(1.5, 1.3, 1.1).contradiction(true, true), None);
        let filed = errors(1.2, 1.3, 1.25).contradiction(true, true).expect("the file does better");
        assert!(filed.contains("1.250 with it and 1.200 without"), "{filed}");
        // instruments explain the errors, and the claimed physics makes them worse
        let physics =
            errors(3.0, 1.1, 1.2).contradiction(true, true).expect("instruments do better");
        assert!(physics.contains("1.200 with it and 1.100 with encoders"), "{physics}");
        assert_eq!(errors(3.0, 1.1, 1.2).contradiction(true, false), None);
        assert_eq!(errors(1.1, 1.1, 1.1).contradiction(false, false), None);
        let fitted = HeldOut { are_held_out: false, ..errors(1.2, 1.3, 1.25) };
        assert_eq!(fitted.contradiction(true, true), None);
    }
}
