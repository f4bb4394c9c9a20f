//! Refinement of places, directions and shapes between the values that are tried.

use super::places::extent;
use super::{Beside, Signature, Variant, spacing};
use rayon::prelude::*;
use trackdyn_model::effect::Role;

impl Variant {
    /// The variant with one parameter moved by `share` of half the distance between tried values.
    fn moved(&self, parameter: usize, share: f64, beside: &Beside) -> Self {
        let of = self.effect.card();
        let card = &of.parameters[parameter];
        let by = share * spacing(card, extent(of, &self.values), beside.evidence) / 2.0;
        let mut moved = self.clone();
        let value = &mut moved.values[parameter];
        *value = match card.role {
            Role::Shape => *value * by.exp(),
            Role::Time => beside.driven.clock(beside.driven.at(*value) + by),
            _ => *value + by,
        };
        *value = value.clamp(card.range[0], card.range[1]);
        moved
    }
}

impl Beside<'_> {
    /// The variant near `start` with the largest gain, and its signatures, by pattern search: steps
    /// to both sides in each shape, direction, place and time, halved where none improves. A time
    /// is found to a sample: no fit crosses one. None where `start` is the best.
    pub fn between(
        &self,
        start: &Variant,
        gain: f64,
        gain_of: impl Fn(&Variant, &[Signature]) -> f64 + Sync,
    ) -> Option<(Variant, Vec<Signature>)> {
        let sizes = start.sizes();
        let others = (0..start.values.len()).filter(|parameter| !sizes.contains(parameter));
        let others: Vec<usize> = others.collect();
        let (mut best, mut most, mut share) = (None, gain, 1.0);
        let settings = &self.evidence.settings().candidates;
        let parameters = start.effect.card().parameters;
        let time = others.iter().find(|&&one| parameters[one].role == Role::Time);
        let least = time.map_or(settings.min_refining_step, |&time| {
            let step = spacing(&parameters[time], None, self.evidence) / 2.0;
            self.driven.sample() / step
        });
        let mut left = settings.refining_rounds;
        while share >= least && left > 0 {
            left -= 1;
            let at = best.as_ref().map_or(start, |(variant, _)| variant);
            let steps =
                others.iter().flat_map(|&parameter| [(parameter, share), (parameter, -share)]);
            let steps: Vec<(usize, f64)> = steps.collect();
            let around = steps.into_par_iter().filter_map(|(parameter, share)| {
                let variant = at.moved(parameter, share, self);
                let signatures = variant.signatures(self)?;
                let gain = gain_of(&variant, &signatures);
                Some((gain, (variant, signatures)))
            });
            let around: Vec<_> = around.collect();
            match around.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((gain, variant)) if gain > most + settings.min_refining_gain => {
                    (best, most) = (Some(variant), gain);
                }
                _ => {
                    share /= 2.0;
                    if time.is_some() {
                        left = settings.refining_rounds;
                    }
                }
            }
        }
        best
    }
}
