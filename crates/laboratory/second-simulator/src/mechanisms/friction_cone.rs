//! Friction on another cone, as simulators have it.

use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Trial};

/// A mixture of the ellipse and of a box or a diamond.
#[derive(Clone, Copy, Debug)]
pub struct FrictionCone {
    normality: f64,
    pyramid: f64,
}

/// Slip angle over which a component of a box or a diamond comes, rad.
const TURN: f64 = 0.02;

impl Described for FrictionCone {
    const SHEET: Sheet = Sheet {
        id: "friction-cone",
        origin: Origin::Catalogue,
        law: "F = −[μ] N ((1 − |b|) u/|u| + |b| e), u = (1 + a ([μ]/√(μ_x μ_y) − 1)) z/z₀; e = \
              tanh(u/0.02) for b > 0, else the larger component of u alone",
        size: "the same at the ends, 0, 1 and −1; between them a mixture instead of a power",
        shares_size: false,
        family: None,
        breaks: &[],
        trial: Trial::law(Identifiability::Indistinct, 1.5),
        parameters: &[
            Parameter {
                key: "normality",
                unit: "1",
                range: [0.0, 1.0],
                typical: 0.5,
                draw: Draw::size(0.5),
            },
            Parameter {
                key: "pyramid",
                unit: "1",
                range: [-0.9, 1.0],
                typical: 0.5,
                draw: Draw::size(0.5).signed(),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { normality: values[0], pyramid: values[1] }
    }
}

impl Mechanism for FrictionCone {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let strain = contact.deflection[0].hypot(contact.deflection[1]);
        if strain == 0.0 {
            return;
        }
        let direction = contact.deflection.map(|z| z / strain);
        let mean = (mu[0] * mu[1]).sqrt();
        let u = [0, 1].map(|k| direction[k] * (1.0 + self.normality * (mu[k] / mean - 1.0)));
        let length = u[0].hypot(u[1]);
        let end = if self.pyramid > 0.0 {
            u.map(|u| (u / TURN).tanh())
        } else {
            let across = 0.5 * (1.0 + ((u[0].abs() - u[1].abs()) / TURN).tanh());
            [across.copysign(u[0]), (1.0 - across).copysign(u[1])]
        };
        let share = self.pyramid.abs();
        for k in 0..2 {
            // z_k/z₀ is multiplied by this: F_k = −μ_k N g_k
            let turned = (1.0 - share) * u[k] / length + share * end[k];
            if direction[k] != 0.0 {
                mu[k] *= turned / direction[k];
            }
        }
    }
}
