//! The motion in which a step ends.

use super::balance::{Balance, Residual, Trial};
use nalgebra::{SMatrix, SVector};
use trackdyn_core::{PerSide, Twist, Wrench};

/// Number of unknowns where belts follow their sprockets: the twist.
pub(super) const TWIST_UNKNOWNS: usize = 3;

/// Number of unknowns where belts slip on them: the twist and the speeds of the belts.
pub(super) const SLIPPING_BELT_UNKNOWNS: usize = 5;

/// Largest residual of a balance, in parts of the weight. An ICR is off by about this part of a
/// metre.
const MAX_RESIDUAL: f64 = 1e-8;

/// Step of difference quotients, m/s: far below what slides a shoe out of its
/// elastic range within a step.
const QUOTIENT_STEP: f64 = 1e-7;

/// Largest number of iterations of a step.
const MAX_ITERATIONS: usize = 60;

/// Largest number of halvings of a step that does not bring the residual down.
const MAX_HALVINGS: u32 = 6;

/// Smallest ratio of a residual to the one before that counts as no contraction.
const MIN_STALLED_CONTRACTION: f64 = 0.9;
/// Largest number of iterations without contraction. After them a shorter step is better.
const MAX_STALLED_ITERATIONS: usize = 4;

/// Newton's method with difference quotients, whose Jacobian is kept from step to step and
/// corrected by Broyden's rule for as long as it serves.
#[derive(Clone, Debug, Default)]
pub(super) struct Newton<const N: usize> {
    jacobian: Option<SMatrix<f64, N, N>>,
}

/// The balance over the scaled unknowns (v_x, v_y, ω L), in parts of the weight, and the speeds of
/// belts that slip, m/s.
struct Scaled<'a, 'b> {
    balance: &'a mut Balance<'b>,
    length: f64,
    weight: f64,
}

impl Scaled<'_, '_> {
    fn trial<const N: usize>(&self, q: &SVector<f64, N>) -> Trial {
        let sprocket = self.balance.scene().sprocket;
        let belt = |k: usize, follows: f64| q.get(k).copied().unwrap_or(follows);
        Trial {
            twist: Twist { v_x: q[0], v_y: q[1], w: q[2] / self.length },
            belt: PerSide::new(belt(3, sprocket.left), belt(4, sprocket.right)),
        }
    }

    fn residual<const N: usize>(&mut self, q: &SVector<f64, N>) -> SVector<f64, N> {
        let Residual { wrench, belt } = self.balance.residual(&self.trial(q));
        let Wrench { force_x, force_y, moment } = wrench;
        let forces = [force_x, force_y, moment / self.length].map(|part| part / self.weight);
        let rows = [forces[0], forces[1], forces[2], belt.left, belt.right];
        SVector::from_fn(|row, _| rows[row])
    }

    fn jacobian<const N: usize>(
        &mut self,
        q: &SVector<f64, N>,
        residual: &SVector<f64, N>,
    ) -> SMatrix<f64, N, N> {
        SMatrix::from_columns(&std::array::from_fn::<_, N, _>(|k| {
            let mut ahead = *q;
            ahead[k] += QUOTIENT_STEP;
            (self.residual(&ahead) - residual) / QUOTIENT_STEP
        }))
    }
}

impl<const N: usize> Newton<N> {
    /// The end of a step, looked for from where it starts, with belts at speeds `belt`; or why
    /// there is none. The end is the trial that the balance looked at last.
    pub(super) fn solve(
        &mut self,
        balance: &mut Balance,
        belt: &PerSide<f64>,
    ) -> Result<Trial, String> {
        let scene = balance.scene();
        let (length, weight) = (scene.vehicle.gauge, scene.total_weight());
        let Twist { v_x, v_y, w } = scene.twist;
        let mut scaled = Scaled { balance, length, weight };
        let start = [v_x, v_y, w * length, belt.left, belt.right];
        let mut q = SVector::<f64, N>::from_fn(|row, _| start[row]);
        let mut residual = scaled.residual(&q);
        let mut stalls = 0;
        for _ in 0..MAX_ITERATIONS {
            if residual.norm() < MAX_RESIDUAL {
                return Ok(scaled.trial(&q));
            }
            let fresh = self.jacobian.is_none();
            let jacobian = self.jacobian.unwrap_or_else(|| scaled.jacobian(&q, &residual));
            let Some(inverse) = jacobian.try_inverse() else {
                self.jacobian = None;
                if fresh {
                    break;
                }
                continue;
            };
            let step = -(inverse * residual);
            let Some((share, next)) = shorten(&mut scaled, &q, &step, &residual, fresh) else {
                self.jacobian = None;
                if fresh {
                    break;
                }
                continue;
            };
            let contraction = next.norm() / residual.norm();
            // where shoes stop, friction that creeps has a kink: a shorter step is the way past it
            stalls = if contraction > MIN_STALLED_CONTRACTION { stalls + 1 } else { 0 };
            if stalls == MAX_STALLED_ITERATIONS {
                break;
            }
            let taken = step * share;
            // J += (Δr − J Δq) Δqᵀ/|Δq|²
            let correction = (next - residual - jacobian * taken) * taken.transpose();
            let serves = share == 1.0 && contraction < 0.3;
            self.jacobian = serves.then(|| jacobian + correction / taken.norm_squared());
            q += taken;
            residual = next;
        }
        self.jacobian = None;
        Err(format!(
            "no motion balances the forces: {:.1e} of the weight are left over",
            residual.norm()
        ))
    }
}

/// The share of a step that brings the residual down, and the residual there. A Jacobian that is
/// not fresh gets one chance.
fn shorten<const N: usize>(
    scaled: &mut Scaled,
    q: &SVector<f64, N>,
    step: &SVector<f64, N>,
    residual: &SVector<f64, N>,
    fresh: bool,
) -> Option<(f64, SVector<f64, N>)> {
    let mut share = 1.0;
    for _ in 0..if fresh { MAX_HALVINGS } else { 1 } {
        let next = scaled.residual(&(q + step * share));
        if next.norm() < (1.0 - 1e-4 * share) * residual.norm() {
            return Some((share, next));
        }
        share /= 2.0;
    }
    None
}
