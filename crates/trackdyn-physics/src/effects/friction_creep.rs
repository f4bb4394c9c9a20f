//! Friction that needs slip to build up.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::model::Site;
use trackdyn_core::Scalar;

/// Rubber or soil that creeps before it slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionCreep {
    speed: f64,
}

impl Effect for FrictionCreep {
    const CARD: Card = Card {
        id: "friction-creep",
        title: "Friction that is reached only above a slip speed",
        law: "τ = −[μ] p (1 − exp(−|s|/v_c)) s/|s|",
        assumes: "Viscous creep at small slip, Coulomb friction at large slip; the same in both \
                  directions.",
        shows: "Slow turns see less friction near the ICRs, which move outwards; fast turns do \
                not.",
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "speed_m_per_s",
            symbol: "v_c",
            unit: "m/s",
            meaning: "slip speed at 63 % of full friction",
            role: Role::Size { neutral: 0.0 },
            range: [0.0001, 2.0],
            typical: 0.03,
        }],
        sources: &["Persson, Sliding Friction, 2000", "Dahl, AIAA Journal 14(12), 1976"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { speed: values[0] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        // 1 − exp(−|s|/v_c)
        stress.scale(-(site.slip_speed() * (-1.0 / self.speed)).exp_m1());
    }
}
