//! A constant pull towards a point of the world.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Situation;
use trackdyn_core::{PerSide, Scalar, Wrench};

/// A cable under constant tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tether {
    tension: f64,
    anchor: [f64; 2],
}

impl Effect for Tether {
    const CARD: Card = Card {
        id: "tether",
        title: "Constant pull towards a point",
        law: "F = T (p_a − p)/|p_a − p| at the origin",
        assumes: "A winch keeps the tension; the cable is fastened over the middle of the contact. \
                  None where the robot stands on the anchor.",
        shows: "The ICRs move with heading and place; close to a slope while the robot stays where \
                it is.",
        resembles: "A cable whose pull grows with its length.",
        breaks: &[Symmetry::Reversal, Symmetry::Mirror, Symmetry::Heading, Symmetry::Place],
        stages: &[Stage::Wrench],
        parameters: &[
            Parameter {
                key: "tension_n",
                symbol: "T",
                unit: "N",
                meaning: "pull of the cable",
                role: Role::Size { neutral: 0.0 },
                range: [0.0, 10000.0],
                typical: 80.0,
            },
            Parameter {
                key: "anchor_x_m",
                symbol: "x_a",
                unit: "m",
                meaning: "anchor in the world, x",
                role: Role::Place { axis: 0 },
                range: [-1000.0, 1000.0],
                typical: -4.0,
            },
            Parameter {
                key: "anchor_y_m",
                symbol: "y_a",
                unit: "m",
                meaning: "anchor in the world, y",
                role: Role::Place { axis: 1 },
                range: [-1000.0, 1000.0],
                typical: 1.0,
            },
        ],
        sources: &[
            "Statics of a cable; McGarey, Pomerleau, Barfoot, Field and Service Robotics, 2016",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { tension: values[0], anchor: [values[1], values[2]] }
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        let circumstance = &situation.ground.circumstance;
        let [x, y] = circumstance.position;
        let cable = [self.anchor[0] - x, self.anchor[1] - y];
        let length = cable[0].hypot(cable[1]);
        if length > 0.0 {
            // F = T (p_a − p)/|p_a − p|
            let pull = circumstance.to_robot(cable.map(|c| self.tension * c / length));
            wrench.add_force(pull.map(S::from), [0.0, 0.0]);
        }
    }
}
