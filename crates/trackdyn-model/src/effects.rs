//! The catalogue: one file per effect, one line per file.

#[macro_use]
mod dispatch;
mod active;
mod error;
mod id;
mod nature;

pub use active::{ActiveEffect, Effects};
pub use error::EffectError;
pub use id::EffectId;

use crate::contact::ShearStress;
use crate::custom::ActiveLaw;
use crate::effect::{Card, Effect, Nature, Term};
use crate::pipeline::{Drive, Ground, RigidBody, Sensor, Site, Situation};
use crate::vehicle::Vehicle;
use trackdyn_core::{PerSide, Scalar, Wrench};

catalogue! {
    friction_anisotropy::FrictionAnisotropy,
    friction_cone::FrictionCone,
    cog_shift::CogShift,
    friction_split::FrictionSplit,
    friction_gradient::FrictionGradient,
    pressure_concentration::PressureConcentration,
    cohesion::Cohesion,
    bulldozing::Bulldozing,
    sensor_lever_arm::SensorLeverArm,
    encoder_scale::EncoderScale,
    sensor_yaw::SensorYaw,
    time_offset::TimeOffset,
    drivetrain_lag::DrivetrainLag,
    yaw_inertia::YawInertia,
    heading_drift::HeadingDrift,
    centripetal::Centripetal,
    load_transfer::LoadTransfer,
    viscous_friction::ViscousFriction,
    stribeck_friction::StribeckFriction,
    friction_creep::FrictionCreep,
    motion_resistance::MotionResistance,
    resistance_split::ResistanceSplit,
    hitch_drag::HitchDrag,
    belt_slip::BeltSlip,
    shear_displacement::ShearDisplacement,
    directional_lugs::DirectionalLugs,
    slope::Slope,
    tether::Tether,
    terrain_patch::TerrainPatch,
    friction_drift::FrictionDrift,
    backward_gain::BackwardGain,
    late_gain::LateGain,
    split_lag::SplitLag,
    ground_change::GroundChange,
    force_law::ForceLaw,
}
