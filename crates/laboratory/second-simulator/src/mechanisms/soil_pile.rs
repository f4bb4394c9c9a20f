//! Soil that piles up beside the tracks.

use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{Twist, Wrench};

/// Yaw rate at which a pile resists with 71 %, rad/s.
const ONSET_RATE: f64 = 5e-3;

/// A turn pushes a pile up in front of the tracks' flanks; driving ahead or turning back leaves it.
#[derive(Clone, Copy, Debug)]
pub struct SoilPile {
    coefficient: f64,
    angle: f64,
    /// Angle that was turned into the piles, rad; left positive.
    turned: f64,
}

impl Described for SoilPile {
    const SHEET: Sheet = Sheet {
        id: "soil-pile",
        origin: Origin::Outside,
        law: "M = −c W L/2 h ω/√(ω² + ω₀²), h = 1 − exp(−|φ|/φ₀), φ the angle turned in one \
              sense, forgotten in L/2 of way ahead, ω₀ = 5 mrad/s",
        size: "once piled up, as a drag of c times each side's load at its track",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Manoeuvre, Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 6.0).with_drawn_forms_only(),
        parameters: &[
            Parameter {
                key: "coefficient",
                unit: "1",
                range: [0.0, 0.5],
                typical: 0.08,
                draw: Draw::size(0.08),
            },
            Parameter {
                key: "angle_deg",
                unit: "deg",
                range: [1.0, 720.0],
                typical: 20.0,
                draw: Draw::log_shape(20.0, 120.0, &[]),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0], angle: values[1].to_radians(), turned: 0.0 }
    }
}

impl Mechanism for SoilPile {
    fn push(&self, scene: &Scene, twist: &Twist, wrench: &mut Wrench) {
        let pile = -(-self.turned.abs() / self.angle).exp_m1();
        let arm = scene.vehicle.gauge / 2.0;
        let sense = twist.w / twist.w.hypot(ONSET_RATE);
        wrench.moment -= self.coefficient * scene.total_weight() * arm * pile * sense;
    }

    fn advance(&mut self, step: &Step) {
        let turn = step.twist.w * step.dt;
        let before = if turn * self.turned < 0.0 { 0.0 } else { self.turned };
        let ahead = step.twist.v_y.abs() * step.dt / (step.scene.vehicle.gauge / 2.0);
        self.turned = (before + turn) * (-ahead).exp();
    }
}
