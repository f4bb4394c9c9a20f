//! A belt that slips on its sprocket under load.

use crate::form::Draws;
use crate::mechanism::{Described, Mechanism, Step};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
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
    stretch_time: f64,
    loss: Loss,
}

/// How the slip grows with the traction.
#[derive(Clone, Copy, Debug)]
enum Loss {
    /// With its power of 3/2.
    Plain,
    /// With another power, beyond 1.
    Power(f64),
    /// Levelling off.
    Levels(f64),
}

impl Described for BeltSlip {
    const SHEET: Sheet = Sheet {
        id: "belt-slip",
        origin: Origin::Catalogue,
        law: "V = V_shown (1 − q), q' = (λ x √(|x|/0.3) − q)/0.02 s, x = shear force over load, in \
              the sprocket's direction",
        size: "equal to the linear V_shown (1 − λ x) at a traction of 0.3 of the load",
        shares_size: false,
        family: Some(Family {
            law: "q' = (0.3 λ C(x/0.3) − q)/T, C odd with C(1) = 1: r |r|^(p − 1), p from 1.4 to \
                  3, or tanh(r/κ)/tanh(1/κ), κ from 0.4 to 1; T from 5 to 50 ms",
            size: "equal to V_shown (1 − λ x) at a traction of 0.3 of the load",
            shares_size: false,
        }),
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
        let lost = PerSide::new(0.0, 0.0);
        Self { slip: values[0], lost, stretch_time: STRETCH_TIME, loss: Loss::Plain }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let loss = if random.happens(0.6) {
            Loss::Power(random.between(1.4, 3.0))
        } else {
            Loss::Levels(random.between(0.4, 1.0))
        };
        let stretch_time = random.log_between(5e-3, 5e-2);
        Self { stretch_time, loss, ..Self::from_values(values) }
    }
}

impl Mechanism for BeltSlip {
    fn slips(&self) -> bool {
        true
    }

    fn slip(&self, side: Side, traction: f64, dt: f64) -> f64 {
        let settled = self.settled(traction);
        let passed = dt / self.stretch_time;
        // the mean of q_0 + (λ x √(|x|/0.3) − q_0)(1 − e^(−t/T))
        settled + (self.lost[side] - settled) * -(-passed).exp_m1() / passed
    }

    fn advance(&mut self, step: &Step) {
        let share = -(-step.dt / self.stretch_time).exp_m1();
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
        let ratio = traction / EQUAL_TRACTION_RATIO;
        let slip = match self.loss {
            // λ x √(|x|/0.3)
            Loss::Plain => self.slip * traction * (traction.abs() / EQUAL_TRACTION_RATIO).sqrt(),
            Loss::Power(power) => self.slip * traction * ratio.abs().powf(power - 1.0),
            Loss::Levels(at) => {
                self.slip * EQUAL_TRACTION_RATIO * (ratio / at).tanh() / at.recip().tanh()
            }
        };
        slip.clamp(-1.0, 1.0)
    }
}
