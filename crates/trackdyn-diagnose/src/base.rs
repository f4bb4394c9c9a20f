//! The base: the vehicle as its file says, with all that is free in every hypothesis.
//!
//! Free are the constant ICRs, which stand for friction ratio, centre of gravity and their like;
//! what encoders and pose sensor make of the motion: gains, clock, mount; and the level of friction
//! and the centre of gravity where mass shows them.

use crate::equations::{Column, Stack};
use crate::fit::Fit;
use crate::hypothesis::{
    Hypothesis, Unknown, active, neutral, typical, unknowns_of, with_friction,
};
use crate::mechanics::{Mechanics, is_instrument};
use crate::normal::{Columns, Normal, Prior};
use crate::prior::prior;
use crate::weighted::Weighted;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::PerSide;
use trackdyn_model::{ActiveEffect, Circumstance, EffectId, Effects, Model, Vehicle, VehicleFile};
use trackdyn_model::{Icrs, Stationary};

/// What every hypothesis starts from.
#[derive(Clone)]
pub struct Base {
    /// The vehicle as its file says, moved with the recorded clock and nothing fitted but the
    /// constant ICRs.
    pub as_filed: Fit,
    /// The base at its best, the vehicle's friction ratio and centre of gravity such that it has
    /// the constant ICRs that were found.
    pub fit: Fit,
    /// What is free in every hypothesis.
    pub nuisances: Vec<Unknown>,
    /// Effects of encoders and pose sensor among them, by their places in the catalogue.
    pub instruments: Vec<EffectId>,
    /// What of the vehicle takes over constant ICRs.
    pub calibration: Calibration,
}

/// The offsets of the constant ICRs.
pub const OFFSETS: [Unknown; 3] = [Unknown::Offset(0), Unknown::Offset(1), Unknown::Offset(2)];

/// What only a robot with mass tells: how far it slides, and where it pulls.
const BY_MASS: [Unknown; 3] = [Unknown::FrictionLevel, Unknown::Cog(0), Unknown::Cog(1)];

impl Base {
    /// The base of a vehicle for this evidence.
    pub fn new(file: &VehicleFile, evidence: &Weighted) -> Self {
        let settings = evidence.settings();
        let hypothesis = Hypothesis::filed(file, &settings.prior);
        let as_filed = Fit::new(hypothesis.clone(), &OFFSETS, evidence, None);
        let start = with_clock(&hypothesis, evidence);
        let mut nuisances = OFFSETS.to_vec();
        let instruments = free_instruments(&start, evidence, &as_filed.mechanics);
        for &effect in &instruments {
            nuisances.extend(unknowns_of(effect));
        }
        // What has mass tells how much friction there is, and where the mass is, if the evidence
        // knows that better than the owner.
        let tried: Vec<Unknown> = nuisances.iter().chain(&BY_MASS).copied().collect();
        let fit = Fit::at(start.clone(), &tried, evidence, Some(&as_filed.mechanics));
        for (place, &unknown) in tried.iter().enumerate().skip(nuisances.len()) {
            let known = fit.solution.covariance[(place, place)].sqrt();
            let before = prior(&start, unknown, evidence).deviation;
            if known < settings.base.max_known_share * before {
                nuisances.push(unknown);
            }
        }
        let plain = Fit::new(start, &nuisances, evidence, Some(&fit.mechanics));
        // The vehicle takes over what it can of the constant ICRs; a second fit tells what is left.
        let (mut fit, mut calibration) = (plain.clone(), Calibration::None);
        for tried in Calibration::ALL {
            let Some(hypothesis) = tried.calibrated(&plain.hypothesis) else { continue };
            let again = Fit::new(hypothesis, &nuisances, evidence, None);
            // Where nothing tells them apart, the first one stands.
            let least = settings.base.min_fall_of_calibration;
            let better = if calibration == Calibration::None { -least } else { least };
            if again.objective < fit.objective - better {
                (fit, calibration) = (again, tried);
            }
        }
        Self { as_filed, fit, nuisances, instruments, calibration }
    }

    /// This base, at its best for the evidence with another noise, or another scale of residuals.
    pub fn refitted(&self, evidence: &Weighted) -> Self {
        let again = |fit: &Fit| {
            let (start, before) = (fit.hypothesis.clone(), Some(&fit.mechanics));
            Fit::new(start, &fit.unknowns, evidence, before)
        };
        Self { as_filed: again(&self.as_filed), fit: again(&self.fit), ..self.clone() }
    }
}

/// The hypothesis with the clock offset that the recording shows by itself, in whatever effect
/// delays poses.
fn with_clock(hypothesis: &Hypothesis, evidence: &Weighted) -> Hypothesis {
    let own = Model::new(hypothesis.vehicle.clone(), hypothesis.effects.clone()).sensor().delay;
    for effect in EffectId::all() {
        let effects: Effects = std::iter::once(typical(effect)).collect();
        let delay = Model::new(hypothesis.vehicle.clone(), effects).sensor().delay;
        if delay != 0.0 && hypothesis.effect(effect).is_none() {
            let share = (evidence.tau() - own) / delay;
            let values: Vec<f64> = (effect.card().parameters)
                .iter()
                .map(|parameter| {
                    neutral(parameter) + share * (parameter.typical - neutral(parameter))
                })
                .collect();
            return hypothesis.with_effect(active(effect, &values));
        }
    }
    hypothesis.clone()
}

/// The effects of encoders and pose sensor that this evidence tells from each other and from
/// constant ICRs, in the catalogue's order.
fn free_instruments(
    hypothesis: &Hypothesis,
    evidence: &Weighted,
    mechanics: &Mechanics,
) -> Vec<EffectId> {
    let mut unknowns = OFFSETS.to_vec();
    let mut chosen = Vec::new();
    for effect in EffectId::all() {
        if !is_instrument(&hypothesis.vehicle, &typical(effect)) {
            continue;
        }
        let more: Vec<Unknown> = unknowns_of(effect).collect();
        let tried: Vec<Unknown> = unknowns.iter().chain(&more).copied().collect();
        let fit = Fit::at(hypothesis.clone(), &tried, evidence, Some(mechanics));
        if own_share(&fit, unknowns.len()) > evidence.settings().base.min_own_share {
            unknowns = tried;
            chosen.push(effect);
        }
    }
    chosen
}

/// The smallest part of a column beyond the first `base` ones that is its own, as share of its
/// square.
fn own_share(fit: &Fit, base: usize) -> f64 {
    let samples = fit.residual.len();
    let flat = |of: &[Column]| vec![Prior::flat(); of.len()];
    let (before, own) = fit.columns.split_at(base);
    let mut stack = Stack::new(before.to_vec(), flat(before));
    stack.push(own.iter().cloned().zip(flat(own)));
    let equations = stack.equations(|columns| {
        Normal::new(&Columns {
            residual: &fit.residual,
            columns,
            weights: &vec![1.0; samples],
            blocks: &vec![0; samples],
            count: 1,
        })
    });
    let projected = equations.projected();
    let share = |&k: &usize| {
        let whole = equations.normal.product(k, k);
        if whole > 0.0 { projected.product(k, k) / whole } else { 0.0 }
    };
    equations.groups[0].iter().map(share).fold(1.0, f64::min)
}

/// What of a vehicle's numbers takes over an offset of the ICRs. As long as ICRs are constant,
/// nothing tells which; effects that act on the centre of gravity do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Calibration {
    /// Friction ratio and centre of gravity: no offset is left.
    Vehicle,
    /// The friction ratio, by the distance of the ICRs. What is left is as a mount of the pose
    /// sensor makes it.
    Friction,
    /// Nothing.
    None,
}

impl Calibration {
    /// All of them, the first choice first.
    pub const ALL: [Self; 3] = [Self::Vehicle, Self::Friction, Self::None];

    /// What of an offset of the ICRs the vehicle ought to take over, m.
    pub fn due(self, [left, right, y]: [f64; 3]) -> f64 {
        match self {
            Self::Vehicle => left.abs().max(right.abs()).max(y.abs()),
            Self::Friction => (right - left).abs(),
            Self::None => 0.0,
        }
    }

    /// The hypothesis with a vehicle that takes over the offset of its constant ICRs; none where
    /// there is no such vehicle.
    pub fn calibrated(self, hypothesis: &Hypothesis) -> Option<Hypothesis> {
        const ROUNDS: usize = 20;
        let wanted = spin(&hypothesis.vehicle)? + Vector3::from(hypothesis.offset);
        let changed = |by: &Vector3<f64>| -> Vehicle {
            let mut vehicle = hypothesis.vehicle.clone();
            // Nobody knows one coefficient better than the other.
            vehicle.friction.across *= (by[0] / 2.0).exp();
            vehicle.friction.along *= (-by[0] / 2.0).exp();
            vehicle.cog[0] += by[1];
            vehicle.cog[1] += by[2];
            vehicle
        };
        let mut by = Vector3::zeros();
        for _ in 0..ROUNDS {
            let vehicle = changed(&by);
            vehicle.check().ok()?;
            let off = wanted - spin(&vehicle)?;
            if self.due(off.into()) < 1e-9 {
                let cog_moved = [0, 1].map(|axis| hypothesis.cog_moved[axis] + by[1 + axis]);
                let offset = off.into();
                return Some(Hypothesis { vehicle, offset, cog_moved, ..hypothesis.clone() });
            }
            let mut slope = Matrix3::zeros();
            for k in 0..3 {
                const STEP: f64 = 1e-5;
                let mut ahead = by;
                ahead[k] += STEP;
                slope.set_column(k, &((spin(&changed(&ahead))? - spin(&vehicle)?) / STEP));
            }
            let step = match self {
                Self::Vehicle => slope.lu().solve(&off)?,
                Self::Friction => {
                    let gap = |icrs: &Vector3<f64>| icrs[1] - icrs[0];
                    Vector3::new(gap(&off) / gap(&slope.column(0).into_owned()), 0.0, 0.0)
                }
                Self::None => return None,
            };
            // No more than half a friction ratio, or a tenth of the gauge, at a time.
            let gauge = hypothesis.vehicle.gauge;
            let size = (step[0].abs() / 0.5)
                .max(step[1].abs() / (0.1 * gauge))
                .max(step[2].abs() / (0.1 * gauge));
            by += step / size.max(1.0);
        }
        None
    }
}

/// Gives a vehicle file the friction and the centre of gravity of a vehicle with the constant ICRs
/// of a hypothesis, with friction at a level of its own; those of the hypothesis where no vehicle
/// has them.
///
/// Of the effects that were `added` the file may have some otherwise, or not: what these moved the
/// vehicle takes over as well.
pub fn correct_constants(
    file: &mut VehicleFile,
    hypothesis: &Hypothesis,
    added: &[EffectId],
    level: f64,
) {
    let filed = |of: &ActiveEffect| file.effects.get(of.card().id);
    let added = added.iter().filter_map(|&effect| hypothesis.effect(effect));
    let missed: Vec<&ActiveEffect> = added.filter(|one| filed(one) != Some(one)).collect();
    let with = spin_with(&hypothesis.vehicle, missed.iter().copied().cloned().collect());
    let as_filed = missed.iter().filter_map(|one| filed(one)).cloned().collect();
    let without = spin_with(&hypothesis.vehicle, as_filed);
    let moved = with.zip(without).map_or(Vector3::zeros(), |(with, without)| with - without);
    let offset = Vector3::from(hypothesis.offset) + moved;
    let taken = Hypothesis { offset: offset.into(), ..hypothesis.clone() };
    let calibrated = Calibration::Vehicle.calibrated(&taken).unwrap_or(taken);
    let vehicle = with_friction(&calibrated.vehicle, level - hypothesis.friction_level);
    file.vehicle.friction = vehicle.friction;
    file.vehicle.cog = vehicle.cog;
}

/// The constant ICRs of a vehicle, m: those of a slow spin without effects.
fn spin(vehicle: &Vehicle) -> Option<Vector3<f64>> {
    spin_with(vehicle, Effects::none())
}

fn spin_with(vehicle: &Vehicle, effects: Effects) -> Option<Vector3<f64>> {
    let model = Model::new(vehicle.clone(), effects);
    let solution = Stationary::new(&model, &Circumstance::default()).solve(PerSide::new(-0.1, 0.1));
    solution.icrs.map(Icrs::to_array).map(Vector3::from)
}

/// The hypothesis with another vehicle and the offset that leaves its constant ICRs where they are.
pub fn with_vehicle(hypothesis: &Hypothesis, vehicle: &Vehicle) -> Option<Hypothesis> {
    let offset = spin(&hypothesis.vehicle)? + Vector3::from(hypothesis.offset) - spin(vehicle)?;
    let vehicle = with_friction(vehicle, hypothesis.friction_level);
    let offset = offset.into();
    Some(Hypothesis { vehicle, offset, cog_moved: [0.0; 2], ..hypothesis.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings;

    /// An effect that is not claimed leaves its constant ICRs, and the offset, to the vehicle;
    /// friction keeps its own level.
    #[test]
    fn the_vehicle_takes_over_what_is_not_claimed() {
        const LEVEL: f64 = 0.1;
        let mut file = VehicleFile::auriga_alpha();
        let gradient = EffectId::of("friction-gradient");
        let gradient = gradient.expect("an effect");
        let effect = active(gradient, &[0.3]);
        let filed = Hypothesis::filed(&file, &settings::Prior::default());
        let filed = filed.with(Unknown::FrictionLevel, 0.4);
        let hypothesis =
            Hypothesis { offset: [0.01, -0.005, 0.02], ..filed.with_effect(effect.clone()) };
        let with = spin_with(&file.vehicle, [effect].into_iter().collect()).expect("a spin");
        let wanted = with + Vector3::from(hypothesis.offset);
        let product = |vehicle: &Vehicle| vehicle.friction.across * vehicle.friction.along;
        let before = product(&file.vehicle);
        correct_constants(&mut file, &hypothesis, &[gradient], LEVEL);
        let off = spin(&file.vehicle).expect("a spin") - wanted;
        assert!(off.norm() < 1e-6, "{off}");
        assert!((product(&file.vehicle) / before - (2.0 * LEVEL).exp()).abs() < 1e-9);
        // what stands in the file as it was found is no matter of the vehicle
        let mut file = VehicleFile::auriga_alpha();
        file.effects.insert(hypothesis.effect(gradient).expect("there").clone());
        let bare = spin(&file.vehicle).expect("a spin") + Vector3::from(hypothesis.offset);
        correct_constants(&mut file, &hypothesis, &[gradient], 0.0);
        let off = spin(&file.vehicle).expect("a spin") - bare;
        assert!(off.norm() < 1e-6, "{off}");
    }
}
