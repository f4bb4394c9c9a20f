//! Ballast that shifts the centre of gravity.

use crate::mechanism::{Described, Mechanism};
use crate::sheet::{
    Draw, Filed, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial,
};
use trackdyn_model::Vehicle;

/// A payload that nobody entered in the vehicle file.
#[derive(Clone, Copy, Debug)]
pub struct CogShift {
    shift: [f64; 2],
}

impl Described for CogShift {
    const SHEET: Sheet = Sheet {
        id: "cog-shift",
        origin: Origin::Catalogue,
        law: "(x_c, y_c) + (x, y)",
        size: "the same: weight and inertia move together",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Mirror],
        trial: Trial::law(Identifiability::Indistinct, 2.0).filed(Filed::CentreOfGravity),
        parameters: &[
            Parameter {
                key: "x_m",
                unit: "m",
                range: [-1.0, 1.0],
                typical: 0.02,
                draw: Draw::size(0.05).times(Scale::Gauge).signed(),
            },
            Parameter {
                key: "y_m",
                unit: "m",
                range: [-2.0, 2.0],
                typical: 0.03,
                draw: Draw::size(0.03).times(Scale::ContactLength).signed(),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { shift: [values[0], values[1]] }
    }
}

impl Mechanism for CogShift {
    fn build(&self, vehicle: &mut Vehicle) {
        vehicle.cog[0] += self.shift[0];
        vehicle.cog[1] += self.shift[1];
    }
}
