//! A stage of a step: the balance of forces at the end of a short interval.

use crate::newton::{self, Convergence, Evaluation, Tolerance, gradients};
use crate::{Balance, Ground, Model, Motion};
use nalgebra::{SMatrix, SVector, Vector3};
use trackdyn_core::{Dual, PerSide, Scalar, Side, Twist};

/// Tolerance of the residual over the weight: 10⁻⁹ of gravity moves no robot.
pub const TOLERANCE: Tolerance = Tolerance { converged: 1e-11, rounding: 1e-9, is_trusting: false };

/// Number of unknowns without belt slip: departure of the twist from straight driving at the left
/// belt's speed.
pub const UNKNOWNS_WITHOUT_SLIP: usize = 3;

/// Number of unknowns with belt slip on the sprockets: also the traction of both sides over their
/// normal load.
pub const UNKNOWNS_WITH_SLIP: usize = 5;

/// Fixed values of a stage.
pub struct Stage<'a> {
    pub model: &'a Model,
    pub ground: &'a Ground,
    /// Sprocket speeds, m/s.
    pub driven: PerSide<f64>,
    /// Base twist u_b of the acceleration, paper's frame.
    pub base: Twist,
    /// 1/(γ h), 1/s; zero without inertia.
    pub per_second: f64,
    /// Slip velocity ε below which a track sticks, m/s.
    pub creep: f64,
}

/// Start of a solve.
pub struct Start {
    pub twist: Twist,
    /// Belt speeds at that motion, m/s.
    pub belt_speed: PerSide<f64>,
    /// Traction over normal load, forward positive.
    pub traction: PerSide<f64>,
    /// What is known of the Jacobian at that motion.
    pub known: Known,
    /// Residual over the weight that counts as balance.
    pub tolerance: Tolerance,
}

/// A solved balance.
pub struct Balanced {
    pub motion: Motion,
    /// Traction over normal load, forward positive, with belt slip on the sprockets; else zero.
    pub traction: PerSide<f64>,
    pub known: Known,
}

/// What is known of the Jacobian of a balance.
#[derive(Clone, Copy, Debug, Default)]
#[expect(clippy::large_enum_variant, reason = "a state is copied, which takes no time")]
pub enum Known {
    #[default]
    Nothing,
    Firm(Slopes<UNKNOWNS_WITHOUT_SLIP>),
    Slipping(Slopes<UNKNOWNS_WITH_SLIP>),
}

/// Jacobian of a balance, J = J_u + J_a/(γ h): by the twist, and by its rate.
#[derive(Clone, Copy, Debug)]
pub struct Slopes<const N: usize> {
    /// J⁻¹.
    inverse: SMatrix<f64, N, N>,
    /// J_a.
    by_rate: SMatrix<f64, N, N>,
    /// 1/(γ h), 1/s.
    per_second: f64,
}

impl<const N: usize> Slopes<N> {
    /// The Jacobian for a step of another length; none where it is singular.
    fn after(self, per_second: f64) -> Option<Self> {
        if per_second == self.per_second {
            return Some(self);
        }
        let longer = self.by_rate * (per_second - self.per_second);
        let inverse = (self.inverse.try_inverse()? + longer).try_inverse()?;
        Some(Self { inverse, per_second, ..self })
    }
}

impl Stage<'_> {
    /// Solves the balance; none without convergence.
    pub fn solve(&self, start: &Start) -> Option<Balanced> {
        if self.model.drive().slip_per_traction == 0.0 {
            let known = if let Known::Firm(known) = start.known { Some(known) } else { None };
            self.balanced(self.search(start, PerSide::default(), known), Known::Firm)
        } else {
            let known = if let Known::Slipping(known) = start.known { Some(known) } else { None };
            self.balanced(self.search(start, start.traction, known), Known::Slipping)
        }
    }

    fn balanced<const N: usize>(
        &self,
        (found, slopes): (Convergence<N>, Option<Slopes<N>>),
        known: impl Fn(Slopes<N>) -> Known,
    ) -> Option<Balanced> {
        let z = found.point.into();
        let known = slopes.map_or(Known::Nothing, known);
        let motion = self.motion(&z);
        found.is_root.then(|| Balanced { motion, traction: traction(&z), known })
    }

    /// Solves from the given start, then from turning and sticking tracks. Also returns the
    /// Jacobian at the end, where it was found.
    fn search<const N: usize>(
        &self,
        start: &Start,
        traction: PerSide<f64>,
        known: Option<Slopes<N>>,
    ) -> (Convergence<N>, Option<Slopes<N>>) {
        let PerSide { left, right } = self.model.drive().belt_speed(self.driven, traction);
        let Twist { v_x, v_y, w } = start.twist;
        let stays = Vector3::new(v_x, v_y - left, w);
        let follows = Vector3::new(v_x, v_y - start.belt_speed.left, w);
        let at = |departure: Vector3<f64>| {
            let unknowns =
                [departure[0], departure[1], departure[2], traction.left, traction.right];
            SVector::<f64, N>::from_fn(|row, _| unknowns[row])
        };
        let tolerance = start.tolerance;
        let residual = |z: SVector<f64, N>| SVector::from(self.residual::<f64, N>(z.into()));
        let near = known.and_then(|known| {
            let (start, known) = (at(follows), known.after(self.per_second)?);
            let inverse = known.inverse;
            let near = newton::from_near((start, residual(start)), inverse, tolerance, residual)?;
            Some((near, near.inverse.map(|inverse| Slopes { inverse, ..known })))
        });
        if let Some(near) = near {
            return near;
        }
        // Nearly stick, in the direction of the previous slip; without one, against the motion.
        let slid = follows.norm();
        let sticks = if slid > 0.0 {
            follows * (self.creep / slid.max(self.creep))
        } else {
            Vector3::new(0.0, -self.creep * left.signum(), 0.0)
        };
        let other = Vector3::new(0.0, right - left, 0.0);
        let starts = [follows, stays, sticks, self.turning(right - left), other + sticks];
        let ends = starts.into_iter().map(|start| {
            newton::solve(
                at(start),
                f64::INFINITY,
                tolerance,
                |z| Evaluation::of_dual(self.residual(Dual::variables(z.into()))),
                residual,
            )
        });
        let found = newton::first_root(ends, |end| end).expect("several starts were tried");
        let slopes = found.inverse.map(|inverse| {
            let by_rate = self.by_rate(found.point.into());
            Slopes { inverse, by_rate, per_second: self.per_second }
        });
        (found, slopes)
    }

    /// J_a: derivative of the residual by the unknowns, through the acceleration alone, times γ h.
    fn by_rate<const N: usize>(&self, z: [f64; N]) -> SMatrix<f64, N, N> {
        if self.per_second == 0.0 {
            return SMatrix::zeros();
        }
        let twist = gradients(&self.motion(&Dual::<N>::variables(z)).twist.to_array());
        // u̇ = (u − u_b)/(γ h): ∂r/∂u̇ = −γ h ∂r/∂u_b
        self.by_base(z) * twist * -self.per_second.recip()
    }

    /// Derivative of the residual by the base twist u_b.
    pub fn by_base<const N: usize>(&self, z: [f64; N]) -> SMatrix<f64, N, 3> {
        let base = Dual::<3>::variables(self.base.to_array());
        gradients(&self.residual_from(z.map(Dual::from), &base))
    }

    /// A turn with this difference of belt speeds (m/s), about a point a quarter of the contact
    /// length outside the slower track's centre-line.
    fn turning(&self, difference: f64) -> Vector3<f64> {
        let [rear, front] = self.model.footprint().ends;
        let x = self.model.vehicle().gauge / 2.0 + (front - rear) / 4.0;
        // w = (V_r − V_l)/(x_r − x_l), eq. (9)
        let w = difference / (2.0 * x);
        Vector3::new(w * self.model.vehicle().cog[1], difference / 2.0, w)
    }

    /// The motion at these unknowns.
    pub fn motion<S: Scalar, const N: usize>(&self, z: &[S; N]) -> Motion<S> {
        self.motion_from(z, &self.base.to_array().map(S::from))
    }

    /// The motion at these unknowns, from a base twist u_b = (v_x, v_y, w).
    #[inline]
    fn motion_from<S: Scalar, const N: usize>(&self, z: &[S; N], base: &[S; 3]) -> Motion<S> {
        let [v_x, v_y, w] = std::array::from_fn(|k| z[k]);
        let belt_speed = self.model.drive().belt_speed(self.driven, traction(z));
        let [base_x, base_y, base_w] = *base;
        let per_second = self.per_second;
        // u̇ = (u − u_b)/(γ h)
        let acceleration = Twist {
            v_x: (v_x - base_x) * per_second,
            v_y: (v_y + (belt_speed.left - base_y)) * per_second,
            w: (w - base_w) * per_second,
        };
        let departure = Twist { v_x, v_y, w };
        Motion::departing(belt_speed, departure, acceleration, self.model.extent())
    }

    /// Residual: force over weight and moment over weight times gauge. With belt slip, also
    /// friction minus traction of each side, over the weight.
    #[inline]
    pub fn residual<S: Scalar, const N: usize>(&self, z: [S; N]) -> [S; N] {
        self.residual_from(z, &self.base.to_array().map(S::from))
    }

    /// The residual, from a base twist u_b = (v_x, v_y, w).
    #[inline]
    fn residual_from<S: Scalar, const N: usize>(&self, z: [S; N], base: &[S; 3]) -> [S; N] {
        let motion = self.motion_from(&z, base);
        let balance = gripping(self.model, self.ground, &motion, self.creep);
        let sum = balance.sum();
        let force = self.model.vehicle().weight().recip();
        let moment = force / self.model.vehicle().gauge;
        let traction = traction(&z);
        // T − (T/N) N
        let off = PerSide::from_fn(|side| {
            (balance.friction[side].force_y - traction[side] * balance.normal_load[side]) * force
        });
        let rows =
            [sum.force_x * force, sum.force_y * force, sum.moment * moment, off.left, off.right];
        std::array::from_fn(|row| rows[row])
    }
}

/// Traction of each side over its normal load in the unknowns; zero where it is none of them.
#[inline]
fn traction<S: Scalar, const N: usize>(z: &[S; N]) -> PerSide<S> {
    let at = |k: usize| z.get(k).copied().unwrap_or(S::from(0.0));
    PerSide::new(at(UNKNOWNS_WITHOUT_SLIP), at(UNKNOWNS_WITHOUT_SLIP + 1))
}

/// Forces on the body, with friction regularised below the slip velocity `creep`, m/s. The ground
/// does not pull: a side without load has no friction, and the other one that of the weight.
#[inline]
pub fn gripping<S: Scalar>(
    model: &Model,
    ground: &Ground,
    motion: &Motion<S>,
    creep: f64,
) -> Balance<S> {
    let balance = model.balance(ground, motion);
    let load = balance.normal_load;
    let borne = |side: Side| match (load[side], load[side.other()]) {
        (own, _) if own.value() <= 0.0 => S::from(0.0),
        (own, other) if other.value() < 0.0 => (own + other) / own,
        _ => S::from(1.0),
    };
    let friction = PerSide::from_fn(|side| {
        balance.friction[side].scaled(borne(side) * grip(motion.slip[side].speed, creep))
    });
    Balance { friction, ..balance }
}

/// Regularisation factor of friction at the root mean square slip σ, m/s.
#[inline]
fn grip<S: Scalar>(slip: S, creep: f64) -> S {
    // σ/√(σ² + ε²)
    slip / (slip * slip + creep * creep).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ActiveEffect, Circumstance, VehicleFile};
    use nalgebra::Matrix3;

    fn jacobian(stage: &Stage, z: [f64; 3]) -> Matrix3<f64> {
        gradients(&stage.residual(Dual::<3>::variables(z)))
    }

    /// In one motion with one acceleration, by a short and by a long step.
    #[test]
    fn a_jacobian_for_a_step_of_another_length_is_that_of_the_step() {
        const LENGTHS: [f64; 2] = [400.0, 30.0];
        let texts = ["yaw-inertia", "centripetal", "load-transfer:cog_height_m=0.2"];
        let effects = texts.iter().map(|text| text.parse::<ActiveEffect>().expect("an effect"));
        let model = &Model::new(VehicleFile::auriga_alpha().vehicle, effects.collect());
        let ground = &model.ground(&Circumstance::default());
        let driven = PerSide::new(-0.2, 0.7);
        let twist = Twist { v_x: 0.02, v_y: 0.3, w: 0.9 };
        let rate = Twist { v_x: 0.4, v_y: -1.0, w: 2.0 };
        let z = [twist.v_x, twist.v_y - driven.left, twist.w];
        let [short, long] = LENGTHS.map(|per_second| {
            let base = twist - rate * per_second.recip();
            Stage { model, ground, driven, base, per_second, creep: 1e-6 }
        });
        let inverse = jacobian(&short, z).try_inverse().expect("regular");
        let known = Slopes { inverse, by_rate: short.by_rate(z), per_second: short.per_second };
        let found = known.after(long.per_second).expect("regular").inverse;
        let off = found * jacobian(&long, z) - Matrix3::identity();
        assert!(off.norm() < 1e-9, "{off}");
        let unchanged = inverse * jacobian(&long, z) - Matrix3::identity();
        assert!(unchanged.norm() > 0.1, "the length matters: {unchanged}");
    }
}
