//! What a diagnosis claims.

use trackdyn_diagnose::diagnosis::{Kind, Missing};

/// Something that the model of a vehicle lacks.
#[derive(Clone, Copy, Debug)]
pub struct Claim<'a> {
    missing: &'a Missing,
}

/// A parameter of an effect, with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Name of the parameter, with its unit.
    pub key: &'static str,
    /// Its estimate.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: f64,
    /// Upper end of its 95 % interval.
    pub high: f64,
}

impl<'a> Claim<'a> {
    pub(super) fn of(missing: &'a Missing) -> Self {
        Self { missing }
    }

    /// What kind of thing it is: physics, an instrument, or a wrong number.
    pub fn kind(&self) -> Kind {
        self.missing.kind
    }

    /// The effect that was fitted, by its id in the catalogue.
    pub fn effect(&self) -> &'static str {
        self.missing.verdict.effect.name()
    }

    /// All effects that explain the recordings alike, by their ids: the fitted one among them.
    pub fn one_of(&self) -> Vec<&'static str> {
        self.missing.verdict.one_of.iter().map(|effect| effect.name()).collect()
    }

    /// Parameters of the fitted effect; empty where it stands for a class of constants.
    pub fn sizes(&self) -> Vec<Size> {
        let sizes = self.missing.parameters.iter().filter_map(|interval| {
            let key = interval.unknown.parameter()?.key;
            Some(Size { key, value: interval.value, low: interval.low, high: interval.high })
        });
        sizes.collect()
    }

    /// What is not in the catalogue and acts like these effects; empty where nothing is known to.
    pub fn resembling(&self) -> String {
        self.missing.resembling()
    }

    /// Evidence, verdict and intervals.
    pub fn missing(&self) -> &'a Missing {
        self.missing
    }
}
