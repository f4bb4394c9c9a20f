//! Curves by a table.

/// Arguments between which a curve is tabulated.
const ARGUMENTS: [f64; 2] = [1e-4, 1e3];
/// Knots of the table: a step of a twentieth of the logarithm, far less than any curve here bends
/// in.
const KNOTS: u16 = 323;

/// A function of a positive number, tabulated over the logarithm: shoes ask for it millions of
/// times.
///
/// Straight lines join the knots. Below the first one a line leads to the value at zero; beyond the
/// last one the curve stays.
#[derive(Clone, Debug)]
pub struct Curve {
    at_zero: f64,
    knots: Box<[f64]>,
}

impl Curve {
    /// The table of a function.
    pub fn of(function: impl Fn(f64) -> f64) -> Self {
        let [first, last] = ARGUMENTS;
        let argument = |k: u16| first * (last / first).powf(f64::from(k) / f64::from(KNOTS - 1));
        let knots = (0..KNOTS).map(|k| function(argument(k))).collect();
        Self { at_zero: function(0.0), knots }
    }

    /// Its value.
    pub fn at(&self, x: f64) -> f64 {
        let [first, last] = ARGUMENTS;
        let share = |from: f64, to: f64, share: f64| from + share * (to - from);
        if x <= first {
            return share(self.at_zero, self.knots[0], x.max(0.0) / first);
        }
        let place = (x / first).ln() / (last / first).ln() * f64::from(KNOTS - 1);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a knot")]
        let knot = (place as usize).min(self.knots.len() - 2);
        #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
        let beyond = (place - knot as f64).min(1.0);
        share(self.knots[knot], self.knots[knot + 1], beyond)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_the_function_s_values() {
        let curve = Curve::of(|x| x / (1.0 + x));
        for x in [0.0, 3e-5, 1e-4, 0.013, 0.7, 1.0, 42.0, 999.0] {
            assert!((curve.at(x) - x / (1.0 + x)).abs() < 1e-4, "{x}: {}", curve.at(x));
        }
        assert!((curve.at(1e9) - curve.at(1e3)).abs() < 1e-12);
    }
}
