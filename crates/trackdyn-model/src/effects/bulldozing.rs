//! Soil pushed aside by tracks that slip sideways.

use crate::contact::ShearStress;
use crate::effect::{Card, Effect, Parameter, Role, Stage};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Sine of the slip angle over which the wall of soil changes sides. With a jump, forces below its
/// size could not be balanced: a robot that speeds up straight ahead would not move at all.
const WALL_TURN_SINE: f64 = 0.01;

/// A resistance to lateral slip that depends on its sign only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bulldozing {
    coefficient: f64,
}

impl Effect for Bulldozing {
    const CARD: Card = Card {
        id: "bulldozing",
        title: "Soil pushed aside by a slipping track",
        law: "τ_x = −μ_b p s_x/√(s_x² + (0.01 |s|)²), beside friction",
        assumes: "The wall of soil grows with the local load and stands up at once, however fast \
                  it is pushed.",
        shows: "Like more friction across, but where the slip is mostly along the track it does \
                not fade: the ICRs move outwards. It belongs to the class of constants.",
        resembles: "",
        breaks: &[],
        stages: &[Stage::Shear],
        parameters: &[Parameter {
            key: "coefficient",
            symbol: "μ_b",
            unit: "1",
            meaning: "lateral resistance over normal pressure",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 1.0],
            typical: 0.1,
        }],
        sources: &[
            "Hegedus, A simplified method for the determination of bulldozing resistance, LLRL \
             report 61, 1960",
            "Steeds, Tracked vehicles, Automobile Engineer 40, 1950",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        // τ_x = −μ_b p s_x/√(s_x² + (ε |s|)²)
        let [across, _] = site.slip_direction();
        let side = across / (across * across + WALL_TURN_SINE * WALL_TURN_SINE).sqrt();
        stress.added[0] += site.normal_pressure() * side * -self.coefficient;
    }
}
