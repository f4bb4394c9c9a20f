//! Track frames that give way.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};
use trackdyn_core::Side;

/// The pull of a belt turns its frame about the arms that carry it: toes go in under power.
#[derive(Clone, Copy, Debug)]
pub struct SoftFrames {
    yield_angle: f64,
}

impl Described for SoftFrames {
    const SHEET: Sheet = Sheet {
        id: "soft-frames",
        origin: Origin::Outside,
        law: "belt velocity V (∓ sin δ, cos δ), δ = c x, x = shear force along the track over the \
              side's load",
        size: "5 degrees where the traction is all of the load; the belts of a turn toe in and out",
        shares_size: false,
        family: None,
        breaks: &[Symmetry::Reversal, Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::Distinct, 6.0).with_drawn_forms_only(),
        parameters: &[Parameter {
            key: "yield_deg",
            unit: "deg",
            range: [-40.0, 40.0],
            typical: 5.0,
            draw: Draw::size(5.0).signed(),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { yield_angle: values[0].to_radians() }
    }
}

impl Mechanism for SoftFrames {
    fn belt(&self, scene: &Scene, side: Side, velocity: &mut [f64; 2]) {
        let traction = scene.traction[side] / scene.weight[side];
        let (sin, cos) = (self.yield_angle * traction).sin_cos();
        let speed = velocity[1];
        *velocity = [velocity[0] - side.sign() * speed * sin, speed * cos];
    }
}
