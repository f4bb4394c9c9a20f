//! A belt that slips on its sprocket under load.

use crate::mechanism::{Described, Mechanism, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// Traction over load at which the law equals the linear one.
const EQUAL_TRACTION_RATIO: f64 = 0.3;

/// Time that the belt takes to stretch, s.
const STRETCH_TIME: f64 = 0.02;

/// The sprocket loses speed to the belt by a power of the traction, and the belt's stretch delays
/// it.
#[derive(Clone, Copy, Debug)]
pub struct BeltSlip {
    slip: f64,
    lost: PerSide<f64>,
}

impl Described for BeltSlip {
    const SHEET: Sheet = Sheet {
        id: "belt-slip",
        origin: Origin::Catalogue,
        law: "V = V_shown (1 − q), q' = (λ x √(|x|/0.3) − q)/0.02 s, x = shear force over load, in \
              the sprocket's direction",
        size: "equal to the linear V_shown (1 − λ x) at a traction of 0.3 of the load",
        shares_size: false,
        breaks: &[Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 5.0),
        parameters: &[Parameter {
            key: "slip",
            unit: "1",
            range: [0.0, 0.5],
            typical: 0.1,
            draw: Draw::size(0.1),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { slip: values[0], lost: PerSide::new(0.0, 0.0) }
    }
}

impl Mechanism for BeltSlip {
    fn slips(&self) -> bool {
        true
    }

    fn slip(&self, side: Side, traction: f64, dt: f64) -> f64 {
        let settled = self.settled(traction);
        let passed = dt / STRETCH_TIME;
        // the mean of q_0 + (λ x √(|x|/0.3) − q_0)(1 − e^(−t/T))
        settled + (self.lost[side] - settled) * -(-passed).exp_m1() / passed
    }

    fn advance(&mut self, step: &Step) {
        let share = -(-step.dt / STRETCH_TIME).exp_m1();
        for side in Side::BOTH {
            let traction = step.scene.sprocket[side].signum() * step.traction[side];
            let settled = self.settled(traction / step.scene.weight[side]);
            self.lost[side] += share * (settled - self.lost[side]);
        }
    }
}

impl BeltSlip {
    /// Part of the speed that is lost under a steady traction over load.
    fn settled(&self, traction: f64) -> f64 {
        // λ x √(|x|/0.3)
        let slip = self.slip * traction * (traction.abs() / EQUAL_TRACTION_RATIO).sqrt();
        slip.clamp(-1.0, 1.0)
    }
}
