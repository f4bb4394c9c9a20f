//! A cable that pulls with a constant force.

use crate::form::Draws;
use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{
    Anchor, Draw, Family, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial,
};
use trackdyn_core::{Pose, Twist, Wrench};

/// A winch with a force control, at a place in the world.
#[derive(Clone, Copy, Debug)]
pub struct Tether {
    pull: f64,
    anchor: [f64; 2],
    winch: Option<Winch>,
}

/// A winch whose pull is not even.
#[derive(Clone, Copy, Debug)]
struct Winch {
    /// Growth of the pull with the distance, both in parts of those at the origin.
    growth: f64,
    /// Distance within which the pull fades, m.
    core: f64,
}

impl Described for Tether {
    const SHEET: Sheet = Sheet {
        id: "tether",
        origin: Origin::Catalogue,
        law: "F = T d/√(|d|² + (0.1 m)²) at the middle of the robot, d from there to the anchor",
        size: "the same beyond a metre; fades over the anchor",
        shares_size: true,
        family: Some(Family {
            law: "F = T (1 + k (|d| − d₀)/d₀) d/√(|d|² + c²), not below nothing, d₀ the anchor's \
                  distance from the origin, k from −0.3 to 0.3, c from 3 to 40 cm",
            size: "the tension where the robot starts from",
            shares_size: false,
        }),
        breaks: &[Symmetry::Reversal, Symmetry::Mirror, Symmetry::Heading, Symmetry::Place],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 6.0),
        parameters: &[
            Parameter {
                key: "tension_n",
                unit: "N",
                range: [0.0, 1e4],
                typical: 100.0,
                draw: Draw::size(0.04).times(Scale::Weight),
            },
            Parameter {
                key: "anchor_x_m",
                unit: "m",
                range: [-1000.0, 1000.0],
                typical: 10.0,
                draw: Draw::place(0, Anchor::Around([3.0, 8.0])),
            },
            Parameter {
                key: "anchor_y_m",
                unit: "m",
                range: [-1000.0, 1000.0],
                typical: 0.0,
                draw: Draw::place(1, Anchor::Around([3.0, 8.0])),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { pull: values[0], anchor: [values[1], values[2]], winch: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let winch =
            Winch { growth: random.between(-0.3, 0.3), core: random.log_between(0.03, 0.4) };
        Self { winch: Some(winch), ..Self::from_values(values) }
    }
}

impl Mechanism for Tether {
    fn push(&self, scene: &Scene, _twist: &Twist, wrench: &mut Wrench) {
        let Pose { x, y, .. } = scene.pose;
        let away = [self.anchor[0] - x, self.anchor[1] - y];
        let distance = away[0].hypot(away[1]);
        let factor = match self.winch {
            None => self.pull / distance.hypot(0.1),
            Some(Winch { growth, core }) => {
                let usual = self.anchor[0].hypot(self.anchor[1]).max(1.0);
                let pull = self.pull * (1.0 + growth * (distance - usual) / usual).max(0.0);
                pull / distance.hypot(core)
            }
        };
        let force = scene.body_axes_from_world(away.map(|away| away * factor));
        wrench.add_force(force, [0.0, 0.0]);
    }
}
