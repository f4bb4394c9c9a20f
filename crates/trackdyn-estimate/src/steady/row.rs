//! Residuals and derivatives of one point.

use super::{CHANNELS, Part};
use crate::least_squares::Loss;
use crate::parameters::{COUNT, Parameters};
use nalgebra::{DMatrix, DVector};
use trackdyn_recording::OperatingPoint;

/// What was measured at a point, by channel.
pub(super) fn observed(point: &OperatingPoint) -> [Option<f64>; CHANNELS] {
    [point.v_forward, point.v_lateral, point.yaw_rate]
}

/// Residuals of a point and derivatives of what is predicted for it.
pub(super) struct Row {
    pub(super) residuals: [Option<f64>; CHANNELS],
    sensitivity: [[f64; COUNT]; CHANNELS],
}

impl Row {
    pub(super) fn at(point: &OperatingPoint, parameters: &Parameters) -> Self {
        let (predicted, sensitivity) = predict(point, parameters);
        let observed = observed(point);
        let residual = |channel: usize| observed[channel].map(|value| value - predicted[channel]);
        Self { residuals: [residual(0), residual(1), residual(2)], sensitivity }
    }

    pub(super) fn whitened(&self, scatter: &[Option<f64>; CHANNELS]) -> [Option<f64>; CHANNELS] {
        std::array::from_fn(|channel| Some(self.residuals[channel]? / scatter[channel]?))
    }

    /// What the point adds to Jᵀ W J, with these weights of the residuals, and to the score.
    pub(super) fn part(
        &self,
        scatter: &[Option<f64>; CHANNELS],
        loss: Loss,
        weight: &dyn Fn(f64) -> f64,
        count: usize,
    ) -> Part {
        let (mut matrix, mut gradient) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let whitened = self.whitened(scatter);
        for (channel, whitened) in whitened.into_iter().enumerate() {
            let (Some(whitened), Some(scatter)) = (whitened, scatter[channel]) else { continue };
            let by = DVector::from_fn(count, |k, _| self.sensitivity[channel][k] / scatter);
            matrix += &by * by.transpose() * weight(whitened);
            gradient += by * (loss.weight(whitened) * whitened);
        }
        (matrix, gradient)
    }
}

/// The motion of a point and its derivatives by all parameters, by channel.
fn predict(
    point: &OperatingPoint,
    parameters: &Parameters,
) -> ([f64; CHANNELS], [[f64; COUNT]; CHANNELS]) {
    let [x_l, x_r, y, alpha_l, alpha_r] = parameters.0;
    let per_gap = 1.0 / (x_r - x_l);
    let v_l = alpha_l * point.v_left;
    // ω = (V_r − V_l)/(x_r − x_l), eq. (9)
    let w = (alpha_r * point.v_right - v_l) * per_gap;
    let w_by = [w * per_gap, -w * per_gap, 0.0, -point.v_left * per_gap, point.v_right * per_gap];
    // Forward speed V_l − ω x_l, eq. (8); to the left −ω y, eq. (7)
    let mut forward_by = w_by.map(|by| -x_l * by);
    forward_by[0] -= w;
    forward_by[3] += point.v_left;
    let mut left_by = w_by.map(|by| -y * by);
    left_by[2] -= w;
    ([v_l - w * x_l, -w * y, w], [forward_by, left_by, w_by])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensitivities_equal_difference_quotients() {
        const STEP: f64 = 1e-6;
        let point = OperatingPoint { v_left: -0.3, v_right: 0.7, ..Default::default() };
        let at = Parameters([-0.375, 0.457, 0.049, 0.97, 1.03]);
        let (_, exact) = predict(&point, &at);
        let by = |k: usize| exact.map(|channel| channel[k]);
        for k in 0..COUNT {
            let moved = |step: f64| {
                let mut moved = at;
                moved.0[k] += step;
                predict(&point, &moved).0
            };
            let (ahead, behind) = (moved(STEP), moved(-STEP));
            for channel in 0..CHANNELS {
                let quotient = (ahead[channel] - behind[channel]) / (2.0 * STEP);
                assert!((by(k)[channel] - quotient).abs() < 1e-9, "{k} {channel}");
            }
        }
    }
}
