//! Other ground in one place.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::model::Ground;
use trackdyn_core::Side;

/// A disc of ground with another friction ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TerrainPatch {
    centre: [f64; 2],
    radius: f64,
    ratio: f64,
}

impl Effect for TerrainPatch {
    const CARD: Card = Card {
        id: "terrain-patch",
        title: "Other ground in one place",
        law: "μ_x ← k μ_x where |p − p_0| < R",
        assumes: "A disc; the robot is on it when its origin is. Its edge is not resolved.",
        shows: "The ICRs jump at a place, the same each time the robot comes by.",
        breaks: &[Symmetry::Place],
        stages: &[Stage::Ground],
        parameters: &[
            Parameter {
                key: "x_m",
                symbol: "x_0",
                unit: "m",
                meaning: "centre of the disc in the world, x",
                role: Role::Place { axis: 0 },
                range: [-10_000.0, 10_000.0],
                typical: 3.0,
            },
            Parameter {
                key: "y_m",
                symbol: "y_0",
                unit: "m",
                meaning: "centre of the disc in the world, y",
                role: Role::Place { axis: 1 },
                range: [-10_000.0, 10_000.0],
                typical: 0.0,
            },
            Parameter {
                key: "radius_m",
                symbol: "R",
                unit: "m",
                meaning: "radius of the disc",
                role: Role::Shape,
                range: [0.01, 10000.0],
                typical: 2.0,
            },
            Parameter {
                key: "ratio",
                symbol: "k",
                unit: "1",
                meaning: "factor on μ_x/μ_y inside",
                role: Role::Size { neutral: 1.0 },
                range: [0.1, 10.0],
                typical: 1.3,
            },
        ],
        sources: &["Martinez et al., IJRR 24(10), 2005, eq. (23) with [μ] of the place"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { centre: [values[0], values[1]], radius: values[2], ratio: values[3] }
    }

    fn ground(&self, ground: &mut Ground) {
        let [x, y] = ground.circumstance.position;
        if (x - self.centre[0]).hypot(y - self.centre[1]) < self.radius {
            for side in Side::BOTH {
                // μ_x ← k μ_x
                ground.friction[side].across *= self.ratio;
            }
        }
    }
}
