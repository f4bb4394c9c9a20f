//! Soil that must be sheared before it resists, and resists less when it has been.

use crate::form::{Curve, Draws};
use crate::mechanism::{Contact, Described, Mechanism};
use crate::sheet::{Family, Draw, Identifiability, Origin, Parameter, Sheet, Symmetry, Trial};

use std::f64::consts::E;

/// Shear stress that is left after long sliding, in parts of the peak, K_r.
const RESIDUAL_STRESS_RATIO: f64 = 0.85;

/// K_w over the K of Janosi and Hanamoto with which this law reaches 1 − 1/e at the same
/// displacement.
const PEAK_PER_MODULUS: f64 = 3.097;

/// # Sources
/// Wong, Theory of Ground Vehicles, 3rd ed., sec. 2.4.
fn hump(ratio: f64) -> f64 {
    let rise = -(-ratio).exp_m1();
    let excess = 1.0 / (RESIDUAL_STRESS_RATIO * (1.0 - 1.0 / E)) - 1.0;
    RESIDUAL_STRESS_RATIO * (1.0 + excess * (1.0 - ratio).exp()) * rise
}

/// Wong's law with a hump.
#[derive(Clone, Debug)]
pub struct ShearDisplacement {
    /// Displacement in which the law is counted, m.
    scale: f64,
    /// Part of the friction over displacement by scale, where it is not Wong's.
    rise: Option<Curve>,
}

impl Described for ShearDisplacement {
    const SHEET: Sheet = Sheet {
        id: "shear-displacement",
        origin: Origin::Catalogue,
        law: "μ K_r (1 + (1/(K_r (1 − 1/e)) − 1) exp(1 − j/K_w)) (1 − exp(−j/K_w)), K_r = 0.85, \
              j the way slid",
        size: "K_w = 3.1 K: at 63 % where j = K, as 1 − exp(−j/K) of Janosi and Hanamoto",
        shares_size: false,
        family: Some(Family {
            law: "μ k(j/K), k = (1 − exp(−(x/a)^p)) (1 + H exp(−ln²(x/b)/(2 w²))), p from 0.6 to \
                  1.6, hump H from 0 to 0.35 at b from 1 to 5 K, w from 0.3 to 0.9, a such that \
                  k(1) = 1 − 1/e",
            size: "63 % where j = K, as Janosi's 1 − exp(−j/K)",
            shares_size: false,
        }),
        breaks: &[Symmetry::Reversal, Symmetry::Manoeuvre, Symmetry::Transient],
        trial: Trial::law(Identifiability::Distinct, 15.0),
        parameters: &[Parameter {
            key: "modulus_m",
            unit: "m",
            range: [0.001, 0.3],
            typical: 0.02,
            draw: Draw::size(0.02),
        }],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { scale: PEAK_PER_MODULUS * values[0], rise: None }
    }

    fn drawn(values: &[f64], random: &mut Draws) -> Self {
        let power = random.between(0.6, 1.6);
        let (height, place) = (random.between(0.0, 0.35), random.log_between(1.0, 5.0));
        let width = random.between(0.3, 0.9);
        let hump = |x: f64| 1.0 + height * (-((x / place).ln() / width).powi(2) / 2.0).exp();
        // 1 − exp(−a^−p) times the hump is 1 − 1/e at x = 1
        let stretch = -(-(1.0 - 1.0 / E) / hump(1.0)).ln_1p();
        let rise = |x: f64| -(-stretch * x.powf(power)).exp_m1() * hump(x);
        let rise = Curve::of(|x| if x > 0.0 { rise(x) } else { 0.0 });
        Self { scale: values[0], rise: Some(rise) }
    }
}

impl Mechanism for ShearDisplacement {
    fn friction(&self, contact: &Contact, mu: &mut [f64; 2]) {
        let ratio = contact.slid / self.scale;
        let factor = match &self.rise {
            None => hump(ratio),
            Some(curve) => curve.at(ratio),
        };
        *mu = mu.map(|mu| mu * factor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hump_is_near_its_displacement_and_the_modulus_at_63_percent() {
        // Wong's curve passes 1 at K_w and goes on to its maximum, 1.013 at 1.25 K_w for this
        // residual
        assert!((hump(1.0) - 1.0).abs() < 1e-12);
        assert!((hump(1.25) - 1.013).abs() < 1e-3 && hump(1.3) < hump(1.25));
        assert!((hump(20.0) - RESIDUAL_STRESS_RATIO).abs() < 1e-6);
        // 1 − exp(−1)
        assert!((hump(1.0 / PEAK_PER_MODULUS) - (1.0 - 1.0 / E)).abs() < 1e-4);
    }
}
