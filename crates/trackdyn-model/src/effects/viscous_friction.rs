//! Friction that grows with slip speed.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Friction that grows linearly with the slip speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscousFriction {
    growth: f64,
}

impl Effect for ViscousFriction {
    const CARD: Card = Card {
        id: "viscous-friction",
        title: "Friction that grows with slip speed",
        law: "τ = −[μ] p (1 + c |s|) s/|s|",
        assumes: "Both directions of friction grow by the same factor.",
        shows: "The ICRs of fast turns differ from those of slow ones, alike forward and in \
                reverse.",
        resembles: "Soil that piles up before a quick track.",
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "growth_s_per_m",
            symbol: "c",
            unit: "s/m",
            meaning: "relative growth of friction per m/s of slip",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 10.0],
            typical: 0.5,
        }],
        sources: &["Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30(7), 1994, sec. 2"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { growth: values[0] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        // 1 + c |s|
        stress.scale(site.slip_speed() * self.growth + 1.0);
    }
}
