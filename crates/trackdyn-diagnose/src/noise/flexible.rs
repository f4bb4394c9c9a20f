//! Columns of all that driving could explain in a residual.

use crate::candidate::sizes;
use crate::evidence::Evidence;
use crate::fit::{Fit, derivatives};
use crate::hypothesis::{Hypothesis, Unknown, at_share};
use crate::locate::{contrasts, icr_columns};
use crate::mechanics::{Instruments, Mechanics};
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_core::real;
use trackdyn_model::EffectId;
use trackdyn_model::effect::Card;

/// Residual of a fit, and all columns that driving could explain; not whitened.
pub(super) struct Flexible {
    pub(super) residual: Vec<Vector3<f64>>,
    pub(super) columns: Vec<Vec<Vector3<f64>>>,
    /// Number of columns of the fit itself, which come first.
    pub(super) own: usize,
}

/// ICRs and response to acceleration that vary with the speed of turning, as by friction that
/// depends on slip speed. Contrasts are few because they are tested; here there may be many.
fn turning(evidence: &Evidence, of: &[Vec<Vector3<f64>>]) -> Vec<Vec<Vector3<f64>>> {
    let fastest = evidence.fastest().max(f64::MIN_POSITIVE);
    let [quickly, slowly] =
        evidence.settings().noise.friction_scales.map(|scale| move |u: f64| (-u / scale).exp());
    let laws: [&dyn Fn(f64) -> f64; 4] = [&|u| u, &|u| u * u, &quickly, &slowly];
    let turns: Vec<f64> = (evidence.samples().iter())
        .map(|sample| (sample.speeds.right - sample.speeds.left).abs() / (2.0 * fastest))
        .collect();
    let column = |value: &[Vector3<f64>], law: &dyn Fn(f64) -> f64| {
        value.iter().zip(&turns).map(|(value, &turn)| value * law(turn)).collect()
    };
    of.iter().flat_map(|value| laws.map(|law| column(value, law))).collect()
}

/// Change of the motion with the friction level, free or not: how fast it responds to acceleration.
fn answer_to_acceleration(evidence: &Evidence, fit: &Fit) -> Vec<Vec<Vector3<f64>>> {
    changes(evidence, fit, &fit.hypothesis, &[Unknown::FrictionLevel])
}

/// Changes of the motion with where masses are, free or not: their place and the sizes of all
/// effects by which acceleration acts. The vehicle file may have them wrong. None without inertia.
fn masses(evidence: &Evidence, fit: &Fit) -> Vec<Vec<Vector3<f64>>> {
    let Fit { hypothesis, .. } = fit;
    if !hypothesis.effects.iter().any(|effect| effect.card().is_inertia()) {
        return Vec::new();
    }
    let acts = |card: &Card| card.is_inertia() || card.moves_load();
    let effects: Vec<EffectId> = EffectId::all().filter(|effect| acts(effect.card())).collect();
    let lacking = effects.iter().filter(|effect| hypothesis.effect(**effect).is_none());
    let none = |whole: Hypothesis, &effect| whole.with_effect(at_share(effect, 0.0));
    let whole = lacking.fold(hypothesis.clone(), none);
    let places = [0, 1].map(Unknown::Cog);
    let sizes =
        |&effect: &EffectId| sizes(effect).into_iter().map(move |k| Unknown::Effect(effect, k));
    let unknowns: Vec<Unknown> = places.into_iter().chain(effects.iter().flat_map(sizes)).collect();
    changes(evidence, fit, &whole, &unknowns)
}

/// Changes of the motion with these numbers of a hypothesis like that of the fit.
fn changes(
    evidence: &Evidence,
    fit: &Fit,
    hypothesis: &Hypothesis,
    unknowns: &[Unknown],
) -> Vec<Vec<Vector3<f64>>> {
    let mechanics = Mechanics::beside(Some(&fit.mechanics), hypothesis, evidence)
        .with_slopes(hypothesis, unknowns, evidence);
    let prediction = mechanics.predict(&Instruments::of(hypothesis), evidence);
    derivatives(hypothesis, &mechanics, &prediction, unknowns, evidence)
}

/// Whitened by the noise alone, without the residual scale.
fn white(evidence: &Weighted, column: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut column = column.to_vec();
    evidence.whiten(&mut column);
    column
}

/// Residual after the fit, not whitened, and the fitted columns, whitened by the noise alone.
pub(super) struct Left {
    pub(super) residual: Vec<Vector3<f64>>,
    pub(super) white: Vec<Vec<Vector3<f64>>>,
}

impl Flexible {
    pub(super) fn new(evidence: &Weighted, fit: &Fit) -> Self {
        let Fit { hypothesis, mechanics, unknowns, .. } = fit;
        let prediction = fit.prediction(evidence);
        let mut columns = derivatives(hypothesis, mechanics, &prediction, unknowns, evidence);
        let icrs = icr_columns(evidence, fit);
        let contrasts = contrasts(evidence, &icrs).into_iter();
        columns.extend(contrasts.flat_map(|contrasts| contrasts.columns));
        columns.extend(turning(evidence, &icrs));
        let answer = answer_to_acceleration(evidence, fit);
        columns.extend(turning(evidence, &answer));
        columns.extend(answer);
        columns.extend(masses(evidence, fit));
        let samples = evidence.samples().iter().zip(&prediction);
        let residual = samples.map(|(sample, motion)| sample.motion - motion).collect();
        Self { residual, columns, own: unknowns.len() }
    }

    /// Fits all columns with the evidence's noise. Only the fit's own columns are used where the
    /// recording is so short that all columns would leave less than half of the degrees of freedom.
    pub(super) fn left(&self, evidence: &Weighted) -> Left {
        let mut residual = white(evidence, &self.residual);
        let mut columns: Vec<_> =
            self.columns.iter().map(|column| white(evidence, column)).collect();
        let normal = evidence.normal(&residual, &columns);
        let mut fitted = normal.independent();
        let most = evidence.settings().noise.max_fitted_share * real(evidence.measured());
        if real(fitted.len()) > most {
            fitted.retain(|&column| column < self.own);
        }
        normal.take(&fitted, &columns, &mut residual);
        evidence.colour(&mut residual);
        let white = fitted.iter().map(|&column| std::mem::take(&mut columns[column])).collect();
        Left { residual, white }
    }
}
