//! A sled that the robot drags behind it.

use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};
use trackdyn_core::{Twist, Wrench};

/// Speed of the hitch at which the sled drags with 71 %, m/s.
const ONSET_SPEED: f64 = 5e-3;

/// The sled's friction acts at the hitch, against its way.
#[derive(Clone, Copy, Debug)]
pub struct HitchDrag {
    coefficient: f64,
    distance: f64,
}

impl Described for HitchDrag {
    const SHEET: Sheet = Sheet {
        id: "hitch-drag",
        origin: Origin::Catalogue,
        law: "F = −c W v/√(|v|² + v₀²) at the hitch, v₀ = 5 mm/s",
        size: "the same above 5 cm/s",
        shares_size: true,
        breaks: &[Symmetry::Manoeuvre],
        trial: Trial::law(Identifiability::DistinctWhenLarge, 6.0),
        parameters: &[
            Parameter {
                key: "drag",
                unit: "1",
                range: [0.0, 0.5],
                typical: 0.05,
                draw: Draw::size(0.05),
            },
            Parameter {
                key: "distance_m",
                unit: "m",
                range: [0.0, 5.0],
                typical: 0.5,
                draw: Draw::shape(0.5, 1.5, &[0.5, 1.5]).times(Scale::ContactLength),
            },
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0], distance: values[1] }
    }
}

impl Mechanism for HitchDrag {
    fn push(&self, scene: &Scene, twist: &Twist, wrench: &mut Wrench) {
        let hitch = [0.0, -self.distance];
        let [v_x, v_y] = twist.velocity_at(hitch);
        let factor = -self.coefficient * scene.total_weight() / v_x.hypot(v_y).hypot(ONSET_SPEED);
        wrench.add_force([factor * v_x, factor * v_y], hitch);
    }
}
