//! Damped Newton's method, and Broyden's method, for a few equations.

use crate::contact::Resolution;
use nalgebra::{SMatrix, SVector};
use trackdyn_core::Dual;

/// Criteria of convergence.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Norm of the residual at which the iteration stops.
    pub converged: f64,
    /// Norm of the residual up to which a point counts as a root when rounding prevents more.
    pub rounding: f64,
    /// Whether a step that by the last rate of convergence ends there is not evaluated again.
    pub is_trusting: bool,
}

impl Tolerance {
    /// Tolerance for friction computed to half the digits.
    const COARSE: Self = Self { converged: 1e-8, rounding: 1e-7, is_trusting: true };

    /// This tolerance, with a residual that counts as converged if that is larger.
    pub fn at_least(self, converged: f64) -> Self {
        if converged <= self.converged {
            return self;
        }
        Self { converged, rounding: self.rounding.max(converged), is_trusting: true }
    }

    /// Tolerance at a resolution of friction: a root is no more accurate than that.
    pub fn at(self, resolution: Resolution) -> Self {
        if resolution == Resolution::Fine { self } else { Self::COARSE }
    }
}

/// Residual below which the next Newton step is expected to be the last, so that its Jacobian is
/// not computed.
const LAST_STEP_RESIDUAL: f64 = 1e-6;

const MAX_ITERATIONS: usize = 80;

/// Share of the predicted decrease of the residual's norm that a step must bring.
const SUFFICIENT_DECREASE: f64 = 1e-4;

/// Smallest share of a Newton step that is tried: below, no root is near, and another start is
/// better.
const MIN_STEP_SHARE: f64 = 1e-3;

/// Residual and Jacobian at a point.
pub struct Evaluation<const N: usize> {
    /// Residual of each equation.
    pub residual: SVector<f64, N>,
    /// Its derivatives by the unknowns.
    pub jacobian: SMatrix<f64, N, N>,
}

impl<const N: usize> Evaluation<N> {
    /// From a residual in dual numbers with derivatives by the unknowns.
    #[inline]
    pub fn of_dual(residual: [Dual<N>; N]) -> Self {
        Self { residual: SVector::from(residual.map(|r| r.value)), jacobian: gradients(&residual) }
    }
}

/// Derivatives of dual numbers, a row for each.
#[inline]
pub fn gradients<const ROWS: usize, const N: usize>(
    rows: &[Dual<N>; ROWS],
) -> SMatrix<f64, ROWS, N> {
    SMatrix::from_fn(|row, column| rows[row].gradient[column])
}

/// End of the iteration.
#[derive(Clone, Copy, Debug)]
pub struct Convergence<const N: usize> {
    /// The last point.
    pub point: SVector<f64, N>,
    /// Norm of the residual there.
    pub residual: f64,
    /// Newton steps taken.
    pub iterations: usize,
    /// Whether the point is a root to rounding.
    pub is_root: bool,
    /// Inverse of the Jacobian near the point; none where it is singular or was not computed.
    pub inverse: Option<SMatrix<f64, N, N>>,
}

/// Largest ratio of the residual after a Broyden step to that before.
const MAX_RESIDUAL_RATIO: f64 = 0.6;

/// Broyden's method from a `start` near a root; none where it does not converge.
///
/// `value` is the residual at the start, `inverse` the inverse Jacobian at a nearby point. Each
/// step s with change y of the residual updates it:
/// B ← B + (s − B y) sᵀB/(sᵀB y).
#[inline]
pub fn from_near<const N: usize>(
    (start, value): (SVector<f64, N>, SVector<f64, N>),
    inverse: SMatrix<f64, N, N>,
    tolerance: Tolerance,
    residual: impl Fn(SVector<f64, N>) -> SVector<f64, N>,
) -> Option<Convergence<N>> {
    let (mut point, mut value, mut inverse) = (start, value, inverse);
    let (mut norm, mut ratio) = (value.norm(), 1.0);
    let mut iterations = 0;
    if norm.is_nan() {
        return None;
    }
    while norm > tolerance.converged {
        let step = -(inverse * value);
        point += step;
        iterations += 1;
        if tolerance.is_trusting && ratio * norm <= tolerance.converged {
            norm *= ratio;
            break;
        }
        let next = residual(point);
        let next_norm = next.norm();
        if next_norm.is_nan() || next_norm > MAX_RESIDUAL_RATIO * norm {
            return None;
        }
        let mapped = inverse * (next - value);
        let along = step.transpose() * inverse;
        inverse += (step - mapped) * along / step.dot(&mapped);
        (value, norm, ratio) = (next, next_norm, next_norm / norm);
    }
    let inverse = Some(inverse).filter(|inverse| inverse.iter().all(|value| value.is_finite()));
    Some(Convergence { point, residual: norm, iterations, is_root: true, inverse })
}

/// Newton's method from `start`. `evaluate` gives residual and Jacobian, `residual` the residual
/// alone. No step moves the first two unknowns by more than `longest_step`.
#[inline]
pub fn solve<const N: usize>(
    start: SVector<f64, N>,
    longest_step: f64,
    tolerance: Tolerance,
    evaluate: impl Fn(SVector<f64, N>) -> Evaluation<N>,
    residual: impl Fn(SVector<f64, N>) -> SVector<f64, N>,
) -> Convergence<N> {
    let mut point = start;
    let mut at = evaluate(point);
    let mut norm = at.residual.norm();
    let mut iterations = 0;
    let mut inverse = None;
    let ended = |point, norm: f64, iterations, inverse| Convergence {
        point,
        residual: norm,
        iterations,
        is_root: norm <= tolerance.rounding,
        inverse,
    };
    while norm > tolerance.converged && iterations < MAX_ITERATIONS {
        let Some(here) = at.jacobian.try_inverse() else { break };
        inverse = Some(here);
        let step = -(here * at.residual);
        if norm < LAST_STEP_RESIDUAL {
            let last = point + step;
            let last_norm = residual(last).norm();
            if last_norm <= tolerance.converged {
                return ended(last, last_norm, iterations + 1, inverse);
            }
        }
        let mut fraction = (longest_step / step.fixed_rows::<2>(0).norm()).min(1.0);
        let accepted = loop {
            let trial = point + step * fraction;
            let next = evaluate(trial);
            let next_norm = next.residual.norm();
            if next_norm <= (1.0 - SUFFICIENT_DECREASE * fraction) * norm {
                break Some((trial, next, next_norm));
            }
            fraction *= 0.5;
            if fraction < MIN_STEP_SHARE {
                break None;
            }
        };
        let Some((trial, next, next_norm)) = accepted else { break };
        (point, at, norm) = (trial, next, next_norm);
        iterations += 1;
    }
    ended(point, norm, iterations, inverse)
}

/// The first result that is a root, or else the one with the smallest residual. Lazy: starts after
/// a root are not tried.
pub fn first_root<E, const N: usize>(
    ends: impl Iterator<Item = E>,
    convergence: impl Fn(&E) -> &Convergence<N>,
) -> Option<E> {
    let mut best: Option<E> = None;
    for end in ends {
        let Convergence { residual, is_root, .. } = *convergence(&end);
        if is_root {
            return Some(end);
        }
        if best.as_ref().is_none_or(|best| residual < convergence(best).residual) {
            best = Some(end);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Vector3};

    const EXACT_TOLERANCE: Tolerance =
        Tolerance { converged: 1e-13, rounding: 1e-11, is_trusting: false };

    fn quadratic(root: Vector3<f64>) -> impl Fn(Vector3<f64>) -> Evaluation<3> {
        move |z| {
            let d = z - root;
            Evaluation {
                residual: d + d.component_mul(&d) * 0.3,
                jacobian: Matrix3::from_diagonal(&d.map(|d| 1.0 + 0.6 * d)),
            }
        }
    }

    #[test]
    fn finds_a_root_quadratically() {
        let root = Vector3::new(1.0, -2.0, 0.5);
        let f = quadratic(root);
        let found = solve(Vector3::zeros(), 10.0, EXACT_TOLERANCE, &f, |z| f(z).residual);
        assert!(found.is_root && found.iterations <= 8);
        assert!((found.point - root).norm() < 1e-12);
    }

    #[test]
    fn finds_a_near_root_without_derivatives_and_leaves_a_far_one() {
        let root = Vector3::new(1.0, -2.0, 0.5);
        let f = |z| quadratic(root)(z).residual;
        let begin = |distance: f64| {
            let start = root + Vector3::repeat(distance);
            // the Jacobian of another point
            from_near((start, f(start)), Matrix3::identity() * 0.9, EXACT_TOLERANCE, f)
        };
        let found = begin(0.1).expect("it is near");
        assert!(found.is_root && (found.point - root).norm() < 1e-12, "{found:?}");
        assert!(begin(10.0).is_none() && begin(f64::NAN).is_none());
        let start = root + Vector3::repeat(0.1);
        let away = from_near((start, f(start)), -Matrix3::identity(), EXACT_TOLERANCE, f);
        assert!(away.is_none());
    }

    #[test]
    fn says_so_where_there_is_no_root() {
        let f = |z: Vector3<f64>| Evaluation {
            residual: Vector3::new(1.0 + z[0] * z[0], z[1], z[2]),
            jacobian: Matrix3::from_diagonal(&Vector3::new(2.0 * z[0], 1.0, 1.0)),
        };
        let found = solve(Vector3::new(0.7, 0.1, 0.1), 10.0, EXACT_TOLERANCE, f, |z| f(z).residual);
        assert!(!found.is_root && found.residual >= 1.0);
    }
}
