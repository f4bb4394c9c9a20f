//! Friction that is bounded along each axis of the world.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use std::f64::consts::{FRAC_PI_4, PI};

/// Steepness with which a side of a box comes: nine tenths where the slip is 6° off its axis.
const STEEPNESS: f64 = 20.0;

/// Two true boxes in place of a part of the circle.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPyramid {
    /// Parts of boxes along the axes of the world and at 22.5° to them.
    parts: [f64; 2],
}

impl Described for FrictionPyramid {
    const SHEET: Sheet = Sheet {
        id: "friction-pyramid",
        origin: Origin::Catalogue,
        law: "parts a and b of friction become −(π/4) √[μ] N |q| Σ_i e_i tanh(20 q_i/√(μ_x + \
              μ_y)), q = √[μ] z/z₀, e_i along two axes at right angles: of the world for a, 22.5° \
              on for b, 45° more where negative",
        size: "true boxes with the same first harmonic",
        shares_size: true,
        family: None,
        breaks: &[Symmetry::Mirror, Symmetry::Heading],
        trial: Trial::law(Identifiability::Distinct, 2.0),
        parameters: &[
            Parameter {
                key: "box",
                unit: "1",
                range: [-1.0, 1.0],
                typical: 0.5,
                draw: Draw::size(0.5).signed(),
            },
            Parameter {
                key: "turned_box",
                unit: "1",
                range: [-1.0, 1.0],
                typical: 0.0,
                draw: Draw::fixed(0.0),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { parts: [values[0], values[1]] }
    }
}

impl Mechanism for FrictionPyramid {
    fn traction(&self, contact: &Contact, force: &mut [f64; 2]) {
        let friction = contact.scene.vehicle.friction;
        let roots = [friction.across.sqrt(), friction.along.sqrt()];
        let [x, y] = contact.deflection;
        let q = [x * roots[0], y * roots[1]];
        let size = q[0].hypot(q[1]);
        let heading = contact.scene.pose.yaw;
        for (k, part) in self.parts.into_iter().enumerate() {
            if part == 0.0 || size == 0.0 {
                continue;
            }
            let turned = if k == 0 { 0.0 } else { PI / 8.0 };
            let axis = if part < 0.0 { turned + FRAC_PI_4 } else { turned };
            let (sin, cos) = (axis - heading).sin_cos();
            // x right and y forward of two axes, counter-clockwise from forward
            for [a, b] in [[-sin, cos], [-cos, -sin]] {
                let along = a * q[0] + b * q[1];
                let side = (STEEPNESS * along / roots[0].hypot(roots[1])).tanh();
                let reach = part.abs() * PI / 4.0 * contact.load * size;
                let pushes = [a * roots[0], b * roots[1]];
                for (force, push) in force.iter_mut().zip(pushes) {
                    *force -= reach * side * push;
                }
            }
            // in place of that part of the circle
            for ((force, root), q) in force.iter_mut().zip(roots).zip(q) {
                *force += part.abs() * contact.load * root * q;
            }
        }
    }
}
