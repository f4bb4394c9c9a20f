//! Friction that falls with slip speed.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Friction that is larger at rest than in sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StribeckFriction {
    excess: f64,
    speed: f64,
}

impl Effect for StribeckFriction {
    const CARD: Card = Card {
        id: "stribeck-friction",
        title: "Friction that falls with slip speed",
        law: "τ = −[μ] p (1 + a exp(−|s|/v_s)) s/|s|",
        assumes: "Both directions of friction fall by the same factor; μ is what remains at high \
                  slip.",
        shows: "The ICRs of slow turns differ from those of fast ones, alike forward and in \
                reverse, and most at slow speeds.",
        resembles: "A film of water or mud, and rubber that warms.",
        breaks: &[Symmetry::SpeedScale, Symmetry::Manoeuvre],
        stages: &[Stage::Shear],
        parameters: &[
            Parameter {
                key: "excess",
                symbol: "a",
                unit: "1",
                meaning: "relative excess of friction at rest",
                role: Role::Size { neutral: 0.0 },
                range: [0.0, 2.0],
                typical: 0.3,
            },
            Parameter {
                key: "speed_m_per_s",
                symbol: "v_s",
                unit: "m/s",
                meaning: "slip speed at which the excess has fallen to 37 %",
                role: Role::Shape,
                range: [0.001, 5.0],
                typical: 0.1,
            },
        ],
        sources: &[
            "Tustin, Journal of the IEE 94(IIA), 1947",
            "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30(7), 1994, sec. 2",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { excess: values[0], speed: values[1] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        // 1 + a exp(−|s|/v_s)
        let decay = (site.slip_speed() * (-1.0 / self.speed)).exp();
        stress.scale(decay * self.excess + 1.0);
    }
}
