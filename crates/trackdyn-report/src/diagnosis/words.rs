//! Words and numbers of a diagnosis.

use crate::panel::ticks::number;
use trackdyn_physics::CATALOGUE;
use trackdyn_physics::effect::Symmetry;

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
pub(super) fn id(effect: usize) -> &'static str {
    CATALOGUE[effect].id
}

/// Names of effects in a row.
pub(super) fn ids(effects: &[usize], between: &str) -> String {
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

/// A probability of chance.
pub(super) fn probability(p: f64) -> String {
    if p < 0.001 { "below 0.001".to_owned() } else { number(p, 3) }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn numbers_keep_their_significant_digits() {
        let texts = [0.0, 1.007_98, -0.001_234, 10_839.35, 2.4e-7].map(|v| significant(v, 3));
        assert_eq!(texts, ["0", "1.01", "−0.00123", "10839", "2.40e−7"]);
    }
}
