//! Axes of a panel.

use crate::ticks::{number, origin};
use serde::{Deserialize, Serialize};

/// Where an axis has numbers.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ticks {
    /// At round numbers, as many as there is room for.
    Round,
    /// At these values, with these texts.
    At(Vec<(f64, String)>),
}

/// A quantity with its range.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Axis {
    /// What is shown along it.
    pub quantity: String,
    /// Unit of the quantity; empty for pure numbers.
    pub unit: String,
    /// Left and right end, or lower and upper end.
    pub range: [f64; 2],
    /// Its numbers.
    pub ticks: Ticks,
    /// Whether quantity and unit are written; panels beside others may leave them out.
    pub is_labelled: bool,
    /// Whether lines cross the panel at the ticks.
    pub has_grid: bool,
}

impl Axis {
    /// An axis with round numbers and grid lines.
    pub fn new(quantity: &str, unit: &str, range: [f64; 2]) -> Self {
        Self {
            quantity: quantity.to_owned(),
            unit: unit.to_owned(),
            range,
            ticks: Ticks::Round,
            is_labelled: true,
            has_grid: true,
        }
    }

    /// An axis without numbers.
    pub fn unmarked(range: [f64; 2]) -> Self {
        Self::new("", "", range).at(Vec::new())
    }

    /// Rows of length one from the top down, without numbers.
    pub fn rows(count: usize) -> Self {
        Self::unmarked([trackdyn_core::real(count.max(1)), 0.0])
    }

    /// The axis with these texts at these values.
    pub fn at(self, ticks: Vec<(f64, String)>) -> Self {
        Self { ticks: Ticks::At(ticks), ..self }
    }

    /// The axis without grid lines.
    pub fn without_grid(self) -> Self {
        Self { has_grid: false, ..self }
    }

    /// Quantity and unit, with what its numbers are counted from.
    pub fn label(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" ({})", self.unit) };
        let origin = self.origin();
        let sign = if origin < 0.0 { '+' } else { '−' };
        let counted = if origin == 0.0 {
            String::new()
        } else {
            format!(" {sign} {}", number(origin.abs(), 0))
        };
        if self.is_labelled { format!("{}{unit}{counted}", self.quantity) } else { String::new() }
    }

    /// What its numbers are counted from.
    pub fn origin(&self) -> f64 {
        match self.ticks {
            Ticks::Round => origin(self.range),
            Ticks::At(_) => 0.0,
        }
    }

    /// Where a value lies between both ends, 0 to 1.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.range[0]) / (self.range[1] - self.range[0])
    }

    /// Whether a value lies between both ends.
    pub fn contains(&self, value: f64) -> bool {
        (self.range[0]..=self.range[1]).contains(&value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_say_what_numbers_are_counted_from() {
        let label = |range| Axis::new("y", "m", range).label();
        assert_eq!(label([4_432_187.0, 4_432_215.5]), "y (m) − 4432100");
        assert_eq!(label([-20_010.2, -20_010.1]), "y (m) + 20011");
        assert_eq!(label([-1.0, 1.0]), "y (m)");
    }
}
