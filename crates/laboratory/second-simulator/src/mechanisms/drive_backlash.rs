//! Play between encoders and belts.

use crate::mechanism::{Described, Mechanism, Scene, Step};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::{PerSide, Side};

/// After every change of sense a belt waits until the play is taken up.
#[derive(Clone, Copy, Debug)]
pub struct DriveBacklash {
    play: f64,
    taken: PerSide<f64>,
}

impl Described for DriveBacklash {
    const SHEET: Sheet = Sheet {
        id: "drive-backlash",
        origin: Origin::Outside,
        law: "V = 0 while the encoder's way is inside the play, else V_shown",
        size: "a worn final drive; shows where the sense changes",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 10.0),
        parameters: &[Parameter {
            key: "play_m",
            unit: "m",
            range: [0.0, 0.2],
            typical: 0.01,
            draw: Draw::size(0.01),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { play: values[0], taken: PerSide::new(0.0, 0.0) }
    }
}

impl Mechanism for DriveBacklash {
    fn drive(&self, _scene: &Scene, dt: f64, belt: &mut PerSide<f64>) {
        *belt = PerSide::from_fn(|side| {
            let way = self.taken[side] + belt[side] * dt;
            // what goes beyond the play moves the belt
            (way - way.clamp(0.0, self.play)) / dt
        });
    }

    fn advance(&mut self, step: &Step) {
        for side in Side::BOTH {
            let way = self.taken[side] + step.fed[side] * step.dt;
            self.taken[side] = way.clamp(0.0, self.play);
        }
    }
}
