//! Motion resistance of the ground.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Situation;
use trackdyn_core::{PerSide, Scalar, Side, Wrench};

/// Resistance of the ground to each track, proportional to its load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionResistance {
    coefficient: f64,
}

/// Adds the resistance of one track: a force against its motion, on its centre-line.
pub(super) fn add_resistance<S: Scalar>(
    coefficient: f64,
    side: Side,
    situation: &Situation<S>,
    normal_load: &PerSide<S>,
    wrench: &mut Wrench<S>,
) {
    let belt_speed = situation.motion.belt_speed[side].value();
    if belt_speed == 0.0 {
        return; // a locked track is dragged by friction alone
    }
    // R = −c_rr N sign(V)
    let resistance = normal_load[side] * (-coefficient * belt_speed.signum());
    let x = side.sign() * situation.vehicle.gauge / 2.0;
    wrench.add_force([S::from(0.0), resistance], [x, 0.0]);
}

impl Effect for MotionResistance {
    const CARD: Card = Card {
        id: "motion-resistance",
        title: "Motion resistance of the ground",
        law: "R = −c_rr N sign(V) along each track",
        assumes: "Compaction and rolling of the track over the ground; losses inside the running \
                  gear do not count, for belt speeds are measured. A belt that stands still has \
                  none.",
        shows: "The map is constant in each sector of the signs of V_l, V_r and |V_r| − |V_l|, and \
                jumps between sectors.",
        resembles: "Friction of bearings, rollers and belts.",
        breaks: &[Symmetry::Manoeuvre],
        stages: &[Stage::Wrench],
        parameters: &[Parameter {
            key: "coefficient",
            symbol: "c_rr",
            unit: "1",
            meaning: "resistance over normal load",
            role: Role::Size { neutral: 0.0 },
            range: [0.0, 0.5],
            typical: 0.05,
        }],
        sources: &[
            "Martinez et al., IJRR 24(10), 2005, sec. 4.1",
            "Wong, Theory of Ground Vehicles, ch. 6",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { coefficient: values[0] }
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        for side in Side::BOTH {
            add_resistance(self.coefficient, side, situation, normal_load, wrench);
        }
    }
}
