//! Encoders and pose sensor that are not what the vehicle file says.

use super::{RIVALS, Rules, Support, Verdict, is_comparable, refusal};
use crate::fit::Fit;
use crate::hypothesis::{Hypothesis, Unknown, neutral, unknowns_of};
use crate::search::{Found, Search};
use nalgebra::DVector;
use trackdyn_physics::VehicleFile;

/// Judges the effects of encoders and pose sensor that are free in every hypothesis.
pub fn judge_instruments(
    search: &Search,
    best: &Found,
    statics: &[usize],
    file: &VehicleFile,
    draws: usize,
    seed: u64,
) -> Vec<Verdict> {
    let mut verdicts = Vec::new();
    for &effect in &search.base.instruments {
        let dropped = without_instrument(search, best, effect, file);
        let columns: Vec<usize> = (0..best.fit.unknowns.len())
            .filter(|&k| matches!(best.fit.unknowns[k], Unknown::Effect(of, _) if of == effect))
            .collect();
        let ln_bayes_factor = best.ln_evidence - dropped.ln_evidence;
        let z = (dropped.fit.objective - best.fit.objective).max(0.0).sqrt();
        if ln_bayes_factor < Rules::LN_BAYES_FACTOR {
            continue;
        }
        let mut one_of = vec![effect];
        let screened = search.screen(&dropped);
        let own_gain = ln_bayes_factor;
        let rivals = screened.iter().filter(|one| {
            is_comparable(one.gain, own_gain)
                && one.gain.is_finite()
                && !best.effects.contains(&one.effect)
                && !statics.contains(&one.effect)
        });
        for rival in rivals.take(RIVALS) {
            let exchanged = search.refit(&dropped, std::slice::from_ref(rival));
            if (exchanged.fit.objective - best.fit.objective) / 2.0 < Rules::SAME {
                one_of.push(rival.effect);
            }
        }
        one_of.sort_unstable();
        // The residual with the effect's own part put back: what a base without it would show.
        let sizes = DVector::from_iterator(
            columns.len(),
            columns.iter().map(|&k| {
                let unknown = best.fit.unknowns[k];
                best.fit.hypothesis.get(unknown) - filed(file, unknown)
            }),
        );
        let mut fit = best.fit.clone();
        for (place, &k) in columns.iter().enumerate() {
            for (value, by) in fit.residual.iter_mut().zip(&best.fit.columns[k]) {
                *value += by * sizes[place];
            }
        }
        let mut support = Support::of_columns(search, &fit, &columns, draws, seed);
        support.ln_bayes_factor = ln_bayes_factor;
        support.z = z;
        let refused = refusal(&support, z, 0.0);
        verdicts.push(Verdict { effect, one_of, support, refused });
    }
    verdicts
}

/// Value of an unknown in the vehicle file; that of no effect where it does not have the effect.
fn filed(file: &VehicleFile, unknown: Unknown) -> f64 {
    let hypothesis = Hypothesis {
        vehicle: file.vehicle.clone(),
        effects: file.effects.clone(),
        offset: [0.0; 3],
    };
    hypothesis.get(unknown)
}

fn without_instrument(search: &Search, best: &Found, effect: usize, file: &VehicleFile) -> Found {
    let of = |unknown: &Unknown| matches!(unknown, Unknown::Effect(other, _) if *other == effect);
    let mut hypothesis = best.fit.hypothesis.without(effect);
    for unknown in unknowns_of(effect) {
        let value = filed(file, unknown);
        if (value - neutral(unknown.parameter().expect("an effect's"))).abs() > 0.0 {
            hypothesis = hypothesis.with(unknown, value);
        }
    }
    let unknowns: Vec<Unknown> =
        best.fit.unknowns.iter().copied().filter(|unknown| !of(unknown)).collect();
    let before = Some(&best.fit.mechanics);
    let fit = Fit::new(hypothesis, &unknowns, search.evidence, search.metric, before);
    Found { effects: best.effects.clone(), ln_evidence: fit.ln_evidence(search.evidence), fit }
}
