//! A belt that slips on its sprocket under load.

use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Invariance, Origin, Parameter, Sheet};
use trackdyn_core::{PerSide, Side};

/// Traction over load at which the law equals the linear one.
const EQUAL_AT: f64 = 0.3;

/// Time that the belt takes to stretch, s.
const STRETCH_TIME: f64 = 0.02;

/// The sprocket loses speed to the belt by a power of the traction, and the belt's stretch delays it.
#[derive(Clone, Copy, Debug)]
pub struct BeltSlip {
    slip: f64,
    lost: PerSide<f64>,
}

impl Described for BeltSlip {
    const SHEET: Sheet = Sheet {
        id: "belt-slip",
        origin: Origin::Catalogue,
        law: "V = V_shown (1 − q), q' = (λ x √(|x|/0.3) − q)/0.02 s, x = traction over load, in \
              the belt's direction",
        size: "equal to the linear V_shown (1 − λ x) at a traction of 0.3 of the load",
        breaks: &[Invariance::Manoeuvre],
        parameters: &[Parameter { key: "slip", unit: "1", range: [0.0, 0.5], typical: 0.1 }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { slip: values[0], lost: PerSide::new(0.0, 0.0) }
    }
}

impl Mechanism for BeltSlip {
    fn drive(&self, _scene: &Scene, _dt: f64, belt: &mut PerSide<f64>) {
        for side in Side::BOTH {
            belt[side] *= 1.0 - self.lost[side];
        }
    }

    fn advance(&mut self, step: &Step) {
        let share = -(-step.dt / STRETCH_TIME).exp_m1();
        for side in Side::BOTH {
            let sense = step.scene.encoder[side].signum();
            let x = sense * step.traction[side] / step.scene.weight[side];
            let slip = self.slip * x * (x.abs() / EQUAL_AT).sqrt();
            self.lost[side] += share * (slip.clamp(-1.0, 1.0) - self.lost[side]);
        }
    }
}
