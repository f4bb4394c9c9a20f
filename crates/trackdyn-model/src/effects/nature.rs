//! Mechanisms and forms.

use super::{CATALOGUE, INERTIAL, NATURES, TERMS};
use crate::effect::{Card, Nature, Parameter, Role, Term};

impl Card {
    /// Whether it is a mechanism or a form.
    pub fn nature(&self) -> Nature {
        self.place().map_or(Nature::Mechanism, |place| NATURES[place])
    }

    /// Whether it is a form: what no mechanism of the catalogue explains may be described by it.
    pub fn is_form(&self) -> bool {
        self.nature() == Nature::Form
    }

    /// Whether it is a part of Newton's second law, which owners know without a measurement.
    pub fn is_inertia(&self) -> bool {
        self.place().is_some_and(|place| INERTIAL[place])
    }

    /// The terms of a form; none of a mechanism.
    pub fn terms(&self) -> Vec<Term> {
        self.place().map_or_else(Vec::new, |place| TERMS[place]())
    }

    /// Value of a parameter that is not given: the typical one, and none of a coefficient of a
    /// form.
    pub fn default_of(&self, parameter: &Parameter) -> f64 {
        match parameter.role {
            Role::Size { neutral } if self.is_form() => neutral,
            _ => parameter.typical,
        }
    }

    fn place(&self) -> Option<usize> {
        CATALOGUE.iter().position(|card| card.id == self.id)
    }
}
