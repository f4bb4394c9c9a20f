//! Kinds of effects, and the terms of a form.

use super::Symmetry;

/// Kind of an effect: mechanism or form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// A cause with a law: a candidate of a diagnosis.
    Mechanism,
    /// An empirical form without a cause. It is no candidate of a diagnosis, but may be proposed
    /// for what no mechanism explains.
    Form,
}

/// A term of a form: one coefficient, or several that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Its name: the key of its first coefficient.
    pub key: &'static str,
    /// Indices of its coefficients among the parameters of the effect.
    pub coefficients: Vec<usize>,
    /// Invariances of the ICR triple that it breaks, ascending.
    pub breaks: Vec<Symmetry>,
    /// The component of the wrench, such as "sideways force".
    pub component: &'static str,
    /// Unit of a coefficient, such as "of the weight".
    pub unit: &'static str,
    /// Factor on the component, such as "v ω/g"; empty where it is constant.
    pub factor: String,
    /// How its coefficients combine.
    pub pairing: Pairing,
}

/// How the coefficients of a term combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairing {
    /// A single coefficient.
    Alone,
    /// a cos nψ + b sin nψ = A cos n(ψ − φ), ψ the heading.
    Heading(u8),
    /// Components along the axes x and y of the world: a norm and a direction.
    World,
    /// Stiffness k per length ℓ of the contact, and the force (a, b) at the origin of the world: a
    /// spring towards ℓ (a, b)/k.
    Spring,
}
