//! Project Chrono: mass properties and contact materials in the JSON of Chrono::Vehicle.

use crate::simulator::notes::{self, Expression, digits};
use crate::simulator::points::{contact_points, icrs, rollers};
use crate::simulator::{Aspect, Robot};
use crate::{Provenance, TextFile};
use std::fmt::Write;
use trackdyn_core::Side;

/// Restitution, Young's modulus (Pa) and Poisson's ratio of rubber on soil. They make contacts soft
/// enough for steps of 1 ms, and are no property of the vehicle.
const RESTITUTION: f64 = 0.1;
const YOUNG_MODULUS: f64 = 2e7;
const POISSON_RATIO: f64 = 0.3;

/// The chassis and the materials, `vehicle.chrono.json`.
pub fn model(robot: &Robot, provenance: &Provenance) -> TextFile {
    let list = |values: &[f64]| -> String {
        values.iter().map(|value| digits(*value)).collect::<Vec<_>>().join(", ")
    };
    let mut text = provenance.c_comment(&notes(robot));
    let _ = write!(
        text,
        "{{
  \"Name\": \"{name}\",
  \"Type\": \"Chassis\",
  \"Template\": \"RigidChassis\",
  \"Components\": [
    {{
      \"Centroidal Frame\": {{\"Location\": [{cog}], \"Orientation\": [1, 0, 0, 0]}},
      \"Mass\": {mass},
      \"Moments of Inertia\": [{inertia}],
      \"Products of Inertia\": [0, 0, 0],
      \"Void\": false
    }}
  ],
  \"Driver Position\": {{\"Location\": [0, 0, 0], \"Orientation\": [1, 0, 0, 0]}},
  \"Gravity\": [{gravity}],
  \"Tracks\": {{
    \"Gauge\": {gauge},
    \"Belt Width\": {width},
    \"Contact Ends\": [{ends}]
  }},
  \"Contact Materials\": {{
",
        name = robot.name,
        cog = list(&robot.cog),
        mass = digits(robot.mass),
        inertia = list(&robot.inertia),
        gravity = list(&robot.gravity),
        gauge = digits(robot.gauge),
        width = digits(robot.width),
        ends = robot
            .patches
            .iter()
            .map(|ends| format!("[{}]", list(ends)))
            .collect::<Vec<_>>()
            .join(", "),
    );
    for side in Side::BOTH {
        let comma = if side == Side::Left { "," } else { "" };
        let _ = writeln!(
            text,
            "    \"{}\": {{
      \"Coefficient of Friction\": {},
      \"Coefficient of Restitution\": {},
      \"Properties\": {{\"Young Modulus\": {}, \"Poisson Ratio\": {}}}
    }}{comma}",
            side.name(),
            digits(robot.friction[side].along),
            digits(RESTITUTION),
            digits(YOUNG_MODULUS),
            digits(POISSON_RATIO),
        );
    }
    text += "  }\n}\n";
    TextFile { name: "vehicle.chrono.json", text }
}

fn notes(robot: &Robot) -> String {
    let mut text = notes::wrapped(
        "A chassis file of Chrono::Vehicle, whose reader takes comments. Mass and centre of \
         gravity are those of the whole vehicle: take from them what suspensions and tracks weigh. \
         Gravity belongs to ChSystem. Each of the Contact Materials goes into the shoes of its \
         track: \"Contact\", \"Shoe Materials\"; NSC uses friction and restitution, SMC all of it. \
         The origin is on the ground, in the centre of the contact: x forward, y left. This file \
         was not run with Chrono.",
        "",
    );
    text += &isotropic(robot);
    text += "\nWhat Chrono cannot say:\n";
    let friction = robot.friction.left;
    let one = format!(
        "Contact materials have one coefficient of friction for all directions: that along the \
         track, {:.4}. Across it is {:.4} in the vehicle.",
        friction.along, friction.across
    );
    text += &notes::wrapped(&one, "- ");
    text += &notes::wrapped(
        "Restitution, Young's modulus and Poisson's ratio are those of rubber, not of the vehicle.",
        "- ",
    );
    text += &notes::assumed(robot);
    text + &notes::effects(robot, express)
}

/// How the vehicle turns with one coefficient of friction in all directions.
pub(crate) fn isotropic(robot: &Robot) -> String {
    let rollers = rollers(robot);
    let mut points = contact_points(robot, &rollers);
    for point in &mut points {
        point.friction.across = point.friction.along;
    }
    let turned = icrs(&points);
    turned.map_or_else(String::new, |icrs| {
        notes::turning(robot, &icrs, "friction alike in all directions, pressure linear")
    })
}

/// Which aspects Chrono has.
fn express(aspect: Aspect) -> Expression {
    use Expression::{By, Lacks};
    match aspect {
        Aspect::Body => By("Mass and Centroidal Frame"),
        Aspect::Friction => By("Coefficient of Friction of each side, along the track"),
        Aspect::Gravity => By("Gravity, for ChSystem::SetGravitationalAcceleration"),
        Aspect::BeltGain => Lacks("multiply the sprocket speeds"),
        Aspect::BeltGainVaries => Lacks("change the sprocket speeds by direction and time"),
        Aspect::BeltLag => Lacks("filter the sprocket speeds"),
        Aspect::BeltSlip => Lacks("lower the sprocket speeds by the traction"),
        Aspect::Mount => Lacks("put the sensor there"),
        Aspect::Delay => Lacks("read the sensor late (ChSensor::SetLag)"),
        Aspect::YawRateBias => Lacks("add it to the yaw rate that is read"),
        Aspect::CogHeight => By("Centroidal Frame"),
        Aspect::Inertia => By("a rigid body has it; friction is divided by the strength"),
        Aspect::FrictionAlong => Lacks("shoes move along the track, and so does their friction"),
        Aspect::Pressure => Lacks("suspensions and shoes share the load"),
        Aspect::Creep => Lacks("SMC: Tangential Stiffness and Damping of Coefficients come near"),
        Aspect::Constant => Lacks("no coefficient for it; a terrain of SCM has cohesion"),
        Aspect::ShearLaw => Lacks("rigid terrain has Coulomb friction; SCM has Janosi's law"),
        Aspect::Force => Lacks("ChBody::AccumulateForce of the chassis, at each step"),
        Aspect::Place => Lacks("RigidTerrain::FrictionFunctor, or a patch with its own material"),
        Aspect::Time => Lacks("friction does not change with time"),
    }
}
