//! Encoders that show a wrong speed.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Drive;
use trackdyn_core::PerSide;

/// A factor between encoder and belt speed on each side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderScale {
    scale: PerSide<f64>,
}

impl Effect for EncoderScale {
    const CARD: Card = Card {
        id: "encoder-scale",
        title: "Belts faster or slower than the encoders show",
        law: "V_l = α_l V_e,l, V_r = α_r V_e,r",
        assumes: "Constant factors: a wrong sprocket radius, stretched belts, uneven wear.",
        shows: "Straight commands drive a curve where the factors differ, else a wrong distance. \
                A wrong scale of the map looks like equal factors.",
        resembles: "A wrong wheel radius or pitch, or tyres that are worn.",
        breaks: &[Symmetry::Manoeuvre, Symmetry::Mirror, Symmetry::Straight],
        stages: &[Stage::Drive],
        parameters: &[
            Parameter {
                key: "left",
                symbol: "α_l",
                unit: "1",
                meaning: "belt speed over shown speed, left",
                role: Role::Size { neutral: 1.0 },
                range: [0.5, 2.0],
                typical: 0.98,
            },
            Parameter {
                key: "right",
                symbol: "α_r",
                unit: "1",
                meaning: "belt speed over shown speed, right",
                role: Role::Size { neutral: 1.0 },
                range: [0.5, 2.0],
                typical: 1.02,
            },
        ],
        sources: &["Martinez et al., IJRR 24(10), 2005, eqs (20)-(21)"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { scale: PerSide::new(values[0], values[1]) }
    }

    fn drive(&self, drive: &mut Drive) {
        // V = α V_e, eqs (20)-(21)
        drive.gain.left *= self.scale.left;
        drive.gain.right *= self.scale.right;
    }
}
