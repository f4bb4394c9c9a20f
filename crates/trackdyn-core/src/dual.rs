//! Dual numbers: a value with its exact first derivatives.

#![expect(clippy::suspicious_arithmetic_impl, reason = "product and quotient rule")]

use crate::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};

/// A number and its derivatives by N variables.
///
/// Plain arrays without branches, which the stationary balance runs faster than the general dual
/// vectors of `num-dual` (docs/design.md); the tests compare every operation with these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// Its derivatives.
    pub gradient: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// Variable number `index`.
    #[inline]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut gradient = [0.0; N];
        gradient[index] = 1.0;
        Self { value, gradient }
    }

    /// Variables number 0 to N − 1.
    #[inline]
    pub fn variables(values: [f64; N]) -> [Self; N] {
        std::array::from_fn(|index| Self::variable(values[index], index))
    }

    /// The value with a gradient combined from those of two numbers.
    #[inline]
    fn combine(value: f64, a: &Self, b: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let gradient = std::array::from_fn(|k| f(a.gradient[k], b.gradient[k]));
        Self { value, gradient }
    }
}

impl<const N: usize> Scalar for Dual<N> {
    const HAS_DERIVATIVES: bool = true;

    #[inline]
    fn value(self) -> f64 {
        self.value
    }

    #[inline]
    fn chain<const K: usize>(value: f64, partials: [f64; K], arguments: [Self; K]) -> Self {
        // ∇f = Σₖ ∂f/∂aₖ ∇aₖ
        let mut gradient = [0.0; N];
        for (partial, argument) in partials.iter().zip(&arguments) {
            for (sum, component) in gradient.iter_mut().zip(&argument.gradient) {
                *sum += partial * component;
            }
        }
        Self { value, gradient }
    }
}

impl<const N: usize> From<f64> for Dual<N> {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, gradient: [0.0; N] }
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, gradient: self.gradient.map(|d| -d) }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;

    #[inline]
    fn add(self, b: Self) -> Self {
        Self::combine(self.value + b.value, &self, &b, |da, db| da + db)
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;

    #[inline]
    fn sub(self, b: Self) -> Self {
        Self::combine(self.value - b.value, &self, &b, |da, db| da - db)
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;

    #[inline]
    fn mul(self, b: Self) -> Self {
        Self::combine(self.value * b.value, &self, &b, |da, db| da * b.value + self.value * db)
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;

    #[inline]
    fn div(self, b: Self) -> Self {
        let inverse = b.value.recip();
        let quotient = self.value * inverse;
        // (a/b)′ = (a′ − (a/b) b′)/b
        Self::combine(quotient, &self, &b, |da, db| (da - quotient * db) * inverse)
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;

    #[inline]
    fn add(self, b: f64) -> Self {
        Self { value: self.value + b, ..self }
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;

    #[inline]
    fn sub(self, b: f64) -> Self {
        Self { value: self.value - b, ..self }
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;

    #[inline]
    fn mul(self, b: f64) -> Self {
        Self { value: self.value * b, gradient: self.gradient.map(|d| d * b) }
    }
}

impl<const N: usize> Div<f64> for Dual<N> {
    type Output = Self;

    #[inline]
    fn div(self, b: f64) -> Self {
        Self { value: self.value / b, gradient: self.gradient.map(|d| d / b) }
    }
}

impl<const N: usize> AddAssign for Dual<N> {
    #[inline]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<const N: usize> MulAssign for Dual<N> {
    #[inline]
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::{Dual64, DualNum};
    use num_traits::Signed;

    /// An expression of every operation of [`Scalar`], for our numbers and those of num-dual.
    macro_rules! expression {
        ($a:expr, $b:expr) => {{
            let (a, b) = ($a, $b);
            let mut sum = (a * b + a / b) * 1.5 - (a - b) / 3.0;
            sum += (a * a + b * b).sqrt() + (a * -0.7).exp_m1() - 0.25;
            sum *= (a - b).abs() + b.recip() + 2.0;
            sum += (a * 0.4).exp() + b.ln_1p();
            -sum
        }};
    }

    #[test]
    fn derivatives_equal_those_of_an_independent_implementation() {
        for (a, b) in [(0.3, 0.7), (1.9, 0.2), (-0.8, 1.1)] {
            let [x, y] = Dual::<2>::variables([a, b]);
            let ours = expression!(x, y);
            for index in 0..2 {
                let seed = |value: f64, k: usize| {
                    let constant = Dual64::from_re(value);
                    if k == index { constant.derivative() } else { constant }
                };
                let theirs = expression!(seed(a, 0), seed(b, 1));
                assert!((ours.value - theirs.re).abs() < 1e-14);
                assert!((ours.gradient[index] - theirs.eps).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn the_chain_rule_takes_a_derivative_by_hand() {
        let [a, b] = Dual::<2>::variables([0.7, -0.4]);
        // f = a b²
        let by_hand = Dual::chain(0.7 * 0.16, [0.16, 2.0 * 0.7 * -0.4], [a, b]);
        let automatic = a * b * b;
        assert!((by_hand.value - automatic.value).abs() < 1e-16);
        for k in 0..2 {
            assert!((by_hand.gradient[k] - automatic.gradient[k]).abs() < 1e-16);
        }
    }
}
