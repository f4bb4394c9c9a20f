//! Different motion resistance of the two sides.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::effects::motion_resistance::add_resistance;
use crate::pipeline::Situation;
use trackdyn_core::{PerSide, Scalar, Side, Wrench};

/// More resistance to one side than to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResistanceSplit {
    difference: f64,
}

impl Effect for ResistanceSplit {
    const CARD: Card = Card {
        id: "resistance-split",
        title: "Different motion resistance of the two sides",
        law: "c_rr,left = c_rr + Δc/2, c_rr,right = c_rr − Δc/2, R = −c_rr N sign(V)",
        assumes: "As motion-resistance, to which it adds; alone, it is the departure from a mean \
                  resistance of zero.",
        shows: "Piecewise constant ICRs that differ between a turn and its mirror image.",
        resembles: "A brake that drags on one side.",
        breaks: &[Symmetry::Manoeuvre, Symmetry::Mirror],
        stages: &[Stage::Wrench],
        parameters: &[Parameter {
            key: "difference",
            symbol: "Δc",
            unit: "1",
            meaning: "left minus right coefficient of motion resistance",
            role: Role::Size { neutral: 0.0 },
            range: [-0.5, 0.5],
            typical: 0.05,
        }],
        sources: &["Martinez et al., IJRR 24(10), 2005, sec. 4.1"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { difference: values[0] }
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        for side in Side::BOTH {
            let coefficient = -side.sign() * self.difference / 2.0;
            add_resistance(coefficient, side, situation, normal_load, wrench);
        }
    }
}
