//! Result of a diagnosis: the answer, its evidence, the models and the detection limits.

mod begun;
mod evidence;
mod judged;
mod limits;
mod located;
mod pipeline;
mod searched;
mod tested;

pub use crate::answer::{Kind, Missing, Status};
pub use crate::held_out::{HeldOut, Unseen};
pub use limits::Limits;
pub use pipeline::{Examination, STAGES, diagnose, examine};

use crate::base::Base;
use crate::drift::Drift;
use crate::exposure::Exposure;
use crate::fit::Fit;
use crate::locate::Location;
use crate::locate::cells::Cell;
use crate::proposal::Proposal;
use crate::resampling::Resampling;
use crate::search::Found;
use crate::uncertainty::{Interval, Level};
use crate::verdict::Verdict;
use crate::weighted::Weighted;
use std::sync::Arc;
use trackdyn_model::effect::{Card, Parameter, Role, Symmetry};
use trackdyn_model::{EffectId, VehicleFile};

/// Options of a diagnosis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Indices of held-out runs: nothing is fitted or chosen on them. Empty: none.
    pub held_out: Vec<usize>,
    /// Number of bootstrap draws, and the seed of all random numbers.
    pub resampling: Resampling,
    /// Laws of a user that are candidates beside the catalogue. Those that the vehicle file has
    /// are candidates anyway.
    pub laws: Vec<EffectId>,
}

/// Result of a diagnosis.
#[derive(Clone)]
pub struct Diagnosis {
    /// Status, claims and refusals.
    pub answer: Answer,
    /// Evidence, located departures and prediction errors.
    pub evidence: Examined,
    /// Base model and best hypothesis.
    pub models: Models,
    /// Detection limits, and which effects can be told apart.
    pub limits: Limits,
}

/// What the diagnosis concludes.
#[derive(Clone)]
pub struct Answer {
    /// Overall status.
    pub status: Status,
    /// Symmetries that the evidence breaks, ascending.
    pub broken: Vec<Symmetry>,
    /// Symmetries that the corrected model leaves broken by more than the form of its laws,
    /// ascending.
    pub left_over: Vec<Symmetry>,
    /// One sentence on where the model fails: channel, driving, symmetries.
    pub place: String,
    /// Claims: effects that the model lacks.
    pub missing: Vec<Missing>,
    /// Effects of the best hypothesis that are not claimed, with the reason.
    pub refused: Vec<Verdict>,
    /// Empirical law for what no effect explains; none where nothing is left or no law fits.
    pub proposed: Option<Proposal>,
    /// The vehicle file with the claims, corrected.
    pub corrected: VehicleFile,
}

/// Evidence of a diagnosis, with the residuals before and after.
#[derive(Clone)]
pub struct Examined {
    /// Evidence of the fitted runs, with its final noise.
    pub seen: Weighted,
    /// Held-out runs; none where none were held out.
    pub unseen: Option<Unseen>,
    /// Departures from the vehicle as filed, with only constant ICRs fitted.
    pub filed: Location,
    /// Departures from the base.
    pub before: Location,
    /// Departures from the corrected model.
    pub after: Location,
    /// ICRs by cells of driving, before and after.
    pub cells: [Vec<Cell>; 2],
    /// Claimed effects, or else the best candidate, against the evidence: series for figures.
    pub exposures: Vec<Exposure>,
    /// Prediction errors before and after, on held-out runs where there are any.
    pub errors: HeldOut,
    /// Drift of dead reckoning before and after, on the same runs.
    pub drift: Drift,
}

/// Models before and after the diagnosis.
#[derive(Clone)]
pub struct Models {
    /// The base: the vehicle as filed, with constant ICRs and instruments fitted.
    pub base: Arc<Base>,
    /// The best hypothesis, reduced to what is claimed and refitted.
    pub best: Found,
    /// Its friction level with an interval; none where friction is not free.
    pub friction_level: Option<Level>,
}

/// Whether encoders or pose sensor are among the claims.
fn blame_instruments(missing: &[Missing]) -> bool {
    missing.iter().any(|missing| missing.kind == Kind::Instrument)
}

/// The model before: a claimed instrument is part of what was missing, so it is not fitted in it.
fn before<'a>(base: &'a Base, missing: &[Missing]) -> &'a Fit {
    if blame_instruments(missing) { &base.as_filed } else { &base.fit }
}

/// The status, by the symmetries left broken and the claims.
fn status(left_over: &[Symmetry], missing: &[Missing]) -> Status {
    if !left_over.is_empty() {
        Status::Unexplained
    } else if missing.iter().any(|missing| missing.verdict.one_of.len() > 1) {
        Status::Ambiguous
    } else if missing.is_empty() {
        Status::NothingMissing
    } else {
        Status::Explained
    }
}

impl Diagnosis {
    /// Whether encoders or pose sensor are among the claims: the model before then keeps them as
    /// filed.
    pub fn blames_instruments(&self) -> bool {
        blame_instruments(&self.answer.missing)
    }

    /// Factor of the vehicle file's friction that inertia shows, and its 95 % interval; none where
    /// no inertial effect is claimed alone, or its strength may be that of the file.
    ///
    /// Inertia is felt in units of friction: k m over μ is m over μ/k.
    pub fn friction_by_inertia(&self) -> Option<[f64; 3]> {
        let alone = self.answer.missing.iter().filter(|missing| missing.verdict.one_of.len() == 1);
        let sizes = alone.flat_map(|missing| &missing.parameters).filter(|size| {
            let is_inertia = size.unknown.card().is_some_and(Card::is_inertia);
            let is_size = |parameter: &Parameter| matches!(parameter.role, Role::Size { .. });
            is_inertia && size.unknown.parameter().is_some_and(is_size)
        });
        let width = |size: &&Interval| (size.high - size.low) / size.value;
        let size = sizes.min_by(|a, b| width(a).total_cmp(&width(b)))?;
        let is_other = size.low > 1.0 || size.high < 1.0;
        is_other.then(|| [size.value, size.high, size.low].map(f64::recip))
    }

    /// A sentence where held-out runs contradict the claims; none where the corrected model
    /// predicts them better.
    pub fn contradiction(&self) -> Option<String> {
        let claims = |kind: Kind| self.answer.missing.iter().any(|missing| missing.kind == kind);
        // constants are fitted in the model before, too
        let [physics, instruments] = [Kind::Physics, Kind::Instrument].map(claims);
        self.evidence.errors.contradiction(physics || instruments, physics)
    }

    /// The fit before: the vehicle as filed where an instrument is claimed, else with instruments
    /// fitted.
    pub fn fit_before(&self) -> &Fit {
        before(&self.models.base, &self.answer.missing)
    }
}
