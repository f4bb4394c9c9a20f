//! Belts that toe out with speed.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::Side;

/// Sprocket arms give way to the drive's reaction, and the belts walk outwards as they run faster.
#[derive(Clone, Copy, Debug)]
pub struct SplayedBelts {
    splay: f64,
}

impl Described for SplayedBelts {
    const SHEET: Sheet = Sheet {
        id: "splayed-belts",
        origin: Origin::Outside,
        law: "belt velocity V (± sin δ, cos δ), δ = c V",
        size: "3 degrees at 1 m/s; belts walk outwards either way",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::SpeedScale, Symmetry::Reversal, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::Distinct, 5.0),
        parameters: &[Parameter {
            key: "splay_deg_s_per_m",
            unit: "deg s/m",
            range: [-20.0, 20.0],
            typical: 3.0,
            draw: Draw::size(3.0).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { splay: values[0].to_radians() }
    }
}

impl Mechanism for SplayedBelts {
    fn belt(&self, _scene: &Scene, side: Side, velocity: &mut [f64; 2]) {
        let speed = velocity[1];
        let (sin, cos) = (self.splay * speed).sin_cos();
        *velocity = [velocity[0] + side.sign() * speed * sin, speed * cos];
    }
}
