//! Candidates: every effect of the catalogue and laws of a user, and their signatures in this
//! evidence.
//!
//! The signature of an effect is the prediction with it minus that without, each solved in full,
//! since a law may not be differentiable at zero size. Where a law has shapes, directions or places
//! besides its size, several variants are tried, and the best one stands for the effect.

mod between;
mod driven;
mod places;

use crate::evidence::Evidence;
use crate::hypothesis::{Hypothesis, Unknown, active, neutral};
use crate::mechanics::{Instruments, Mechanics, is_instrument};
use crate::prior::area;
use crate::progress::Cancelled;
use crate::weighted::Weighted;
use driven::Driven;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::BTreeSet;
use trackdyn_model::effect::{Card, Parameter, Role};
use trackdyn_model::{ActiveEffect, EffectId};

/// An effect with one choice of shape, direction and place.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// The effect.
    pub effect: EffectId,
    /// Values of all parameters; the signature is taken at these sizes.
    pub values: Vec<f64>,
}

/// Signatures of all candidates: some variants of each effect.
#[derive(Default)]
pub struct Catalogue {
    /// Each variant with its signatures.
    pub entries: Vec<(Variant, Vec<Signature>)>,
}

/// Derivative of the prediction by a size of an effect.
#[derive(Clone, Debug)]
pub struct Signature {
    /// The size.
    pub unknown: Unknown,
    /// Change of the prediction per unit of the size, whitened.
    pub column: Vec<Vector3<f64>>,
}

impl Catalogue {
    /// These signatures whitened by evidence; before, they were whitened by other evidence of the
    /// same samples.
    pub fn whitened_by(mut self, evidence: &Weighted, before: &Weighted) -> Self {
        self.entries.par_iter_mut().for_each(|(_, signatures)| {
            for signature in signatures {
                let column = std::mem::take(&mut signature.column);
                signature.column = evidence.white(before.raw(column));
            }
        });
        self
    }
}

impl Variant {
    /// Indices of the sizes among the parameters.
    pub fn sizes(&self) -> Vec<usize> {
        sizes(self.effect)
    }

    /// The variant with sizes at these distances from the neutral ones.
    pub fn with_sizes(&self, sizes: &[f64]) -> Self {
        let mut variant = self.clone();
        for (&parameter, &size) in self.sizes().iter().zip(sizes) {
            let card = &self.effect.card().parameters[parameter];
            let [low, high] = card.range;
            variant.values[parameter] = (neutral(card) + size).clamp(low, high);
        }
        variant
    }

    /// Signatures of all sizes; none where the effect cannot act.
    fn signatures(&self, beside: &Beside) -> Option<Vec<Signature>> {
        self.sizes().into_iter().map(|size| self.signature(size, beside)).collect()
    }

    /// Signature of a size, at the first step for which a motion exists.
    fn signature(&self, size: usize, beside: &Beside) -> Option<Signature> {
        let parameters = self.effect.card().parameters;
        let mut values = self.values.clone();
        let mut steps = &beside.evidence.settings().candidates.size_steps[..];
        if let Some(present) = beside.hypothesis.effect(self.effect) {
            // Already present: signature of an increase.
            values = present.values().to_vec();
            steps = &steps[1..];
        } else {
            for size in self.sizes() {
                values[size] = neutral(&parameters[size]);
            }
        }
        let (before, [low, high]) = (values[size], parameters[size].range);
        let typical = self.values[size] - neutral(&parameters[size]);
        steps.iter().find_map(|step| {
            values[size] = (before + step * typical).clamp(low, high);
            let distance = values[size] - before;
            if distance == 0.0 {
                return None;
            }
            let change = beside.change(active(self.effect, &values))?;
            let quotient = change.iter().map(|change| change / distance).collect();
            let column = beside.evidence.white(quotient);
            Some(Signature { unknown: Unknown::Effect(self.effect, size), column })
        })
    }
}

/// The hypothesis beside which signatures are computed.
pub struct Beside<'a> {
    hypothesis: &'a Hypothesis,
    evidence: &'a Weighted,
    mechanics: Mechanics,
    prediction: Vec<Vector3<f64>>,
    driven: Driven,
}

/// Indices of the sizes among an effect's parameters.
pub fn sizes(effect: EffectId) -> Vec<usize> {
    let parameters = effect.card().parameters.iter().enumerate();
    parameters
        .filter(|(_, parameter)| matches!(parameter.role, Role::Size { .. }))
        .map(|(place, _)| place)
        .collect()
}

/// All variants of the suspected mechanisms that are tried on this evidence, except instruments
/// that are free anyway.
pub fn candidates(
    suspects: &[EffectId],
    instruments: &[EffectId],
    evidence: &Evidence,
) -> Vec<Variant> {
    let tried = |effect: &&EffectId| !instruments.contains(*effect) && !effect.card().is_form();
    suspects.iter().filter(tried).flat_map(|effect| variants(*effect, evidence)).collect()
}

/// Variants of an effect tried on this evidence: none for effects of place or direction where there
/// is no common world.
pub fn variants(effect: EffectId, evidence: &Evidence) -> Vec<Variant> {
    let card = effect.card();
    let parameters = card.parameters;
    let of_the_world =
        |parameter: &Parameter| matches!(parameter.role, Role::Place { .. } | Role::Direction);
    if !evidence.has_world() && parameters.iter().any(of_the_world) {
        return Vec::new();
    }
    let mut all = vec![Vec::new()];
    for parameter in parameters {
        let choices = choices(parameter, card, evidence);
        all = all
            .into_iter()
            .flat_map(|values: Vec<f64>| {
                choices.iter().map(move |choice| {
                    let mut values = values.clone();
                    values.push(*choice);
                    values
                })
            })
            .collect();
    }
    // What begins at a time ends later.
    let is_time = |place: &usize| parameters[*place].role == Role::Time;
    let times: Vec<usize> = (0..parameters.len()).filter(is_time).collect();
    all.retain(|values| times.is_sorted_by(|a, b| values[*a] < values[*b]));
    let all = all.into_iter().flat_map(|values| places::of_extent(card, values, evidence));
    all.map(|values| Variant { effect, values }).collect()
}

/// Values of a parameter that are tried.
fn choices(parameter: &Parameter, of: &Card, evidence: &Evidence) -> Vec<f64> {
    let [low, high] = parameter.range;
    let inside = |value: f64| value.clamp(low, high);
    let settings = &evidence.settings().candidates;
    let step = spacing(parameter, None, evidence);
    match parameter.role {
        Role::Size { .. } if of.shears() => {
            let distance = parameter.typical - neutral(parameter);
            settings.shear_sizes.map(|part| inside(neutral(parameter) + part * distance)).to_vec()
        }
        Role::Size { .. } => vec![parameter.typical],
        Role::Direction => {
            let angles = (0..).map(|k| step * f64::from(k)).take_while(|angle| *angle < 360.0);
            angles.map(inside).collect()
        }
        Role::Shape => shapes(parameter, settings.shape_ratio),
        Role::Time => {
            let driven = Driven::of(evidence);
            let half = driven.whole() / 2.0;
            // A single change before or after the recording changes nothing in it.
            let times = of.parameters.iter().filter(|one| one.role == Role::Time).count();
            let is_tried = |time: &f64| times > 1 || time.abs() < 1.0;
            let tried = settings.times.into_iter().filter(is_tried);
            tried.map(|time| inside(driven.clock(half + time * half))).collect()
        }
        Role::Place { .. } if of.has_extent() => vec![parameter.typical],
        Role::Place { .. } => {
            let [middle, _] = area(evidence, parameter.role);
            settings.places.map(|place| inside(middle + place * step)).to_vec()
        }
    }
}

/// Shapes that are tried: the typical one and one on either side, or all inside where it is an end
/// of the range.
fn shapes(parameter: &Parameter, ratio: f64) -> Vec<f64> {
    let [low, high] = parameter.range;
    let steps = match parameter.typical {
        typical if typical == high => [-1.0, -0.5, 0.0],
        typical if typical == low => [0.0, 0.5, 1.0],
        _ => [-1.0, 0.0, 1.0],
    };
    let tried = steps.map(|k| (parameter.typical * (k * ratio.ln()).exp()).clamp(low, high));
    let mut tried = tried.to_vec();
    tried.dedup();
    tried
}

/// Spacing of the values that are tried. For a place it is its extent, or that of the driving; for
/// a shape it is logarithmic; for a time it is in driven time.
fn spacing(parameter: &Parameter, extent: Option<f64>, evidence: &Evidence) -> f64 {
    match parameter.role {
        Role::Size { .. } => 0.0,
        Role::Direction => evidence.settings().candidates.direction_step,
        Role::Shape => evidence.settings().candidates.shape_ratio.ln(),
        Role::Time => {
            let [earlier, later, ..] = evidence.settings().candidates.times;
            (later - earlier) * Driven::of(evidence).whole() / 2.0
        }
        Role::Place { .. } => extent.unwrap_or_else(|| area(evidence, parameter.role)[1]),
    }
}

impl<'a> Beside<'a> {
    /// A hypothesis on this evidence.
    pub fn new(hypothesis: &'a Hypothesis, evidence: &'a Weighted) -> Self {
        let mechanics = Mechanics::new(hypothesis, evidence);
        let prediction = mechanics.predict(&Instruments::of(hypothesis), evidence);
        Self { hypothesis, evidence, mechanics, prediction, driven: Driven::of(evidence) }
    }

    /// Whether the hypothesis has the effect already.
    pub fn knows(&self, variant: &Variant) -> bool {
        self.hypothesis.effect(variant.effect).is_some()
    }

    /// Change of the prediction by an effect; none where it has no motion.
    fn change(&self, effect: ActiveEffect) -> Option<Vec<Vector3<f64>>> {
        let is_instrument = is_instrument(&self.hypothesis.vehicle, &effect);
        let with = self.hypothesis.with_effect(effect);
        let instruments = Instruments::of(&with);
        let with = if is_instrument {
            self.mechanics.predict(&instruments, self.evidence)
        } else {
            let mechanics = Mechanics::beside(Some(&self.mechanics), &with, self.evidence);
            if mechanics.failure().is_some() {
                return None;
            }
            mechanics.predict(&instruments, self.evidence)
        };
        let changes = with.iter().zip(&self.prediction).map(|(with, without)| with - without);
        let changes: Vec<Vector3<f64>> = changes.collect();
        // A NaN would spoil all other columns of the normal equations.
        let are_numbers = changes.iter().flatten().all(|change| change.is_finite());
        are_numbers.then_some(changes)
    }

    /// Signatures of variants, in parallel, without those that cannot act. An effect already
    /// present has one variant only: its shape, direction and place are given.
    pub fn signatures(&self, variants: &[Variant]) -> Vec<(Variant, Vec<Signature>)> {
        self.signatures_while(variants, || Ok(())).unwrap_or_default()
    }

    /// [`Self::signatures`], as long as `go_on` lets it.
    ///
    /// # Errors
    /// [`Cancelled`], by `go_on`.
    pub fn signatures_while(
        &self,
        variants: &[Variant],
        go_on: impl Fn() -> Result<(), Cancelled> + Sync,
    ) -> Result<Vec<(Variant, Vec<Signature>)>, Cancelled> {
        let mut known = BTreeSet::new();
        let is_own = |variant: &&Variant| !self.knows(variant) || known.insert(variant.effect);
        let tried: Vec<&Variant> = variants.iter().filter(is_own).collect();
        let entry = |variant: &Variant| Some((variant.clone(), variant.signatures(self)?));
        let entries = tried.into_par_iter().map(|variant| {
            go_on()?;
            Ok(entry(variant))
        });
        entries.filter_map(Result::transpose).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::hypothesis::typical;
    use crate::plan::assumed_noise;
    use crate::settings::Settings;
    use trackdyn_core::rounding::Digits;
    use trackdyn_core::{Pose, real};
    use trackdyn_model::VehicleFile;
    use trackdyn_recording::TrackSample;

    /// Turns in which both tracks change their speeds by 1.5 m/s² all the time.
    fn restless() -> Weighted {
        let wave = |t: f64, period: f64| (4.0 * (t / period).fract() - 2.0).abs() - 1.0;
        let reading = |k: usize| {
            let t = 0.03 * real(k);
            TrackSample { t, v_left: 0.6 * wave(t, 1.6), v_right: 0.75 * wave(t + 0.3, 2.0) }
        };
        let tracks = (0..=60 * READINGS).map(reading).collect();
        let run = PlannedRun { tracks, pose: Pose::default(), blocks: vec![0] };
        let noise = assumed_noise(1e-3, 1e-3);
        Weighted::new(Evidence::planned(&[run], noise, 0.0, &Settings::default(), |evidence| {
            vec![Vector3::zeros(); evidence.samples().len()]
        }))
    }

    /// A robot that accelerates all the time responds to each effect differently from one in steady
    /// motion. Changes of the acceleration itself by instruments are left to the fit.
    #[test]
    fn a_signature_beside_inertia_is_the_change_of_a_whole_simulation() {
        let evidence = restless();
        let predicted = |of: &Hypothesis| {
            Mechanics::new(of, &evidence).predict(&Instruments::of(of), &evidence)
        };
        let still = Hypothesis::filed(&VehicleFile::auriga_alpha(), &evidence.settings().prior);
        let with = |of: Hypothesis, id: &str| of.with_effect(id.parse().expect("an effect"));
        let moving = ["yaw-inertia", "centripetal"].into_iter().fold(still, with);
        let filed = with(moving.clone(), "load-transfer:cog_height_m=0.1");
        let height = EffectId::of("load-transfer").expect("an effect");
        let mut cases: Vec<(&Hypothesis, ActiveEffect)> =
            [0.11, 0.2].map(|to| (&filed, active(height, &[to]))).to_vec();
        let others = EffectId::all().filter(|one| {
            let card = one.card();
            !card.is_form() && !card.is_inertia() && !is_instrument(&moving.vehicle, &typical(*one))
        });
        cases.extend(others.map(|one| (&moving, typical(one))));
        for (base, effect) in cases {
            let id = effect.card().id;
            let whole = predicted(&base.with_effect(effect.clone()));
            let found = Beside::new(base, &evidence).change(effect).expect("it drives");
            let (mut off, mut all) = (0.0, 0.0);
            for ((found, whole), here) in found.iter().zip(&whole).zip(&predicted(base)) {
                off += (found - (whole - here)).norm_squared();
                all += (whole - here).norm_squared();
            }
            // a patch may lie where the robot never is
            let is_whole = off <= 0.0025 * all + 1e-12;
            assert!(is_whole, "{id}: {} of the change is missing", (off / all).sqrt());
        }
    }

    #[test]
    fn shapes_are_tried_on_both_sides_or_inside_of_an_end() {
        let tried = |id: &str, key: &str| {
            let card = EffectId::of(id).expect("an effect").card();
            let parameter = card.parameters.iter().find(|one| one.key == key).expect("a key");
            let tried = shapes(parameter, 2.5).into_iter();
            tried.map(|shape| Digits::Decimals(3).round(shape)).collect::<Vec<_>>()
        };
        assert_eq!(tried("terrain-patch", "radius_m"), [0.8, 2.0, 5.0]);
        assert_eq!(tried("shear-displacement", "residual"), [0.4, 0.632, 1.0]);
    }
}
