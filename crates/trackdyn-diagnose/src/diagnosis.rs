//! What a diagnosis says: the answer, the evidence for it, the models, and the limits of it.

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
pub use pipeline::{STAGES, diagnose};

use crate::base::Base;
use crate::exposure::Exposure;
use crate::fit::Fit;
use crate::locate::Location;
use crate::locate::cells::Cell;
use crate::proposal::Proposal;
use crate::resampling::Resampling;
use crate::search::Found;
use crate::uncertainty::Level;
use crate::verdict::Verdict;
use crate::weighted::Weighted;
use std::sync::Arc;
use trackdyn_model::VehicleFile;
use trackdyn_model::effect::Symmetry;

/// How to diagnose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Indices of runs that nothing is fitted or chosen on; empty: none are held out.
    pub held_out: Vec<usize>,
    /// Draws of the bootstrap, and the seed of everything random.
    pub resampling: Resampling,
}

/// The outcome.
#[derive(Clone)]
pub struct Diagnosis {
    /// What is said.
    pub answer: Answer,
    /// What it was learned from, and what is left of that.
    pub evidence: Examined,
    /// The models before and after.
    pub models: Models,
    /// What this evidence could have shown.
    pub limits: Limits,
}

/// What is said.
#[derive(Clone)]
pub struct Answer {
    /// In a word.
    pub status: Status,
    /// Symmetries that the evidence breaks.
    pub broken: Vec<Symmetry>,
    /// One sentence: channel, driving, symmetries.
    pub place: String,
    /// What was left out.
    pub missing: Vec<Missing>,
    /// Effects of the best hypothesis that are not claimed, and why.
    pub refused: Vec<Verdict>,
    /// A law for what no effect explains, where something is left and one was found.
    pub proposed: Option<Proposal>,
    /// The vehicle that explains the evidence.
    pub corrected: VehicleFile,
}

/// What a diagnosis was learned from, and what is left of it.
#[derive(Clone)]
pub struct Examined {
    /// The evidence of the fit, with the noise that its residuals show.
    pub seen: Weighted,
    /// What is left of held-out runs; none where none were.
    pub unseen: Option<Unseen>,
    /// Where the evidence departs from the vehicle as filed with nothing fitted but constant ICRs.
    pub filed: Location,
    /// Where it departs from the base.
    pub before: Location,
    /// Where it departs from the corrected model.
    pub after: Location,
    /// ICRs in cells of driving, before and after.
    pub cells: [Vec<Cell>; 2],
    /// The claimed effects, or else the best candidate, against the evidence.
    pub exposures: Vec<Exposure>,
    /// Errors before and after, on held-out runs where there are any.
    pub errors: HeldOut,
}

/// The models before and after.
#[derive(Clone)]
pub struct Models {
    /// The base: as filed with constants, and with instruments.
    pub base: Arc<Base>,
    /// The best hypothesis, refitted to what is claimed.
    pub best: Found,
    /// The level of friction in it; none where it is not free.
    pub friction_level: Option<Level>,
}

/// Whether encoders or pose sensor are to blame for something.
fn blame_instruments(missing: &[Missing]) -> bool {
    missing.iter().any(|missing| missing.kind == Kind::Instrument)
}

/// What was there before: an instrument that is claimed is part of what was missing.
fn before<'a>(base: &'a Base, missing: &[Missing]) -> &'a Fit {
    if blame_instruments(missing) { &base.as_filed } else { &base.fit }
}

/// The answer in a word, by the symmetries that are left over and what is claimed.
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
    /// Whether encoders or pose sensor are to blame for something: they are then not part of what
    /// was before.
    pub fn blames_instruments(&self) -> bool {
        blame_instruments(&self.answer.missing)
    }

    /// What held-out runs say against what is claimed, as a sentence; none where the corrected
    /// model does better there.
    pub fn contradiction(&self) -> Option<String> {
        let claims = |kind: Kind| self.answer.missing.iter().any(|missing| missing.kind == kind);
        // constants are fitted in what was there before too
        let [physics, instruments] = [Kind::Physics, Kind::Instrument].map(claims);
        self.evidence.errors.contradiction(physics || instruments, physics)
    }

    /// The fit of what was there before: of the vehicle as filed where encoders or pose sensor are
    /// to blame for something, else with these at their best.
    pub fn fit_before(&self) -> &Fit {
        before(&self.models.base, &self.answer.missing)
    }
}
