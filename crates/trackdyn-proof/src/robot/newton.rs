//! The twist at which a step ends.

use super::balance::Balance;
use nalgebra::{Matrix3, Vector3};
use trackdyn_core::{Twist, Wrench};

/// Residual, in parts of the weight, at which the balance is found. An ICR is off by about this part of a
/// metre.
const TOLERANCE: f64 = 1e-8;

/// Speed by which difference quotients reach out, m/s: far below what slides a shoe out of its elastic
/// range within a step.
const REACH: f64 = 1e-7;

const ITERATIONS: usize = 60;

/// Halvings of a step that does not bring the residual down.
const HALVINGS: u32 = 6;

/// Contraction of the residual that is as good as none.
const STALLED: f64 = 0.9;
/// Iterations without contraction after which a shorter step is better than more of them.
const STALLS: usize = 4;

/// Newton's method with difference quotients, whose Jacobian is kept from step to step and corrected by
/// Broyden's rule for as long as it serves.
#[derive(Clone, Debug, Default)]
pub(super) struct Newton {
    jacobian: Option<Matrix3<f64>>,
}

/// The balance over the scaled unknowns (v_x, v_y, ω L), in parts of the weight.
struct Scaled<'a, 'b> {
    balance: &'a mut Balance<'b>,
    length: f64,
    weight: f64,
}

impl Scaled<'_, '_> {
    fn twist(&self, q: &Vector3<f64>) -> Twist {
        Twist { v_x: q.x, v_y: q.y, w: q.z / self.length }
    }

    fn residual(&mut self, q: &Vector3<f64>) -> Vector3<f64> {
        let Wrench { force_x, force_y, moment } = self.balance.residual(&self.twist(q));
        Vector3::new(force_x, force_y, moment / self.length) / self.weight
    }

    fn jacobian(&mut self, q: &Vector3<f64>, residual: &Vector3<f64>) -> Matrix3<f64> {
        Matrix3::from_columns(&[0, 1, 2].map(|k| {
            let mut ahead = *q;
            ahead[k] += REACH;
            (self.residual(&ahead) - residual) / REACH
        }))
    }
}

impl Newton {
    /// The twist, or why there is none.
    pub(super) fn solve(&mut self, balance: &mut Balance) -> Result<Twist, String> {
        let scene = balance.scene();
        let (length, weight) = (scene.vehicle.gauge, scene.total_weight());
        let Twist { v_x, v_y, w } = scene.twist;
        let mut scaled = Scaled { balance, length, weight };
        let mut q = Vector3::new(v_x, v_y, w * length);
        let mut residual = scaled.residual(&q);
        let mut stalls = 0;
        for _ in 0..ITERATIONS {
            if residual.norm() < TOLERANCE {
                return Ok(scaled.twist(&q));
            }
            let fresh = self.jacobian.is_none();
            let jacobian = self.jacobian.unwrap_or_else(|| scaled.jacobian(&q, &residual));
            let Some(step) = jacobian.lu().solve(&-residual) else {
                self.jacobian = None;
                if fresh {
                    break;
                }
                continue;
            };
            let Some((share, next)) = shorten(&mut scaled, &q, &step, &residual, fresh) else {
                self.jacobian = None;
                if fresh {
                    break;
                }
                continue;
            };
            let contraction = next.norm() / residual.norm();
            // where shoes stop, friction that creeps has a kink: a shorter step is the way past it
            stalls = if contraction > STALLED { stalls + 1 } else { 0 };
            if stalls == STALLS {
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

/// The share of a step that brings the residual down, and the residual there. A Jacobian that is not
/// fresh gets one chance.
fn shorten(
    scaled: &mut Scaled,
    q: &Vector3<f64>,
    step: &Vector3<f64>,
    residual: &Vector3<f64>,
    fresh: bool,
) -> Option<(f64, Vector3<f64>)> {
    let mut share = 1.0;
    for _ in 0..if fresh { HALVINGS } else { 1 } {
        let next = scaled.residual(&(q + step * share));
        if next.norm() < (1.0 - 1e-4 * share) * residual.norm() {
            return Some((share, next));
        }
        share /= 2.0;
    }
    None
}
