//! Words and numbers of a diagnosis.

use crate::ticks::number;
use trackdyn_core::rounding::decimals;
use trackdyn_diagnose::uncertainty::Interval;
use trackdyn_model::EffectId;
use trackdyn_model::effect::Symmetry;

/// Channels of a motion.
pub(super) const CHANNELS: [&str; 3] = ["forward", "left", "yaw"];

/// A symmetry: its name, and what is compared.
pub(super) fn symmetry(symmetry: Symmetry) -> [&'static str; 2] {
    match symmetry {
        Symmetry::SpeedScale => ["speed scale", "slow against fast, tracks in the same ratio"],
        Symmetry::Reversal => ["reversal", "forward against backward, left turn against right"],
        Symmetry::Manoeuvre => ["manoeuvre", "arcs against counter-rotation against spins"],
        Symmetry::Mirror => ["mirror image", "left against right side"],
        Symmetry::Heading => ["heading", "heading one way against another"],
        Symmetry::Place => ["place", "here against there"],
        Symmetry::Time => ["time", "early against late"],
        Symmetry::Transient => {
            ["changes of speed", "speeding up, slowing down or the past against steady"]
        }
        Symmetry::Straight => ["straight driving", "equal tracks: straight ahead, at their speed?"],
    }
}

/// Name of an effect in files.
pub(super) fn id(effect: EffectId) -> &'static str {
    effect.name()
}

/// Names of effects in a row.
pub(super) fn ids(effects: &[EffectId], between: &str) -> String {
    effects.iter().map(|&effect| id(effect)).collect::<Vec<_>>().join(between)
}

/// A number with this many significant digits.
pub(super) fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return number(value, 0);
    }
    #[expect(clippy::cast_possible_truncation, reason = "a decimal exponent")]
    let exponent = value.abs().log10().floor() as i32;
    if !(-5..6).contains(&exponent) {
        let decimals = usize::try_from(digits - 1).unwrap_or(0);
        return format!("{value:.decimals$e}").replace('-', "−");
    }
    number(value, usize::try_from(digits - 1 - exponent).unwrap_or(0))
}

/// An estimate and the ends of its interval, to two digits of half of it: a gain that is 1.0023 is
/// not 1.
pub(super) fn with_interval(interval: &Interval) -> [String; 3] {
    sized([interval.value, interval.low, interval.high])
}

/// A value and the ends of its interval.
pub(super) fn sized(numbers: [f64; 3]) -> [String; 3] {
    /// Smaller ones are read as powers of ten.
    const MIN_HALF_WIDTH: f64 = 1e-6;
    let half = (numbers[2] - numbers[1]) / 2.0;
    if half >= MIN_HALF_WIDTH && numbers.iter().all(|value| value.is_finite()) {
        numbers.map(|value| number(value, decimals(half)))
    } else {
        numbers.map(|value| significant(value, 4))
    }
}

/// A probability of chance.
pub(super) fn probability(p: f64) -> String {
    if p < 0.001 { "below 0.001".to_owned() } else { number(p, 3) }
}

#[cfg(test)]
mod tests {
    use super::{Interval, significant, with_interval};
    use trackdyn_diagnose::hypothesis::Unknown;

    #[test]
    fn numbers_keep_their_significant_digits() {
        let texts = [0.0, 1.007_98, -0.001_234, 10_839.35, 2.4e-7].map(|v| significant(v, 3));
        assert_eq!(texts, ["0", "1.01", "−0.00123", "10839", "2.40e−7"]);
    }

    #[test]
    fn intervals_show_what_they_are_of() {
        let of = |value, low, high| {
            with_interval(&Interval { unknown: Unknown::FrictionLevel, value, low, high })
        };
        assert_eq!(of(0.999_79, 0.999_74, 1.000_93), ["0.99979", "0.99974", "1.00093"]);
        assert_eq!(of(242.0, 237.0, 247.0), ["242.0", "237.0", "247.0"]);
        assert_eq!(of(1234.0, 234.0, 2234.0), ["1234", "234", "2234"]);
        assert_eq!(of(2e-9, 1e-9, 3e-9), ["2.000e−9", "1.000e−9", "3.000e−9"]);
        assert_eq!(of(1.0, 1.0, 1.0), ["1.000", "1.000", "1.000"]);
    }
}
