//! A passive load dragged behind the robot.

use crate::effect::{Card, Effect, Parameter, Role, Stage, Symmetry};
use crate::pipeline::Situation;
use trackdyn_core::{PerSide, STANDARD_GRAVITY, Scalar, Wrench};

/// A friction force against the motion of a point behind the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitchDrag {
    drag: f64,
    distance: f64,
}

/// Speed over which the drag changes its direction, m/s: far below driving speeds. At rest it has
/// no direction.
const REST_SPEED: f64 = 1e-7;

impl Effect for HitchDrag {
    const CARD: Card = Card {
        id: "hitch-drag",
        title: "Passive drag behind the robot",
        law: "F = −d m g v_h/|v_h| at (0, −r)",
        assumes: "Dry friction of what is dragged, at a point fixed to the hull; a point at rest \
                  is held by up to d m g, as it creeps at less than 1 µm/s.",
        shows: "The drag turns with the motion of the hitch: counter-rotation sees it across, arcs \
                along the tracks. Close to motion resistance.",
        resembles: "Running gear that grips more where it is steered, and soil that piles up.",
        breaks: &[Symmetry::Manoeuvre],
        stages: &[Stage::Wrench],
        parameters: &[
            Parameter {
                key: "drag",
                symbol: "d",
                unit: "1",
                meaning: "drag over the robot's weight",
                role: Role::Size { neutral: 0.0 },
                range: [0.0, 0.5],
                typical: 0.05,
            },
            Parameter {
                key: "distance_m",
                symbol: "r",
                unit: "m",
                meaning: "distance of the hitch behind the origin",
                role: Role::Shape,
                range: [0.0, 5.0],
                typical: 0.8,
            },
        ],
        sources: &["Coulomb friction of a body that is dragged at a point"],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { drag: values[0], distance: values[1] }
    }

    fn wrench<S: Scalar>(
        &self,
        situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        wrench: &mut Wrench<S>,
    ) {
        let hitch = [0.0, -self.distance];
        let [v_x, v_y] = situation.motion.twist.velocity_at(hitch);
        let speed = (v_x * v_x + v_y * v_y + REST_SPEED * REST_SPEED).sqrt();
        // F = −d m g v_h/|v_h|
        let drag = self.drag * situation.vehicle.mass * STANDARD_GRAVITY;
        wrench.add_force([v_x, v_y].map(|v| v * -drag / speed), hitch);
    }
}
