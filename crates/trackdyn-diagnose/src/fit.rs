//! Fit of a hypothesis: robust maximum a posteriori estimate by Gauss-Newton steps.
//!
//! # Law
//! Minimise Σ ρ(|z|) + ½ Σ ((θ − m)/s)², with z the whitened residual of a sample, ρ Huber's loss
//! of its norm, and m, s the prior mean and standard deviation of each unknown θ.

use crate::evidence::Evidence;
use crate::hypothesis::{Hypothesis, Unknown, neutral, typical, typical_size};
use crate::mechanics::{Instruments, Mechanics, is_instrument};
use crate::normal::{Prior, Solution};
use crate::prior::priors;
use crate::settings;
use crate::starts::{self, Begun};
use crate::weighted::Weighted;
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;
use trackdyn_model::EffectId;
use trackdyn_model::effect::Role;

/// A fitted hypothesis.
#[derive(Clone)]
pub struct Fit {
    /// The hypothesis with its estimates.
    pub hypothesis: Hypothesis,
    /// Unknowns of the fit.
    pub unknowns: Vec<Unknown>,
    /// Indices of the unknowns that are not held at a bound.
    pub free: Vec<usize>,
    /// Its mechanics, which predicts the motion.
    pub mechanics: Mechanics,
    /// Whitened and scaled residual of each sample.
    pub residual: Vec<Vector3<f64>>,
    /// Jacobian of the prediction, a column for each unknown, whitened and scaled alike.
    pub columns: Vec<Vec<Vector3<f64>>>,
    /// Twice the objective: −2 ln posterior up to a constant.
    pub objective: f64,
    /// The linearised fit at the estimate.
    pub solution: Solution,
}

/// Step of a finite difference, taken away from an upper bound.
fn step(hypothesis: &Hypothesis, unknown: Unknown, settings: &settings::Fit) -> f64 {
    let value = hypothesis.get(unknown);
    let size = match unknown {
        Unknown::Offset(_) => settings.icr_difference * hypothesis.vehicle.gauge,
        Unknown::FrictionLevel => settings.friction_difference,
        Unknown::Cog(_) => settings.cog_difference * hypothesis.vehicle.gauge,
        Unknown::Effect(..) => {
            let parameter = unknown.parameter().expect("an effect's");
            match parameter.role {
                Role::Size { .. } => {
                    // a size may set the scale of a law: a step beyond that scale gives no
                    // derivative
                    let distance = (value - neutral(parameter)).abs();
                    let typical = typical_size(parameter);
                    let [low, high] = settings.size_difference_limits;
                    (settings.size_difference * distance).clamp(low * typical, high * typical)
                }
                Role::Place { .. } => settings.place_difference,
                Role::Time => settings.time_difference,
                Role::Direction => settings.direction_difference,
                Role::Shape => {
                    let part = settings.shape_difference;
                    part * value.abs().max(part * parameter.typical)
                }
            }
        }
    };
    let [_, high] = hypothesis.range(unknown);
    if value + size > high { -size } else { size }
}

/// Jacobian of the prediction in the given unknowns by finite differences, whitened columns.
pub fn columns(
    hypothesis: &Hypothesis,
    mechanics: &Mechanics,
    prediction: &[Vector3<f64>],
    unknowns: &[Unknown],
    evidence: &Weighted,
) -> Vec<Vec<Vector3<f64>>> {
    let columns = derivatives(hypothesis, mechanics, prediction, unknowns, evidence).into_iter();
    columns.map(|column| evidence.white(column)).collect()
}

/// Jacobian of the prediction in the given unknowns by finite differences, not whitened.
pub fn derivatives(
    hypothesis: &Hypothesis,
    mechanics: &Mechanics,
    prediction: &[Vector3<f64>],
    unknowns: &[Unknown],
    evidence: &Evidence,
) -> Vec<Vec<Vector3<f64>>> {
    unknowns
        .par_iter()
        .map(|&unknown| {
            let step = step(hypothesis, unknown, &evidence.settings().fit);
            let moved = hypothesis.with(unknown, hypothesis.get(unknown) + step);
            let step = moved.get(unknown) - hypothesis.get(unknown);
            let instruments = Instruments::of(&moved);
            let prediction_there = if is_outside(hypothesis, unknown) {
                mechanics.predict(&instruments, evidence)
            } else {
                mechanics.varied(&moved, evidence).predict(&instruments, evidence)
            };
            prediction_there.iter().zip(prediction).map(|(b, a)| (b - a) / step).collect()
        })
        .collect()
}

/// Whether an unknown does not enter the balance of forces: offsets, sensors, gains and lags.
fn is_outside(hypothesis: &Hypothesis, unknown: Unknown) -> bool {
    match unknown {
        Unknown::Offset(_) => true,
        Unknown::FrictionLevel | Unknown::Cog(_) => false,
        Unknown::Effect(effect, _) => is_instrument(&hypothesis.vehicle, &typical(effect)),
    }
}

/// A hypothesis with its prediction and residuals.
pub struct Point {
    hypothesis: Hypothesis,
    mechanics: Mechanics,
    prediction: Vec<Vector3<f64>>,
    residual: Vec<Vector3<f64>>,
    /// Twice the objective; ∞ where the hypothesis has no motion.
    pub objective: f64,
}

impl Point {
    /// Evaluates a hypothesis, some of whose numbers are unknowns of a fit. `before` is the
    /// mechanics of a similar hypothesis, for reuse ([`Mechanics::beside`]).
    pub fn new(
        hypothesis: Hypothesis,
        unknowns: &[Unknown],
        evidence: &Weighted,
        before: Option<&Mechanics>,
    ) -> Self {
        let mechanics = Mechanics::beside(before, &hypothesis, evidence);
        Self::with_mechanics(hypothesis, mechanics, unknowns, evidence)
    }

    /// Its mechanics.
    pub fn mechanics(&self) -> &Mechanics {
        &self.mechanics
    }

    fn with_mechanics(
        hypothesis: Hypothesis,
        mechanics: Mechanics,
        unknowns: &[Unknown],
        evidence: &Weighted,
    ) -> Self {
        let prediction = mechanics.predict(&Instruments::of(&hypothesis), evidence);
        let residual = evidence.residual(&prediction);
        let objective = if mechanics.failure().is_some() {
            f64::INFINITY
        } else {
            // min of ∞ and NaN is ∞
            let of_starts = |starts| starts::penalty(evidence, &hypothesis, starts);
            let of_starts = mechanics.starts().map_or(0.0, of_starts);
            let of_unknowns = penalty(&hypothesis, unknowns, evidence);
            (evidence.loss(&residual) + of_unknowns + of_starts).min(f64::INFINITY)
        };
        Self { hypothesis, mechanics, prediction, residual, objective }
    }
}

/// Prior penalty Σ ((θ − m)/s)² of these unknowns.
fn penalty(hypothesis: &Hypothesis, unknowns: &[Unknown], evidence: &Weighted) -> f64 {
    let known = priors(hypothesis, unknowns, evidence);
    known.iter().map(|prior| (prior.mean / prior.deviation).powi(2)).sum()
}

impl Fit {
    /// Fits the unknowns of a hypothesis, starting from its values. `before` is the mechanics of a
    /// similar hypothesis, for reuse ([`Mechanics::beside`]).
    pub fn new(
        start: Hypothesis,
        unknowns: &[Unknown],
        evidence: &Weighted,
        before: Option<&Mechanics>,
    ) -> Self {
        let start = Point::new(start, unknowns, evidence, before);
        Self::from_point(start, unknowns, evidence)
    }

    /// Whether a parameter of an effect ended at a limit of its physical range.
    pub fn is_at_limit(&self, unknown: Unknown) -> bool {
        /// Distance to a limit, as share of the range, that counts as rounding.
        const ROUNDING: f64 = 1e-6;
        let value = self.hypothesis.get(unknown);
        unknown.parameter().is_some_and(|parameter| {
            let [low, high] = parameter.range;
            (value - low).min(high - value) <= ROUNDING * (high - low)
        })
    }

    /// Fits the unknowns of a hypothesis, starting from an evaluated point.
    ///
    /// During a descent the inertial departure is extrapolated linearly from one simulated motion
    /// ([`Mechanics::on_the_way`]). At the end it is simulated anew unless the end is near that
    /// motion. The fit then goes on from there, or from a share of the way if the extrapolation
    /// misled it.
    pub fn from_point(start: Point, unknowns: &[Unknown], evidence: &Weighted) -> Self {
        let mut fit = Self::linearised(start, unknowns, evidence);
        for _ in 0..evidence.settings().fit.max_restarts {
            let end = fit.clone().descended(evidence);
            if !end.mechanics.has_departure() {
                return end;
            }
            let anew = |hypothesis: Hypothesis| {
                Point::new(hypothesis, unknowns, evidence, Some(&end.mechanics))
            };
            let whole = anew(end.hypothesis.clone());
            if whole.mechanics.has_inertia_of(&end.mechanics) {
                return end;
            }
            let parts = evidence.settings().fit.step_shares[1..]
                .iter()
                .map(|&share| anew(fit.towards(&end, share)));
            let better = |point: &Point| point.objective < fit.objective;
            let Some(point) = std::iter::once(whole).chain(parts).find(better) else { break };
            fit = Self::linearised(point, unknowns, evidence);
        }
        fit
    }

    /// A better fit, whose runs begin in the motions that suit its own hypothesis; none where there
    /// is none, or the evidence has stationary beginnings.
    ///
    /// To first order, the evidence allows for beginnings that suit another hypothesis. Here, the
    /// unknowns and the beginnings of this hypothesis are fitted in turn, each beside the other.
    /// The objective remains that of the evidence.
    pub fn with_own_starts(&self, evidence: &Weighted) -> Option<Self> {
        evidence.starts()?;
        let begun = |fit: &Self| starts::fitted(evidence, &fit.hypothesis, Some(&fit.mechanics));
        let settings = &evidence.settings().evidence;
        let mut here = begun(self)?;
        let mut best: Option<Self> = None;
        for _ in 0..settings.start_repeats {
            let Begun { hypothesis, mechanics, by_starts } = here;
            let own = evidence.allowing_for_starts(by_starts);
            let moved = Self::new(hypothesis, &self.unknowns, &own, Some(&mechanics));
            let Some(there) = begun(&moved) else { break };
            let before = Some(&there.mechanics);
            let next = Self::new(there.hypothesis.clone(), &self.unknowns, evidence, before);
            let fall = best.as_ref().unwrap_or(self).objective - next.objective;
            if fall > 0.0 {
                best = Some(next);
            }
            if fall < settings.min_fall_by_starts {
                break;
            }
            here = there;
        }
        best
    }

    /// The hypothesis at a share of the way from here to `end`.
    fn towards(&self, end: &Self, share: f64) -> Hypothesis {
        self.shifted(|k| {
            let unknown = self.unknowns[k];
            share * (end.hypothesis.get(unknown) - self.hypothesis.get(unknown))
        })
    }

    /// The hypothesis with unknown k shifted by `by(k)`.
    fn shifted(&self, by: impl Fn(usize) -> f64) -> Hypothesis {
        let places = self.unknowns.iter().enumerate();
        places.fold(self.hypothesis.clone(), |moved, (k, &unknown)| {
            let value = moved.get(unknown) + by(k);
            moved.with(unknown, value)
        })
    }

    /// Descends from here, with the inertial departure extrapolated from one simulated motion.
    ///
    /// The Jacobian is kept as long as it predicts the decrease of each step; otherwise it is
    /// computed anew, even after a step that failed. The end is where a Jacobian of the point
    /// itself promises almost no decrease, or its step fails.
    ///
    /// Returns the end and the decrease of the objective since the Jacobian was computed; `are_own`
    /// says whether the initial Jacobian is of the initial point.
    fn descent(self, are_own: bool, evidence: &Weighted) -> (Self, f64) {
        let mut fit = self;
        let (mut are_own, mut since) = (are_own, 0.0);
        let mut largest = 0;
        let settings::Fit { max_steps, min_fall, max_promise_error, .. } = evidence.settings().fit;
        for _ in 0..max_steps {
            let (next, share) = fit.next(largest, evidence).unzip();
            // A step as long as the last one, or the next longer one, comes first: longer ones
            // lead where the law was not linear.
            largest = share.map_or(0, |share| share.saturating_sub(1));
            let gain = next.as_ref().map_or(0.0, |next| fit.objective - next.objective);
            let promised = fit.solution.gain;
            let foretold = (gain - promised).abs() < max_promise_error * promised + min_fall;
            let is_last = gain < min_fall && (foretold || are_own);
            if is_last && next.is_none() {
                break;
            }
            let Self { hypothesis, mechanics, unknowns, columns, .. } = fit;
            let point = next.unwrap_or_else(|| {
                Point::with_mechanics(hypothesis, mechanics, &unknowns, evidence)
            });
            (are_own, since) = if foretold { (false, since + gain) } else { (true, 0.0) };
            fit = if foretold {
                Self::with_columns(point, &unknowns, columns, evidence)
            } else {
                Self::linearised(point, &unknowns, evidence)
            };
            if is_last {
                break;
            }
        }
        (fit, since)
    }

    /// Descends from here; the Jacobian at the end is computed anew if the objective fell far
    /// since.
    fn descended(self, evidence: &Weighted) -> Self {
        let (end, since) = self.descent(true, evidence);
        if since < evidence.settings().fit.max_fall_of_jacobian {
            return end;
        }
        let Self { hypothesis, mechanics, unknowns, .. } = end;
        let point = Point::with_mechanics(hypothesis, mechanics, &unknowns, evidence);
        Self::linearised(point, &unknowns, evidence)
    }

    /// The point after the first share of the step that lowers the objective, and the index of that
    /// share. Shares decrease, and are tried from index `largest` on. None where no share lowers
    /// it, or where the promised decrease is negligible.
    fn next(&self, largest: usize, evidence: &Weighted) -> Option<(Point, usize)> {
        let settings = &evidence.settings().fit;
        if self.solution.gain < settings.min_promised_fall {
            return None;
        }
        settings.step_shares.into_iter().enumerate().skip(largest).find_map(|(place, share)| {
            let hypothesis = self.stepped(share);
            let mechanics = self.mechanics.on_the_way(&hypothesis, &self.unknowns, evidence);
            let unknowns = &self.unknowns;
            let point = Point::with_mechanics(hypothesis, mechanics, unknowns, evidence);
            (point.objective < self.objective).then_some((point, place))
        })
    }

    /// Profile of twice the objective: the unknown at index `place` is held at `value` and the
    /// others are refitted, starting from their linear prediction. The inertial departure is
    /// extrapolated from one simulated motion.
    pub fn profile(&self, place: usize, value: f64, evidence: &Weighted) -> f64 {
        let held = self.unknowns[place];
        let covariance = &self.solution.covariance;
        let moved = (value - self.hypothesis.get(held)) / covariance[(place, place)];
        let hypothesis = self.shifted(|k| moved * covariance[(k, place)]).with(held, value);
        let others = || (0..self.unknowns.len()).filter(|&k| k != place);
        let unknowns: Vec<Unknown> = others().map(|k| self.unknowns[k]).collect();
        let columns = others().map(|k| self.columns[k].clone()).collect();
        let mechanics = self.mechanics.on_the_way(&hypothesis, &unknowns, evidence);
        let point = Point::with_mechanics(hypothesis, mechanics, &unknowns, evidence);
        let start = Self::with_columns(point, &unknowns, columns, evidence);
        let (Self { hypothesis, objective, .. }, _) = start.descent(false, evidence);
        objective + penalty(&hypothesis, &[held], evidence)
    }

    /// A hypothesis with its present values and Jacobian, without a fit.
    pub fn at(
        hypothesis: Hypothesis,
        unknowns: &[Unknown],
        evidence: &Weighted,
        before: Option<&Mechanics>,
    ) -> Self {
        let point = Point::new(hypothesis, unknowns, evidence, before);
        Self::linearised(point, unknowns, evidence)
    }

    /// This hypothesis fitted to other evidence, starting from its values.
    pub fn refitted(&self, evidence: &Weighted) -> Self {
        let Self { hypothesis, unknowns, mechanics, .. } = self;
        Self::new(hypothesis.clone(), unknowns, evidence, Some(mechanics))
    }

    /// This hypothesis on other evidence, with its Jacobian, without a fit.
    pub fn on(&self, evidence: &Weighted) -> Self {
        Self::at(self.hypothesis.clone(), &self.unknowns, evidence, None)
    }

    /// Predicted motion of each sample: forward (m), left (m), yaw (rad).
    pub fn prediction(&self, evidence: &Evidence) -> Vec<Vector3<f64>> {
        self.mechanics.predict(&Instruments::of(&self.hypothesis), evidence)
    }

    /// A point with its Jacobian, and with the slopes of its departure in time.
    fn linearised(point: Point, unknowns: &[Unknown], evidence: &Weighted) -> Self {
        let mechanics = point.mechanics.with_slopes(&point.hypothesis, unknowns, evidence);
        let point = if mechanics.has_inertia_of(&point.mechanics) {
            Point { mechanics, ..point }
        } else {
            Point::with_mechanics(point.hypothesis, mechanics, unknowns, evidence)
        };
        let Point { hypothesis, mechanics, prediction, .. } = &point;
        let columns = columns(hypothesis, mechanics, prediction, unknowns, evidence);
        Self::with_columns(point, unknowns, columns, evidence)
    }

    /// A point with this Jacobian.
    fn with_columns(
        point: Point,
        unknowns: &[Unknown],
        columns: Vec<Vec<Vector3<f64>>>,
        evidence: &Weighted,
    ) -> Self {
        let Point { hypothesis, mechanics, residual, objective, .. } = point;
        let priors = priors(&hypothesis, unknowns, evidence);
        let normal = evidence.normal(&residual, &columns);
        // An unknown at a bound that its step would cross is held there.
        let mut free: Vec<usize> = (0..unknowns.len()).collect();
        let solution = loop {
            let solution = normal.fit(&free, &priors);
            let steps = free.iter().zip(solution.estimate.iter());
            let crossing = steps
                .enumerate()
                .find(|(_, (k, step))| at_bound(&hypothesis, unknowns[**k], **step))
                .map(|(place, _)| place);
            match crossing {
                Some(place) => {
                    free.remove(place);
                }
                None => break solution,
            }
        };
        let solution = extended_to_all(&solution, &free, &priors);
        Self {
            hypothesis,
            unknowns: unknowns.to_vec(),
            free,
            mechanics,
            residual,
            columns,
            objective,
            solution,
        }
    }

    /// The hypothesis after a share of the Gauss-Newton step.
    fn stepped(&self, share: f64) -> Hypothesis {
        self.shifted(|k| share * self.solution.estimate[k])
    }

    /// Unknowns of the fit without those of an effect.
    pub fn unknowns_without(&self, effect: EffectId) -> Vec<Unknown> {
        self.unknowns.iter().copied().filter(|unknown| !unknown.is_of(effect)).collect()
    }

    /// Log evidence (marginal likelihood) by Laplace's method, up to a constant that all hypotheses
    /// share; −∞ where the linearised fit is singular.
    ///
    /// −½ minimum − ½ ln det(1 + S J S), J the information and S the prior deviations.
    pub fn ln_evidence(&self) -> f64 {
        // max of −∞ and NaN is −∞
        (-0.5 * (self.objective + self.solution.occam)).max(f64::NEG_INFINITY)
    }
}

/// Whether an unknown stands at a bound that a step would cross.
pub(crate) fn at_bound(hypothesis: &Hypothesis, unknown: Unknown, step: f64) -> bool {
    let value = hypothesis.get(unknown);
    let [low, high] = hypothesis.range(unknown);
    (value <= low && step < 0.0) || (value >= high && step > 0.0)
}

/// A solution of the free unknowns, extended to all: the others do not move and keep their prior
/// variance.
fn extended_to_all(solution: &Solution, free: &[usize], priors: &[Prior]) -> Solution {
    let variances: Vec<f64> = priors.iter().map(|prior| prior.deviation.powi(2)).collect();
    let mut estimate = DVector::zeros(priors.len());
    let mut covariance = DMatrix::from_diagonal(&DVector::from(variances));
    for (a, &i) in free.iter().enumerate() {
        estimate[i] = solution.estimate[a];
        for (b, &j) in free.iter().enumerate() {
            covariance[(i, j)] = solution.covariance[(a, b)];
        }
    }
    Solution { estimate, covariance, ..solution.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hypothesis::unknowns_of;
    use trackdyn_model::VehicleFile;

    /// A zero step would make the finite difference NaN.
    #[test]
    fn every_number_has_a_step_to_take_wherever_it_stands() {
        let prior = settings::Prior::default();
        let filed = Hypothesis::filed(&VehicleFile::auriga_alpha(), &prior);
        let settings = settings::Fit::default();
        let effects = EffectId::all().flat_map(unknowns_of);
        for unknown in effects.chain([Unknown::Offset(0), Unknown::FrictionLevel]) {
            let [low, high] = filed.range(unknown);
            for value in [low.max(-1e9), high.min(1e9), 0.0_f64.clamp(low, high)] {
                let here = filed.with(unknown, value);
                let there = here.with(unknown, here.get(unknown) + step(&here, unknown, &settings));
                assert!(there.get(unknown) != here.get(unknown), "{unknown:?} at {value}");
            }
        }
    }
}
