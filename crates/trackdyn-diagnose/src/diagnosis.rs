//! The diagnosis: all steps in order, and what comes out of them.

use crate::base::{Base, correct_constants};
use crate::candidate::{Beside, candidates};
use crate::error::Error;
use crate::evidence::{Evidence, FEWEST};
use crate::exposure::Exposure;
use crate::fit::Fit;
use crate::hypothesis::with_friction;
use crate::isolability::Isolability;
use crate::locate::cells::{Cell, cells};
use crate::locate::{Location, Residual, excess, icr_columns};
use crate::noise::{sharper, with_remaining_noise, without_outliers};
use crate::proposal::{Proposal, completed};
use crate::search::{Catalogue, Found, Screened, Search};
use crate::uncertainty::{Interval, Level, Uncertainty};
use crate::verdict::{
    Constants, Rules, Verdict, judge, judge_constants, judge_instruments, refuse_unsure,
};
use nalgebra::Vector3;
use std::collections::BTreeSet;
use trackdyn_core::real;
use trackdyn_physics::VehicleFile;
use trackdyn_physics::effect::Symmetry;

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

/// Errors on runs that were held out, in units of the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldOut {
    /// Root mean square of the whitened residual before.
    pub before: f64,
    /// With nothing but the base fitted: constants, encoders and pose sensor.
    pub instruments: f64,
    /// After.
    pub after: f64,
    /// What is left when everything that moves ICRs or instruments, model or not, is fitted away.
    pub noise_floor: f64,
    /// Whether the runs really were held out; else these are the runs of the fit.
    pub are_held_out: bool,
}

impl HeldOut {
    /// What these errors say against what is claimed, anything at all or physics too; none where that does better than
    /// what it was compared with.
    fn contradiction(&self, claims: bool, claims_physics: bool) -> Option<String> {
        let Self { before, instruments, after, are_held_out, .. } = *self;
        if !are_held_out {
            None
        } else if claims && after >= before {
            Some(format!(
                "What is claimed does not help there: the error is {after:.3} with it and {before:.3} without. It may be true \
                 of the other runs alone, and the vehicle as filed is the one to drive on with."
            ))
        } else if claims_physics && after >= instruments {
            Some(format!(
                "The physics that is claimed does not help there: the error is {after:.3} with it and {instruments:.3} with \
                 encoders, pose sensor and constants at their best alone. It may be true of the other runs only."
            ))
        } else {
            None
        }
    }

    /// Share of the excess over the noise floor that the corrected model explains; none where there is no
    /// excess.
    pub fn excess_explained(&self) -> Option<f64> {
        let excess = self.before.powi(2) - self.noise_floor.powi(2);
        (excess > 1e-3 * self.noise_floor.powi(2))
            .then(|| (self.before.powi(2) - self.after.powi(2)) / excess)
    }
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

/// The smallest size of an effect that this evidence could have shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detectable {
    /// Place of the effect in the catalogue.
    pub effect: usize,
    /// Place of the size among its parameters.
    pub parameter: usize,
    /// Distance of the size from none at which it would stand out five standard deviations; none where no
    /// physical size would.
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
    /// What this evidence can tell apart.
    pub isolability: Isolability,
    /// The same of all candidates beside the base, what is claimed among them.
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

/// Stages that progress is reported of.
pub const STAGES: [&str; 6] = ["base", "location", "signatures", "search", "verdicts", "limits"];

/// Diagnoses evidence. `progress` is told of each finished stage.
///
/// # Errors
/// Evidence without turning, or a vehicle that cannot move so.
pub fn diagnose(
    evidence: &Evidence,
    file: &VehicleFile,
    options: &Options,
    progress: &dyn Fn(&'static str),
) -> Result<Diagnosis, Error> {
    let held_out: Vec<bool> =
        (0..evidence.runs().len()).map(|run| options.held_out.contains(&run)).collect();
    let seen: Vec<bool> = held_out.iter().map(|held_out| !held_out).collect();
    let (mut unseen, mut evidence) = (evidence.of_runs(&held_out), evidence.of_runs(&seen));
    let found = evidence.samples().len();
    if found < FEWEST && !evidence.is_steady() {
        return Err(Error::TooFewSegments { found, needed: FEWEST });
    }
    let base = Base::new(file, &evidence);
    if let Some(reason) = base.as_filed.mechanics.failure() {
        return Err(Error::NoMotion(reason));
    }
    if !turns(&base.as_filed) {
        return Err(Error::NoTurning);
    }
    evidence = with_remaining_noise(&evidence, &base.fit);
    // Late stamps and ticks are noise that a lag of the drive would smooth: readings without them stand, unless they
    // explain less.
    let steps = evidence.steps();
    let between_ticks = |evidence: &Evidence| evidence.with_speeds_between_ticks(steps);
    let cleanings: [&dyn Fn(&Evidence) -> Evidence; 2] =
        [&Evidence::with_regular_stamps, &between_ticks];
    for cleaned in cleanings {
        let base = base.refitted(&evidence);
        let tried = cleaned(&evidence);
        let again = base.refitted(&tried);
        if again.fit.objective < base.fit.objective + CLEANED {
            evidence = with_remaining_noise(&tried, &again.fit);
            unseen = cleaned(&unseen);
        }
    }
    loop {
        let base = base.refitted(&evidence);
        progress(STAGES[0]);
        let mut attempt = attempt(&evidence, file, options, base, true, progress);
        evidence = attempt.evidence.clone();
        let scale = evidence.residual_scale(&attempt.best.fit.residual);
        // Residuals larger than the noise that no effect explains make every other claim less sure.
        let grows = scale.iter().any(|scale| *scale > TOLERATED);
        if !grows || evidence.scale() != [1.0; 3] {
            if !options.held_out.is_empty() {
                attempt.judge_on(&unseen, options);
            }
            return Ok(completed(attempt, options));
        }
        evidence = evidence.with_scale(scale.map(|scale| scale.max(1.0)));
    }
}

/// By how much readings without stamps that jitter, or without ticks, may raise twice the misfit by chance.
const CLEANED: f64 = 4.0;

/// Residuals may be this much larger than the noise before the noise is taken to be larger.
const TOLERATED: f64 = 1.1;

fn attempt(
    evidence: &Evidence,
    file: &VehicleFile,
    options: &Options,
    base: Base,
    is_first: bool,
    progress: &dyn Fn(&'static str),
) -> Diagnosis {
    let Options { draws, seed, .. } = *options;
    let of_base = icr_columns(evidence, &base.fit);
    let of_filed = icr_columns(evidence, &base.as_filed);
    let as_filed = Residual { evidence, fit: &base.as_filed, icrs: &of_filed };
    let filed = as_filed.locate(draws, seed);
    let of_fit = Residual { evidence, fit: &base.fit, icrs: &of_base };
    let located = of_fit.locate(draws, seed);
    progress(STAGES[1]);

    let tried = candidates(&base.instruments, evidence);
    let hypothesis = &base.fit.hypothesis;
    let beside = Beside::new(hypothesis, evidence);
    let mut catalogue = Catalogue { entries: beside.signatures(&tried) };
    let between = Search::new(evidence, &base, &catalogue).between(&beside);
    catalogue.entries.extend(between);
    progress(STAGES[2]);

    let search = Search::new(evidence, &base, &catalogue);
    let screened = search.screen(&search.nothing());
    let found = search.best();
    let again = if is_first { sharper(evidence, &found.fit) } else { None };
    if let Some(evidence) = again {
        let base = search.base.refitted(&evidence);
        return attempt(&evidence, file, options, base, false, progress);
    }
    progress(STAGES[3]);

    let constants = Constants::of(&search);
    let Judgement { best, friction_level, missing, refused } =
        judged(&search, found, &constants, file, options);
    progress(STAGES[4]);

    let of_best = icr_columns(evidence, &best.fit);
    let of_corrected = Residual { evidence, fit: &best.fit, icrs: &of_best };
    let after = of_corrected.locate_in_waves(draws, seed);
    let left_over = after.left_over(Rules::tolerated(evidence, &base, &best));
    let status = status(&left_over, &missing);
    let broken = [located.broken(), filed.broken(), left_over].concat();
    let broken: Vec<Symmetry> = BTreeSet::from_iter(broken).into_iter().collect();
    let left = search.screen(&best);
    let isolability = Isolability::new(&search, &best, &screened);
    let resemblance = Isolability::new(&search, &search.nothing(), &screened);
    let exposures = exposures(&search, &best.fit, &missing, &screened, &constants.only);
    let detectable = isolability.detectable();
    let corrected = corrected(file, &best, friction_level, &missing);
    let cells = [(&base.fit, &of_base), (&best.fit, &of_best)]
        .map(|(fit, icrs)| cells(evidence, &fit.residual, icrs));
    let place = crate::place::sentence(evidence, &base, [&located, &after], &broken);
    let held_out = errors(evidence, [before(&base, &missing), &base.fit, &best.fit], options);
    progress(STAGES[5]);
    Diagnosis {
        status,
        before: located,
        after,
        filed,
        broken,
        place,
        missing,
        refused,
        screened,
        left,
        constants: constants.only,
        isolability,
        resemblance,
        exposures,
        detectable,
        held_out,
        unseen: None,
        cells,
        base,
        best,
        friction_level,
        evidence: evidence.clone(),
        corrected,
        proposed: None,
    }
}

/// What is claimed, what is refused, and the hypothesis with the claims alone.
struct Judgement {
    best: Found,
    friction_level: Option<Level>,
    missing: Vec<Missing>,
    refused: Vec<Verdict>,
}

/// Judges all that the best hypothesis adds, then instruments and constants beside what is left of it.
fn judged(
    search: &Search,
    found: Found,
    constants: &Constants,
    file: &VehicleFile,
    options: &Options,
) -> Judgement {
    let Options { draws, seed, .. } = *options;
    let mut best = found;
    let mut refused: Vec<Verdict> = Vec::new();
    // What mostly moves constant ICRs is free in every hypothesis: it stays, claimed or not.
    let stays = |one: &Verdict| constants.mostly.contains(&one.effect);
    // A claim is judged beside all others: each time the weakest of them is refused, those that are left are asked again.
    let (physics, mut intervals) = loop {
        let mut asked = best.effects.clone();
        asked.retain(|effect| !refused.iter().any(|other| other.effect == *effect));
        let mut physics = judge(search, &best, &asked, constants, file, draws, seed);
        let mut intervals = Vec::new();
        if physics.iter().all(|one| one.refused.is_none() || stays(one)) {
            intervals = Uncertainty::of(search, &best).intervals(&claimed(&physics));
            refuse_unsure(&mut physics, &intervals);
        }
        refused.extend(physics.extract_if(.., |one| one.refused.is_some() && stays(one)));
        let fallen = physics.iter().enumerate().filter(|(_, one)| one.refused.is_some());
        let weakest = fallen.min_by(|(_, a), (_, b)| a.support.z.total_cmp(&b.support.z));
        let Some((place, _)) = weakest else { break (physics, intervals) };
        let weakest = physics.remove(place);
        best = search.without(&best, weakest.effect);
        refused.push(weakest);
    };
    let instruments = judge_instruments(search, &best, draws, seed);
    let own = claimed(&physics);
    let wrong = judge_constants(search, &best, constants, file, &own, draws, seed);
    let uncertainty = Uncertainty::of(search, &best);
    intervals.extend(uncertainty.intervals(&claimed(&instruments)));
    let of = |effect: usize| -> Vec<Interval> {
        intervals.iter().filter(|interval| interval.unknown.is_of(effect)).copied().collect()
    };
    let physics = physics.into_iter().map(|verdict| (Kind::Physics, verdict));
    let instruments = instruments.into_iter().map(|verdict| (Kind::Instrument, verdict));
    let wrong = wrong.into_iter().map(|verdict| (Kind::Constant, verdict));
    let mut missing = Vec::new();
    for (kind, verdict) in physics.chain(instruments).chain(wrong) {
        if verdict.refused.is_some() {
            refused.push(verdict);
        } else {
            let parameters = if kind == Kind::Constant { Vec::new() } else { of(verdict.effect) };
            missing.push(Missing { kind, verdict, parameters });
        }
    }
    let friction_level = uncertainty.friction_level();
    Judgement { best, friction_level, missing, refused }
}

/// The effects that are not refused.
fn claimed(verdicts: &[Verdict]) -> Vec<usize> {
    verdicts.iter().filter(|one| one.refused.is_none()).map(|one| one.effect).collect()
}

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

/// The claimed effects, or else the best candidate, against the evidence.
fn exposures(
    search: &Search,
    best: &Fit,
    missing: &[Missing],
    screened: &[Screened],
    constants: &[usize],
) -> Vec<Exposure> {
    let claimed = missing.iter().filter(|missing| missing.kind != Kind::Constant);
    let claimed: Vec<Exposure> =
        claimed.map(|missing| Exposure::of_fitted(search, best, missing.verdict.effect)).collect();
    if !claimed.is_empty() {
        return claimed;
    }
    // Of what constant ICRs can stand for, there is nothing to see.
    let shows =
        |one: &&Screened| one.gain.is_finite() && one.z > 0.0 && !constants.contains(&one.effect);
    let candidate = screened.iter().find(shows);
    candidate.map(|one| Exposure::of_candidate(search, one)).into_iter().collect()
}

/// Whether the constant ICRs are determined at all.
fn turns(fit: &Fit) -> bool {
    let gauge = fit.hypothesis.vehicle.gauge;
    let covariance = &fit.solution.covariance;
    let gap = covariance[(0, 0)] + covariance[(1, 1)] - 2.0 * covariance[(0, 1)];
    gap.sqrt() < 0.2 * gauge
}

/// The vehicle that explains the evidence: the filed one, with what is claimed and the level of friction where it
/// surely differs. Where the constant ICRs were wrong, friction ratio and centre of gravity stand for all that could
/// move them.
fn corrected(
    file: &VehicleFile,
    best: &Found,
    friction_level: Option<Level>,
    missing: &[Missing],
) -> VehicleFile {
    let level = sure(friction_level);
    let vehicle = with_friction(&file.vehicle, level);
    let mut corrected = VehicleFile { vehicle, ..file.clone() };
    correct(&mut corrected, best, missing, level);
    corrected
}

/// The level of friction where it surely differs from the filed one.
pub(crate) fn sure(friction_level: Option<Level>) -> f64 {
    friction_level.filter(Level::is_sure).map_or(0.0, |level| level.value)
}

/// Puts what is claimed into a vehicle file, as a hypothesis has it, with friction at a level.
pub(crate) fn correct(corrected: &mut VehicleFile, found: &Found, missing: &[Missing], level: f64) {
    let hypothesis = &found.fit.hypothesis;
    let (constants, effects): (Vec<_>, Vec<_>) =
        missing.iter().partition(|missing| missing.kind == Kind::Constant);
    for missing in effects {
        if let Some(effect) = hypothesis.effect(missing.verdict.effect) {
            corrected.effects.insert(effect.clone());
        }
    }
    if !constants.is_empty() {
        correct_constants(corrected, hypothesis, &found.effects, level);
    }
}

/// The errors on evidence, with the fits to it.
fn errors(
    evidence: &Evidence,
    [before, instruments, after]: [&Fit; 3],
    options: &Options,
) -> HeldOut {
    let [before, instruments, error] =
        [before, instruments, after].map(|fit| excess(evidence, &fit.residual));
    let icrs = icr_columns(evidence, after);
    let residual = Residual { evidence, fit: after, icrs: &icrs };
    let flexible = residual.locate(1, options.seed);
    let count = real(evidence.measured().max(1));
    let floor = error * error - flexible.explicable.max(0.0) / count;
    let noise_floor = floor.max(0.0).sqrt().min(error);
    HeldOut { before, instruments, after: error, noise_floor, are_held_out: false }
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
        let claims_physics = self.missing.iter().any(|missing| missing.kind == Kind::Physics);
        self.held_out.contradiction(!self.missing.is_empty(), claims_physics)
    }

    /// The fit of what was there before: of the vehicle as filed where encoders or pose sensor are to blame for
    /// something, else with these at their best.
    pub fn fit_before(&self) -> &Fit {
        before(&self.base, &self.missing)
    }

    /// Judges it by runs that nothing was fitted or chosen on.
    fn judge_on(&mut self, evidence: &Evidence, options: &Options) {
        let evidence = evidence.with_scale(self.evidence.scale());
        let noise = self.evidence.noise();
        let evidence = noise.map_or_else(|| evidence.clone(), |noise| evidence.with_noise(*noise));
        let best = &self.best.fit;
        let evidence = without_outliers(&evidence, &best.on(&evidence));
        let [before, instruments, after] =
            [self.fit_before(), &self.base.fit, best].map(|fit| fit.on(&evidence));
        let errors = errors(&evidence, [&before, &instruments, &after], options);
        self.held_out = HeldOut { are_held_out: true, ..errors };
        let (before, after) = (before.residual, after.residual);
        self.unseen = Some(Unseen { evidence, before, after });
    }
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
        // what encoders did wrong is explained, and the physics beside it makes it worse
        let physics =
            errors(3.0, 1.1, 1.2).contradiction(true, true).expect("instruments do better");
        assert!(physics.contains("1.200 with it and 1.100 with encoders"), "{physics}");
        assert_eq!(errors(3.0, 1.1, 1.2).contradiction(true, false), None);
        assert_eq!(errors(1.1, 1.1, 1.1).contradiction(false, false), None);
        let fitted = HeldOut { are_held_out: false, ..errors(1.2, 1.3, 1.25) };
        assert_eq!(fitted.contradiction(true, true), None);
    }
}
