//! Belts that follow the encoders late.

mod chain;

use chain::Chain;
use crate::form::Draws;
use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// Two lags in a row: the motor's and the belt's.
#[derive(Clone, Debug)]
pub struct DrivetrainLag {
    half: f64,
    motor: PerSide<f64>,
    belt: PerSide<f64>,
    chain: Option<PerSide<Chain>>,
}

impl Described for DrivetrainLag {
    const SHEET: Sheet = Sheet {
        id: "drivetrain-lag",
        origin: Origin::Catalogue,
        law: "u' = (V_shown − u)/(T/2), V' = (u − V)/(T/2)",
        size: "both delay a ramp by T",
        shares_size: false,
        family: Some(Family {
            law: "one to three lags in a row, after a dead time of 0.1 to 0.6 T where there is one \
                  lag, in half of the others none",
            size: "lags and dead time together delay a ramp by T",
            shares_size: false,
        }),
        breaks: &[Symmetry::Transient],
        trial: Trial::law(Identifiability::Indistinct, 4.0),
        parameters: &[Parameter {
            key: "time_constant_s",
            unit: "s",
            range: [0.001, 2.0],
            typical: 0.15,
            draw: Draw::size(0.15),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        let rest = PerSide::new(0.0, 0.0);
        Self { half: values[0] / 2.0, motor: rest, belt: rest, chain: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let chain = Chain::draw(values[0], random);
        let chain = PerSide::from_fn(|_| chain.clone());
        Self { chain: Some(chain), ..Self::from_values(values) }
    }
}

impl Mechanism for DrivetrainLag {
    fn drive(&self, _scene: &Scene, dt: f64, belt: &mut PerSide<f64>) {
        *belt = PerSide::from_fn(|side| match &self.chain {
            None => self.mean(side, belt[side], dt),
            Some(chain) => chain[side].clone().pass(belt[side], dt),
        });
    }

    fn advance(&mut self, step: &Step) {
        for side in Side::BOTH {
            if let Some(chain) = &mut self.chain {
                chain[side].pass(step.fed[side], step.dt);
                continue;
            }
            let [motor, belt] = self.follow(side, step.fed[side], step.dt);
            self.motor[side] = motor;
            self.belt[side] = belt;
        }
    }
}

impl DrivetrainLag {
    /// Mean speed of the belt over `dt` at a constant input, m/s.
    fn mean(&self, side: Side, input: f64, dt: f64) -> f64 {
        let passed = dt / self.half;
        let decay = (-passed).exp();
        let (motor, belt) = (self.motor[side] - input, self.belt[side] - input);
        input + (belt * (1.0 - decay) + motor * (1.0 - decay * (1.0 + passed))) / passed
    }

    /// Speeds of motor and belt after `dt` at a constant input, m/s.
    fn follow(&self, side: Side, input: f64, dt: f64) -> [f64; 2] {
        let passed = dt / self.half;
        let decay = (-passed).exp();
        let (motor, belt) = (self.motor[side] - input, self.belt[side] - input);
        [input + motor * decay, input + (belt + motor * passed) * decay]
    }
}
