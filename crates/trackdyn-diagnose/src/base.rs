//! Base model: the vehicle as filed, with the nuisance parameters that are free in every
//! hypothesis.
//!
//! These are the constant ICRs, which stand for friction ratio, centre of gravity and the like;
//! gains, clock and mount of encoders and pose sensor; and the friction level and the centre of
//! gravity where inertia shows them.

use crate::equations::{Column, Stack};
use crate::fit::Fit;
use crate::hypothesis::{
    Hypothesis, Unknown, active, at_share, neutral, typical, unknowns_of, with_friction,
};
use crate::mechanics::{Mechanics, is_instrument, single};
use crate::normal::{Columns, Normal, Prior};
use crate::prior::prior;
use crate::progress::{Cancelled, Watch};
use crate::weighted::Weighted;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use trackdyn_core::PerSide;
use trackdyn_model::effect::Parameter;
use trackdyn_model::{ActiveEffect, Circumstance, EffectId, Effects, Model, Vehicle, VehicleFile};
use trackdyn_model::{Icrs, Stationary};

/// Start of every hypothesis.
#[derive(Clone)]
pub struct Base {
    /// The vehicle as filed, with only constant ICRs fitted.
    pub as_filed: Fit,
    /// The fitted base. Friction ratio and centre of gravity of its vehicle are adjusted to the
    /// constant ICRs.
    pub fit: Fit,
    /// Nuisance parameters, free in every hypothesis.
    pub nuisances: Vec<Unknown>,
    /// Instrument effects among them.
    pub instruments: Vec<EffectId>,
    /// Which numbers of the vehicle absorb constant ICR offsets.
    pub calibration: Calibration,
}

/// Offsets of the constant ICRs.
pub const OFFSETS: [Unknown; 3] = [Unknown::Offset(0), Unknown::Offset(1), Unknown::Offset(2)];

/// Numbers that only inertia shows: how far the robot slides, and where its mass is.
const INERTIA_UNKNOWNS: [Unknown; 3] = [Unknown::FrictionLevel, Unknown::Cog(0), Unknown::Cog(1)];

impl Base {
    /// Fits the base of a vehicle to the evidence.
    ///
    /// # Errors
    /// [`Cancelled`], by the observer of the watch.
    pub fn new(file: &VehicleFile, evidence: &Weighted, watch: &Watch) -> Result<Self, Cancelled> {
        let settings = evidence.settings();
        let hypothesis = Hypothesis::filed(file, &settings.prior);
        let as_filed = Fit::new(hypothesis.clone(), &OFFSETS, evidence, None);
        let start = with_clock(&hypothesis, evidence);
        let mut nuisances = OFFSETS.to_vec();
        let instruments = free_instruments(&start, evidence, &as_filed.mechanics, watch)?;
        for &effect in &instruments {
            nuisances.extend(unknowns_of(effect));
        }
        // With inertia, the evidence may determine friction level and centre of gravity better than
        // the vehicle file: they are free then.
        let tried: Vec<Unknown> = nuisances.iter().chain(&INERTIA_UNKNOWNS).copied().collect();
        let fit = Fit::at(start.clone(), &tried, evidence, Some(&as_filed.mechanics));
        for (place, &unknown) in tried.iter().enumerate().skip(nuisances.len()) {
            let known = fit.solution.covariance[(place, place)].sqrt();
            let before = prior(&start, unknown, evidence).deviation;
            if known < settings.base.max_known_share * before {
                nuisances.push(unknown);
            }
        }
        watch.go_on()?;
        let plain = Fit::new(start, &nuisances, evidence, Some(&fit.mechanics));
        // The vehicle's numbers absorb constant ICR offsets; a second fit finds the rest.
        let (mut fit, mut calibration) = (plain.clone(), Calibration::None);
        for tried in Calibration::ALL {
            let Some(hypothesis) = tried.calibrated(&plain.hypothesis) else { continue };
            watch.go_on()?;
            let again = Fit::new(hypothesis, &nuisances, evidence, None);
            // Where no calibration fits clearly better, the first one is kept.
            let least = settings.base.min_fall_of_calibration;
            let better = if calibration == Calibration::None { -least } else { least };
            if again.objective < fit.objective - better {
                (fit, calibration) = (again, tried);
            }
        }
        Ok(Self { as_filed, fit, nuisances, instruments, calibration })
    }

    /// The base refitted to evidence with other noise or scale.
    pub fn refitted(&self, evidence: &Weighted) -> Self {
        let [as_filed, fit] = [&self.as_filed, &self.fit].map(|fit| fit.refitted(evidence));
        Self { as_filed, fit, ..self.clone() }
    }
}

/// The hypothesis with the clock offset estimated from the recording, in the effect that delays
/// poses.
fn with_clock(hypothesis: &Hypothesis, evidence: &Weighted) -> Hypothesis {
    let own = Model::new(hypothesis.vehicle.clone(), hypothesis.effects.clone()).sensor().delay;
    for effect in EffectId::all() {
        let delay = single(&hypothesis.vehicle, &typical(effect)).sensor().delay;
        if delay != 0.0 && hypothesis.effect(effect).is_none() {
            let share = (evidence.tau() - own) / delay;
            return hypothesis.with_effect(at_share(effect, share));
        }
    }
    hypothesis.clone()
}

/// The hypothesis without the effects that delay poses, unless the vehicle file has them.
pub fn without_clock(hypothesis: &Hypothesis, filed: &Hypothesis) -> Hypothesis {
    let delays = |effect: &ActiveEffect| single(&hypothesis.vehicle, effect).sensor().delay != 0.0;
    let late = hypothesis.effects.iter().filter(|effect| delays(effect));
    let added = late.map(ActiveEffect::effect).filter(|effect| filed.effect(*effect).is_none());
    added.fold(hypothesis.clone(), |hypothesis, effect| hypothesis.without(effect))
}

/// Instrument effects that this evidence separates from each other and from constant ICRs, in
/// catalogue order.
fn free_instruments(
    hypothesis: &Hypothesis,
    evidence: &Weighted,
    mechanics: &Mechanics,
    watch: &Watch,
) -> Result<Vec<EffectId>, Cancelled> {
    let mut unknowns = OFFSETS.to_vec();
    let mut chosen = Vec::new();
    for effect in EffectId::all() {
        if effect.card().is_rare() || !is_instrument(&hypothesis.vehicle, &typical(effect)) {
            continue;
        }
        watch.go_on()?;
        let more: Vec<Unknown> = unknowns_of(effect).collect();
        let tried: Vec<Unknown> = unknowns.iter().chain(&more).copied().collect();
        let fit = Fit::at(hypothesis.clone(), &tried, evidence, Some(mechanics));
        if own_share(&fit, unknowns.len()) > evidence.settings().base.min_own_share {
            unknowns = tried;
            chosen.push(effect);
        }
    }
    Ok(chosen)
}

/// Smallest share of a column's square, of all columns after the first `base`, that is independent
/// of the others.
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

/// Which numbers of a vehicle absorb ICR offsets. Constant ICRs cannot decide this; effects that
/// act at the centre of gravity can.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Calibration {
    /// Friction ratio and centre of gravity: no offset is left.
    Vehicle,
    /// Friction ratio only, from the distance of the ICRs. The rest acts like a shifted pose
    /// sensor.
    Friction,
    /// None.
    None,
}

impl Calibration {
    /// All choices, preferred first.
    pub const ALL: [Self; 3] = [Self::Vehicle, Self::Friction, Self::None];

    /// Largest offset that the vehicle should absorb, m.
    pub fn due(self, [left, right, y]: [f64; 3]) -> f64 {
        match self {
            Self::Vehicle => left.abs().max(right.abs()).max(y.abs()),
            Self::Friction => (right - left).abs(),
            Self::None => 0.0,
        }
    }

    /// The hypothesis with a vehicle that absorbs the ICR offset; none where no such vehicle
    /// exists.
    pub fn calibrated(self, hypothesis: &Hypothesis) -> Option<Hypothesis> {
        let wanted = spin(&hypothesis.vehicle)? + Vector3::from(hypothesis.offset);
        let Absorbed { vehicle, by, off } = self.absorbed(&hypothesis.vehicle, wanted, &spin)?;
        let cog_moved = [0, 1].map(|axis| hypothesis.cog_moved[axis] + by[1 + axis]);
        Some(Hypothesis { vehicle, offset: off.into(), cog_moved, ..hypothesis.clone() })
    }

    /// The vehicle with the wanted constant ICRs, by Newton's method from another vehicle. `spin`
    /// gives the constant ICRs of a vehicle. None where no such vehicle exists.
    fn absorbed(
        self,
        from: &Vehicle,
        wanted: Vector3<f64>,
        spin: &dyn Fn(&Vehicle) -> Option<Vector3<f64>>,
    ) -> Option<Absorbed> {
        const ROUNDS: usize = 20;
        let changed = |by: &Vector3<f64>| -> Vehicle {
            let mut vehicle = from.clone();
            // Neither coefficient is known better than the other.
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
                return Some(Absorbed { vehicle, by, off });
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
            // Step limit: half a unit of ln friction ratio, or a tenth of the gauge.
            let gauge = from.gauge;
            let size = (step[0].abs() / 0.5)
                .max(step[1].abs() / (0.1 * gauge))
                .max(step[2].abs() / (0.1 * gauge));
            by += step / size.max(1.0);
        }
        None
    }
}

/// A vehicle that absorbs an offset of the constant ICRs.
struct Absorbed {
    vehicle: Vehicle,
    /// What was changed: ln of the friction ratio, and the centre of gravity, m.
    by: Vector3<f64>,
    /// What it does not absorb, m.
    off: Vector3<f64>,
}

/// Gives a vehicle file, with its effects, the constant ICRs of a hypothesis at the friction level
/// `level`: by friction and centre of gravity. Where no vehicle with these effects has these ICRs,
/// the vehicle is calibrated without effects.
///
/// An offset common to both ICRs that exceeds `tolerated` (m) is one for which the fit found no
/// centre of gravity. A pose sensor at d sees the ICRs moved by -d, so the sensor is moved instead.
pub fn correct_constants(
    file: &mut VehicleFile,
    hypothesis: &Hypothesis,
    level: f64,
    tolerated: f64,
) {
    let [left, right, y] = hypothesis.offset;
    let common = [f64::midpoint(left, right), y];
    let lever = |file: &VehicleFile| Vector2::from(file.model().sensor().lever);
    let before = lever(file);
    if common.iter().any(|part| part.abs() > tolerated)
        && let Some(sensor) = moved_sensor(file, common.map(|part| -part))
    {
        file.effects.insert(sensor);
    }
    let moved = lever(file) - before;
    let offset = Vector3::new(left + moved[0], right + moved[0], y + moved[1]);
    let from = with_friction(&hypothesis.vehicle, level - hypothesis.friction_level);
    let spin = |vehicle: &Vehicle| spin_with(vehicle, file.effects.clone());
    let own = spin_with(&hypothesis.vehicle, hypothesis.effects.clone());
    let wanted = own.map(|own| own + offset);
    let absorbed = wanted.and_then(|wanted| Calibration::Vehicle.absorbed(&from, wanted, &spin));
    let alone = || {
        let rest = Hypothesis { offset: offset.into(), ..hypothesis.clone() };
        let calibrated = Calibration::Vehicle.calibrated(&rest)?;
        Some(with_friction(&calibrated.vehicle, level - hypothesis.friction_level))
    };
    let absorbed = absorbed.map(|absorbed| absorbed.vehicle);
    let vehicle = absorbed.or_else(alone).unwrap_or(from);
    file.vehicle.friction = vehicle.friction;
    file.vehicle.cog = vehicle.cog;
}

/// The effect that tells the place of the pose sensor, with the sensor of a vehicle file moved by
/// (x right, y forward), m; none where no effect tells it.
fn moved_sensor(file: &VehicleFile, by: [f64; 2]) -> Option<ActiveEffect> {
    EffectId::all().find_map(|effect| {
        let parameters = effect.card().parameters;
        let lever = |values: &[f64]| {
            Vector2::from(single(&file.vehicle, &active(effect, values)).sensor().lever)
        };
        let none: Vec<f64> = parameters.iter().map(neutral).collect();
        let [first, second] = parameters else { return None };
        let slope = |place: usize, parameter: &Parameter| {
            let mut moved = none.clone();
            moved[place] = parameter.typical;
            (lever(&moved) - lever(&none)) / (parameter.typical - none[place])
        };
        let slopes = Matrix2::from_columns(&[slope(0, first), slope(1, second)]);
        let sizes = slopes.try_inverse()? * Vector2::from(by);
        let present =
            file.effects.get(effect.card().id).map_or(none.clone(), |one| one.values().to_vec());
        Some(active(effect, &[present[0] + sizes[0], present[1] + sizes[1]]))
    })
}

/// Constant ICRs of a vehicle without effects, in a slow spin, m.
fn spin(vehicle: &Vehicle) -> Option<Vector3<f64>> {
    spin_with(vehicle, Effects::none())
}

/// Constant ICRs of a vehicle with effects, in a slow spin, m.
pub(crate) fn spin_with(vehicle: &Vehicle, effects: Effects) -> Option<Vector3<f64>> {
    let model = Model::new(vehicle.clone(), effects);
    let solution = Stationary::new(&model, &Circumstance::default()).solve(PerSide::new(-0.1, 0.1));
    solution.icrs.map(Icrs::to_array).map(Vector3::from)
}

/// The hypothesis with another vehicle, and the offset that keeps its constant ICRs.
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

    /// An unclaimed effect leaves its shift of the ICRs, and the offset, to the vehicle; friction
    /// keeps its own level.
    #[test]
    fn the_vehicle_takes_over_what_is_not_claimed() {
        const LEVEL: f64 = 0.1;
        const MAX_DIFFERENCE: f64 = 0.1;
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
        correct_constants(&mut file, &hypothesis, LEVEL, MAX_DIFFERENCE);
        let off = spin(&file.vehicle).expect("a spin") - wanted;
        assert!(off.norm() < 1e-6, "{off}");
        assert!((product(&file.vehicle) / before - (2.0 * LEVEL).exp()).abs() < 1e-9);
        // an effect in the file as fitted is not absorbed
        let mut file = VehicleFile::auriga_alpha();
        file.effects.insert(hypothesis.effect(gradient).expect("there").clone());
        correct_constants(&mut file, &hypothesis, 0.0, MAX_DIFFERENCE);
        let off = spin_with(&file.vehicle, file.effects.clone()).expect("a spin") - wanted;
        assert!(off.norm() < 1e-6, "{off}");
        // nor one that changes what the friction ratio does to the ICRs
        let concentration = EffectId::of("pressure-concentration").expect("an effect");
        let concentration = active(concentration, &[1.6]);
        let hypothesis = hypothesis.without(gradient).with_effect(concentration);
        let mut file = VehicleFile::auriga_alpha();
        file.effects = hypothesis.effects.clone();
        correct_constants(&mut file, &hypothesis, LEVEL, MAX_DIFFERENCE);
        let own = spin_with(&hypothesis.vehicle, hypothesis.effects.clone()).expect("a spin");
        let there = spin_with(&file.vehicle, file.effects).expect("a spin");
        let off = there - own - Vector3::from(hypothesis.offset);
        assert!(off.norm() < 1e-6, "{off}");
    }

    /// A fit that leaves an offset found no centre of gravity for the offset common to both ICRs.
    /// Seen from the moved sensor, the ICRs are where the fit has them.
    #[test]
    fn what_the_fit_leaves_to_no_centre_of_gravity_is_left_to_the_sensor() {
        let mut file = VehicleFile::auriga_alpha();
        let before = file.vehicle.clone();
        let filed = Hypothesis::filed(&file, &settings::Prior::default());
        let hypothesis = Hypothesis { offset: [0.03, 0.05, -0.02], ..filed };
        correct_constants(&mut file, &hypothesis, 0.0, 0.004);
        let [right, forward] = file.model().sensor().lever;
        let seen = spin_with(&file.vehicle, file.effects.clone()).expect("a spin")
            - Vector3::new(right, right, forward);
        let wanted = spin(&before).expect("a spin") + Vector3::from(hypothesis.offset);
        assert!((seen - wanted).norm() < 1e-6, "{seen} {wanted}");
        let moved = [0, 1].map(|axis| file.vehicle.cog[axis] - before.cog[axis]);
        // the friction ratio takes the rest, and moves the middle by little
        assert!(moved.iter().all(|moved| moved.abs() < 2e-3), "{moved:?}");
        assert!((right + 0.04).abs() < 1e-9 && (forward - 0.02).abs() < 1e-9);
    }
}
