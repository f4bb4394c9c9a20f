//! The diagnosis: all stages in order.

use super::begun::begun;
use super::evidence::{Cleaned, InNoise, Split};
use super::judged::Judged;
use super::located::Located;
use super::searched::{self, Searched};
use super::tested::Tested;
use super::{Answer, Diagnosis, Examined, Limits, Models, Options};
use crate::corrected::corrected;
use crate::drift::Drift;
use crate::error::Error;
use crate::evidence::Evidence;
use crate::progress::{Observer, Stage, Watch};
use crate::proposal::{Unexplained, propose};
use crate::search::{Known, Search};
use crate::verdict::Constants;
use crate::weighted::Weighted;
use std::collections::BTreeSet;
use std::sync::Arc;
use trackdyn_model::{ActiveEffect, EffectId, VehicleFile};

/// Stages of a search.
const SEARCH: usize = searched::STAGES_SHARPENED;

/// Stages of the longest course: noise, readings and beginnings; search, search rescaled and
/// verdicts; search and verdicts once more; location, held-out runs, proposal, limits and
/// correction.
pub const STAGES: usize = 3 + (2 * SEARCH + 1) + (SEARCH + 1) + 5;

/// A diagnosis with the search that it rests on, for further questions to the same evidence.
pub struct Examination {
    /// The diagnosis.
    pub diagnosis: Diagnosis,
    /// Evidence, base and catalogue of candidates, with all refits that were made.
    pub search: Search,
    /// Effects that act as constant ICRs.
    pub constants: Constants,
}

/// Candidates: the catalogue, then the laws of a user that are given or that the file has.
fn suspects(laws: &[EffectId], file: &VehicleFile) -> Vec<EffectId> {
    let filed = file.effects.iter().map(ActiveEffect::effect);
    let own = filed.chain(laws.iter().copied()).filter(|effect| effect.custom().is_some());
    EffectId::all().chain(own.collect::<BTreeSet<_>>()).collect()
}

/// Diagnoses evidence. `observer` receives the progress and may cancel.
///
/// # Errors
/// Evidence without turning, or with too few samples; a vehicle for which no motion exists;
/// [`Error::Cancelled`].
pub fn diagnose(
    evidence: &Evidence,
    file: &VehicleFile,
    options: &Options,
    observer: &Observer,
) -> Result<Diagnosis, Error> {
    examine(evidence, file, options, observer).map(|examined| examined.diagnosis)
}

/// Diagnoses evidence and keeps the search.
///
/// # Errors
/// Those of [`diagnose`].
pub fn examine(
    evidence: &Evidence,
    file: &VehicleFile,
    options: &Options,
    observer: &Observer,
) -> Result<Examination, Error> {
    let resampling = options.resampling;
    let suspects = suspects(&options.laws, file);
    let watch = &Watch::new(observer, STAGES);

    // Evidence: runs to fit, and held-out runs.
    let Split { seen, unseen } = Split::new(evidence, &options.held_out)?;

    // Noise: the residual scatter after everything that driving could explain is fitted.
    let InNoise { seen, base } =
        watch.try_stage(Stage::Noise, || InNoise::of(seen, file, watch))?;

    // Cleaned: late stamps and encoder ticks are removed from the readings.
    let Cleaned { seen, unseen, base } =
        watch.try_stage(Stage::Readings, || Cleaned::of(seen, unseen, base, watch))?;

    // Begun: runs that were cut out of a slide begin in a motion of their own.
    let own = watch.try_stage(Stage::Beginnings, || begun(&seen, &base, watch))?;
    let seen = own.unwrap_or(seen);

    // Signatures and search, repeated with smaller noise where the best hypothesis shows that the
    // noise was overestimated. A repeat begins with what was found before.
    let searched_in = |seen: &Weighted, known: Known| {
        Searched::sharpened(seen, base.refitted(seen), &suspects, known, watch)
    };
    let first = searched_in(&seen, Known::default())?;

    // Rescaled: unexplained residuals larger than the noise would make claims too certain, so the
    // evidence is searched again with the residuals scaled down.
    let searched = if let Some(seen) = first.rescaled() {
        searched_in(&seen, first.into_known())?
    } else {
        watch.skip(SEARCH);
        first
    };

    // Verdicts, and once more where refused effects leave larger residuals.
    let judged = |searched: Searched| {
        let judged = || Judged::of(searched, file, resampling, watch);
        watch.try_stage(Stage::Verdicts, judged)
    };
    let first = judged(searched)?;
    let judged = if let Some(seen) = first.rescaled() {
        judged(searched_in(&seen, first.into_known())?)?
    } else {
        watch.skip(SEARCH + 1);
        first
    };

    // Location: where residuals depart from zero before and after the correction.
    let located = watch.stage(Stage::Location, || Located::of(&judged, resampling))?;

    // Held-out runs: prediction errors where nothing was fitted or chosen.
    let tested = || Tested::of(&judged, unseen.as_ref(), resampling);
    let tested = watch.stage(Stage::HeldOut, tested)?;

    // Proposal: an empirical law for what no effect explains.
    let proposed = watch.stage(Stage::Proposal, || {
        let unexplained = Unexplained {
            evidence: &judged.search.evidence,
            base: &judged.search.base,
            best: &judged.best,
            filed: &located.filed,
            before: &located.before,
            after: &located.after,
            held_out: tested.errors,
            unseen: tested.unseen.as_ref(),
        };
        let is_left = !located.left_over.is_empty();
        is_left.then(|| propose(&unexplained, resampling)).flatten()
    })?;

    // Limits: what this evidence could have shown, and told apart.
    let limits = || (Limits::of(&judged), judged.exposures());
    let (limits, exposures) = watch.stage(Stage::Limits, limits)?;

    // Corrected: the vehicle file with the claims, and how far dead reckoning by it drifts.
    let (corrected, drift) = watch.stage(Stage::Correction, || {
        let corrected = corrected(
            file,
            &judged.best,
            judged.friction_level,
            &judged.missing,
            proposed.as_ref(),
            judged.search.settings().verdict.min_icr_difference,
        );
        let unseen = tested.unseen.as_ref().map(|unseen| &unseen.evidence);
        let drift = Drift::of(unseen.unwrap_or(&judged.search.evidence), [file, &corrected]);
        (corrected, drift)
    })?;

    let Judged { search, screened: _, constants, best, friction_level, missing, refused } = judged;
    let place = located.sentence(&search);
    let broken = located.broken();
    let Located { filed, before, after, left_over, cells } = located;
    let diagnosis = Diagnosis {
        answer: Answer {
            status: super::status(&left_over, &missing),
            broken,
            left_over,
            place,
            missing,
            refused,
            proposed,
            corrected,
        },
        evidence: Examined {
            seen: search.evidence.clone(),
            unseen: tested.unseen,
            filed,
            before,
            after,
            cells,
            exposures,
            errors: tested.errors,
            drift,
        },
        models: Models { base: Arc::clone(&search.base), best, friction_level },
        limits,
    };
    Ok(Examination { diagnosis, search, constants })
}
