//! The line of greatest likelihood through returns.

use crate::beam::{self, Beam};
use crate::line::Line;
use crate::scan::Return;
use nalgebra::{Matrix2, Vector2};
use trackdyn_core::Pose;

/// Largest number of Newton's steps; from the start below, three reach rounding.
const MAX_STEPS: usize = 10;

/// The line that minimises Σ (ρ − d/(n · u))²; `None` where the returns lie on none, or graze it.
///
/// The residual is along the beam, where the noise is: the derivatives then hold no noise, and the
/// line is not biased by it to first order.
pub(super) fn line(returns: &[Return], range_noise: f64) -> Option<Line> {
    let [first, .., last] = returns else { return None };
    let mut line = Line {
        covariance: Matrix2::zeros(),
        first_beam: first.beam,
        last_beam: last.beam,
        ..start(returns)?
    };
    for _ in 0..MAX_STEPS {
        let mut normal = Matrix2::zeros();
        let mut gradient = Vector2::zeros();
        for hit in returns {
            let Beam { range, by_line, .. } =
                beam::on_line(&line, &Pose::default(), hit.direction)?;
            normal += by_line * by_line.transpose();
            gradient += by_line * (hit.range - range);
        }
        let inverse = normal.try_inverse()?;
        // (Σ b bᵀ) δ = Σ b (ρ − h)
        let step = inverse * gradient;
        line.angle += step[0];
        line.distance += step[1];
        line.covariance = inverse * (range_noise * range_noise);
        if !line.angle.is_finite() || line.distance <= 0.0 {
            return None;
        }
        if step.dot(&(normal * step)) < 1e-18 * range_noise * range_noise {
            break;
        }
    }
    Some(line)
}

/// The linear fit 1/ρ = a · u, weighted by ρ⁴.
fn start(returns: &[Return]) -> Option<Line> {
    let mut normal = Matrix2::zeros();
    let mut right = Vector2::zeros();
    for hit in returns {
        let u = Vector2::from(hit.direction);
        let cube = hit.range.powi(3);
        normal += u * u.transpose() * (cube * hit.range);
        right += u * cube;
    }
    // n/d
    let a = normal.try_inverse()? * right;
    let size = a.norm();
    (size > 0.0 && size.is_finite()).then(|| Line {
        angle: a[1].atan2(a[0]),
        distance: size.recip(),
        covariance: Matrix2::zeros(),
        first_beam: 0,
        last_beam: 0,
    })
}
