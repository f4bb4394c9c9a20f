//! What a diagnosis says.

mod corrected;
mod held_out;
mod steps;

pub use held_out::HeldOut;
pub use steps::{STAGES, diagnose};

pub(crate) use corrected::{correct, sure};

use crate::base::Base;
use crate::evidence::Evidence;
use crate::exposure::Exposure;
use crate::fit::Fit;
use crate::isolability::Isolability;
use crate::locate::Location;
use crate::locate::cells::Cell;
use crate::proposal::Proposal;
use crate::search::{Found, Screened};
use crate::uncertainty::{Interval, Level};
use crate::verdict::Verdict;
use nalgebra::Vector3;
use trackdyn_model::VehicleFile;
use trackdyn_model::effect::Symmetry;

/// How to diagnose.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Indices of runs that nothing is fitted or chosen on; empty: none are held out.
    pub held_out: Vec<usize>,
    /// Draws of the bootstrap.
    pub draws: usize,
    /// Seed of everything random.
    pub seed: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { held_out: Vec::new(), draws: 2000, seed: 1 }
    }
}

/// What a diagnosis says in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// What was left out is named.
    Explained,
    /// Nothing that this evidence could show was left out.
    NothingMissing,
    /// Something is missing that several effects explain alike.
    Ambiguous,
    /// Something is there that the catalogue does not explain.
    Unexplained,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Explained, Self::NothingMissing, Self::Ambiguous, Self::Unexplained];

    /// Its word in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::NothingMissing => "nothing-missing",
            Self::Ambiguous => "ambiguous",
            Self::Unexplained => "unexplained",
        }
    }
}

/// What kind of thing was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Physics of the robot on its ground.
    Physics,
    /// What encoders and pose sensor make of the motion.
    Instrument,
    /// A wrong number, or one of the effects that only move constant ICRs.
    Constant,
}

/// Something that was left out, with its sizes.
#[derive(Clone, Debug)]
pub struct Missing {
    /// What kind of thing it is.
    pub kind: Kind,
    /// The verdict.
    pub verdict: Verdict,
    /// Its parameters with intervals; empty where it stands for a class of constants.
    pub parameters: Vec<Interval>,
}

/// What is left of runs that nothing was fitted or chosen on.
#[derive(Clone)]
pub struct Unseen {
    /// What they show.
    pub evidence: Evidence,
    /// Whitened residuals before.
    pub before: Vec<Vector3<f64>>,
    /// After.
    pub after: Vec<Vector3<f64>>,
}

/// The smallest change of an effect's size that this evidence could have shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detectable {
    /// Place of the effect in the catalogue.
    pub effect: usize,
    /// Place of the size among its parameters.
    pub parameter: usize,
    /// How far the size would have to be off to stand out five standard deviations: from none, from the filed one where the vehicle file
    /// has the effect, from the fitted one where the best hypothesis adds it. None where no physical size would.
    pub size: Option<f64>,
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
    pub constants: Vec<usize>,
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
    pub evidence: Evidence,
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
