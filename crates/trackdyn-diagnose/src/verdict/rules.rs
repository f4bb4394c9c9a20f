//! What a claim must reach.

use crate::base::Base;
use crate::search::Found;
use crate::weighted::Weighted;
use trackdyn_core::real;

/// What a claim must reach.
pub struct Rules;

impl Rules {
    /// Family-wise probability of chance.
    pub const P: f64 = 0.01;
    /// Logarithm of the Bayes factor against the best hypothesis without the effect.
    pub const LN_BAYES_FACTOR: f64 = 5.0;
    /// Gain on blocks that were held out, in its standard errors.
    pub const GAIN: f64 = 2.0;
    /// Blocks of time below which what they show may have happened once: two may meet in one event.
    pub const ONCE: f64 = 3.0;
    /// Share of resampled recordings that name the same.
    pub const STABLE: f64 = 0.9;
    /// Log-likelihood within which two hypotheses are one answer.
    pub const SAME: f64 = 3.0;
    /// Separation, in standard deviations, below which two effects are one answer.
    pub const ISOLATED: f64 = 3.0;
    /// Part of the whole departure that an effect must explain beside others: a law is known to about a tenth
    /// of what it does, and what it leaves is not another effect.
    pub const FORM: f64 = 0.1;
    /// Part of the gauge by which constant ICRs must differ from those of the vehicle file to be a wrong number:
    /// shoes, tyres and their pressure are known no better.
    pub const CONSTANT: f64 = 0.01;
    /// Part of the noise that may be left in one symmetry, in squares: no simulator equals the ground to all digits.
    pub const LEFT: f64 = 0.01;
    /// Part of the whole departure that the forms of the named laws may leave in one symmetry.
    pub const FORM_LEFT: f64 = 0.2;

    /// χ² that may be left in one symmetry beside a hypothesis: a part of what its laws took away, and of the noise.
    pub fn tolerated(evidence: &Weighted, base: &Base, best: &Found) -> f64 {
        let whole = (base.fit.objective - best.fit.objective).max(0.0);
        Self::FORM_LEFT * Self::FORM_LEFT * whole + Self::LEFT * real(evidence.measured())
    }
}
