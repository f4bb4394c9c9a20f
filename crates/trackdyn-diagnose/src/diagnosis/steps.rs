//! The diagnosis: all steps in order.

use super::{Diagnosis, Kind, Missing, Options, Status, before};
use crate::base::Base;
use crate::candidate::{Beside, candidates};
use crate::corrected::{correct, corrected, sure};
use crate::error::Error;
use crate::evidence::{Evidence, FEWEST, Origin};
use crate::exposure::Exposure;
use crate::fit::Fit;
use crate::held_out::{errors, judged as judged_by_unseen};
use crate::isolability::Isolability;
use crate::locate::cells::cells;
use crate::locate::{Residual, icr_columns};
use crate::noise::{sharper, with_remaining_noise};
use crate::proposal::{Proposal, Unexplained, propose};
use crate::search::{Catalogue, Found, Screened, Search};
use crate::uncertainty::{Interval, Level, Uncertainty};
use crate::verdict::{
    Constants, Rules, Verdict, judge, judge_constants, judge_instruments, refuse_unsure,
};
use crate::weighted::Weighted;
use std::collections::BTreeSet;
use trackdyn_model::EffectId;
use trackdyn_model::VehicleFile;
use trackdyn_model::effect::Symmetry;

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
    let (mut unseen, evidence) = (evidence.of_runs(&held_out), evidence.of_runs(&seen));
    let mut evidence = Weighted::new(evidence);
    if evidence.samples().len() < FEWEST && matches!(evidence.origin(), Origin::Drive(_)) {
        let durations = evidence.samples().iter().map(|sample| sample.duration);
        return Err(Error::too_few_segments(durations, FEWEST));
    }
    if !options.held_out.is_empty() && unseen.samples().is_empty() {
        return Err(Error::NothingHeldOut);
    }
    let base = Base::new(file, &evidence);
    if let Some(reason) = base.as_filed.mechanics.failure() {
        let reason = reason.to_owned();
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
        let tried = evidence.with_readings(cleaned);
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
                let fits = [attempt.fit_before(), &attempt.base.fit, &attempt.best.fit];
                let (held_out, unseen) =
                    judged_by_unseen(&unseen, &attempt.evidence, fits, options.resampling);
                (attempt.held_out, attempt.unseen) = (held_out, Some(unseen));
            }
            return Ok(completed(attempt, options));
        }
        evidence = evidence.with_scale(scale.map(|scale| scale.max(1.0)));
    }
}

/// A diagnosis that leaves something unexplained, with the law that is proposed for it: in `proposed`, and in the
/// corrected vehicle.
fn completed(mut diagnosis: Diagnosis, options: &Options) -> Diagnosis {
    if diagnosis.status == Status::Unexplained {
        let unexplained = Unexplained {
            evidence: &diagnosis.evidence,
            base: &diagnosis.base,
            best: &diagnosis.best,
            filed: &diagnosis.filed,
            before: &diagnosis.before,
            after: &diagnosis.after,
            held_out: diagnosis.held_out,
            unseen: diagnosis.unseen.as_ref(),
        };
        diagnosis.proposed = propose(&unexplained, options.resampling);
        let Diagnosis { proposed, corrected, missing, friction_level, .. } = &mut diagnosis;
        if let Some(Proposal { found, effect, .. }) = proposed {
            // the law first: what it moves is no constant
            if let Some(law) = found.fit.hypothesis.effect(*effect) {
                corrected.effects.insert(law.clone());
            }
            correct(corrected, found, missing, sure(*friction_level));
        }
    }
    diagnosis
}

/// By how much readings without stamps that jitter, or without ticks, may raise twice the misfit by chance.
const CLEANED: f64 = 4.0;

/// Residuals may be this much larger than the noise before the noise is taken to be larger.
const TOLERATED: f64 = 1.1;

fn attempt(
    evidence: &Weighted,
    file: &VehicleFile,
    options: &Options,
    base: Base,
    is_first: bool,
    progress: &dyn Fn(&'static str),
) -> Diagnosis {
    let resampling = options.resampling;
    let of_base = icr_columns(evidence, &base.fit);
    let of_filed = icr_columns(evidence, &base.as_filed);
    let as_filed = Residual { evidence, fit: &base.as_filed, icrs: &of_filed };
    let filed = as_filed.locate(resampling);
    let of_fit = Residual { evidence, fit: &base.fit, icrs: &of_base };
    let located = of_fit.locate(resampling);
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
    let after = of_corrected.locate_in_waves(resampling);
    let left_over = after.left_over(Rules::tolerated(evidence, &base, &best));
    let status = status(&left_over, &missing);
    let broken = [located.broken(), filed.broken(), left_over].concat();
    let broken: Vec<Symmetry> = BTreeSet::from_iter(broken).into_iter().collect();
    let left = search.screen(&best);
    let detectable = Isolability::new(&search, &best, &screened).detectable();
    let resemblance = Isolability::new(&search, &search.nothing(), &screened);
    let exposures = exposures(&search, &best.fit, &missing, &screened, &constants.only);
    let corrected = corrected(file, &best, friction_level, &missing);
    let cells = [(&base.fit, &of_base), (&best.fit, &of_best)]
        .map(|(fit, icrs)| cells(evidence, &fit.residual, icrs));
    let place = crate::place::sentence(evidence, &base, [&located, &after], &broken);
    let held_out = errors(evidence, [before(&base, &missing), &base.fit, &best.fit], resampling);
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
    let resampling = options.resampling;
    let mut best = found;
    let mut refused: Vec<Verdict> = Vec::new();
    // What mostly moves constant ICRs is free in every hypothesis: it stays, claimed or not.
    let stays = |one: &Verdict| constants.mostly.contains(&one.effect);
    // A claim is judged beside all others: each time the weakest of them is refused, those that are left are asked again.
    let (physics, mut intervals) = loop {
        let mut asked = best.effects.clone();
        asked.retain(|effect| !refused.iter().any(|other| other.effect == *effect));
        let mut physics = judge(search, &best, &asked, constants, file, resampling);
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
    let instruments = judge_instruments(search, &best, resampling);
    let own = claimed(&physics);
    let wrong = judge_constants(search, &best, constants, file, &own, resampling);
    let uncertainty = Uncertainty::of(search, &best);
    intervals.extend(uncertainty.intervals(&claimed(&instruments)));
    let of = |effect: EffectId| -> Vec<Interval> {
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
fn claimed(verdicts: &[Verdict]) -> Vec<EffectId> {
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
    constants: &[EffectId],
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
    /// Standard deviation of their distance, in gauges, from which on the recording has told nothing of it: without one it is 0.71, of two
    /// offsets that are known to half a gauge.
    const UNKNOWN: f64 = 0.2;
    let gauge = fit.hypothesis.vehicle.gauge;
    let covariance = &fit.solution.covariance;
    let gap = covariance[(0, 0)] + covariance[(1, 1)] - 2.0 * covariance[(0, 1)];
    gap.sqrt() < UNKNOWN * gauge
}
