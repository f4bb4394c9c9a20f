//! How many digits files keep of their numbers, and how many show an uncertainty.
//!
//! What is below the last digit is rounding: it would differ between machines.

/// Digits that a file keeps of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// So many after the decimal point, at most 22.
    Decimals(i32),
    /// So many from the first one that is not zero.
    Significant(i32),
}

impl Digits {
    /// The number with these digits.
    pub fn round(self, value: f64) -> f64 {
        let decimals = match self {
            Self::Decimals(decimals) => decimals,
            Self::Significant(_) if value == 0.0 || !value.is_finite() => return value,
            Self::Significant(digits) => digits - 1 - exponent(value),
        };
        let unit = 10.0_f64.powi(decimals);
        (value * unit).round() / unit
    }
}

/// Decimal exponent of a finite number that is not zero.
#[expect(clippy::cast_possible_truncation, reason = "between -324 and 308")]
fn exponent(value: f64) -> i32 {
    value.abs().log10().floor() as i32
}

/// Decimals that show an uncertainty with one or two digits.
pub fn decimals(half: f64) -> usize {
    if half <= 0.0 || !half.is_finite() {
        return 4;
    }
    usize::try_from((1 - exponent(half)).clamp(0, 7)).unwrap_or(4)
}

#[cfg(test)]
mod tests {
    use super::Digits;

    #[test]
    fn digits_are_counted_from_the_point_or_from_the_first_one() {
        assert_eq!(Digits::Decimals(4).round(0.123_456), 0.1235);
        assert_eq!(Digits::Decimals(4).round(-12.000_04), -12.0);
        assert_eq!(Digits::Significant(3).round(0.001_234_5), 0.001_23);
        assert_eq!(Digits::Significant(3).round(-123_456.0), -123_000.0);
        assert_eq!(Digits::Significant(3).round(0.0), 0.0);
        assert!(Digits::Significant(3).round(f64::NAN).is_nan());
    }

    /// A decimal of a file stays what it is when it is read and written again.
    #[test]
    fn rounding_twice_is_rounding_once() {
        for digits in [Digits::Decimals(9), Digits::Decimals(12), Digits::Significant(9)] {
            for k in 1..1000 {
                let once = digits.round(f64::from(k).sqrt() / 7.0);
                assert_eq!(digits.round(once), once);
            }
        }
    }
}
