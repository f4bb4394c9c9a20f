//! In which ways an effect can stand in a simulator of rigid bodies.

use super::breaks_any;
use trackdyn_model::effect::{Stage, Symmetry};
use trackdyn_model::{
    ActiveEffect, Circumstance, Drive, Effects, Model, RigidBody, Sensor, Vehicle,
};

/// A property of a robot or its ground that an effect changes, and that a simulator has or has not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// Mass or centre of gravity.
    Body,
    /// Friction coefficients of a side.
    Friction,
    /// Direction of gravity.
    Gravity,
    /// Ratio of belt speed to encoder speed.
    BeltGain,
    /// Belt gains that depend on direction or time.
    BeltGainVaries,
    /// Time constant of the belts.
    BeltLag,
    /// Speed that belts lose under traction.
    BeltSlip,
    /// Place or heading of the pose sensor.
    Mount,
    /// Delay of the pose sensor.
    Delay,
    /// Yaw rate that the pose sensor reports at rest.
    YawRateBias,
    /// Height of the centre of gravity.
    CogHeight,
    /// Inertia of the body.
    Inertia,
    /// Friction that changes along the contact.
    FrictionAlong,
    /// Pressure that is not linear along a patch.
    Pressure,
    /// Slip in proportion to the force before friction is full.
    Creep,
    /// A law of shear stress that moves the constant ICRs, and nothing else.
    Constant,
    /// Another law of shear stress.
    ShearLaw,
    /// A force on the body.
    Force,
    /// Ground that differs from place to place.
    Place,
    /// Ground that changes with time.
    Time,
}

impl Aspect {
    /// The aspects of an effect of this vehicle: what it changes of a base model, and what its card
    /// says of the rest.
    pub fn of(effect: &ActiveEffect, vehicle: &Vehicle) -> Vec<Self> {
        let base = Model::new(vehicle.clone(), Effects::none());
        let model = Model::new(vehicle.clone(), [effect.clone()].into_iter().collect());
        let here = Circumstance::default();
        let (level, ground) = (base.ground(&here), model.ground(&here));
        let (direct, drive) = (Drive::direct(), *model.drive());
        let (at_origin, sensor) = (Sensor::default(), *model.sensor());
        let (none, body) = (RigidBody::default(), model.rigid_body());

        let acts_at = |stage| effect.card().stages.contains(&stage);
        let breaks = |symmetry| breaks_any(effect, &[symmetry]);
        let is_ground_varied = breaks(Symmetry::Place) || breaks(Symmetry::Time);
        let is_inertia = (body.steady_inertia, body.transient_inertia)
            != (none.steady_inertia, none.transient_inertia);
        let is_gravity = (ground.gravity_along, ground.gravity_normal)
            != (level.gravity_along, level.gravity_normal);
        let is_friction_along = body.friction_gradient != none.friction_gradient;
        let is_pressure = body.pressure_concentration != none.pressure_concentration;
        let is_creep = body.creep_speed != none.creep_speed;
        let is_other_shear =
            acts_at(Stage::Shear) && !(is_friction_along || is_pressure || is_creep);
        let is_constant = effect.card().breaks.is_empty();
        [
            (Self::Body, model.vehicle() != base.vehicle()),
            (Self::Friction, ground.friction != level.friction && !is_ground_varied),
            (Self::Gravity, is_gravity),
            (Self::BeltGain, drive.gain != direct.gain),
            (Self::BeltGainVaries, !drive.has_one_gain()),
            (Self::BeltLag, drive.time_constant != direct.time_constant),
            (Self::BeltSlip, drive.slip_per_traction != direct.slip_per_traction),
            (Self::Mount, (sensor.lever, sensor.yaw) != (at_origin.lever, at_origin.yaw)),
            (Self::Delay, sensor.delay != at_origin.delay),
            (Self::YawRateBias, sensor.yaw_rate_bias != at_origin.yaw_rate_bias),
            (Self::CogHeight, body.cog_height != none.cog_height),
            (Self::Inertia, is_inertia),
            (Self::FrictionAlong, is_friction_along),
            (Self::Pressure, is_pressure),
            (Self::Creep, is_creep),
            (Self::Constant, is_other_shear && is_constant),
            (Self::ShearLaw, is_other_shear && !is_constant),
            (Self::Force, acts_at(Stage::Wrench) && !is_inertia),
            (Self::Place, acts_at(Stage::Ground) && breaks(Symmetry::Place)),
            (Self::Time, acts_at(Stage::Ground) && breaks(Symmetry::Time)),
        ]
        .into_iter()
        .filter_map(|(aspect, is_there)| is_there.then_some(aspect))
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Aspect;
    use trackdyn_model::{ActiveEffect, CATALOGUE, VehicleFile};

    fn aspects(text: &str) -> Vec<Aspect> {
        let effect: ActiveEffect = text.parse().expect("an effect");
        Aspect::of(&effect, &VehicleFile::auriga_alpha().vehicle)
    }

    /// An effect without one would be missing from both lists of a file.
    #[test]
    fn every_effect_of_the_catalogue_has_an_aspect() {
        for card in CATALOGUE {
            let typical: Vec<String> =
                card.parameters.iter().map(|one| format!("{}={}", one.key, one.typical)).collect();
            let found = aspects(&format!("{}:{}", card.id, typical.join(",")));
            assert!(!found.is_empty(), "{}", card.id);
        }
    }

    #[test]
    fn aspects_are_what_an_effect_changes() {
        for (text, expected) in [
            ("cog-shift", vec![Aspect::Body]),
            ("friction-split", vec![Aspect::Friction]),
            ("slope", vec![Aspect::Gravity]),
            ("encoder-scale", vec![Aspect::BeltGain]),
            ("yaw-inertia", vec![Aspect::Inertia]),
            ("friction-gradient", vec![Aspect::FrictionAlong]),
            ("cohesion", vec![Aspect::Constant]),
            ("viscous-friction", vec![Aspect::ShearLaw]),
            ("tether", vec![Aspect::Force]),
            ("terrain-patch:x_m=0,y_m=0", vec![Aspect::Place]),
            ("friction-drift", vec![Aspect::Time]),
        ] {
            assert_eq!(aspects(text), expected, "{text}");
        }
    }
}
