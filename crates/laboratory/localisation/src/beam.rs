//! The range at which a beam meets a line, and its derivatives.
//!
//! h = (d − n · t) / (n · R u)
//!
//! for the line n · p = d in the reference's frame, from a sensor at (t, R) in it, along u in the
//! sensor's own frame. The residual of a match is ρ − h.

use crate::line::Line;
use nalgebra::{Vector2, Vector3};
use trackdyn_core::Pose;

/// Range of a beam on a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    /// h, m.
    pub(crate) range: f64,
    /// ∂h/∂(x, y, yaw).
    pub(crate) by_pose: Vector3<f64>,
    /// ∂h/∂(θ, d).
    pub(crate) by_line: Vector2<f64>,
}

/// Smallest sine of the angle between beam and line: 6 degrees. Below it the range moves by more
/// than ten times what the line moves, and the law is no longer nearly linear.
const MIN_SINE_OF_INCIDENCE: f64 = 0.1;

/// The range of a beam; `None` where it grazes the line, or the sensor is behind it.
#[inline]
pub(crate) fn on_line(line: &Line, pose: &Pose, [u, v]: [f64; 2]) -> Option<Beam> {
    on_normal(line.angle.sin_cos(), line.distance, pose, pose.yaw.sin_cos(), [u, v])
}

/// The range of a beam on the line with the sine and cosine of θ, from a sensor with those of its
/// yaw.
#[inline]
pub(crate) fn on_normal(
    (n_sin, n_cos): (f64, f64),
    distance: f64,
    pose: &Pose,
    (sin, cos): (f64, f64),
    [u, v]: [f64; 2],
) -> Option<Beam> {
    // R u, n · R u, and n′ · R u with n′ = ∂n/∂θ
    let (w_x, w_y) = (cos * u - sin * v, sin * u + cos * v);
    let along = n_cos * w_x + n_sin * w_y;
    let turned = n_cos * w_y - n_sin * w_x;
    // d − n · t, and n′ · t
    let height = distance - n_cos * pose.x - n_sin * pose.y;
    let shift = n_cos * pose.y - n_sin * pose.x;
    if along < MIN_SINE_OF_INCIDENCE || height <= 0.0 {
        return None;
    }
    let per = along.recip();
    let range = height * per;
    Some(Beam {
        range,
        // ∂h/∂t = −n/(n · R u),  ∂h/∂ψ = −h (n · R′ u)/(n · R u) = h (n′ · R u)/(n · R u)
        by_pose: Vector3::new(-n_cos * per, -n_sin * per, range * turned * per),
        // ∂h/∂θ = (−n′ · t − h n′ · R u)/(n · R u),  ∂h/∂d = 1/(n · R u)
        by_line: Vector2::new((-shift - range * turned) * per, per),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix2;

    #[test]
    fn derivatives_are_those_of_differences() {
        let at = |v: [f64; 5]| {
            let line = Line {
                angle: v[3],
                distance: v[4],
                covariance: Matrix2::zeros(),
                first_beam: 0,
                last_beam: 0,
            };
            let u = 0.9_f64.sin_cos();
            on_line(&line, &Pose::new(v[0], v[1], v[2]), [u.1, u.0]).expect("not grazing")
        };
        let v = [0.3, -0.2, 0.4, 0.8, 2.5];
        let beam = at(v);
        let exact = [beam.by_pose.as_slice(), beam.by_line.as_slice()].concat();
        for (k, exact) in exact.into_iter().enumerate() {
            let moved = |by: f64| {
                let mut v = v;
                v[k] += by;
                at(v).range
            };
            let difference = (moved(1e-6) - moved(-1e-6)) / 2e-6;
            assert!((difference - exact).abs() < 1e-8, "{k}: {difference} {exact}");
        }
    }
}
