//! Smooth functions on a rectangle, as sums of Chebyshev polynomials.
//!
//! # Law
//! A function whose waves run through Ω radians from the middle of an interval to its end is given
//! by n polynomials up to an error of 2 (Ω/2)ⁿ/n!, the first Bessel coefficient that is left out.
//!
//! # Sources
//! Trefethen, Approximation Theory and Approximation Practice, 2013, chapters 3 and 8.

/// Largest error of the polynomials of an axis, relative to the size of the function.
const MAX_ERROR: f64 = 1e-14;

/// Largest number of polynomials on an axis: a function that needs more oscillates too fast.
const MAX_POLYNOMIALS: usize = 64;

/// One side of the rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    middle: f64,
    half: f64,
    /// Number of polynomials, and of places where the functions are asked for.
    pub(super) count: usize,
}

impl Axis {
    /// From low to high, for functions that wave by at most `frequency` radians per unit; none
    /// where they wave too fast.
    pub(super) fn new([low, high]: [f64; 2], frequency: f64) -> Option<Self> {
        let half = 0.5 * (high - low);
        let quarter = 0.5 * frequency * half;
        let mut term = 2.0;
        for count in 1..=MAX_POLYNOMIALS {
            #[expect(clippy::cast_precision_loss, reason = "at most 64")]
            let order = count as f64;
            term *= quarter / order;
            // Past the largest term they fall faster and faster.
            if term < MAX_ERROR && quarter < order {
                return Some(Self { middle: 0.5 * (low + high), half, count });
            }
        }
        None
    }

    /// A rectangle without extent on this side.
    pub(super) fn point() -> Self {
        Self { middle: 0.0, half: 1.0, count: 1 }
    }

    /// Zeros of the first polynomial that is left out, on the axis.
    fn nodes(&self) -> Vec<f64> {
        (0..self.count).map(|k| self.middle + self.half * self.node(k)).collect()
    }

    fn node(&self, k: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "at most 64")]
        let part = (2 * k + 1) as f64 / (2 * self.count) as f64;
        // cos πp = sin π(1/2 − p)
        sine(std::f64::consts::PI * (0.5 - part))
    }

    /// T₀ to Tₙ₋₁ at a place between −1 and 1.
    fn polynomials(&self, x: f64, values: &mut [f64; MAX_POLYNOMIALS]) {
        (values[0], values[1]) = (1.0, x);
        for k in 2..self.count {
            values[k] = 2.0 * x * values[k - 1] - values[k - 2];
        }
    }

    fn place(&self, x: f64) -> f64 {
        (x - self.middle) / self.half
    }
}

/// sin x for |x| ≤ π/2 by its series: the same on every machine, which the system's need not be.
fn sine(x: f64) -> f64 {
    let q = x * x;
    let nested = (1..=12).rev().fold(1.0, |inner, k| {
        let k = f64::from(k);
        1.0 - q / (2.0 * k * (2.0 * k + 1.0)) * inner
    });
    x * nested
}

/// Functions on a rectangle.
#[derive(Clone, Debug)]
pub(super) struct Surface<const N: usize> {
    axes: [Axis; 2],
    /// Factors of the products of polynomials, those of the second axis in a row.
    factors: Vec<[f64; N]>,
}

/// The places at which the functions are asked for, those of the second axis in a row.
pub(super) fn places(axes: &[Axis; 2]) -> Vec<[f64; 2]> {
    let second = axes[1].nodes();
    let of = |a: f64| second.iter().map(move |b| [a, *b]).collect::<Vec<_>>();
    axes[0].nodes().into_iter().flat_map(of).collect()
}

impl<const N: usize> Surface<N> {
    /// The functions with these values at [`places`].
    pub(super) fn new(axes: [Axis; 2], values: &[[f64; N]]) -> Self {
        let tables = axes.map(|axis| {
            let at = |k: usize| {
                let mut polynomials = [0.0; MAX_POLYNOMIALS];
                axis.polynomials(axis.node(k), &mut polynomials);
                polynomials
            };
            (0..axis.count).map(at).collect::<Vec<_>>()
        });
        let [rows, columns] = axes.map(|axis| axis.count);
        let mut factors = vec![[0.0; N]; rows * columns];
        #[expect(clippy::cast_precision_loss, reason = "at most 64")]
        let scale = |order: usize, count: usize| {
            if order == 0 { 1.0 / count as f64 } else { 2.0 / count as f64 }
        };
        for (place, factor) in factors.iter_mut().enumerate() {
            let (i, j) = (place / columns, place % columns);
            for (at, values) in values.iter().enumerate() {
                let weight = tables[0][at / columns][i] * tables[1][at % columns][j];
                for (factor, value) in factor.iter_mut().zip(values) {
                    *factor += weight * value;
                }
            }
            let scale = scale(i, rows) * scale(j, columns);
            *factor = factor.map(|factor| factor * scale);
        }
        Self { axes, factors }
    }

    /// The functions at a place.
    pub(super) fn at(&self, [a, b]: [f64; 2]) -> [f64; N] {
        let (mut first, mut second) = ([0.0; MAX_POLYNOMIALS], [0.0; MAX_POLYNOMIALS]);
        self.axes[0].polynomials(self.axes[0].place(a), &mut first);
        self.axes[1].polynomials(self.axes[1].place(b), &mut second);
        let mut sum = [0.0; N];
        for (row, first) in self.factors.chunks_exact(self.axes[1].count).zip(&first) {
            let mut inner = [0.0; N];
            for (factors, second) in row.iter().zip(&second) {
                for (inner, factor) in inner.iter_mut().zip(factors) {
                    *inner += second * factor;
                }
            }
            for (sum, inner) in sum.iter_mut().zip(inner) {
                *sum += first * inner;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_come_out_everywhere_on_the_rectangle() {
        let waves = |[a, b]: [f64; 2]| [(3.0 * a - 2.0 * b).sin(), (3.0 * a + b).cos()];
        let axes = [Axis::new([0.3, 2.1], 3.0), Axis::new([-1.0, 4.0], 2.0)];
        let axes = axes.map(|axis| axis.expect("slow waves"));
        assert!(axes[0].count < 20 && axes[1].count < 30, "{axes:?}");
        let values: Vec<[f64; 2]> = places(&axes).into_iter().map(waves).collect();
        let surface = Surface::new(axes, &values);
        for step in 0..=20 {
            let part = f64::from(step) / 20.0;
            for place in [[0.3 + 1.8 * part, -1.0], [1.0, -1.0 + 5.0 * part], [2.1, 4.0]] {
                let (found, expected) = (surface.at(place), waves(place));
                for k in 0..2 {
                    assert!((found[k] - expected[k]).abs() < 1e-13, "{place:?}");
                }
            }
        }
        assert!(Axis::new([0.0, 1.0], 1e3).is_none());
    }

    #[test]
    fn sines_are_those_of_the_library() {
        for step in -50..=50 {
            let x = f64::from(step) * std::f64::consts::FRAC_PI_2 / 50.0;
            assert!((sine(x) - x.sin()).abs() < 2e-16, "{x}");
        }
    }
}
