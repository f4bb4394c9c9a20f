//! Refits with the whole simulator, each made once.

use super::done::{Key, Step};
use super::{Found, Screened, Search};
use crate::base::{Calibration, with_vehicle};
use crate::fit::{Fit, Point};
use crate::hypothesis::{Hypothesis, active, unknowns_of};
use crate::prior::prior;
use trackdyn_model::EffectId;

impl Search {
    /// Refits the hypothesis with more effects. It starts from where an earlier search left them,
    /// if that keeps the gain that the screen promises now.
    pub fn refit(&self, beside: &Found, more: &[Screened]) -> Found {
        let added: Vec<EffectId> = more.iter().map(|one| one.effect).collect();
        let (effects, _) = beside.extended(&added);
        let earlier = self.again(&effects);
        let serves = |found: &Found| {
            !self.is_worse(found, beside) && self.keeps_promise(found, beside, promised(more))
        };
        if let Some(found) = earlier.as_ref().filter(|found| serves(found)) {
            return found.clone();
        }
        let added = more.iter().map(|one| (one.entry, one.sizes.clone())).collect();
        let anew = || self.refitted(beside, more);
        let anew = self.done.or_else(Key::step(beside, Step::Add(added)), anew);
        earlier.into_iter().fold(anew, |anew, earlier| {
            if earlier.ln_evidence > anew.ln_evidence { earlier } else { anew }
        })
    }

    /// Whether a hypothesis with more effects keeps enough of the ln evidence that these promised.
    fn keeps_promise(&self, found: &Found, beside: &Found, promised: f64) -> bool {
        let settings = &self.settings().search;
        let kept = found.ln_evidence - beside.ln_evidence;
        promised < settings.min_ln_evidence || kept > settings.min_kept_share * promised
    }

    /// The hypothesis with these effects, refitted from where an earlier search left it; none where
    /// there it was not tried.
    pub(super) fn again(&self, effects: &[EffectId]) -> Option<Found> {
        let earlier = self.known.with(effects)?;
        let again = || self.recalibrated(effects.to_vec(), earlier.refitted(&self.evidence));
        Some(self.done.or_else(Key::Again(effects.to_vec()), again))
    }

    /// Whether a hypothesis with more effects fits worse than that without them.
    fn is_worse(&self, found: &Found, without: &Found) -> bool {
        let most = self.settings().search.max_rise_of_nested;
        found.fit.objective > without.fit.objective + most
    }

    fn refitted(&self, beside: &Found, more: &[Screened]) -> Found {
        let settings = &self.settings().search;
        let added: Vec<EffectId> = more.iter().map(|one| one.effect).collect();
        let (effects, unknowns) = beside.extended(&added);
        let evidence = &self.evidence;
        let at = |hypothesis: Hypothesis| {
            Point::new(hypothesis, &unknowns, evidence, Some(&beside.fit.mechanics))
        };
        let start = |share: f64| at(self.with(beside, more, share));
        let fitted = |start: Point| {
            let fit = Fit::from_point(start, &unknowns, evidence);
            self.recalibrated(effects.clone(), fit)
        };
        // For a nonlinear law the screen may promise a size so large that the fit does not return
        // from it. If the point explains less than no effect, or the fit keeps little of the
        // promised gain, a start at smaller sizes is tried too: either may lie beyond a crest of
        // the objective.
        // More effects at no size are the hypothesis without them: no fit need end worse.
        let no_worse = |found: Found| {
            if !self.is_worse(&found, beside) {
                return found;
            }
            let none = fitted(at(self.at_no_size(beside, more)));
            if none.fit.objective < found.fit.objective { none } else { found }
        };
        let kept = |found: &Found| found.ln_evidence - beside.ln_evidence;
        let mut far = Some(start(1.0));
        let is_less = |far: &mut Point| far.objective < beside.fit.objective;
        let found = fitted(far.take_if(is_less).unwrap_or_else(|| start(settings.near_start)));
        if self.keeps_promise(&found, beside, promised(more)) {
            return no_worse(found);
        }
        let second = far.unwrap_or_else(|| start(settings.near_start));
        if second.objective.is_infinite() {
            return no_worse(found);
        }
        let other = fitted(second);
        no_worse(if kept(&other) > kept(&found) { other } else { found })
    }

    /// The hypothesis with more effects, at a share of the screened sizes.
    fn with(&self, beside: &Found, more: &[Screened], share: f64) -> Hypothesis {
        let mut hypothesis = beside.fit.hypothesis.clone();
        for one in more {
            let variant = &self.catalogue.entries[one.entry].0;
            let sizes: Vec<f64> = one.sizes.iter().map(|size| share * size).collect();
            let present = hypothesis.effect(one.effect).map(|effect| effect.values().to_vec());
            let values = match present {
                // Already present: its size changes from its present value.
                Some(mut values) => {
                    for (&place, size) in variant.sizes().iter().zip(&sizes) {
                        values[place] += size;
                    }
                    values
                }
                None => variant.with_sizes(&sizes).values,
            };
            hypothesis = hypothesis.with_effect(active(one.effect, &values));
        }
        hypothesis
    }

    /// The hypothesis with more effects at size zero, with their other numbers at the expected
    /// values. It is as good as the hypothesis without them.
    fn at_no_size(&self, beside: &Found, more: &[Screened]) -> Hypothesis {
        let hypothesis = &beside.fit.hypothesis;
        let added = more.iter().filter(|one| hypothesis.effect(one.effect).is_none());
        let added = added.flat_map(|one| unknowns_of(one.effect));
        added.fold(self.with(beside, more, 0.0), |all, unknown| {
            let expected = all.get(unknown) + prior(&all, unknown, &self.evidence).mean;
            all.with(unknown, expected)
        })
    }

    /// Refits after constant ICR offsets were converted to the vehicle's own numbers: friction and
    /// centre of gravity had absorbed what an added effect now explains.
    pub(crate) fn recalibrated(&self, effects: Vec<EffectId>, mut fit: Fit) -> Found {
        let settings = &self.settings().search;
        for _ in 0..settings.recalibrations {
            let calibration = self.base.calibration;
            let moved: [f64; 3] = std::array::from_fn(|k| {
                fit.hypothesis.offset[k] - self.base.fit.hypothesis.offset[k]
            });
            if calibration.due(moved) < settings.max_offset * fit.hypothesis.vehicle.gauge {
                break;
            }
            let Some(again) = calibration.calibrated(&fit.hypothesis) else { break };
            let (unknowns, before) = (&fit.unknowns, Some(&fit.mechanics));
            let again = Fit::new(again, unknowns, &self.evidence, before);
            if again.objective >= fit.objective {
                break;
            }
            fit = again;
        }
        self.found(effects, fit)
    }

    /// Expresses the constant ICRs by another of the vehicle's numbers, where the effects found now
    /// favour that one.
    pub(super) fn with_best_calibration(&self, found: Found) -> Found {
        let filed = &self.base.as_filed.hypothesis.vehicle;
        let Some(whole) = with_vehicle(&found.fit.hypothesis, filed) else { return found };
        let least = self.settings().search.min_fall_of_meaning;
        let mut best = found;
        for calibration in Calibration::ALL {
            let Some(hypothesis) = calibration.calibrated(&whole) else { continue };
            let (unknowns, before) = (&best.fit.unknowns, Some(&best.fit.mechanics));
            let fit = Fit::new(hypothesis, unknowns, &self.evidence, before);
            if fit.objective < best.fit.objective - least {
                best = self.found(best.effects, fit);
            }
        }
        best
    }

    /// A hypothesis whose runs begin in the motions that suit it best.
    pub fn with_own_starts(&self, found: Found) -> Found {
        match found.fit.with_own_starts(&self.evidence) {
            Some(fit) => self.found(found.effects, fit),
            None => found,
        }
    }

    /// The hypothesis without one of its added effects, refitted from there: the base itself may be
    /// a worse local minimum.
    pub fn without(&self, found: &Found, effect: EffectId) -> Found {
        let others = found.effects.iter().copied().filter(|other| *other != effect);
        let others: Vec<EffectId> = others.collect();
        let is_base = others.is_empty();
        let without = self.again(&others).unwrap_or_else(|| {
            let left_out = || self.left_out(found, effect, others);
            self.done.or_else(Key::step(found, Step::Leave(effect)), left_out)
        });
        // The base itself, but for rounding: its refits are known.
        let lower = self.base.fit.objective - without.fit.objective;
        let is_same = lower <= self.settings().search.max_rise_of_nested;
        if is_base && is_same { self.nothing() } else { without }
    }

    fn left_out(&self, found: &Found, effect: EffectId, effects: Vec<EffectId>) -> Found {
        let hypothesis = found.fit.hypothesis.with_effect_of(&self.base.fit.hypothesis, effect);
        let unknowns = found.fit.unknowns_without(effect);
        let before = Some(&self.base.fit.mechanics);
        let fit = Fit::new(hypothesis, &unknowns, &self.evidence, before);
        let without = self.recalibrated(effects, fit);
        let rise = without.fit.objective / found.fit.objective - 1.0;
        let may_be_near = rise < self.settings().search.max_rise_by_starts;
        if may_be_near { self.with_own_starts(without) } else { without }
    }
}

/// Largest gain of ln evidence that the screen promised of these.
fn promised(more: &[Screened]) -> f64 {
    more.iter().map(|one| one.gain).fold(0.0, f64::max)
}
