//! Numbers as every one of the languages reads them.

use trackdyn_core::rounding::Digits;

/// Largest length that is accepted, m.
pub(crate) const MAX_LENGTH: f64 = 1e4;

/// The shortest decimal text that reads back as the same number. It has a point, because ROS takes
/// `1` for an integer and refuses it. It has no exponent, because YAML 1.1 takes `1e-7` for a text.
pub(crate) fn number(value: f64) -> String {
    // The sum turns −0 into 0.
    let text = format!("{}", value + 0.0);
    if text.contains('.') { text } else { text + ".0" }
}

/// A length in m to twelve decimals, as kinematics files give it.
pub(crate) fn metres(length: f64) -> String {
    number(Digits::Decimals(12).round(length))
}

#[cfg(test)]
mod tests {
    use super::{metres, number};

    #[test]
    fn numbers_have_a_point_and_no_exponent() {
        assert_eq!(number(1.0), "1.0");
        assert_eq!(number(-0.0), "0.0");
        assert_eq!(number(1e-7), "0.0000001");
        assert_eq!(number(0.1 + 0.2).parse(), Ok(0.1 + 0.2));
        assert_eq!(metres(0.1 + 0.2), "0.3");
    }
}
