//! Shear stress that builds up with shear displacement, and may pass a peak.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Length over which soil falls from its peak, in shear deformation moduli. The peak lies at two to
/// three moduli, when nearly all friction is mobilised.
const HUMP_LENGTH_IN_MODULI: f64 = 4.0;

/// Smallest speed of a moving belt, m/s: 0.03 mm in a year. Behind a lag, a stopping belt becomes
/// so slow that the reciprocal overflows.
const MIN_BELT_SPEED: f64 = 1e-12;

/// Soil or rubber that resists fully only after some shear displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearDisplacement {
    modulus: f64,
    residual: f64,
}

impl Effect for ShearDisplacement {
    const CARD: Card = Card {
        id: "shear-displacement",
        title: "Shear stress that builds up with shear displacement",
        law: "τ = −[μ] p (1 − exp(−j/K)) (1 + (1/r − 1)/cosh(j/4K)) s/|s|, j = |∫ s dt| since the \
              point entered the contact",
        assumes: "μ is what remains after long shearing; r = 1 is the law of Janosi and Hanamoto, \
                  less is soil with a hump. A belt point enters at the edge towards which its \
                  track moves and travels to the point at the belt's speed; the small turn of the \
                  hull meanwhile is left out. A belt that stands still has sheared fully.",
        shows: "y moves against the direction of travel, more so the slower the slip builds up.",
        resembles: "Lugs or tyres that bend before they slide.",
        breaks: &[Symmetry::Reversal, Symmetry::Manoeuvre],
        stages: &[Stage::Shear],
        parameters: &[
            Parameter {
                key: "modulus_m",
                symbol: "K",
                unit: "m",
                meaning: "shear deformation modulus: displacement at 63 % of full friction, \
                          without a hump",
                role: Role::Size { neutral: 0.0 },
                range: [1e-5, 0.3],
                typical: 0.02,
            },
            Parameter {
                key: "residual",
                symbol: "r",
                unit: "1",
                meaning: "friction after long shearing, as part of what it is before soil gives \
                          way",
                role: Role::Shape,
                range: [0.3, 1.0],
                typical: 1.0,
            },
        ],
        sources: &[
            "Janosi, Hanamoto, 1st Int. Conf. on Terrain-Vehicle Systems, Turin, 1961",
            "Kacigin, Guskov, Journal of Terramechanics 5(3), 1968",
            "Wong, Chiang, Proc. IMechE D 215(3), 2001",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { modulus: values[0], residual: values[1] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let belt_speed = site.belt_speed();
        if belt_speed.value().abs() <= MIN_BELT_SPEED {
            return;
        }
        let [x, y] = site.slip.position;
        let entry = if belt_speed.value() > 0.0 { site.patch.y[1] } else { site.patch.y[0] };
        // The slip is linear in y, so ∫ s dt is its mid-way value times |y_entry − y|/|V|.
        let travelled = (entry - y).abs();
        let half_way = site.slip_field().direction_at([x, (y + entry) * 0.5]);
        let unit_slip = (half_way[0] * half_way[0] + half_way[1] * half_way[1]).sqrt();
        let displacement = unit_slip * travelled * (site.slip_field().speed / belt_speed.abs());
        stress.scale(self.mobilised(displacement));
    }
}

impl ShearDisplacement {
    /// Friction after a shear displacement, m, relative to its residual value.
    fn mobilised<S: Scalar>(&self, displacement: S) -> S {
        let ratio = displacement * (1.0 / self.modulus);
        // 1 − exp(−j/K)
        let build_up = -(-ratio).exp_m1();
        let excess = 1.0 / self.residual - 1.0;
        if excess == 0.0 {
            return build_up;
        }
        // 1 + (1/r − 1)/cosh(j/4K), with 1/cosh x = 2 q/(1 + q²), q = exp(−x)
        let q = (ratio * (-1.0 / HUMP_LENGTH_IN_MODULI)).exp();
        build_up * (q / (q * q + 1.0) * (2.0 * excess) + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soil_without_a_hump_follows_janosi_and_one_with_it_gives_way_to_what_remains() {
        let modulus = 0.01;
        let janosi = ShearDisplacement { modulus, residual: 1.0 };
        let hump = ShearDisplacement { modulus, residual: 0.7 };
        let mut largest = 0.0_f64;
        for step in 0..400 {
            let displacement = 1e-3 * trackdyn_core::real(step);
            let expected = 1.0 - (-displacement / modulus).exp();
            assert!((janosi.mobilised(displacement) - expected).abs() < 1e-15);
            let ratio = displacement / modulus;
            let expected = expected * (1.0 + 3.0 / 7.0 / (ratio / 4.0).cosh());
            assert!((hump.mobilised(displacement) - expected).abs() < 1e-14);
            largest = largest.max(hump.mobilised(displacement));
        }
        assert!(largest > 1.1 && largest < 1.0 / 0.7);
        assert!((hump.mobilised(1.0) - 1.0_f64).abs() < 1e-9);
    }
}
