//! A stage of a step: the balance of forces at the end of a short interval.

use crate::newton::{self, Convergence, Evaluation, Tolerance};
use crate::{Balance, Ground, Model, Motion};
use nalgebra::{SMatrix, SVector, Vector3};
use trackdyn_core::{Dual, PerSide, Scalar, Side, Twist};

/// Tolerance of the residual over the weight: 10⁻⁹ of gravity moves no robot.
const TOLERANCE: Tolerance = Tolerance { converged: 1e-11, rounding: 1e-9, is_trusting: false };

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
    /// Inverse Jacobian at that motion, if known.
    pub inverse: Inverse,
}

/// A solved balance.
pub struct Balanced {
    pub motion: Motion,
    /// Traction over normal load, forward positive, with belt slip on the sprockets; else zero.
    pub traction: PerSide<f64>,
    pub inverse: Inverse,
}

/// Inverse of the Jacobian of a balance.
#[derive(Clone, Copy, Debug, Default)]
pub enum Inverse {
    #[default]
    Unknown,
    Firm(SMatrix<f64, UNKNOWNS_WITHOUT_SLIP, UNKNOWNS_WITHOUT_SLIP>),
    Slipping(SMatrix<f64, UNKNOWNS_WITH_SLIP, UNKNOWNS_WITH_SLIP>),
}

impl Stage<'_> {
    /// Solves the balance; none without convergence.
    pub fn solve(&self, start: &Start) -> Option<Balanced> {
        if self.model.drive().slip_per_traction == 0.0 {
            let known = if let Inverse::Firm(known) = start.inverse { Some(known) } else { None };
            self.balanced(&self.search(start, PerSide::default(), known), Inverse::Firm)
        } else {
            let known =
                if let Inverse::Slipping(known) = start.inverse { Some(known) } else { None };
            self.balanced(&self.search(start, start.traction, known), Inverse::Slipping)
        }
    }

    fn balanced<const N: usize>(
        &self,
        found: &Convergence<N>,
        inverse: impl Fn(SMatrix<f64, N, N>) -> Inverse,
    ) -> Option<Balanced> {
        let z = found.point.into();
        let inverse = found.inverse.map_or(Inverse::Unknown, inverse);
        let motion = self.motion(&z);
        found.is_root.then(|| Balanced { motion, traction: traction(&z), inverse })
    }

    /// Solves from the given start, then from turning and sticking tracks.
    fn search<const N: usize>(
        &self,
        start: &Start,
        traction: PerSide<f64>,
        inverse: Option<SMatrix<f64, N, N>>,
    ) -> Convergence<N> {
        let PerSide { left, right } = self.model.drive().belt_speed(self.driven, traction);
        let Twist { v_x, v_y, w } = start.twist;
        let stays = Vector3::new(v_x, v_y - left, w);
        let follows = Vector3::new(v_x, v_y - start.belt_speed.left, w);
        let at = |departure: Vector3<f64>| {
            let unknowns =
                [departure[0], departure[1], departure[2], traction.left, traction.right];
            SVector::<f64, N>::from_fn(|row, _| unknowns[row])
        };
        let tolerance = TOLERANCE.at(self.model.resolution());
        let residual = |z: SVector<f64, N>| SVector::from(self.residual::<f64, N>(z.into()));
        let near = inverse.and_then(|inverse| {
            let start = at(follows);
            newton::from_near((start, residual(start)), inverse, tolerance, residual)
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
        newton::first_root(ends, |end| end).expect("several starts were tried")
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
    pub fn residual_from<S: Scalar, const N: usize>(&self, z: [S; N], base: &[S; 3]) -> [S; N] {
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
