//! Verdicts: which effects of the best hypothesis are claimed, and which refused.

use super::searched::Searched;
use crate::answer::{Kind, Missing};
use crate::exposure::Exposure;
use crate::hypothesis::typical;
use crate::mechanics::is_instrument;
use crate::progress::{Cancelled, Watch};
use crate::resampling::Resampling;
use crate::search::{Found, Known, Screened, Search};
use crate::uncertainty::{Interval, Level, Uncertainty};
use crate::verdict::{
    Basis, Constants, Refusal, Verdict, judge, judge_constants, judge_instruments, unless_unsure,
};
use crate::weighted::Weighted;
use std::slice;
use trackdyn_model::{EffectId, VehicleFile};

/// A search with its verdicts.
pub(super) struct Judged {
    /// Evidence, base and catalogue of candidates.
    pub search: Search,
    /// All candidates screened beside the base, best first.
    pub screened: Vec<Screened>,
    /// Effects that act as constant ICRs.
    pub constants: Constants,
    /// The best hypothesis, reduced to what is claimed and refitted.
    pub best: Found,
    /// Its friction level with an interval; none where friction is not free.
    pub friction_level: Option<Level>,
    /// Claims.
    pub missing: Vec<Missing>,
    /// Refused effects, with the reason.
    pub refused: Vec<Verdict>,
}

impl Judged {
    /// Judges the effects of the best hypothesis, then instruments and constant ICRs beside those
    /// that remain.
    pub fn of(
        searched: Searched,
        file: &VehicleFile,
        resampling: Resampling,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let Searched { search, screened, found } = searched;
        let constants = Constants::of(&search);
        let basis = Basis { search: &search, constants: &constants, file, resampling, watch };
        let Physics { best, verdicts, intervals, mut refused } = Physics::of(&basis, found)?;
        let instruments = judge_instruments(&basis, &best)?;
        let own = claimed(&verdicts);
        let wrong = judge_constants(&basis, &best, &own)?;
        let uncertainty = Uncertainty::of(&search, &best);
        let of_instruments = uncertainty.intervals(&claimed(&instruments));
        let friction_level = uncertainty.friction_level();
        let intervals = [intervals, of_instruments].concat();
        let of = |effect: EffectId| -> Vec<Interval> {
            intervals.iter().filter(|interval| interval.unknown.is_of(effect)).copied().collect()
        };
        let vehicle = &search.base.fit.hypothesis.vehicle;
        let kind = |effect| {
            let is_instrument = is_instrument(vehicle, &typical(effect));
            if is_instrument { Kind::Instrument } else { Kind::Physics }
        };
        let physics = verdicts.into_iter().map(|verdict| (kind(verdict.effect), verdict));
        let instruments = instruments.into_iter().map(|verdict| (Kind::Instrument, verdict));
        let wrong = wrong.into_iter().map(|verdict| (Kind::Constant, verdict));
        let mut missing = Vec::new();
        for (kind, verdict) in physics.chain(instruments).chain(wrong) {
            if verdict.refused.is_some() {
                refused.push(verdict);
            } else {
                let parameters =
                    if kind == Kind::Constant { Vec::new() } else { of(verdict.effect) };
                missing.push(Missing { kind, verdict, parameters });
            }
        }
        // Whose place another took stands in a set with it.
        refused.retain(|one| !missing.iter().any(|set| set.verdict.one_of.contains(&one.effect)));
        Ok(Self { search, screened, constants, best, friction_level, missing, refused })
    }

    /// The evidence with the residuals of the best hypothesis scaled down to the noise; none where
    /// they do not exceed it.
    pub fn rescaled(&self) -> Option<Weighted> {
        self.search.evidence.rescaled(&self.best.fit.residual)
    }

    /// What the search found, for a search with other noise.
    pub fn into_known(self) -> Known {
        self.search.into_known(self.best)
    }
}

impl Judged {
    /// Claimed effects, or else the best candidate, against the evidence: series for figures.
    pub fn exposures(&self) -> Vec<Exposure> {
        let Self { search, screened, constants, best, missing, .. } = self;
        let claimed = missing.iter().filter(|missing| missing.kind != Kind::Constant);
        let claimed: Vec<Exposure> = claimed
            .map(|missing| Exposure::of_fitted(search, &best.fit, missing.verdict.effect))
            .collect();
        if !claimed.is_empty() {
            return claimed;
        }
        // An effect equivalent to constant ICRs shows nothing in a figure.
        let shows = |one: &&Screened| {
            one.gain.is_finite() && one.z > 0.0 && !constants.only.contains(&one.effect)
        };
        let candidate = screened.iter().find(shows);
        candidate.map(|one| Exposure::of_candidate(search, one)).into_iter().collect()
    }
}

/// Verdicts on the effects of the best hypothesis.
struct Physics {
    /// The best hypothesis, without the refused effects.
    best: Found,
    /// Verdicts that claim.
    verdicts: Vec<Verdict>,
    /// Confidence intervals of the claimed parameters.
    intervals: Vec<Interval>,
    /// Refused effects.
    refused: Vec<Verdict>,
}

impl Physics {
    /// Backward elimination: while any claim is refused, the weakest refused effect is left out, or
    /// another member of its set takes its place, and all are judged again.
    fn of(basis: &Basis, found: Found) -> Result<Self, Cancelled> {
        let Basis { search, constants, watch, .. } = *basis;
        // Effects that mostly act as constant ICRs are free in every hypothesis: they stay, even
        // refused.
        let stays = |one: &Verdict| constants.mostly.contains(&one.effect);
        let mut best = found;
        let mut refused: Vec<Verdict> = Vec::new();
        loop {
            let mut asked = best.effects.clone();
            asked.retain(|effect| !refused.iter().any(|other| other.effect == *effect));
            let verdicts = judge(basis, &best, &asked)?;
            let all_stand = verdicts.iter().all(|one| one.refused.is_none() || stays(one));
            let intervals = if all_stand {
                Uncertainty::of(search, &best).intervals(&claimed(&verdicts))
            } else {
                Vec::new()
            };
            let verdicts =
                verdicts.into_iter().map(|one| unless_unsure(one, &intervals, &search.evidence));
            let (staying, mut verdicts): (Vec<Verdict>, Vec<Verdict>) =
                verdicts.partition(|one| one.refused.is_some() && stays(one));
            refused.extend(staying);
            let fallen = verdicts.iter().enumerate().filter(|(_, one)| one.refused.is_some());
            let weakest = fallen.min_by(|(_, a), (_, b)| a.support.z.total_cmp(&b.support.z));
            let Some((place, _)) = weakest else {
                return Ok(Self { best, verdicts, intervals, refused });
            };
            let weakest = verdicts.remove(place);
            watch.go_on()?;
            let without = search.without(&best, weakest.effect);
            best = in_its_place(basis, &without, &weakest, &refused)?.unwrap_or(without);
            refused.push(weakest);
        }
    }
}

/// The hypothesis with the best other member of a set whose leader is refused for its numbers; none
/// where no other member of the set explains anything.
fn in_its_place(
    basis: &Basis,
    without: &Found,
    leader: &Verdict,
    refused: &[Verdict],
) -> Result<Option<Found>, Cancelled> {
    let Basis { search, constants, watch, .. } = *basis;
    if !leader.refused.as_ref().is_some_and(Refusal::is_of_numbers) {
        return Ok(None);
    }
    let is_other = |one: &&Screened| {
        one.effect != leader.effect
            && leader.one_of.contains(&one.effect)
            && !constants.mostly.contains(&one.effect)
            && !refused.iter().any(|other| other.effect == one.effect)
    };
    let mut best: Option<Found> = None;
    for one in search.screen(without).iter().filter(is_other) {
        watch.go_on()?;
        let found = search.refit(without, slice::from_ref(one));
        let least = best.as_ref().unwrap_or(without).ln_evidence;
        if found.ln_evidence > least {
            best = Some(found);
        }
    }
    Ok(best)
}

/// The effects that are not refused.
fn claimed(verdicts: &[Verdict]) -> Vec<EffectId> {
    verdicts.iter().filter(|one| one.refused.is_none()).map(|one| one.effect).collect()
}
