//! Verdicts on encoders and pose sensor that differ from the vehicle file.

use super::rivals::is_rival;
use super::support::change;
use super::{Basis, Support, Verdict, refusal, within_filed};
use crate::fit::Fit;
use crate::progress::Cancelled;
use crate::search::{Found, Screened, Search};
use crate::settings::Settings;
use nalgebra::DVector;
use trackdyn_model::EffectId;

/// Judges the instrument effects, which are free in every hypothesis.
///
/// # Errors
/// [`Cancelled`], by the observer of the watch.
pub fn judge_instruments(basis: &Basis, best: &Found) -> Result<Vec<Verdict>, Cancelled> {
    let Basis { search, resampling, watch, .. } = *basis;
    let filed = &search.base.as_filed.hypothesis;
    let Settings { verdict: rules, answer, .. } = search.settings();
    let mut verdicts = Vec::new();
    for &effect in &search.base.instruments {
        let fit = &best.fit;
        let columns: Vec<usize> =
            (0..fit.unknowns.len()).filter(|&k| fit.unknowns[k].is_of(effect)).collect();
        let parts: Vec<f64> = columns
            .iter()
            .map(|&k| {
                let unknown = fit.unknowns[k];
                fit.hypothesis.get(unknown) - filed.get(unknown)
            })
            .collect();
        if is_negligible(fit, &columns, &parts, rules.min_ln_bayes_factor) {
            continue;
        }
        watch.go_on()?;
        let dropped = without_instrument(search, best, effect);
        let ln_bayes_factor = best.ln_evidence - dropped.ln_evidence;
        let z = (dropped.fit.objective - best.fit.objective).max(0.0).sqrt();
        if ln_bayes_factor < rules.min_ln_bayes_factor {
            continue;
        }
        let mut one_of = vec![effect];
        let screened = search.screen(&dropped);
        // An error that few robots have is no rival of a usual one unless it explains more.
        let is_likely =
            |one: &&Screened| !one.effect.card().is_rare() || one.gain > ln_bayes_factor;
        let rivals = screened.iter().filter(is_likely);
        let rivals = rivals.filter(|one| is_rival(one, ln_bayes_factor, best, answer));
        for rival in rivals.take(answer.max_rivals) {
            watch.go_on()?;
            let exchanged = search.refit(&dropped, std::slice::from_ref(rival));
            let behind = (exchanged.fit.objective - best.fit.objective) / 2.0;
            if behind < answer.max_ln_likelihood_gap {
                one_of.push(rival.effect);
            }
        }
        one_of.sort_unstable();
        let support = Support {
            ln_bayes_factor,
            z,
            ..Support::of_columns(search, best, &columns, &parts, resampling)
        };
        // The forms of laws that were found stand in the evidence; those of the file may be wrong
        // by as much as laws are known.
        let of_filed_laws = || within_filed(search, &dropped, &change(effect, &dropped, best)?);
        let refused = refusal(&support, 0.0, rules).or_else(of_filed_laws);
        let found = fit.hypothesis.effect(effect).cloned();
        verdicts.push(Verdict { effect, one_of, found, support, refused });
    }
    Ok(verdicts)
}

/// The best hypothesis with one instrument effect as filed, refitted.
fn without_instrument(search: &Search, best: &Found, effect: EffectId) -> Found {
    let hypothesis = best.fit.hypothesis.with_effect_of(&search.base.as_filed.hypothesis, effect);
    let unknowns = best.fit.unknowns_without(effect);
    let before = Some(&best.fit.mechanics);
    let fit = Fit::new(hypothesis, &unknowns, &search.evidence, before);
    search.with_own_starts(search.found(best.effects.clone(), fit))
}

/// Whether an instrument effect as filed, `parts` away, costs less than half of a claim by the
/// linear prediction of the fit. The other half allows for nonlinearity. False where one of its
/// numbers is held at a bound, for which there is no prediction.
fn is_negligible(fit: &Fit, columns: &[usize], parts: &[f64], claim: f64) -> bool {
    let rise = || fit.solution.rise(columns, &DVector::from_column_slice(parts));
    columns.iter().all(|column| fit.free.contains(column)) && rise() / 2.0 < claim / 2.0
}
