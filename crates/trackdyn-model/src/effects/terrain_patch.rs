//! A patch of different ground.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Ground;
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
        law: "μ_x ← (1 + (√k − 1) s) μ_x, μ_y ← (1 + (1/√k − 1) s) μ_y, s the part of a side's \
              length where |p − p_0| < R",
        assumes: "A disc; each side has the mean friction of what lies under its middle line. \
                  With both sides on it the ratio alone counts, with one side each coefficient.",
        shows: "The ICRs jump at a place, the same each time the robot comes by.",
        resembles: "An edge or a cable that was driven over.",
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
        for side in Side::BOTH {
            let line = ground.lines[side].map(|end| ground.circumstance.to_world(end));
            let share = self.share(line);
            let root = self.ratio.sqrt();
            let friction = &mut ground.friction[side];
            // μ_x ← (1 + (√k − 1) s) μ_x, μ_y ← (1 + (1/√k − 1) s) μ_y
            friction.across *= 1.0 + (root - 1.0) * share;
            friction.along *= 1.0 + (1.0 / root - 1.0) * share;
        }
    }
}

impl TerrainPatch {
    /// Share of a line between two places that lies on the disc.
    fn share(&self, [from, to]: [[f64; 2]; 2]) -> f64 {
        let along = [to[0] - from[0], to[1] - from[1]];
        let away = [from[0] - self.centre[0], from[1] - self.centre[1]];
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        // |a + t d|² = R²:  d² t² + 2 (a·d) t + a² − R² = 0
        let (square, half) = (dot(along, along), dot(along, away));
        let discriminant = half * half - square * (dot(away, away) - self.radius * self.radius);
        if discriminant <= 0.0 {
            return 0.0;
        }
        let [enters, leaves] = [-1.0, 1.0].map(|sign| (sign * discriminant.sqrt() - half) / square);
        (leaves.min(1.0) - enters.max(0.0)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_of_a_line_is_what_points_along_it_say() {
        const POINTS: u32 = 100_000;
        let patch = TerrainPatch { centre: [1.0, -0.5], radius: 0.7, ratio: 1.3 };
        for (from, to) in [
            ([0.5, -0.5], [1.2, -0.4]),
            ([0.0, -0.5], [1.0, -0.2]),
            ([0.0, -1.0], [2.0, 0.1]),
            ([1.1, 0.0], [1.1, 2.0]),
            ([3.0, 0.0], [3.0, 1.0]),
            ([0.0, 0.21], [2.0, 0.21]),
        ] {
            let inside = |k: &u32| {
                let t = (f64::from(*k) + 0.5) / f64::from(POINTS);
                let [x, y]: [f64; 2] = std::array::from_fn(|i| from[i] + t * (to[i] - from[i]));
                (x - 1.0).hypot(y + 0.5) < 0.7
            };
            let count = (0..POINTS).filter(inside).count();
            let expected = trackdyn_core::real(count) / f64::from(POINTS);
            let share = patch.share([from, to]);
            assert!((share - expected).abs() < 2e-5, "{from:?} to {to:?}: {share}, {expected}");
        }
    }
}
