//! Added-variable series of an effect: its predicted change against the observed departure, for
//! figures.
//!
//! All that is free is projected out of both. The points then scatter about a line of slope one if
//! the effect has its estimated size, and of slope zero if it is absent.

use crate::fit::Fit;
use crate::mechanics::{Instruments, Mechanics};
use crate::normal::{Columns, Normal};
use crate::search::{Screened, Search};
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_model::EffectId;

/// Predicted and observed change by an effect, for each sample, whitened.
#[derive(Clone, Debug)]
pub struct Exposure {
    /// The effect.
    pub effect: EffectId,
    /// Change of the prediction by the effect at its estimated size.
    pub predicted: Vec<Vector3<f64>>,
    /// Residual of the prediction without the effect.
    pub observed: Vec<Vector3<f64>>,
}

impl Exposure {
    /// Series of a fitted effect, against the fit with the effect as filed.
    pub fn of_fitted(search: &Search, fit: &Fit, effect: EffectId) -> Self {
        let Search { evidence, base, .. } = search;
        let without = fit.hypothesis.with_effect_of(&base.as_filed.hypothesis, effect);
        let prediction =
            Mechanics::new(&without, evidence).predict(&Instruments::of(&without), evidence);
        let observed = evidence.residual(&prediction);
        let predicted = observed.iter().zip(&fit.residual).map(|(a, b)| a - b).collect();
        let others = fit.unknowns.iter().zip(&fit.columns);
        let others: Vec<_> = others
            .filter(|(unknown, _)| !unknown.is_of(effect))
            .map(|(_, column)| column.clone())
            .collect();
        Self { effect, predicted, observed }.beside(&others, &fit.residual, evidence)
    }

    /// Series of a screened candidate beside the base.
    pub fn of_candidate(search: &Search, one: &Screened) -> Self {
        let fit = &search.base.fit;
        let mut predicted = vec![Vector3::zeros(); fit.residual.len()];
        let (_, signatures) = &search.catalogue.entries[one.entry];
        for (signature, size) in signatures.iter().zip(&one.sizes) {
            for (sum, value) in predicted.iter_mut().zip(&signature.column) {
                *sum += value * *size;
            }
        }
        Self { effect: one.effect, predicted, observed: fit.residual.clone() }.beside(
            &fit.columns,
            &fit.residual,
            &search.evidence,
        )
    }

    /// Both series with these columns projected out.
    fn beside(
        self,
        columns: &[Vec<Vector3<f64>>],
        residual: &[Vector3<f64>],
        evidence: &Weighted,
    ) -> Self {
        let weights = evidence.weights(residual);
        let blocks = vec![0; weights.len()];
        let rest = |of: Vec<Vector3<f64>>| -> Vec<Vector3<f64>> {
            let normal = Normal::new(&Columns {
                residual: &of,
                columns,
                weights: &weights,
                blocks: &blocks,
                count: 1,
            });
            let mut rest = of;
            normal.take(&normal.independent(), columns, &mut rest);
            rest
        };
        Self { predicted: rest(self.predicted), observed: rest(self.observed), ..self }
    }
}
