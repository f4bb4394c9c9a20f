//! Sloping ground.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Ground;

/// A plane that rises in one direction of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    angle: f64,
    uphill: f64,
}

impl Effect for Slope {
    const CARD: Card = Card {
        id: "slope",
        title: "Sloping ground",
        law: "g_along = −g sin β · uphill, g_normal = g cos β; uphill in the robot's axes",
        assumes: "A plane; the robot's heading stays what it is while it turns by a little.",
        shows: "ICRs that move with the heading; nothing in straight driving where the tracks \
                stick, as they do unless friction or belts need slip to bear a load.",
        resembles: "A steady pull in one direction of the world, as of wind or a long cable.",
        breaks: &[Symmetry::Reversal, Symmetry::Mirror, Symmetry::Heading],
        stages: &[Stage::Ground],
        parameters: &[
            Parameter {
                key: "angle_deg",
                symbol: "β",
                unit: "deg",
                meaning: "inclination of the ground",
                role: Role::Size { neutral: 0.0 },
                range: [0.0, 60.0],
                typical: 2.0,
            },
            Parameter {
                key: "uphill_deg",
                symbol: "φ",
                unit: "deg",
                meaning: "direction of steepest ascent in the world, counter-clockwise from its x \
                          axis",
                role: Role::Direction,
                range: [-360.0, 360.0],
                typical: 0.0,
            },
        ],
        sources: &["Weight along an inclined plane, at the centre of gravity"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { angle: values[0].to_radians(), uphill: values[1].to_radians() }
    }

    fn ground(&self, ground: &mut Ground) {
        let (sin, cos) = self.uphill.sin_cos();
        let uphill = ground.circumstance.to_robot([cos, sin]);
        // g_along = −g sin β · uphill, g_normal = g cos β
        let along = ground.gravity_normal * self.angle.sin();
        for (gravity, component) in ground.gravity_along.iter_mut().zip(uphill) {
            *gravity -= along * component;
        }
        ground.gravity_normal *= self.angle.cos();
    }
}
