//! Mechanisms and forms.

use super::{CATALOGUE, INERTIA_FLAGS, NATURES, RARITY_FLAGS, TERMS};
use crate::effect::{Card, Nature, Parameter, Role, Term};

impl Card {
    /// Whether it is a mechanism or a form.
    pub fn nature(&self) -> Nature {
        self.place().map_or(Nature::Mechanism, |place| NATURES[place])
    }

    /// Whether it is a form, which may describe what no mechanism explains.
    pub fn is_form(&self) -> bool {
        self.nature() == Nature::Form
    }

    /// Whether it is a term of Newton's second law, which owners know without a measurement.
    pub fn is_inertia(&self) -> bool {
        self.place().is_some_and(|place| INERTIA_FLAGS[place])
    }

    /// Whether it is an error of instruments that few robots have.
    pub fn is_rare(&self) -> bool {
        self.place().is_some_and(|place| RARITY_FLAGS[place])
    }

    /// Terms of a form; empty for a mechanism.
    pub fn terms(&self) -> Vec<Term> {
        self.place().map_or_else(Vec::new, |place| TERMS[place]())
    }

    /// Default of a parameter: the typical value, or zero for a coefficient of a form.
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
