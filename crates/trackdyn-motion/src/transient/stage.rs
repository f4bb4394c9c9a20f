//! One stage of a step: the balance of forces at the end of a short time.

use crate::newton::{self, Convergence, Evaluation, Tolerance};
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{Dual, PerSide, Scalar, Side, Twist, Wrench};
use trackdyn_physics::{Ground, Model, Motion};

/// Residual over the weight: 10⁻⁹ of gravity is far below what moves a robot.
const TOLERANCE: Tolerance = Tolerance { converged: 1e-11, rounding: 1e-9 };

/// What is held fixed while the twist is sought.
pub struct Stage<'a> {
    pub model: &'a Model,
    pub ground: &'a Ground,
    /// Speeds of the belts, m/s.
    pub belt_speed: PerSide<f64>,
    /// Twist from which the acceleration counts, paper's frame.
    pub base: Twist,
    /// One over the time from there, 1/s; zero where there is no inertia.
    pub per_second: f64,
    /// Slip velocity ε below which a track sticks, m/s.
    pub creep: f64,
}

impl Stage<'_> {
    /// Finds the departure from straight driving at the left belt's speed that balances the forces.
    ///
    /// Starts from `guess`, a twist that went with the belt speeds `before`; then from tracks that stick. `inverse` is
    /// that of the Jacobian there, where it is known.
    pub fn solve(
        &self,
        guess: &Twist,
        before: &PerSide<f64>,
        inverse: Option<Matrix3<f64>>,
    ) -> Convergence {
        let left = self.belt_speed.left;
        let stays = Vector3::new(guess.v_x, guess.v_y - left, guess.w);
        let follows = Vector3::new(guess.v_x, guess.v_y - before.left, guess.w);
        let residual = |z: Vector3<f64>| Vector3::from(self.residual([z[0], z[1], z[2]]));
        let near =
            inverse.and_then(|inverse| newton::from_near(follows, inverse, TOLERANCE, residual));
        if let Some(near) = near {
            return near;
        }
        // Stick in the direction in which the robot slid before; of a robot that did not, held back.
        let slid = follows.norm();
        let sticks = if slid > 0.0 {
            follows * (self.creep / slid.max(self.creep))
        } else {
            Vector3::new(0.0, -self.creep * left.signum(), 0.0)
        };
        let right = Vector3::new(0.0, self.belt_speed.right - left, 0.0);
        let starts = [follows, stays, sticks, self.turning(), right + sticks];
        let ends = starts.into_iter().map(|start| {
            newton::solve(
                start,
                f64::INFINITY,
                TOLERANCE,
                |z| Evaluation::of_dual(self.residual(Dual::variables(z.into()))),
                residual,
            )
        });
        newton::first_root(ends, |end| end).expect("several starts were tried")
    }

    /// A turn about a point a quarter of the contact length outside the slower track's centre-line.
    fn turning(&self) -> Vector3<f64> {
        let [rear, front] = self.model.footprint().ends;
        let x = self.model.vehicle().gauge / 2.0 + (front - rear) / 4.0;
        let difference = self.belt_speed.right - self.belt_speed.left;
        // w = (V_r − V_l)/(x_r − x_l), eq. (9)
        let w = difference / (2.0 * x);
        Vector3::new(w * self.model.vehicle().cog[1], difference / 2.0, w)
    }

    /// The motion with this departure from straight driving.
    pub fn motion<S: Scalar>(&self, [v_x, v_y, w]: [S; 3]) -> Motion<S> {
        let Twist { v_x: base_x, v_y: base_y, w: base_w } = self.base;
        let per_second = self.per_second;
        // u̇ = (u − u_b)/(γ h)
        let acceleration = Twist {
            v_x: (v_x - base_x) * per_second,
            v_y: (v_y + (self.belt_speed.left - base_y)) * per_second,
            w: (w - base_w) * per_second,
        };
        let departure = Twist { v_x, v_y, w };
        Motion::departing(self.belt_speed, departure, acceleration, self.model.extent())
    }

    /// Traction of each side over its normal load, forward positive.
    pub fn traction(&self, motion: &Motion) -> PerSide<f64> {
        let balance = self.model.balance(self.ground, motion);
        PerSide::from_fn(|side| {
            grip(motion.slip[side].speed, self.creep) * balance.friction[side].force_y
                / balance.normal_load[side]
        })
    }

    /// Force over weight and moment over weight times gauge.
    #[inline]
    fn residual<S: Scalar>(&self, z: [S; 3]) -> [S; 3] {
        let motion = self.motion(z);
        let sum = net_force(self.model, self.ground, &motion, self.creep);
        let force = self.model.vehicle().weight().recip();
        let moment = force / self.model.vehicle().gauge;
        [sum.force_x * force, sum.force_y * force, sum.moment * moment]
    }
}

/// The sum of all forces on the body, which is zero where they balance; tracks stick below the slip velocity `creep`, m/s.
#[inline]
pub fn net_force<S: Scalar>(
    model: &Model,
    ground: &Ground,
    motion: &Motion<S>,
    creep: f64,
) -> Wrench<S> {
    let balance = model.balance(ground, motion);
    let mut sum = balance.load;
    for side in Side::BOTH {
        sum += balance.friction[side].scaled(grip(motion.slip[side].speed, creep));
    }
    sum
}

/// Share of its friction that a side with the root mean square slip σ (m/s) has.
#[inline]
fn grip<S: Scalar>(slip: S, creep: f64) -> S {
    // σ/√(σ² + ε²)
    slip / (slip * slip + creep * creep).sqrt()
}
