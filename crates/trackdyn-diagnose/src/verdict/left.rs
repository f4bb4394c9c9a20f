//! Tolerated rest of a departure beside a corrected model.

use crate::base::Base;
use crate::search::Found;
use crate::weighted::Weighted;
use trackdyn_core::real;

/// Chi-squared that may remain in one symmetry beside a hypothesis: a share of the decrease by its
/// laws, and a share of the noise.
pub fn tolerated(evidence: &Weighted, base: &Base, best: &Found) -> f64 {
    let settings = &evidence.settings().location;
    let whole = (base.fit.objective - best.fit.objective).max(0.0);
    let form = settings.max_form_left * settings.max_form_left * whole;
    form + settings.max_noise_left * real(evidence.measured())
}
