//! The number type of the physics: plain `f64`, or a dual number that carries derivatives.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};

/// A real number, with or without derivatives.
///
/// Every law of trackdyn is written once over this type: `f64` gives the value alone,
/// [`Dual`](crate::Dual) the value and its exact derivatives.
pub trait Scalar:
    Copy
    + Debug
    + From<f64>
    + Neg<Output = Self>
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + Sub<Output = Self>
    + Sub<f64, Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + MulAssign
    + 'static
{
    /// Whether it carries derivatives.
    const HAS_DERIVATIVES: bool;

    /// The value without its derivatives.
    fn value(self) -> f64;

    /// A function of several numbers from its value and its partial derivatives there: the chain
    /// rule for a derivative that was worked out by hand. `partials[k]` belongs to `arguments[k]`.
    #[must_use]
    fn chain<const K: usize>(value: f64, partials: [f64; K], arguments: [Self; K]) -> Self;

    /// A function of this number from its value and its derivative there.
    #[must_use]
    #[inline]
    fn map(self, value: f64, derivative: f64) -> Self {
        Self::chain(value, [derivative], [self])
    }

    /// 1/a.
    #[must_use]
    #[inline]
    fn recip(self) -> Self {
        let inverse = self.value().recip();
        self.map(inverse, -inverse * inverse)
    }

    /// √a.
    #[must_use]
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.map(root, 0.5 / root)
    }

    /// |a|.
    #[must_use]
    #[inline]
    fn abs(self) -> Self {
        self.map(self.value().abs(), self.value().signum())
    }

    /// eᵃ.
    #[must_use]
    #[inline]
    fn exp(self) -> Self {
        let value = self.value().exp();
        self.map(value, value)
    }

    /// eᵃ − 1, exact near zero.
    #[must_use]
    #[inline]
    fn exp_m1(self) -> Self {
        let a = self.value();
        // Far from zero the difference loses nothing, and takes half the time.
        let value = if a.abs() > MIN_EXACT_SUMMAND { a.exp() - 1.0 } else { a.exp_m1() };
        self.map(value, value + 1.0)
    }

    /// ln(1 + a), exact near zero.
    #[must_use]
    #[inline]
    fn ln_1p(self) -> Self {
        let a = self.value();
        let value = if a > MIN_EXACT_SUMMAND { (1.0 + a).ln() } else { a.ln_1p() };
        self.map(value, (1.0 + a).recip())
    }
}

/// Smallest size of a number that keeps all its digits when it is added to one.
const MIN_EXACT_SUMMAND: f64 = 0.5;

/// A count as a real number.
#[expect(clippy::cast_precision_loss, reason = "counts of samples stay far below 2⁵³")]
pub fn real(count: usize) -> f64 {
    count as f64
}

impl Scalar for f64 {
    const HAS_DERIVATIVES: bool = false;

    #[inline]
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn chain<const K: usize>(value: f64, _partials: [f64; K], _arguments: [Self; K]) -> Self {
        value
    }
}
