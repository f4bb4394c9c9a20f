//! Cells as numbers.

/// Words for what was not measured, in small letters.
const ABSENT_WORDS: [&str; 10] =
    ["n/a", "na", "#n/a", "nan", "null", "none", "nil", "-", "--", "?"];

/// A number as spreadsheets, numpy and C write it; NaN for nothing.
pub(crate) fn number(text: &[u8]) -> Option<f64> {
    if text.is_empty() {
        return Some(f64::NAN);
    }
    if let Ok(number) = fast_float2::parse(text) {
        return Some(number);
    }
    let word = std::str::from_utf8(text).ok()?.to_ascii_lowercase();
    ABSENT_WORDS.contains(&word.as_str()).then_some(f64::NAN)
}

/// A number as any table has it, with a decimal comma or without.
pub(super) fn any_number(text: &[u8]) -> Option<f64> {
    number(text).or_else(|| with_commas(text, true))
}

/// A number that may have a decimal comma, or separators between thousands; none where it has one
/// comma that may be either.
pub(super) fn with_commas(text: &[u8], are_decimal: bool) -> Option<f64> {
    let text = std::str::from_utf8(text).ok()?;
    let grouped = |separator: char, point: char| {
        let (whole, fraction) = text.split_once(point).unwrap_or((text, ""));
        let digits = whole.trim_start_matches(['-', '+']);
        let mut groups = digits.split(separator);
        let is_digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
        let is_first = |group: &str| (1..=3).contains(&group.len()) && is_digits(group);
        let are_groups = groups.next().is_some_and(is_first)
            && groups.all(|group| group.len() == 3 && is_digits(group));
        let plain = whole.replace(separator, "");
        are_groups.then(|| format!("{plain}.{fraction}")).and_then(|text| number(text.as_bytes()))
    };
    let count = |of: char| text.matches(of).count();
    match (count(','), count('.')) {
        // 1,000.05 and 1.000,05
        (1.., 1) if text.find(',') < text.find('.') => grouped(',', '.'),
        (1, 1..) => grouped('.', ','),
        (1, 0) => {
            let is_clear = are_decimal || shows_decimal_comma(text.as_bytes());
            is_clear.then(|| number(text.replace(',', ".").as_bytes())).flatten()
        }
        (2.., 0) => grouped(',', '.'),
        _ => None,
    }
}

/// Whether a cell has a comma that cannot separate thousands, as that of 1,234 can.
pub(super) fn shows_decimal_comma(text: &[u8]) -> bool {
    let mut parts = text.split(|byte| *byte == b',');
    let (Some(whole), Some(fraction), None) = (parts.next(), parts.next(), parts.next()) else {
        return false;
    };
    let digits = whole.strip_prefix(b"-").unwrap_or(whole);
    let are_digits = [digits, fraction].concat().iter().all(u8::is_ascii_digit);
    are_digits && (fraction.len() != 3 || digits == b"0" || digits.len() > 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_are_read_where_they_are_clear() {
        for (text, are_decimal, value) in [
            ("0,05", false, Some(0.05)),
            ("-0,123", false, Some(-0.123)),
            ("12,5", false, Some(12.5)),
            ("1,234", true, Some(1.234)),
            ("1,234", false, None),
            ("1,000.050", false, Some(1000.05)),
            ("-1,234,567", false, Some(-1_234_567.0)),
            ("1.000,05", true, Some(1000.05)),
            ("1,00.05", false, None),
            ("a,b", true, None),
        ] {
            assert_eq!(with_commas(text.as_bytes(), are_decimal), value, "{text}");
        }
        assert!(number(b"N/A").is_some_and(f64::is_nan));
        assert_eq!(number(b"fast"), None);
    }
}
