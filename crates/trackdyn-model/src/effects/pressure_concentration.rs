//! Normal pressure that is not linear along a patch.

use crate::contact::{Friction, ShearStress};
use crate::effect::{Card, Effect, Parameter, Role, Stage};
use crate::pipeline::{RigidBody, Site};
use trackdyn_core::Scalar;

/// More pressure at the ends of a patch than in its middle, or vice versa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureConcentration {
    concentration: f64,
}

impl Effect for PressureConcentration {
    const CARD: Card = Card {
        id: "pressure-concentration",
        title: "Pressure concentrated at the ends of a patch, or under rollers",
        law: "p ← p + κ p̄ (3 η² − 1)/2, η = ±1 at the ends of the patch, p̄ its mean pressure",
        assumes: "The second Legendre polynomial changes neither the load of a patch nor its \
                  centre of pressure. κ > 0 stands for rollers at the ends of a stiff track, κ < \
                  0 for a belly or a soft tyre. Road wheels that carry alike are κ = 5/2 (12 \
                  r²/l² − 1) to first order, with r² the mean of their y² about the middle; axles \
                  in the vehicle file are exact.",
        shows: "Ends count for more: the ICRs move outwards. It belongs to the class of constants.",
        resembles: "",
        breaks: &[],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "concentration",
            symbol: "κ",
            unit: "1",
            meaning: "excess of the pressure at the ends over the mean",
            role: Role::Size { neutral: 0.0 },
            range: [-0.9, 1.9],
            typical: 0.4,
        }],
        sources: &[
            "Wong, Garber, Preston-Thomas, Proc. IMechE D 198, 1984",
            "Wong, Theory of Ground Vehicles, ch. 2",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { concentration: values[0] }
    }

    fn rigid_body(&self, body: &mut RigidBody) {
        body.pressure_concentration += self.concentration;
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let [_, middle] = site.patch.centre();
        let mean = site.pressure.at(middle);
        let eta = (site.slip.position[1] - middle) * (site.patch.length().recip() * 2.0);
        // p ← p + κ p̄ (3 η² − 1)/2
        let pressure = mean * (eta * eta * 1.5 - 0.5) * self.concentration;
        let Friction { across, along } = site.friction();
        let direction = site.slip_direction();
        let added = stress.added.iter_mut();
        for ((added, component), mu) in added.zip(direction).zip([across, along]) {
            // τ_added = −[μ] Δp s/|s|
            *added += component * pressure * -mu;
        }
    }
}
