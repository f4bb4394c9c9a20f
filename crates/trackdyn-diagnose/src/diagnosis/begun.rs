//! Evidence whose runs begin in a motion of their own, where the evidence favours that.

use crate::base::Base;
use crate::candidate::Catalogue;
use crate::fit::Fit;
use crate::progress::{Cancelled, Watch};
use crate::search::{Found, Search};
use crate::starts::{beginning_as, with_own_starts};
use crate::weighted::Weighted;
use trackdyn_core::Side;

/// The evidence in which each run begins in a motion of its own; none where stationary beginnings
/// explain it as well.
///
/// A sliding robot has inertia. So Newton's second law is fitted as a whole, with stationary
/// beginnings and with unknown ones, and the evidence of both is compared. Unknown beginnings cost
/// three numbers a run.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub(super) fn begun(
    seen: &Weighted,
    base: &Base,
    watch: &Watch,
) -> Result<Option<Weighted>, Cancelled> {
    let settings = seen.settings();
    if !begin_in_motion(seen) {
        return Ok(None);
    }
    let base = base.refitted(seen);
    let search = Search::new(seen.clone(), base, Catalogue { entries: Vec::new() });
    let nothing = search.nothing();
    let newton = search.newton(&nothing, watch)?;
    let worth = settings.search.min_ln_evidence;
    let is_seen = |found: &Found| found.ln_evidence > nothing.ln_evidence + worth;
    let Fit { mut hypothesis, unknowns, .. } = match newton {
        Some(newton) if is_seen(&newton) => newton.fit,
        Some(_) => return Ok(None),
        None => nothing.fit,
    };
    let least = Fit::at(hypothesis.clone(), &unknowns, seen, None).ln_evidence() + worth;
    let mut best: Option<(f64, Weighted)> = None;
    for _ in 0..settings.evidence.start_repeats {
        watch.go_on()?;
        let Some(own) = with_own_starts(seen, &hypothesis) else { break };
        let fit = Fit::new(hypothesis, &unknowns, &own, None);
        let fit = fit.with_own_starts(&own).unwrap_or(fit);
        let ln_evidence = fit.ln_evidence() + own.ln_determinant_of_starts();
        hypothesis = fit.hypothesis;
        let most = best.as_ref().map_or(least, |(most, _)| *most);
        if ln_evidence <= most {
            break;
        }
        let is_enough = best.is_some() && ln_evidence < most + worth;
        best = Some((ln_evidence, beginning_as(&own, &hypothesis)));
        if is_enough {
            break;
        }
    }
    Ok(best.map(|(_, own)| own))
}

/// Whether tracks run at the first reading of a run.
fn begin_in_motion(seen: &Weighted) -> bool {
    let least = seen.settings().evidence.min_start_speed * seen.fastest();
    let mut first = seen.tracks().iter().filter_map(|run| run.first());
    first.any(|reading| Side::BOTH.iter().any(|&side| reading.speeds()[side].abs() > least))
}
