//! All mechanisms: one file each, one line per file.

#[macro_use]
mod registry;
mod active;

pub use active::ActiveMechanism;

use crate::form::{Draws, Form};
use crate::mechanism::{Described, Mechanism};
use crate::sheet::Sheet;

/// The sheet of the mechanism with an id.
pub fn sheet_of(id: &str) -> Option<&'static Sheet> {
    MECHANISMS.iter().find(|sheet| sheet.id == id)
}

mechanisms! {
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
    brushed_ground::BrushedGround,
    spring_cable::SpringCable,
    steering_grip::SteeringGrip,
    washboard::Washboard,
    splayed_belts::SplayedBelts,
    twisted_frame::TwistedFrame,
    stiff_hull::StiffHull,
    side_wind::SideWind,
    warm_rubber::WarmRubber,
    drive_backlash::DriveBacklash,
    stray_force::StrayForce,
    slow_clutch::SlowClutch,
    eccentric_sprocket::EccentricSprocket,
    soft_frames::SoftFrames,
    soil_pile::SoilPile,
}
