//! What a diagnosis says.

mod steps;

pub use crate::answer::{Kind, Missing, Status};
pub use crate::held_out::{HeldOut, Unseen};
pub use steps::{STAGES, diagnose};

use crate::base::Base;
use crate::exposure::Exposure;
use crate::fit::Fit;
use crate::isolability::{Detectable, Isolability};
use crate::locate::Location;
use crate::locate::cells::Cell;
use crate::proposal::Proposal;
use crate::resampling::Resampling;
use crate::search::{Found, Screened};
use crate::uncertainty::Level;
use crate::verdict::Verdict;
use crate::weighted::Weighted;
use trackdyn_model::EffectId;
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
    /// In a word.
    pub status: Status,
    /// Where the base departs from the evidence.
    pub before: Location,
    /// The same of the corrected model.
    pub after: Location,
    /// The same of the vehicle as filed with nothing fitted but constant ICRs.
    pub filed: Location,
    /// Symmetries that the evidence breaks.
    pub broken: Vec<Symmetry>,
    /// One sentence: channel, driving, symmetries.
    pub place: String,
    /// What was left out.
    pub missing: Vec<Missing>,
    /// Effects of the best hypothesis that are not claimed, and why.
    pub refused: Vec<Verdict>,
    /// All candidates beside the base, best first.
    pub screened: Vec<Screened>,
    /// The same beside the corrected model.
    pub left: Vec<Screened>,
    /// Effects that only move constant ICRs.
    pub constants: Vec<EffectId>,
    /// What this evidence can tell apart, of all candidates beside the base, what is claimed among them.
    pub resemblance: Isolability,
    /// The claimed effects, or else the best candidate, against the evidence.
    pub exposures: Vec<Exposure>,
    /// Smallest sizes that would have shown.
    pub detectable: Vec<Detectable>,
    /// Errors before and after.
    pub held_out: HeldOut,
    /// What is left of held-out runs; none where none were.
    pub unseen: Option<Unseen>,
    /// ICRs in cells of driving, before and after.
    pub cells: [Vec<Cell>; 2],
    /// The base: as filed with constants, and with instruments.
    pub base: Base,
    /// The best hypothesis, refitted to what is claimed.
    pub best: Found,
    /// The level of friction in it; none where it is not free.
    pub friction_level: Option<Level>,
    /// The evidence of the fit, with the noise that its residuals show.
    pub evidence: Weighted,
    /// The vehicle that explains the evidence.
    pub corrected: VehicleFile,
    /// A law for what no effect explains, where something is left and one was found.
    pub proposed: Option<Proposal>,
}

/// Whether encoders or pose sensor are to blame for something.
fn blame_instruments(missing: &[Missing]) -> bool {
    missing.iter().any(|missing| missing.kind == Kind::Instrument)
}

/// What was there before: an instrument that is claimed is part of what was missing.
fn before<'a>(base: &'a Base, missing: &[Missing]) -> &'a Fit {
    if blame_instruments(missing) { &base.as_filed } else { &base.fit }
}

impl Diagnosis {
    /// Whether encoders or pose sensor are to blame for something: they are then not part of what was before.
    pub fn blames_instruments(&self) -> bool {
        blame_instruments(&self.missing)
    }

    /// What held-out runs say against what is claimed, as a sentence; none where the corrected model does better there.
    pub fn contradiction(&self) -> Option<String> {
        let claims = |kind: Kind| self.missing.iter().any(|missing| missing.kind == kind);
        // constants are fitted in what was there before too
        let [physics, instruments] = [Kind::Physics, Kind::Instrument].map(claims);
        self.held_out.contradiction(physics || instruments, physics)
    }

    /// The fit of what was there before: of the vehicle as filed where encoders or pose sensor are to blame for
    /// something, else with these at their best.
    pub fn fit_before(&self) -> &Fit {
        before(&self.base, &self.missing)
    }
}
