//! The number type of the physics: plain `f64`, or a dual number that carries derivatives.

use num_dual::DualNum;

/// A real number, with or without derivatives.
///
/// Every law of trackdyn is written once over this type. `f64` gives the value alone, the dual
/// numbers of `num-dual` give the value and its exact derivatives.
pub trait Scalar: DualNum<Primitive = f64> + Copy {}

impl<S: DualNum<Primitive = f64> + Copy> Scalar for S {}

/// A value with known partial derivatives as a [`Scalar`]: the chain rule for a hand-written
/// derivative.
///
/// `partials[k]` is the derivative of `value` with respect to `arguments[k]`. Exact to first order.
#[inline]
pub fn chain<S: Scalar, const K: usize>(value: f64, partials: [f64; K], arguments: [S; K]) -> S {
    // f(a) = f(a₀) + Σₖ ∂f/∂aₖ · (aₖ − a₀ₖ); the bracket has value zero and keeps aₖ's derivatives.
    let mut sum = S::from(value);
    for (partial, argument) in partials.into_iter().zip(arguments) {
        sum += (argument - argument.re()) * partial;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::chain;
    use num_dual::{Dual64, DualNum};

    #[test]
    fn chain_equals_automatic_differentiation() {
        let a = Dual64::from(0.7).derivative();
        let b = a.sin();
        let by_hand = chain(a.re * b.re * b.re, [b.re * b.re, 2.0 * a.re * b.re], [a, b]);
        let automatic = a * b * b;
        assert!((by_hand.re - automatic.re).abs() < 1e-15);
        assert!((by_hand.eps - automatic.eps).abs() < 1e-15);
    }
}
