//! Shear stress that builds up with shear displacement.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::model::Site;
use trackdyn_core::Scalar;

/// Soil or rubber that must be sheared some way before it resists fully.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearDisplacement {
    modulus: f64,
}

impl Effect for ShearDisplacement {
    const CARD: Card = Card {
        id: "shear-displacement",
        title: "Shear stress that builds up with shear displacement",
        law: "τ = −[μ] p (1 − exp(−j/K)) s/|s|, j = |∫ s dt| since the point entered the contact",
        assumes: "A belt point enters at the edge towards which its track moves and travels to the \
                  point at the belt's speed; the small turn of the hull meanwhile is left out. A \
                  belt that stands still has sheared fully.",
        shows: "y moves against the direction of travel, more so the slower the slip builds up.",
        breaks: &[Symmetry::Reversal, Symmetry::Manoeuvre],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "modulus_m",
            symbol: "K",
            unit: "m",
            meaning: "shear deformation modulus: displacement at 63 % of full friction",
            role: Role::Size { neutral: 0.0 },
            range: [1e-4, 0.3],
            typical: 0.02,
        }],
        sources: &[
            "Janosi, Hanamoto, 1st Int. Conf. on Terrain-Vehicle Systems, Turin, 1961",
            "Wong, Chiang, Proc. IMechE D 215(3), 2001",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { modulus: values[0] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let belt_speed = site.belt_speed();
        if belt_speed == 0.0 {
            return;
        }
        let [x, y] = site.slip.position;
        let entry = if belt_speed > 0.0 { site.patch.y[1] } else { site.patch.y[0] };
        // The slip is linear in y, so ∫ s dt is its value half-way times |y_entry − y|/|V|.
        let travelled = (-y + entry).abs();
        let half_way = site.slip_field().direction_at([x, (y + entry) * 0.5]);
        let unit_slip = (half_way[0] * half_way[0] + half_way[1] * half_way[1]).sqrt();
        let displacement = unit_slip * travelled * (site.slip_field().speed / belt_speed.abs());
        // 1 − exp(−j/K)
        stress.scale(-(displacement * (-1.0 / self.modulus)).exp_m1());
    }
}
