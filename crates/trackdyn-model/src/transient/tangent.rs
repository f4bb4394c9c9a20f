//! First-order change of a simulated motion by a change of the forces.
//!
//! # Law
//! Each stage of each step solves r(z, u_b) = 0, with z the unknowns of the balance and u_b the
//! base of its acceleration. With other forces, r + δr,
//!
//! ```text
//! J δz = −δr − B δu_b,   J = ∂r/∂z,   B = ∂r/∂u_b
//! ```
//!
//! δr is taken at the motion itself, and δu_b follows from the stages before, by the scheme of the
//! [motion](super). A stage takes one evaluation of the other forces; a second simulation takes
//! several.
//!
//! # Assumes
//! Forces that do not depend on place, heading or time; equal gains and lags of the drive.

use super::stage::{Stage, UNKNOWNS_WITH_SLIP, UNKNOWNS_WITHOUT_SLIP, gripping};
use super::{GAMMA, Instant, Step, Transient, base_of_second};
use crate::newton::Evaluation;
use crate::{Circumstance, Ground, Model, Motion};
use nalgebra::{SMatrix, SVector, Vector3};
use trackdyn_core::{Dual, PerSide, Twist};

/// Change of the twist (paper's frame) in both stages of each step of a model's motion, by the
/// forces of each of the `others`.
///
/// `starts` are the changes at the start of the first step, `creep` is the slip velocity below
/// which a track sticks, m/s. A stage whose balance is singular leaves the change as it was.
pub fn tangents(
    model: &Model,
    steps: &[Step],
    others: &[Model],
    starts: &[Twist],
    creep: f64,
) -> Vec<Vec<[Twist; 2]>> {
    let slips = |model: &Model| model.drive().slip_per_traction != 0.0;
    let along = Along::new(model, others, creep);
    if slips(model) || others.iter().any(slips) {
        along.changes::<UNKNOWNS_WITH_SLIP>(steps, starts)
    } else {
        along.changes::<UNKNOWNS_WITHOUT_SLIP>(steps, starts)
    }
}

/// A model, and others with its motion.
struct Along<'a> {
    model: &'a Model,
    ground: Ground,
    others: Vec<(&'a Model, Ground)>,
    has_inertia: bool,
    creep: f64,
}

/// A linearised stage.
struct Linear<'a, const N: usize> {
    stage: Stage<'a>,
    /// The unknowns z.
    at: [f64; N],
    /// Their residual r, zero to the tolerance of the simulation.
    residual: SVector<f64, N>,
    /// J⁻¹; none where it is singular.
    inverse: Option<SMatrix<f64, N, N>>,
    /// B.
    by_base: SMatrix<f64, N, 3>,
}

impl<'a> Along<'a> {
    fn new(model: &'a Model, others: &'a [Model], creep: f64) -> Self {
        let level = Circumstance::default();
        let ground = model.ground(&level);
        let others = others.iter().map(|other| (other, other.ground(&level))).collect();
        Self { model, ground, others, has_inertia: Transient::feels_inertia(model), creep }
    }

    fn changes<const N: usize>(&self, steps: &[Step], starts: &[Twist]) -> Vec<Vec<[Twist; 2]>> {
        let mut ended = starts.to_vec();
        let mut changes = vec![Vec::with_capacity(steps.len()); self.others.len()];
        for step in steps {
            let [first, second] =
                step.stages.each_ref().map(|instant| self.linear::<N>(instant, step.duration));
            let others = self.others.iter().zip(&mut ended).zip(&mut changes);
            for ((other, ended), changes) in others {
                let one = first.change(other, *ended);
                let two = second.change(other, base_of_second(*ended, one));
                changes.push([one, two]);
                *ended = two;
            }
        }
        changes
    }

    fn linear<const N: usize>(&self, instant: &Instant, duration: f64) -> Linear<'_, N> {
        let Instant { driven, belt_speed, twist, rate } = *instant;
        let step = GAMMA * duration;
        // u_b = u − γ h u̇
        let base = twist - rate * step;
        let per_second = if self.has_inertia { step.recip() } else { 0.0 };
        let Self { model, ref ground, creep, .. } = *self;
        let stage = Stage { model, ground, driven, base, per_second, creep };
        let departure = Twist { v_y: twist.v_y - belt_speed.left, ..twist };
        // Tractions are unknowns only where belts slip on their sprockets.
        let traction = if N == UNKNOWNS_WITH_SLIP {
            self.traction(belt_speed, departure, rate)
        } else {
            PerSide::default()
        };
        let unknowns = [departure.v_x, departure.v_y, departure.w, traction.left, traction.right];
        let at: [f64; N] = std::array::from_fn(|row| unknowns[row]);
        let here = Evaluation::of_dual(stage.residual(Dual::<N>::variables(at)));
        let (residual, inverse) = (here.residual, here.jacobian.try_inverse());
        Linear { at, residual, inverse, by_base: stage.by_base(at), stage }
    }

    /// Traction of each side over its normal load at a motion, forward positive.
    fn traction(&self, belts: PerSide<f64>, departure: Twist, rate: Twist) -> PerSide<f64> {
        let motion = Motion::departing(belts, departure, rate, self.model.extent());
        let balance = gripping(self.model, &self.ground, &motion, self.creep);
        PerSide::from_fn(|side| balance.friction[side].force_y / balance.normal_load[side])
    }
}

impl<const N: usize> Linear<'_, N> {
    /// Change of the twist by the forces of another model, for a change `base` of u_b.
    fn change(&self, (model, ground): &(&Model, Ground), base: Twist) -> Twist {
        let Some(inverse) = self.inverse else { return base };
        let other = Stage { model, ground, ..self.stage };
        let by_forces = SVector::from(other.residual(self.at)) - self.residual;
        // δz = −J⁻¹ (δr + B δu_b)
        let change = inverse * -(by_forces + self.by_base * Vector3::from(base.to_array()));
        let there = (SVector::from(self.at) + change).into();
        let [there, here] =
            [other.motion::<f64, N>(&there), self.stage.motion(&self.at)].map(|at| at.twist);
        there - here
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ActiveEffect, VehicleFile};
    use trackdyn_core::{Plant, Pose, Trajectory, real};

    /// A small change of a parameter against the difference of two simulations with equal steps,
    /// through turns, a stop and a reversal.
    #[test]
    fn they_are_differences_of_two_simulations() {
        const STEP: f64 = 0.01;
        let drive = [(0.2, 0.8), (0.3, 0.5), (0.5, -0.5), (0.0, 0.0), (-0.4, -0.1), (0.4, 0.4)];
        let norm = |twist: Twist| Vector3::from(twist.to_array()).norm();
        let simulated = |model: &Model| -> Vec<Step> {
            let mut path = Trajectory::default();
            let mut robot =
                Transient::at_rest(model, 0.0, Pose::default()).with_step(STEP).with_steps();
            for (k, (left, right)) in drive.iter().enumerate() {
                let until = 0.1 * (real(k) + 1.0);
                robot.drive(PerSide::new(*left, *right), until, &mut path).expect("it moves");
            }
            robot.into_steps()
        };
        let model = |texts: &[&str]| {
            let effects = texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect"));
            Model::new(VehicleFile::auriga_alpha().vehicle, effects.collect())
        };
        let inertia = "yaw-inertia:strength=1,gyration_m=0.3";
        for [here, there] in [
            [&["load-transfer:cog_height_m=0.1"], &["load-transfer:cog_height_m=0.10001"]],
            [&["viscous-friction:growth_s_per_m=1"], &["viscous-friction:growth_s_per_m=1.0001"]],
            [&["belt-slip:slip=0.05"], &["belt-slip:slip=0.050005"]],
        ] {
            let [here, there] =
                [here, there].map(|texts| model(&[&texts[..], &[inertia, "centripetal"]].concat()));
            let [before, after] = [&here, &there].map(simulated);
            let others = [there];
            let changes = &tangents(
                &here,
                &before,
                &others,
                &[Twist::zero()],
                super::super::STICKING_SLIP_VELOCITY,
            )[0];
            let (mut off, mut largest) = (0.0_f64, 0.0_f64);
            for ((before, after), change) in before.iter().zip(&after).zip(changes) {
                for (k, change) in change.iter().enumerate() {
                    let difference = after.stages[k].twist - before.stages[k].twist;
                    off = off.max(norm(difference - *change));
                    largest = largest.max(norm(difference));
                }
            }
            assert!(largest > 1e-6 && off < 1e-3 * largest, "{off:.1e} of {largest:.1e}");
        }
    }
}
