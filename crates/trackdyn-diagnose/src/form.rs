//! What the form of a law leaves.
//!
//! No law of nature has the form of the catalogue to the digit: friction grows with another power
//! of the slip, a drag is half constant and half grows with speed. What such a law does to the
//! motion then differs by a part that varies smoothly with the driving.
//!
//! # Law
//! Where a fitted law changes the motion of a sample by d, nature changes it by d (1 + ε), in each
//! channel. ε = Σ c_j b_j with b_j a constant and smooth functions of the driving, each of unit
//! mean square, and c_j normal with variance τ²/n. A law that breaks neither S nor P has no other
//! form at other speeds; ε varies with direction, side and time only where the law itself does.
//!
//! A size in the vehicle file that is not fitted is known only to a share. So the form of such a
//! law is what is orthogonal to the change by its size: a wrong size must not pass for another
//! form.
//!
//! The c_j are factors of columns d b_j beside those of the unknowns. τ is none or one of a few
//! values, all equally probable: the evidence is the mean over them, and the most probable value
//! weighs the columns wherever else they count.
//!
//! # Assumes
//! d is taken as size times derivative.

use crate::candidate::{Catalogue, sizes};
use crate::equations::{Column, Equations, at_right_angles, square};
use crate::evidence::{Evidence, Sample};
use crate::fit::Fit;
use crate::hypothesis::{Unknown, beyond_none, typical};
use crate::mechanics::is_instrument;
use crate::normal::{Prior, ln_mean};
use crate::prior::priors;
use crate::weighted::Weighted;
use nalgebra::Vector3;
use trackdyn_core::real;
use trackdyn_model::effect::Symmetry;
use trackdyn_model::{ActiveEffect, EffectId};

/// Columns by which the laws of a hypothesis may differ in form from those of nature.
#[derive(Clone, Debug, Default)]
pub struct Forms {
    /// The columns, whitened and scaled.
    pub columns: Vec<Column>,
    /// Prior of the factor of each column.
    pub priors: Vec<Prior>,
    /// Standard deviations of the factors of the first columns; the others have their own.
    shares: Vec<Share>,
    /// Most probable relative standard deviation τ of the forms; zero where they are exact.
    pub deviation: f64,
    /// ln of the mean evidence over all τ, less that of exact forms.
    pub gain: f64,
}

impl Forms {
    /// Forms of the laws of forces in a fitted hypothesis, with τ the most probable of these
    /// deviations and none. The catalogue has the derivatives by sizes of the vehicle file.
    pub fn of(fit: &Fit, deviations: &[f64], catalogue: &Catalogue, evidence: &Weighted) -> Self {
        let widest = deviations.iter().copied().fold(0.0, f64::max);
        let (columns, shares) = columns(fit, widest, catalogue, evidence);
        if columns.is_empty() {
            return Self::default();
        }
        let all = [&fit.columns[..], &columns[..]].concat();
        let normal = evidence.normal(&fit.residual, &all);
        let known = priors(&fit.hypothesis, &fit.unknowns, evidence);
        let exact = normal.fit(&fit.free, &known).ln_evidence;
        let of_forms = fit.columns.len()..all.len();
        let free: Vec<usize> = fit.free.iter().copied().chain(of_forms).collect();
        let gain_at = |&deviation: &f64| {
            let known = [&known[..], &scaled(&shares, deviation)].concat();
            let gain = normal.fit(&free, &known).ln_evidence - exact;
            // A sum that is singular tells nothing of forms.
            if gain.is_finite() { gain } else { f64::NEG_INFINITY }
        };
        let gains: Vec<f64> = deviations.iter().map(gain_at).collect();
        let gain = ln_mean(gains.iter().copied().chain([0.0]));
        let best = gains.iter().zip(deviations).max_by(|a, b| a.0.total_cmp(b.0));
        match best.filter(|(gain, _)| **gain > 0.0) {
            Some((_, &deviation)) => {
                Self { columns, priors: scaled(&shares, deviation), shares, deviation, gain }
            }
            None => Self { gain, ..Self::default() },
        }
    }

    /// Forms beside another column that is free wherever they are.
    pub fn beside(mut self, more: Option<(Column, Prior)>) -> Self {
        let (columns, priors): (Vec<Column>, Vec<Prior>) = more.into_iter().unzip();
        self.columns.extend(columns);
        self.priors.extend(priors);
        self
    }

    /// Forms with this τ, whatever the evidence says of it.
    pub fn at(fit: &Fit, deviation: f64, catalogue: &Catalogue, evidence: &Weighted) -> Self {
        let (columns, shares) = columns(fit, deviation, catalogue, evidence);
        Self { columns, priors: scaled(&shares, deviation), shares, deviation, gain: 0.0 }
    }

    /// What is free in equations at each of these τ and without forms, which all are equally
    /// probable. Their forms are at `first` and after; as the equations say where laws are exact.
    pub fn alternatives(
        &self,
        equations: &Equations,
        first: usize,
        deviations: &[f64],
    ) -> Vec<Alternative> {
        let Equations { free, priors, .. } = equations;
        let own = first..first + self.shares.len();
        let as_it_is = Alternative { free: free.clone(), priors: priors.clone() };
        if own.is_empty() {
            return vec![as_it_is];
        }
        let at = |&deviation: &f64| {
            let mut there = as_it_is.clone();
            there.priors.splice(own.clone(), scaled(&self.shares, deviation));
            there
        };
        let exact = free.iter().copied().filter(|column| !own.contains(column)).collect();
        let exact = Alternative { free: exact, priors: priors.clone() };
        deviations.iter().map(at).chain([exact]).collect()
    }
}

/// What is free in equations at one deviation of the forms.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// The free columns.
    pub free: Vec<usize>,
    /// Prior of the factor of each column of the equations.
    pub priors: Vec<Prior>,
}

/// Standard deviation of the factor of a column.
#[derive(Clone, Copy, Debug)]
enum Share {
    /// As part of τ.
    OfForms(f64),
    /// Whatever τ is.
    Known(f64),
}

impl Share {
    fn at(self, deviation: f64) -> f64 {
        match self {
            Self::OfForms(part) => part * deviation,
            Self::Known(deviation) => deviation,
        }
    }
}

/// Priors of factors that have these shares of a deviation.
fn scaled(shares: &[Share], deviation: f64) -> Vec<Prior> {
    shares.iter().map(|share| Prior::normal(0.0, share.at(deviation))).collect()
}

/// Columns of all laws of a fit, each with the deviation of its factor; without those that show
/// nothing at this τ.
fn columns(
    fit: &Fit,
    deviation: f64,
    catalogue: &Catalogue,
    evidence: &Weighted,
) -> (Vec<Column>, Vec<Share>) {
    let functions = Functions::of(evidence);
    let mut columns: Vec<(Column, Share)> = Vec::new();
    for law in fit.hypothesis.effects.iter().map(ActiveEffect::effect) {
        let Some(change) = change(fit, catalogue, law) else { continue };
        let raw = evidence.raw(change.clone());
        let smooth = functions.of_law(law);
        let share = Share::OfForms(real(smooth.len()).sqrt().recip());
        let products = smooth.into_iter().flat_map(|function| products(&raw, function, evidence));
        if fit.unknowns.iter().any(|unknown| unknown.is_of(law)) {
            columns.extend(products.map(|column| (column, share)));
        } else {
            columns.extend(products.map(|column| (at_right_angles(column, &change), share)));
            let known = Share::Known(evidence.settings().verdict.max_form_error);
            columns.push((change, known));
        }
    }
    let least = evidence.settings().prior.min_form_effect;
    columns.retain(|(column, share)| share.at(deviation) * square(column).sqrt() > least);
    columns.into_iter().unzip()
}

/// Change of the prediction by a law, whitened and scaled; none for instruments and Newton's law,
/// which have no other form, and where no derivative is known.
fn change(fit: &Fit, catalogue: &Catalogue, law: EffectId) -> Option<Column> {
    let active = fit.hypothesis.effect(law)?;
    if law.card().is_inertia() || is_instrument(&fit.hypothesis.vehicle, &typical(law)) {
        return None;
    }
    let fitted = fit.unknowns.iter().zip(&fit.columns);
    let of_fit: Vec<(Unknown, &Column)> = fitted
        .filter(|(unknown, _)| unknown.is_of(law))
        .map(|(unknown, c)| (*unknown, c))
        .collect();
    let derivatives = if of_fit.is_empty() {
        let known = catalogue.entries.iter().find(|(variant, _)| variant.effect == law)?;
        known.1.iter().map(|signature| (signature.unknown, &signature.column)).collect()
    } else {
        of_fit
    };
    let sizes = sizes(law);
    let mut change: Option<Column> = None;
    for (unknown, derivative) in derivatives {
        let Unknown::Effect(_, place) = unknown else { continue };
        if !sizes.contains(&place) {
            continue;
        }
        let size = beyond_none(active, place);
        let sum = change.get_or_insert_with(|| vec![Vector3::zeros(); derivative.len()]);
        for (sum, value) in sum.iter_mut().zip(derivative) {
            *sum += value * size;
        }
    }
    change
}

/// A change times a function, in each channel by itself, whitened and scaled.
fn products<'a>(
    change: &'a Column,
    function: &'a [f64],
    evidence: &'a Weighted,
) -> impl Iterator<Item = Column> + use<'a> {
    (0..3).map(move |channel| {
        let of_channel = change.iter().zip(function).map(|(value, by)| {
            let mut only = Vector3::zeros();
            only[channel] = value[channel] * by;
            only
        });
        evidence.white(of_channel.collect())
    })
}

/// Smooth functions of the driving, at each sample.
struct Functions {
    one: Vec<f64>,
    /// ln speed and its square.
    speed: [Vec<f64>; 2],
    /// |V_r − V_l|/(|V_r| + |V_l|)
    turning: Vec<f64>,
    /// (V_r + V_l)/(|V_r| + |V_l|)
    forward: Vec<f64>,
    /// (V_r − V_l)/(|V_r| + |V_l|)
    side: Vec<f64>,
    time: Vec<f64>,
}

impl Functions {
    fn of(evidence: &Evidence) -> Self {
        /// Least sum of the belt speeds that enters a logarithm or a quotient, m/s.
        const MIN_SPEED: f64 = 1e-3;
        let of = |function: &dyn Fn(&Sample) -> f64| -> Vec<f64> {
            evidence.samples().iter().map(function).collect()
        };
        let whole = |sample: &Sample| {
            let [left, right] = [sample.speeds.left, sample.speeds.right].map(f64::abs);
            (left + right).max(MIN_SPEED)
        };
        let speed = standardised(of(&|sample| whole(sample).ln()));
        let squared = standardised(speed.iter().map(|speed| speed * speed).collect());
        let side = of(&|sample| (sample.speeds.right - sample.speeds.left) / whole(sample));
        let forward = of(&|sample| (sample.speeds.right + sample.speeds.left) / whole(sample));
        Self {
            one: of(&|_| 1.0),
            speed: [speed, squared],
            turning: standardised(side.iter().map(|side| side.abs()).collect()),
            forward: standardised(forward),
            side: standardised(side),
            time: standardised(of(&|sample| sample.start)),
        }
    }

    /// The functions on which the form of a law may depend; none where it acts as constant ICRs.
    fn of_law(&self, law: EffectId) -> Vec<&[f64]> {
        let breaks = law.card().breaks;
        let is_of = |symmetry: Symmetry| breaks.contains(&symmetry);
        let [fast, faster] = &self.speed;
        let mut smooth: Vec<&[f64]> = Vec::new();
        if is_of(Symmetry::SpeedScale) || is_of(Symmetry::Manoeuvre) {
            smooth.extend([&fast[..], faster, &self.turning]);
        }
        let others = [
            (Symmetry::Reversal, &self.forward),
            (Symmetry::Mirror, &self.side),
            (Symmetry::Time, &self.time),
        ];
        if breaks.iter().any(|symmetry| *symmetry != Symmetry::Mirror) {
            smooth.push(&self.one);
            smooth.extend(others.iter().filter(|(of, _)| is_of(*of)).map(|(_, by)| &by[..]));
        }
        smooth
    }
}

/// Values less their mean, in units of their root mean square; zeros where they are alike.
fn standardised(values: Vec<f64>) -> Vec<f64> {
    let count = real(values.len().max(1));
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    let scale = if square > 0.0 { square.sqrt().recip() } else { 0.0 };
    values.into_iter().map(|value| scale * (value - mean)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::candidate::{Signature, Variant};
    use crate::evidence::planned::{PlannedRun, READINGS};
    use crate::hypothesis::{Hypothesis, active, unknowns_of};
    use crate::mechanics::{Instruments, Mechanics};
    use crate::plan::assumed_noise;
    use crate::settings::Settings;
    use trackdyn_core::Pose;
    use trackdyn_model::VehicleFile;
    use trackdyn_recording::TrackSample;

    const TRIED: [f64; 3] = [0.1, 0.2, 0.4];

    /// Arcs and spins at many speeds.
    fn runs() -> Vec<PlannedRun> {
        let speeds = |k: usize| {
            let fast = 0.1 + 0.09 * real(k % 11);
            [fast * (0.9 - 0.3 * real(k % 7)), fast]
        };
        let reading = |k: usize| {
            let [v_left, v_right] = speeds(k / (4 * READINGS));
            TrackSample { t: 0.03 * real(k), v_left, v_right }
        };
        let tracks = (0..=400 * READINGS).map(reading).collect();
        let blocks = (0..100).map(|k| 4 * k * READINGS).collect();
        vec![PlannedRun { tracks, pose: Pose::default(), blocks }]
    }

    /// Forms of a fitted law where nature's is stronger by the part `bend` at each speed, and the
    /// half width of the interval of its size with and without them.
    fn fitted(bend: impl Fn(&Sample) -> f64) -> (Forms, [f64; 2]) {
        let law = EffectId::of("viscous-friction").expect("an effect");
        let settings = Settings::default();
        let without = Hypothesis::filed(&VehicleFile::auriga_alpha(), &settings.prior);
        let with = without.with_effect(active(law, &[1.0]));
        let predicted = |hypothesis: &Hypothesis, evidence: &Evidence| {
            Mechanics::new(hypothesis, evidence).predict(&Instruments::of(hypothesis), evidence)
        };
        let evidence =
            Evidence::planned(&runs(), assumed_noise(1e-4, 1e-4), 0.0, &settings, |evidence| {
                let motions = [&without, &with].map(|hypothesis| predicted(hypothesis, evidence));
                let [without, with] = motions;
                let both = with.iter().zip(&without).zip(evidence.samples());
                both.map(|((with, without), sample)| with + (with - without) * bend(sample))
                    .collect()
            });
        let evidence = Weighted::new(evidence);
        let unknowns: Vec<Unknown> = unknowns_of(law).collect();
        let fit = Fit::new(with, &unknowns, &evidence, None);
        let forms = Forms::of(&fit, &TRIED, &Catalogue::default(), &evidence);
        let all = [&fit.columns[..], &forms.columns].concat();
        let known = [&priors(&fit.hypothesis, &unknowns, &evidence)[..], &forms.priors].concat();
        let normal = evidence.normal(&fit.residual, &all);
        let half = |count: usize| {
            let columns: Vec<usize> = (0..count).collect();
            normal.fit(&columns, &known).covariance[(0, 0)].sqrt()
        };
        let halves = [half(1), half(all.len())];
        (forms, halves)
    }

    #[test]
    fn a_law_of_its_own_form_costs_the_choice_alone() {
        let (forms, _) = fitted(|_| 0.0);
        assert_eq!(forms.deviation, 0.0);
        assert!(forms.columns.is_empty());
        let choice = real(TRIED.len() + 1).recip().ln();
        assert!(forms.gain >= choice && forms.gain < 0.0, "{}", forms.gain);
    }

    #[test]
    fn a_law_of_another_form_is_seen_and_known_less() {
        let speed = |sample: &Sample| sample.speeds.left.abs() + sample.speeds.right.abs();
        let (forms, [exact, whole]) = fitted(|sample| 0.3 * speed(sample).ln());
        assert!(forms.deviation > 0.0 && forms.gain > 20.0, "{} {}", forms.deviation, forms.gain);
        // The size is the mean over the forms: known to a part of τ, not to the noise.
        assert!(whole > 3.0 * exact && whole > 0.02, "{exact} {whole}");
    }

    /// A law of the vehicle file acts with twice its filed size, which is no other form.
    #[test]
    fn a_wrong_size_in_the_file_is_no_form() {
        let law = EffectId::of("viscous-friction").expect("an effect");
        let settings = Settings::default();
        let plain = Hypothesis::filed(&VehicleFile::auriga_alpha(), &settings.prior);
        let [filed, there] = [0.3, 0.6].map(|size| plain.with_effect(active(law, &[size])));
        let predicted = |of: &Hypothesis, evidence: &Evidence| {
            Mechanics::new(of, evidence).predict(&Instruments::of(of), evidence)
        };
        let noise = assumed_noise(1e-4, 1e-4);
        let evidence = Evidence::planned(&runs(), noise, 0.0, &settings, |evidence| {
            predicted(&there, evidence)
        });
        let evidence = Weighted::new(evidence);
        let fit = Fit::new(filed.clone(), &[], &evidence, None);
        let [here, twice] = [&filed, &there].map(|of| predicted(of, &evidence));
        let change = twice.iter().zip(&here).map(|(twice, here)| (twice - here) / 0.3).collect();
        let column = evidence.white(change);
        let signature = Signature { unknown: Unknown::Effect(law, 0), column: column.clone() };
        let variant = Variant { effect: law, values: vec![0.3] };
        let catalogue = Catalogue { entries: vec![(variant, vec![signature])] };
        let forms = Forms::at(&fit, 0.4, &catalogue, &evidence);
        let normal = evidence.normal(&fit.residual, &[&forms.columns[..], &[column]].concat());
        let columns: Vec<usize> = (0..forms.columns.len()).collect();
        let misfit = normal.fit(&columns, &forms.priors).misfit;
        let priors = [&forms.priors[..], &[Prior::flat()]].concat();
        let all: Vec<usize> = (0..=columns.len()).collect();
        let free = normal.fit(&all, &priors);
        // known to a tenth of 0.3, and 0.3 away: ten standard deviations, and all of its χ²
        assert!(misfit - free.misfit > 60.0, "{misfit} {}", free.misfit);
        assert!(free.misfit < 0.2 * misfit, "{misfit} {}", free.misfit);
    }

    #[test]
    fn forms_keep_what_their_law_keeps() {
        let evidence = Evidence::planned(
            &runs(),
            assumed_noise(1e-3, 1e-3),
            0.0,
            &Settings::default(),
            |evidence| vec![Vector3::zeros(); evidence.samples().len()],
        );
        let functions = Functions::of(&evidence);
        let count = |id: &str| functions.of_law(EffectId::of(id).expect("an effect")).len();
        // A law that keeps S, R, P and all else moves constant ICRs, whatever its form.
        assert_eq!(count("friction-anisotropy"), 0);
        assert_eq!(count("cog-shift"), 0);
        // Ground that changes with time keeps S and P.
        assert_eq!(count("friction-drift"), 2);
        assert_eq!(count("viscous-friction"), 4);
    }
}
