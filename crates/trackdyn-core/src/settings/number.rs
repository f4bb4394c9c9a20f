//! Values of settings: numbers, counts and lists of numbers.

use toml::Value;

/// What a setting may be: a number, a count, or so many numbers.
pub trait Number: Sized {
    /// As a TOML value.
    fn value(&self) -> Value;

    /// From a TOML value within a range.
    ///
    /// # Errors
    /// What was expected.
    fn read(value: &Value, range: [f64; 2]) -> Result<Self, String>;
}

impl Number for f64 {
    fn value(&self) -> Value {
        Value::Float(*self)
    }

    fn read(value: &Value, [low, high]: [f64; 2]) -> Result<Self, String> {
        number(value)
            .filter(|number| (low..=high).contains(number))
            .ok_or_else(|| format!("a number from {low} to {high}"))
    }
}

impl Number for usize {
    fn value(&self) -> Value {
        Value::Integer(i64::try_from(*self).unwrap_or(i64::MAX))
    }

    fn read(value: &Value, [low, high]: [f64; 2]) -> Result<Self, String> {
        let whole = value.as_integer().and_then(|whole| Self::try_from(whole).ok());
        whole
            .filter(|whole| (low..=high).contains(&crate::real(*whole)))
            .ok_or_else(|| format!("a whole number from {low} to {high}"))
    }
}

impl<const N: usize> Number for [f64; N] {
    fn value(&self) -> Value {
        Value::Array(self.iter().map(Number::value).collect())
    }

    fn read(value: &Value, range: [f64; 2]) -> Result<Self, String> {
        let [low, high] = range;
        let numbers = value.as_array().into_iter().flatten();
        let numbers: Result<Vec<f64>, String> =
            numbers.map(|number| f64::read(number, range)).collect();
        let numbers = numbers.ok().and_then(|numbers| Self::try_from(numbers).ok());
        numbers.ok_or_else(|| format!("{N} numbers from {low} to {high}"))
    }
}

/// A whole number is a number too: nobody writes 5.0 for 5.
fn number(value: &Value) -> Option<f64> {
    #[expect(clippy::cast_precision_loss, reason = "settings are small")]
    let whole = value.as_integer().map(|whole| whole as f64);
    value.as_float().or(whole)
}
