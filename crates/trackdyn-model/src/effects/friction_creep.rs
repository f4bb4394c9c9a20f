//! Friction that needs slip to build up.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::{RigidBody, Site};
use trackdyn_core::Scalar;

/// Rubber or soil that creeps before it slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionCreep {
    speed: f64,
    sharpness: f64,
}

impl Effect for FrictionCreep {
    const CARD: Card = Card {
        id: "friction-creep",
        title: "Friction that is reached only above a slip speed, as soft contacts have it",
        law: "τ = −[μ] p (1 − (1 + |s|/(n v_c))^−n) s/|s|",
        assumes: "Viscous creep at small slip, Coulomb friction at large slip; alike in both \
                  directions. With large n friction is full soon above v_c, as 1 − exp(−|s|/v_c); \
                  with n = 1 the rest comes slowly, as 1/|s|. Soft contacts of simulators (slip1 \
                  and slip2 of ODE; solref, solimp and impratio of MuJoCo) rise alike whatever \
                  their load: under an even load, this law with v_c = slip1 · μ N of a contact.",
        shows: "Slow turns see less friction near the ICRs, which move outwards; fast turns do \
                not.",
        resembles: "Rubber blocks that bend before they slide.",
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        stages: &[Stage::Shear],
        parameters: &[
            Parameter {
                key: "speed_m_per_s",
                symbol: "v_c",
                unit: "m/s",
                meaning: "slip speed of full friction by its slope at rest",
                role: Role::Size { neutral: 0.0 },
                range: [1e-5, 2.0],
                typical: 0.03,
            },
            Parameter {
                key: "sharpness",
                symbol: "n",
                unit: "1",
                meaning: "power of the slip speed with which the rest of friction comes",
                role: Role::Shape,
                range: [1.0, 20.0],
                typical: 20.0,
            },
        ],
        sources: &[
            "Persson, Sliding Friction, 2000",
            "Dahl, AIAA Journal 14(12), 1976",
            "Smith, Open Dynamics Engine, manual: contact.surface, slip1 and slip2",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { speed: values[0], sharpness: values[1] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        // μ p (1 − (1 + |s|/(n v_c))^−n) = μ p |s|/v_c at small slip
        body.creep_speed += self.speed;
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        stress.scale(self.mobilised(site.slip_speed()));
    }
}

impl FrictionCreep {
    /// Share of full friction at a slip speed, m/s.
    fn mobilised<S: Scalar>(&self, slip_speed: S) -> S {
        let Self { speed, sharpness } = *self;
        // 1 − (1 + |s|/(n v_c))^−n
        let ratio = slip_speed * (1.0 / (sharpness * speed));
        -(ratio.ln_1p() * -sharpness).exp_m1()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::Dual;

    #[test]
    fn friction_comes_at_once_or_slowly() {
        let part = |sharpness: f64, slip_speed: f64| -> f64 {
            FrictionCreep { speed: 0.02, sharpness }.mobilised(slip_speed)
        };
        // a hyperbola, then nearly an exponential
        assert!((part(1.0, 0.06) - 0.75).abs() < 1e-12);
        assert!((part(20.0, 0.02) - (1.0 - (-1.0_f64).exp())).abs() < 0.01);
        for sharpness in [1.0, 3.0, 20.0] {
            assert!((part(sharpness, 2e-8) - 1e-6).abs() < 1e-11, "alike from rest");
            let quotient = (part(sharpness, 0.0301) - part(sharpness, 0.0299)) / 2e-4;
            let creep = FrictionCreep { speed: 0.02, sharpness };
            let slope = creep.mobilised(Dual::<1>::variable(0.03, 0)).gradient[0];
            assert!((slope / quotient - 1.0).abs() < 1e-5, "{slope} and {quotient}");
        }
    }
}
