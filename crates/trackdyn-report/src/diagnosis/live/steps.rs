//! Numbers as whole multiples of a step.

/// Steps of numbers: times (s), residuals (σ), speeds (m/s), places (m), errors of heading (°).
pub(super) const TIME: f64 = 0.01;
pub(super) const RESIDUAL: f64 = 0.01;
pub(super) const SPEED: f64 = 0.001;
pub(super) const PLACE: f64 = 0.001;
pub(super) const ANGLE: f64 = 0.01;

/// Whole numbers of steps; none where there is no value.
pub(super) type Steps = Vec<Option<i64>>;

/// The whole number of steps that is nearest.
#[expect(clippy::cast_possible_truncation, reason = "a float becomes the nearest whole number")]
pub(super) fn step(value: f64, step: f64) -> i64 {
    (value / step).round() as i64
}

pub(super) fn whole(values: impl Iterator<Item = f64>, by: f64) -> Vec<i64> {
    values.map(|value| step(value, by)).collect()
}

pub(super) fn steps(values: impl IntoIterator<Item = Option<f64>>, by: f64) -> Steps {
    values.into_iter().map(|value| value.map(|value| step(value, by))).collect()
}

/// The nearest multiple of a step, with its digits only.
pub(super) fn near(value: f64, by: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few digits")]
    let steps = step(value, by) as f64;
    steps / by.recip().round()
}
