//! A sled that the robot drags behind it.

use crate::form::Draws;
use crate::mechanism::{Described, Mechanism, Scene};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Scale, Sheet, Symmetry, Trial};
use trackdyn_core::{Twist, Wrench};

/// Speed of the hitch at which the sled drags with 71 %, m/s.
const ONSET_SPEED: f64 = 5e-3;

/// The sled's friction acts at the hitch, against its way.
#[derive(Clone, Copy, Debug)]
pub struct HitchDrag {
    coefficient: f64,
    distance: f64,
    sled: Option<Sled>,
}

/// A sled that is not a point.
#[derive(Clone, Copy, Debug)]
struct Sled {
    /// Half its length over the distance.
    half_length: f64,
    /// Drag across over that along.
    across: f64,
    onset_speed: f64,
}

impl Described for HitchDrag {
    const SHEET: Sheet = Sheet {
        id: "hitch-drag",
        origin: Origin::Catalogue,
        law: "F = −c W v/√(|v|² + v₀²) at the hitch, v₀ = 5 mm/s",
        size: "the same above 5 cm/s",
        shares_size: true,
        family: Some(Family {
            law: "F = −c W/2 [q v_x, v_y]/√(|v|² + v₀²) at each of two points on the robot's y \
                  axis, at r ± b: q from 0.5 to 1.8, b/r from 0 to 0.4, v₀ from 1 to 10 mm/s",
            size: "the drag in a straight line, at the mean distance",
            shares_size: false,
        }),
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
        Self { coefficient: values[0], distance: values[1], sled: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let sled = Sled {
            half_length: random.between(0.0, 0.4),
            across: random.log_between(0.5, 1.8),
            onset_speed: random.log_between(1e-3, 1e-2),
        };
        Self { sled: Some(sled), ..Self::from_values(values) }
    }
}

impl Mechanism for HitchDrag {
    fn push(&self, scene: &Scene, twist: &Twist, wrench: &mut Wrench) {
        if let Some(Sled { half_length, across, onset_speed }) = self.sled {
            for sign in [1.0, -1.0] {
                let point = [0.0, -self.distance * (1.0 + sign * half_length)];
                let [v_x, v_y] = twist.velocity_at(point);
                let drag = 0.5 * self.coefficient * scene.total_weight();
                let factor = -drag / v_x.hypot(v_y).hypot(onset_speed);
                wrench.add_force([factor * across * v_x, factor * v_y], point);
            }
            return;
        }
        let hitch = [0.0, -self.distance];
        let [v_x, v_y] = twist.velocity_at(hitch);
        let factor = -self.coefficient * scene.total_weight() / v_x.hypot(v_y).hypot(ONSET_SPEED);
        wrench.add_force([factor * v_x, factor * v_y], hitch);
    }
}
