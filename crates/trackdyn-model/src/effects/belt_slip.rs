//! A belt that slips on its sprocket.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Drive;

/// Speed that a belt loses under traction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeltSlip {
    slip: f64,
}

impl Effect for BeltSlip {
    const CARD: Card = Card {
        id: "belt-slip",
        title: "Belt that slips on its sprocket under traction",
        law: "V = V_e − κ |V_e| T/N, T traction of the track, forward positive",
        assumes: "Slip in proportion to traction over normal load and to speed; the encoder sits \
                  on the sprocket.",
        shows: "The outer belt runs slower and the inner one faster than shown: the ICRs move \
                outwards, and differ between manoeuvres.",
        resembles: "A belt that stretches, or a clutch that slips.",
        breaks: &[Symmetry::Manoeuvre],
        stages: &[Stage::Drive],
        parameters: &[Parameter {
            key: "slip",
            symbol: "κ",
            unit: "1",
            meaning: "relative slip per traction over normal load",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 0.5],
            typical: 0.05,
        }],
        sources: &["Firbank, Mechanics of the belt drive, Int. J. Mech. Sci. 12(12), 1970"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { slip: values[0] }
    }

    fn drive(&self, drive: &mut Drive) {
        // V = V_e − κ |V_e| T/N
        drive.slip_per_traction += self.slip;
    }
}
