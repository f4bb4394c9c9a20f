//! Drives that hesitate.

use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// A controller that waits before it lets go or turns round: nothing while a drive runs.
#[derive(Clone, Copy, Debug)]
pub struct SlowClutch {
    pause: f64,
    /// Sense in which a drive ran last or waits to run: −1, 0 or 1.
    sense: PerSide<f64>,
    /// Time that it still waits, s.
    wait: PerSide<f64>,
}

impl Described for SlowClutch {
    const SHEET: Sheet = Sheet {
        id: "slow-clutch",
        origin: Origin::Outside,
        law: "V = 0 for T after V_shown leaves rest or changes its sense, else V_shown",
        size: "a dead time at starts and reversals only, where a lag delays every change",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 10.0).with_drawn_forms_only(),
        parameters: &[Parameter {
            key: "pause_s",
            unit: "s",
            range: [0.0, 1.0],
            typical: 0.1,
            draw: Draw::size(0.1),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        let none = PerSide::new(0.0, 0.0);
        Self { pause: values[0], sense: none, wait: none }
    }
}

impl SlowClutch {
    /// Time that a drive waits once it is to run at a speed, s.
    fn wait(&self, side: Side, speed: f64) -> f64 {
        if sense(speed) == self.sense[side] { self.wait[side] } else { self.pause }
    }
}

/// Sense of a speed; none at rest.
fn sense(speed: f64) -> f64 {
    if speed == 0.0 { 0.0 } else { speed.signum() }
}

impl Mechanism for SlowClutch {
    fn drive(&self, _scene: &Scene, dt: f64, belt: &mut PerSide<f64>) {
        *belt = PerSide::from_fn(|side| {
            let speed = belt[side];
            speed * (1.0 - self.wait(side, speed).min(dt) / dt)
        });
    }

    fn advance(&mut self, step: &Step) {
        for side in Side::BOTH {
            let speed = step.fed[side];
            self.wait[side] = (self.wait(side, speed) - step.dt).max(0.0);
            self.sense[side] = sense(speed);
        }
    }
}
