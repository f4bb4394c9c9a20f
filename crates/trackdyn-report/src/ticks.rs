//! Round numbers along an axis.

/// Round numbers inside a range.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ticks {
    /// The numbers, ascending.
    pub values: Vec<f64>,
    /// Their distance.
    pub step: f64,
    /// Digits after the point that tell them apart.
    pub decimals: usize,
}

impl Ticks {
    /// Multiples of 1, 2 or 5 times a power of ten inside `range`, at least `spacing` pixels apart
    /// on an axis of `length` pixels.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an axis has a few ticks; a step has a few digits"
    )]
    pub fn along([low, high]: [f64; 2], length: i32, spacing: i32) -> Self {
        let least = (high - low) * f64::from(spacing) / f64::from(length.max(1));
        if !(least.is_finite() && least > 0.0) {
            return Self { values: Vec::new(), step: 0.0, decimals: 0 };
        }
        let exponent = least.log10().floor() as i32;
        let (factor, exponent) = match least * (1.0 - 1e-9) / 10.0_f64.powi(exponent) {
            ratio if ratio <= 1.0 => (1.0, exponent),
            ratio if ratio <= 2.0 => (2.0, exponent),
            ratio if ratio <= 5.0 => (5.0, exponent),
            _ => (1.0, exponent + 1),
        };
        let step = factor * 10.0_f64.powi(exponent);
        // Rounding must not lose a tick at an end
        let slack = 1e-9 * (high - low) / step;
        let first = (low / step - slack).ceil() as i64;
        let last = (high / step + slack).floor() as i64;
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        let values = (first..=last).map(|k| k as f64 * step).collect();
        Self { values, step, decimals: (-exponent).max(0) as usize }
    }

    /// The even multiples of the step.
    pub fn every_second(&self) -> Self {
        let even = |value: &&f64| (*value / self.step).round().rem_euclid(2.0) == 0.0;
        let values = self.values.iter().filter(even).copied().collect();
        Self { values, step: 2.0 * self.step, ..*self }
    }
}

/// What the numbers along a range are counted from: zero, or a round number below them all where
/// they would be long and alike, as the coordinates of a map are.
#[expect(clippy::cast_possible_truncation, reason = "a length has a few hundred digits at most")]
pub fn origin([low, high]: [f64; 2]) -> f64 {
    const MIN_FAR_VALUE: f64 = 1e4;
    let length = high - low;
    let is_far = low.abs().max(high.abs()) >= MIN_FAR_VALUE.max(10.0 * length);
    if !(is_far && length > 0.0) {
        return 0.0;
    }
    let unit = 10.0_f64.powi(length.log10().ceil() as i32).max(1.0);
    (low / unit).floor() * unit
}

/// A number with this many digits after the point, and the sign of mathematics.
pub fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(zero) if zero.bytes().all(|byte| matches!(byte, b'0' | b'.')) => zero.to_owned(),
        Some(positive) => format!("−{positive}"),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let ticks = Ticks::along([-1.05, 1.05], 390, 90);
        let values = vec![-1.0, -0.5, 0.0, 0.5, 1.0];
        assert_eq!(ticks, Ticks { values, step: 0.5, decimals: 1 });
        assert_eq!(ticks.every_second().values, [-1.0, 0.0, 1.0]);
        let ticks = Ticks::along([-0.3791, -0.3699], 390, 60);
        assert_eq!(ticks.decimals, 3);
        assert!(ticks.values.iter().all(|value| (-0.3791..=-0.3699).contains(value)));
        assert_eq!(Ticks::along([0.0, 100.0], 300, 90).values, [0.0, 50.0, 100.0]);
    }

    #[test]
    fn an_axis_without_extent_has_no_ticks() {
        assert!(Ticks::along([1.0, 1.0], 300, 90).values.is_empty());
        assert!(Ticks::along([f64::NAN, 1.0], 300, 90).values.is_empty());
    }

    #[test]
    fn far_numbers_are_counted_from_a_round_one_below_them() {
        assert_eq!(origin([-3.0, 12_000.0]), 0.0);
        assert_eq!(origin([9_000.0, 9_001.0]), 0.0);
        assert_eq!(origin([4_432_187.0, 4_432_215.5]), 4_432_100.0);
        assert_eq!(origin([-20_010.2, -20_010.1]), -20_011.0);
    }

    #[test]
    fn numbers_have_one_zero_and_a_true_minus() {
        assert_eq!(number(-0.000_1, 2), "0.00");
        assert_eq!(number(-0.375, 3), "−0.375");
        assert_eq!(number(12.0, 0), "12");
    }
}
