//! Friction that is bounded by a box in axes of the world.

use crate::contact::{Friction, ShearStress};
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::{RigidBody, Site};
use trackdyn_core::Scalar;

/// First harmonic of a box over its mean: |cos θ| + |sin θ| = 4/π (1 − 2/15 cos 4θ − …).
const BOX: f64 = 2.0 / 15.0;

/// Friction as contacts of simulators have it: a bound along each axis instead of a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionPyramid {
    /// Parts of cos 4θ and sin 4θ in boxes.
    parts: [f64; 2],
}

impl Effect for FrictionPyramid {
    const CARD: Card = Card {
        id: "friction-pyramid",
        title: "Friction bounded by a box in axes of the world, a pyramid of simulators",
        law: "τ = −p √[μ] ∂(|q| D)/∂q, D = 1 − 2/15 (a cos 4θ + b sin 4θ), q = √[μ] s/|s| at the \
              angle θ from the world's x axis",
        assumes: "The first harmonic of a box over its mean, 4/π of its half width. a = 1 is a box \
                  along the axes of the world (ODE without fdir1), a = −1 one at 45° to them \
                  (pyramidal cones of MuJoCo), b is for axes 22.5° off. A box in axes of the robot \
                  moves constant ICRs only, as bulldozing does.",
        shows: "ICRs that move with the heading and come back every 90°, alike forward and in \
                reverse.",
        breaks: &[Symmetry::Mirror, Symmetry::Heading],
        stages: &[Stage::Shear],
        parameters: &[
            Parameter {
                key: "box",
                symbol: "a",
                unit: "1",
                meaning: "a box along the axes of the world",
                role: Role::Size { neutral: 0.0 },
                range: [-1.2, 1.2],
                typical: 0.5,
            },
            Parameter {
                key: "turned_box",
                symbol: "b",
                unit: "1",
                meaning: "a box at 22.5° to the axes of the world",
                role: Role::Size { neutral: 0.0 },
                range: [-1.2, 1.2],
                typical: 0.5,
            },
        ],
        sources: &[
            "Smith, Open Dynamics Engine, manual: contact.surface, fdir1",
            "Todorov, MuJoCo, documentation: computation, friction cones",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { parts: [values[0], values[1]] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        for (part, own) in body.friction_pyramid.iter_mut().zip(self.parts) {
            *part += own;
        }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let Friction { across, along } = site.friction();
        let [across, along] = [across.sqrt(), along.sqrt()];
        let [x, y] = site.slip_direction();
        // q = √[μ] s/|s|, forward and to the left
        let q = [y * along, x * -across];
        let [forward, left] = self.gradient(q, site.situation.ground.circumstance.heading);
        let pressure = site.normal_pressure();
        // τ_added = −p √[μ] ∂(|q| (D − 1))/∂q
        stress.added[0] += pressure * left * across;
        stress.added[1] += pressure * forward * -along;
    }
}

impl FrictionPyramid {
    /// ∂(|q| (D − 1))/∂q, with q forward and to the left of a robot with this heading, rad.
    fn gradient<S: Scalar>(&self, [ahead, left]: [S; 2], heading: f64) -> [S; 2] {
        let [a, b] = self.parts;
        let (sin, cos) = (4.0 * heading).sin_cos();
        // a cos 4θ + b sin 4θ with θ counted from the heading
        let [a, b] = [a * cos + b * sin, b * cos - a * sin];
        let size = (ahead * ahead + left * left).sqrt();
        let (cos, sin) = (ahead / size, left / size);
        let (cos_2, sin_2) = (cos * cos - sin * sin, cos * sin * 2.0);
        let (cos_4, sin_4) = (cos_2 * cos_2 - sin_2 * sin_2, cos_2 * sin_2 * 2.0);
        // D − 1 = −2/15 (a cos 4θ + b sin 4θ), dD/dθ = 8/15 (a sin 4θ − b cos 4θ)
        let radial = (cos_4 * a + sin_4 * b) * -BOX;
        let turning = (sin_4 * a - cos_4 * b) * (4.0 * BOX);
        // ∂(|q| (D − 1))/∂q = (D − 1) e_r + dD/dθ e_θ
        [(cos * radial - sin * turning) * size, (sin * radial + cos * turning) * size]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    const ANGLES: u32 = 3600;

    fn angles() -> impl Iterator<Item = f64> {
        (0..ANGLES).map(|k| TAU * (f64::from(k) + 0.5) / f64::from(ANGLES))
    }

    /// Along the slip and across it, to its left.
    fn parts(of: [f64; 2], angle: f64) -> [f64; 2] {
        let (sin, cos) = angle.sin_cos();
        [cos * of[0] + sin * of[1], cos * of[1] - sin * of[0]]
    }

    #[test]
    fn a_box_along_the_world_has_this_first_harmonic() {
        let law = FrictionPyramid { parts: [1.0, 0.0] };
        let [mut of_box, mut of_law] = [[0.0; 2]; 2];
        let mut mean = 0.0;
        for angle in angles() {
            let (sin, cos) = (4.0 * angle).sin_cos();
            let both = [
                parts([angle.cos().signum(), angle.sin().signum()], angle),
                parts(law.gradient([angle.cos(), angle.sin()], 0.0), angle),
            ];
            mean += both[0][0] / f64::from(ANGLES);
            for (sum, [along, across]) in [&mut of_box, &mut of_law].into_iter().zip(both) {
                sum[0] += along * cos;
                sum[1] += across * sin;
            }
        }
        assert!((mean - 4.0 / PI).abs() < 1e-6);
        for (of_box, of_law) in of_box.into_iter().zip(of_law) {
            assert!((of_box / mean / of_law - 1.0).abs() < 1e-4, "{of_box} {of_law}");
        }
    }

    /// A contact that drives the slip would be a machine.
    #[test]
    fn it_takes_work_at_any_slip_and_any_ratio_of_friction() {
        for parts in [[1.2, 1.2], [-1.2, 1.2], [1.0, 0.0]] {
            let law = FrictionPyramid { parts };
            for roots in [[1.0, 1.0], [0.3, 1.0], [1.0, 0.3]] {
                for angle in angles() {
                    let q = [angle.cos() * roots[0], angle.sin() * roots[1]];
                    let [x, y] = law.gradient(q, 0.7);
                    // s · τ/p = −q · (q/|s/|s|| + ∂(|q| (D − 1))/∂q)
                    let squared = q[0] * q[0] + q[1] * q[1];
                    assert!(squared + q[0] * x + q[1] * y > 0.7 * squared);
                }
            }
        }
    }

    #[test]
    fn the_world_turns_against_the_robot_and_a_quarter_turn_changes_nothing() {
        let law = FrictionPyramid { parts: [0.8, -0.3] };
        for angle in angles().step_by(100) {
            let at = |heading: f64| {
                let slip = angle - heading;
                let force = law.gradient([slip.cos(), slip.sin()], heading);
                parts(force, slip)
            };
            for heading in [0.4, 2.0, -1.0] {
                for (here, there) in at(heading).into_iter().zip(at(0.0)) {
                    assert!((here - there).abs() < 1e-14);
                }
            }
            let quarter = law.gradient([angle.cos(), angle.sin()], 0.3 + FRAC_PI_2);
            for (here, there) in
                quarter.into_iter().zip(law.gradient([angle.cos(), angle.sin()], 0.3))
            {
                assert!((here - there).abs() < 1e-14);
            }
        }
    }
}
