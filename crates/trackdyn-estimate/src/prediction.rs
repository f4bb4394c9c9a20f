//! What a kinematic model makes of the track speeds of a segment.

pub(crate) mod batch;
mod lanes;
mod series;

pub use lanes::Lanes;
pub(crate) use series::{any_arc, arc};

use crate::observations::Piece;
use crate::parameters::{COUNT, Parameters};

/// Motion over a segment from its first pose: forward (m), left (m), yaw (rad); and its
/// derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// Forward, left, yaw.
    pub motion: [f64; 3],
    /// Derivatives of the motion by each parameter.
    pub sensitivity: [[f64; 3]; COUNT],
}

/// The motion and its derivatives by all parameters.
///
/// Constant speeds move the robot on an arc of angle a: a chord along the mean heading, shorter
/// than the arc by sinc(a/2). Exact.
#[inline]
pub fn predict(parameters: &Parameters, pieces: &[Piece]) -> Prediction {
    let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
    let per_gap = 1.0 / (x_r - x_l);
    let (mut forward, mut left, mut yaw) = (0.0, 0.0, 0.0);
    let mut sensitivity = [[0.0; 3]; COUNT];
    for piece in pieces {
        let v_l = alpha_l * piece.v_left;
        let w = (alpha_r * piece.v_right - v_l) * per_gap;
        let angle = w * piece.duration;
        let (sin, cos) = (yaw + 0.5 * angle).sin_cos();
        let (sinc, sinc_by_angle) = sinc_half(angle);
        let time = sinc * piece.duration;
        let (ahead, aside) = (v_l - w * x_l, -w * y);
        let step = [time * (ahead * cos - aside * sin), time * (ahead * sin + aside * cos)];
        // ∂ω/∂θ
        let w_by =
            [w * per_gap, -w * per_gap, 0.0, -piece.v_left * per_gap, piece.v_right * per_gap];
        // What ∂/∂θ of V_l − ω x_l and of −ω y has beside the terms in ∂ω/∂θ
        let ahead_by = [-w, 0.0, 0.0, piece.v_left, 0.0];
        let aside_by = [0.0, 0.0, -w, 0.0, 0.0];
        for (k, by) in sensitivity.iter_mut().enumerate() {
            let angle_by = w_by[k] * piece.duration;
            let heading_by = by[2] + 0.5 * angle_by;
            let stretch_by = sinc_by_angle / sinc * angle_by;
            let ahead_by = ahead_by[k] - x_l * w_by[k];
            let aside_by = aside_by[k] - y * w_by[k];
            by[0] += time * (ahead_by * cos - aside_by * sin) - step[1] * heading_by
                + stretch_by * step[0];
            by[1] += time * (ahead_by * sin + aside_by * cos)
                + step[0] * heading_by
                + stretch_by * step[1];
            by[2] += angle_by;
        }
        forward += step[0];
        left += step[1];
        yaw += angle;
    }
    Prediction { motion: [forward, left, yaw], sensitivity }
}

/// Velocity forward (m/s), velocity to the left (m/s) and yaw rate (rad/s) during a piece.
#[inline]
pub fn body_velocity(parameters: &Parameters, piece: &Piece) -> [f64; 3] {
    let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
    let v_l = alpha_l * piece.v_left;
    // eqs (9), (8), (7)
    let w = (alpha_r * piece.v_right - v_l) / (x_r - x_l);
    [v_l - w * x_l, -w * y, w]
}

/// sinc(a/2) = sin(a/2)/(a/2) and its derivative by a: by their series where it is exact to
/// rounding.
#[inline]
fn sinc_half(angle: f64) -> (f64, f64) {
    if angle.abs() < 0.1 {
        let q = angle * angle;
        let value = 1.0 - q / 24.0 * (1.0 - q / 80.0 * (1.0 - q / 168.0));
        let derivative = -angle / 12.0 * (1.0 - q / 40.0 * (1.0 - q / 112.0));
        (value, derivative)
    } else {
        let half = 0.5 * angle;
        let value = half.sin() / half;
        (value, (half.cos() - value) / angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::frames::ros_twist_from_paper;
    use trackdyn_core::{PerSide, Pose};

    const PARAMETERS: Parameters = Parameters([-0.375, 0.457, 0.049, 0.97, 1.03]);

    fn pieces() -> Vec<Piece> {
        [(0.03, 0.2, 0.9), (0.04, -0.5, 0.5), (0.5, 0.7, -1.0), (0.03, 0.4, 0.4), (0.02, 0.0, -1.0)]
            .map(|(duration, v_left, v_right)| Piece { duration, v_left, v_right })
            .to_vec()
    }

    #[test]
    fn motion_is_the_composition_of_exponentials() {
        let kinematics = PARAMETERS.kinematics();
        let pose = pieces().iter().fold(Pose::default(), |pose, piece| {
            let twist = kinematics.twist(PerSide::new(piece.v_left, piece.v_right));
            pose.compose(&Pose::exp(&ros_twist_from_paper(&twist), piece.duration))
        });
        let [x, y, yaw] = predict(&PARAMETERS, &pieces()).motion;
        assert!((x - pose.x).abs() < 1e-14 && (y - pose.y).abs() < 1e-14);
        assert!((yaw - pose.yaw).abs() < 1e-14);
    }

    #[test]
    fn sensitivities_equal_difference_quotients() {
        const STEP: f64 = 1e-5;
        let exact = predict(&PARAMETERS, &pieces()).sensitivity;
        for (k, exact) in exact.iter().enumerate() {
            let at = |step: f64| {
                let mut moved = PARAMETERS;
                moved.0[k] += step;
                predict(&moved, &pieces()).motion
            };
            let (ahead, behind) = (at(STEP), at(-STEP));
            for channel in 0..3 {
                let quotient = (ahead[channel] - behind[channel]) / (2.0 * STEP);
                assert!((exact[channel] - quotient).abs() < 1e-9, "{k} {channel}");
            }
        }
    }

    #[test]
    fn series_meets_the_quotient() {
        let (below, above) = (sinc_half(0.1 - 1e-12), sinc_half(0.1 + 1e-12));
        assert!((below.0 - above.0).abs() < 1e-13 && (below.1 - above.1).abs() < 1e-12);
    }
}
