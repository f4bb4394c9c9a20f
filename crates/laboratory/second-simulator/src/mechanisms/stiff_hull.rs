//! A hull that resists torsion.

use crate::mechanism::{Described, Load, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Sheet, Trial};
use trackdyn_core::Side;

/// Both tracks pitch alike, so the lighter side has the larger share of the pitching moment.
#[derive(Clone, Copy, Debug)]
pub struct StiffHull {
    share: f64,
}

impl Described for StiffHull {
    const SHEET: Sheet = Sheet {
        id: "stiff-hull",
        origin: Origin::Outside,
        law: "N_j y_j = W y_p/2 with a torsion-stiff hull; a share of the way from y_j = y_p",
        size: "static; acts only where the centre of gravity is off the middle both ways",
        shares_size: false,
        family: None,
        breaks: &[],
        trial: Trial::law(Identifiability::Distinct, 1.0),
        parameters: &[Parameter {
            key: "share",
            unit: "1",
            range: [0.0, 1.0],
            typical: 1.0,
            draw: Draw::size(1.0),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { share: values[0] }
    }
}

impl Mechanism for StiffHull {
    fn load(&self, scene: &Scene, load: &mut Load) {
        for side in Side::BOTH {
            // N_j/W = 1/2 ± x_p/L
            let bears = 0.5 + side.sign() * load.across / scene.vehicle.gauge;
            load.along[side] *= 1.0 + self.share * (0.5 / bears - 1.0);
        }
    }
}
