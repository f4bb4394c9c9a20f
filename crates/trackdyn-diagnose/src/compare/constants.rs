//! Which single number moves the constant ICRs of one set to those of the other.

use super::Smallest;
use super::quantity::{Estimate, Group, middle_half_y};
use crate::base::spin_with;
use crate::candidate::sizes;
use crate::diagnosis::Examination;
use crate::hypothesis::{active, largest_size, neutral, typical_size};
use nalgebra::{DMatrix, DVector, Vector3};
use trackdyn_core::real;
use trackdyn_estimate::interval::NORMAL_QUANTILE;
use trackdyn_model::{EffectId, Effects, Vehicle};

/// An effect that explains a difference of constant ICRs by itself, with the sizes that do.
#[derive(Clone, Debug)]
pub struct Member {
    /// The effect.
    pub effect: EffectId,
    /// Index of each size among its parameters, and its value with an interval: what the second set
    /// has more than the first.
    pub sizes: Vec<(usize, Estimate)>,
}

/// Effects that constant ICRs may stand for in both sets, ascending.
fn class(sets: [&Examination; 2]) -> impl Iterator<Item = EffectId> {
    let [first, second] = sets.map(|set| set.constants.class());
    first.iter().copied().filter(|effect| second.contains(effect))
}

/// Effects of the class of constants of which each explains the difference of constant ICRs by
/// itself. Where none does, all of the class, without sizes: then several are needed.
pub(super) fn members(sets: [&Examination; 2], group: &Group) -> Vec<Member> {
    let search = &sets[0].search;
    let vehicle = &search.base.as_filed.hypothesis.vehicle;
    let max_chance = search.settings().comparison.max_chance;
    let moved = Vector3::from_fn(|n, _| group.numbers[n].difference.value);
    let deviation = deviation(sets, group);
    let alone = |effect| member(vehicle, effect, (moved, deviation), max_chance);
    let alone: Vec<Member> = class(sets).filter_map(alone).collect();
    if alone.is_empty() {
        return class(sets).map(|effect| Member { effect, sizes: Vec::new() }).collect();
    }
    alone
}

/// Standard deviations of the differences of constant ICRs, m: by the noise, and by the share of
/// the gauge to which contact models are known.
fn deviation(sets: [&Examination; 2], group: &Group) -> Vector3<f64> {
    let search = &sets[0].search;
    let gauge = search.base.as_filed.hypothesis.vehicle.gauge;
    let form = search.settings().verdict.min_icr_difference * gauge / NORMAL_QUANTILE;
    Vector3::from_fn(|n, _| group.numbers[n].difference.deviation().hypot(form))
}

/// Smallest difference of each size of the class of constants that would have shown, by what it
/// moves the constant ICRs.
pub(super) fn smallest(sets: [&Examination; 2], group: &Group) -> Vec<Smallest> {
    let search = &sets[0].search;
    let (vehicle, deviation) = (&search.base.as_filed.hypothesis.vehicle, deviation(sets, group));
    let least = search.settings().limits.min_detected_z;
    let of_size = |effect: EffectId, parameter: usize| {
        let card = &effect.card().parameters[parameter];
        let none: Vec<f64> = effect.card().parameters.iter().map(neutral).collect();
        let by = icr_slope(vehicle, effect, &none, parameter)?.component_div(&deviation).norm();
        let size = Some(least / by).filter(|size| *size <= largest_size(card));
        Some(Smallest { effect, parameter, size })
    };
    class(sets)
        .flat_map(|effect| sizes(effect).into_iter().filter_map(move |size| of_size(effect, size)))
        .collect()
}

/// Constant ICRs of a vehicle with an effect of these values: their middle, half distance and y.
fn icrs(vehicle: &Vehicle, effect: EffectId, values: &[f64]) -> Option<Vector3<f64>> {
    let effects: Effects = std::iter::once(active(effect, values)).collect();
    Some(Vector3::from(middle_half_y(spin_with(vehicle, effects)?.into())))
}

/// Change of the constant ICRs per change of a parameter of an effect.
fn icr_slope(
    vehicle: &Vehicle,
    effect: EffectId,
    values: &[f64],
    place: usize,
) -> Option<Vector3<f64>> {
    const STEP: f64 = 1e-3;
    let parameter = &effect.card().parameters[place];
    let step = STEP * typical_size(parameter);
    let step = if values[place] + step > parameter.range[1] { -step } else { step };
    let mut there = values.to_vec();
    there[place] += step;
    Some((icrs(vehicle, effect, &there)? - icrs(vehicle, effect, values)?) / step)
}

/// Sizes of an effect that move the constant ICRs by `moved`; none where no size in its range does,
/// within the deviations; `max_chance` is that of chi-squared, in standard deviations.
///
/// Gauss-Newton steps from none, with sizes held in their ranges.
fn member(
    vehicle: &Vehicle,
    effect: EffectId,
    (moved, deviation): (Vector3<f64>, Vector3<f64>),
    max_chance: f64,
) -> Option<Member> {
    const ROUNDS: usize = 30;
    let parameters = effect.card().parameters;
    let places = sizes(effect);
    let start: Vec<f64> = parameters.iter().map(neutral).collect();
    let none = Vector3::from(middle_half_y(spin_with(vehicle, Effects::none())?.into()));
    let shift =
        |values: &[f64]| Some((icrs(vehicle, effect, values)? - none).component_div(&deviation));
    let wanted = moved.component_div(&deviation);
    let slopes = |values: &[f64]| -> Option<DMatrix<f64>> {
        let mut slopes = DMatrix::zeros(3, places.len());
        for (column, &place) in places.iter().enumerate() {
            let slope = icr_slope(vehicle, effect, values, place)?;
            slopes.set_column(column, &slope.component_div(&deviation));
        }
        Some(slopes)
    };
    let mut values = start;
    let mut left = wanted - shift(&values)?;
    for _ in 0..ROUNDS {
        let slopes = slopes(&values)?;
        let step = slopes.svd(true, true).solve(&DVector::from_row_slice(left.as_slice()), 1e-9);
        let step = step.ok()?;
        let mut share = 1.0;
        let (mut better, before) = (None, left.norm());
        while share > 1e-3 && better.is_none() {
            let mut tried = values.clone();
            for (column, &place) in places.iter().enumerate() {
                let [low, high] = parameters[place].range;
                tried[place] = (tried[place] + share * step[column]).clamp(low, high);
            }
            let rest = shift(&tried).map(|shift| wanted - shift);
            better = rest.filter(|rest| rest.norm() < before).map(|rest| (tried, rest));
            share /= 2.0;
        }
        let Some((tried, rest)) = better else { break };
        (values, left) = (tried, rest);
        if before - left.norm() < 1e-6 {
            break;
        }
    }
    // χ² of three numbers less those that were fitted
    let degrees = real(3_usize.saturating_sub(places.len()).max(1));
    let by_chance = degrees + max_chance * (2.0 * degrees).sqrt();
    if left.norm_squared() > by_chance || left.norm() >= wanted.norm() {
        return None;
    }
    let slopes = slopes(&values)?;
    let covariance = slopes.tr_mul(&slopes).pseudo_inverse(1e-12).ok()?;
    let sizes = places.iter().enumerate().map(|(column, &place)| {
        let half = NORMAL_QUANTILE * covariance[(column, column)].max(0.0).sqrt();
        let value = values[place];
        (place, Estimate { value, low: value - half, high: value + half })
    });
    Some(Member { effect, sizes: sizes.collect() })
}
