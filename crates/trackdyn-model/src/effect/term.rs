//! What a form consists of.

use super::Symmetry;

/// What kind of knowledge an effect is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// A cause with a law: a candidate of a diagnosis.
    Mechanism,
    /// An empirical form that describes without a cause. No candidate: it may be proposed for what
    /// no mechanism explains.
    Form,
}

/// A term of a form: one coefficient, or a few that mean something only together.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Its name: the key of its first coefficient.
    pub key: &'static str,
    /// Places of its coefficients among the parameters of the effect.
    pub coefficients: Vec<usize>,
    /// Invariances of the ICR triple that it breaks, ascending.
    pub breaks: Vec<Symmetry>,
    /// The component of the wrench, such as "sideways force".
    pub component: &'static str,
    /// What a coefficient counts, such as "of the weight".
    pub unit: &'static str,
    /// What the component goes with, such as "times v ω/g"; empty where it is constant.
    pub factor: String,
    /// How its coefficients make one number.
    pub pairing: Pairing,
}

/// How the coefficients of a term belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairing {
    /// There is one.
    Alone,
    /// a cos nψ + b sin nψ = A cos n(ψ − φ), ψ the heading.
    Heading(u8),
    /// Components along the axes x and y of the world: a size and a direction.
    World,
    /// Stiffness k per length ℓ of the contact, and the force (a, b) at the origin of the world: a
    /// spring towards ℓ (a, b)/k.
    Spring,
}
