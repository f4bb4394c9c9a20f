//! Isaac Sim and other readers of USD: an articulation with rollers that drive.
//!
//! PhysX has no belt either, so a track is two rows of balls on springs, each with a drive.
//! Friction of a physics material is alike in all directions, so balls do, and need no axle.

use crate::chrono::isotropic;
use crate::simulator::notes::{self, Expression, digits};
use crate::simulator::points::rollers;
use crate::simulator::{Aspect, Robot, Roller};
use crate::{Provenance, TextFile};
use std::fmt::Write;
use trackdyn_core::{STANDARD_GRAVITY, Side, real};

/// Share of the mass in all balls and their carriers.
const BALL_SHARE: f64 = 0.02;

/// Radius of a ball over the length of the contact.
const RADIUS: f64 = 0.1;

/// Deflection of the springs at rest over the length of the contact.
const DEFLECTION: f64 = 0.003;

/// Speed that a drive loses where a track has full traction, m/s.
const DROOP: f64 = 1e-3;

/// A ball, its carrier on a spring, and the numbers of both.
struct Ball {
    name: String,
    side: Side,
    /// Centre, m.
    place: [f64; 3],
    radius: f64,
    /// Mass of the ball, and of its carrier, kg.
    mass: f64,
    /// N/m and N s/m.
    stiffness: f64,
    damping: f64,
    /// Deflection at rest, m.
    deflection: f64,
    /// N m s per rad.
    drive: f64,
}

/// Two balls for each roller.
fn balls(robot: &Robot) -> Vec<Ball> {
    let rollers = rollers(robot);
    let count = 2.0 * real(rollers.len());
    let [length, ..] = robot.hull();
    let (radius, deflection) = (RADIUS * length, DEFLECTION * length);
    let load = robot.mass * STANDARD_GRAVITY / count;
    let stiffness = load / deflection;
    let half = Roller::half_width(robot.width);
    let of_roller = |roller: &Roller| {
        let Roller { side, index, place: [x, y], preload, friction } = *roller;
        [("outer", side.sign() * -half), ("inner", side.sign() * half)].map(|(row, offset)| Ball {
            name: format!("{}_{row}_{index}", side.name()),
            side,
            place: [x, y + offset, radius],
            radius,
            mass: BALL_SHARE * robot.mass / count / 2.0,
            stiffness,
            damping: 2.0 * (stiffness * robot.mass / count).sqrt(),
            deflection: deflection * preload,
            // M = k_v r² ω, with k_v the traction over the lost speed
            drive: friction.along * load / DROOP * radius * radius,
        })
    };
    rollers.iter().flat_map(of_roller).collect()
}

/// The stage `vehicle.usda`.
pub fn stage(robot: &Robot, provenance: &Provenance) -> TextFile {
    let balls = balls(robot);
    let parts: Vec<_> = balls.iter().map(|ball| (ball.place, 2.0 * ball.mass)).collect();
    let (mass, cog, inertia) = robot.chassis(&parts);
    let gravity = robot.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let name = &robot.name;
    let mut text = String::from("#usda 1.0\n");
    text += &provenance.hash_comment(&notes(robot));
    let _ = write!(
        text,
        "(
    defaultPrim = \"{name}\"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = \"Z\"
)

def PhysicsScene \"physics\"
{{
    vector3f physics:gravityDirection = {direction}
    float physics:gravityMagnitude = {magnitude}
}}

def Plane \"ground\" (
    prepend apiSchemas = [\"PhysicsCollisionAPI\", \"MaterialBindingAPI\"]
)
{{
    uniform token axis = \"Z\"
    rel material:binding:physics = </ground/material>

{ground}}}

def Xform \"{name}\" (
    prepend apiSchemas = [\"PhysicsArticulationRootAPI\", \"PhysxArticulationAPI\"]
)
{{
    bool physxArticulation:enabledSelfCollisions = 0

",
        direction = tuple(&robot.gravity.map(|g| g / gravity)),
        magnitude = digits(gravity),
        ground = material("material", 1.0),
    );
    for side in Side::BOTH {
        text += &material(side.name(), robot.friction[side].along);
    }
    text += &rigid_body("base_link", "Xform", [0.0; 3], mass, cog, inertia, &hull(robot));
    for ball in &balls {
        text += &prims(name, ball);
    }
    text += "}\n";
    TextFile { name: "vehicle.usda", text }
}

/// A physics material. Friction of two materials is multiplied; the ground's is 1.
fn material(name: &str, friction: f64) -> String {
    let friction = digits(friction);
    format!(
        "    def Material \"{name}\" (
        prepend apiSchemas = [\"PhysicsMaterialAPI\", \"PhysxMaterialAPI\"]
    )
    {{
        float physics:dynamicFriction = {friction}
        float physics:restitution = 0
        float physics:staticFriction = {friction}
        uniform token physxMaterial:frictionCombineMode = \"multiply\"
    }}

"
    )
}

/// The hull, which is seen and does not collide.
fn hull(robot: &Robot) -> String {
    let [length, width, height] = robot.hull();
    let [rear, front] = robot.ends();
    let middle = [f64::midpoint(rear, front), 0.0, 2.0 * RADIUS * length + height / 2.0];
    format!(
        "
        def Cube \"hull\"
        {{
            double size = 1
            double3 xformOp:translate = {}
            float3 xformOp:scale = {}
            uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:scale\"]
        }}
",
        tuple(&middle),
        tuple(&[length, width - 2.0 * robot.width, height])
    )
}

/// A rigid body with its mass properties.
fn rigid_body(
    name: &str,
    kind: &str,
    place: [f64; 3],
    mass: f64,
    cog: [f64; 3],
    inertia: [f64; 3],
    rest: &str,
) -> String {
    let collides =
        if kind == "Xform" { "" } else { ", \"PhysicsCollisionAPI\", \"MaterialBindingAPI\"" };
    format!(
        "    def {kind} \"{name}\" (
        prepend apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"{collides}]
    )
    {{
        point3f physics:centerOfMass = {}
        float3 physics:diagonalInertia = {}
        quatf physics:principalAxes = (1, 0, 0, 0)
        float physics:mass = {}
        double3 xformOp:translate = {}
        uniform token[] xformOpOrder = [\"xformOp:translate\"]
{rest}    }}

",
        tuple(&cog),
        tuple(&inertia),
        digits(mass),
        tuple(&place)
    )
}

/// A carrier, a ball, and the joints of both.
fn prims(robot: &str, ball: &Ball) -> String {
    let Ball { name, side, place, radius, mass, stiffness, damping, deflection, drive } = ball;
    let moment = 0.4 * mass * radius * radius;
    let carrier = format!("{name}_carrier");
    let shape = format!(
        "        double radius = {}\n        rel material:binding:physics = </{robot}/{}>\n",
        digits(*radius),
        side.name()
    );
    let mut text = rigid_body(&carrier, "Xform", *place, *mass, [0.0; 3], [moment; 3], "");
    text += &rigid_body(name, "Sphere", *place, *mass, [0.0; 3], [moment; 3], &shape);
    let _ = write!(
        text,
        "    def PhysicsPrismaticJoint \"{name}_spring\" (
        prepend apiSchemas = [\"PhysicsDriveAPI:linear\"]
    )
    {{
        uniform token physics:axis = \"Z\"
        rel physics:body0 = </{robot}/base_link>
        rel physics:body1 = </{robot}/{carrier}>
        point3f physics:localPos0 = {place}
        point3f physics:localPos1 = (0, 0, 0)
        float drive:linear:physics:damping = {damping}
        float drive:linear:physics:stiffness = {stiffness}
        float drive:linear:physics:targetPosition = {rest}
    }}

    def PhysicsRevoluteJoint \"{name}_drive\" (
        prepend apiSchemas = [\"PhysicsDriveAPI:angular\"]
    )
    {{
        uniform token physics:axis = \"Y\"
        rel physics:body0 = </{robot}/{carrier}>
        rel physics:body1 = </{robot}/{name}>
        point3f physics:localPos0 = (0, 0, 0)
        point3f physics:localPos1 = (0, 0, 0)
        float drive:angular:physics:damping = {drive}
        float drive:angular:physics:stiffness = 0
        float drive:angular:physics:targetVelocity = 0
    }}

",
        place = tuple(place),
        damping = digits(*damping),
        stiffness = digits(*stiffness),
        rest = digits(-deflection),
        // Angular drives of USD are per degree.
        drive = digits(drive.to_radians()),
    );
    text
}

/// Numbers in brackets.
fn tuple(values: &[f64; 3]) -> String {
    format!("({})", values.map(digits).join(", "))
}

fn notes(robot: &Robot) -> String {
    let [length, ..] = robot.hull();
    let mut text = notes::wrapped(
        &format!(
            "Set drive:angular:physics:targetVelocity of all left_*_drive and right_*_drive to \
             V/r of the side, deg/s, with the belt speed V and r = {} m. The origin is on the \
             ground, in the centre of the contact: x forward, y left. This file was not run with \
             Isaac Sim.",
            digits(RADIUS * length)
        ),
        "",
    );
    text += &isotropic(robot);
    text += "\nWhat USD and PhysX cannot say:\n";
    let friction = robot.friction.left;
    let one = format!(
        "A physics material has one coefficient of friction for all directions: that along the \
         track, {:.4}. Across it is {:.4} in the vehicle.",
        friction.along, friction.across
    );
    for limit in [
        one.as_str(),
        "A contact has no belt speed: a track is two rows of balls on springs. Balls reach into \
         each other, so the articulation does not collide with itself.",
        "PhysxMaterialAPI belongs to PhysX; other readers of USD may average friction with that of \
         the ground, which is 1 here.",
        "The hull does not collide, because its ground clearance is not known.",
    ] {
        text += &notes::wrapped(limit, "- ");
    }
    text += &notes::assumed(robot);
    text + &notes::effects(robot, express)
}

/// Which aspects USD with PhysX has.
fn express(aspect: Aspect) -> Expression {
    use Expression::{By, Lacks};
    match aspect {
        Aspect::Body => By("mass and centre of mass of base_link"),
        Aspect::Friction => By("friction of the material of each side, along the track"),
        Aspect::Gravity => By("direction of gravity of the scene"),
        Aspect::BeltGain => Lacks("multiply the target velocities"),
        Aspect::BeltGainVaries => Lacks("change the target velocities by direction and time"),
        Aspect::BeltLag => Lacks("filter the target velocities"),
        Aspect::BeltSlip => Lacks("lower the target velocities by the traction"),
        Aspect::Mount => Lacks("put the sensor there"),
        Aspect::Delay => Lacks("read the sensor late"),
        Aspect::YawRateBias => Lacks("add it to the yaw rate that is read"),
        Aspect::CogHeight => By("centre of mass of base_link"),
        Aspect::Inertia => By("a rigid body has it; friction is divided by the strength"),
        Aspect::FrictionAlong => Lacks("bind a material of its own to each ball"),
        Aspect::Pressure => By("target positions of the springs"),
        Aspect::Creep => Lacks("PhysX has dry friction"),
        Aspect::Constant => Lacks("one coefficient of friction cannot turn as the vehicle does"),
        Aspect::ShearLaw => Lacks("Coulomb friction is all there is"),
        Aspect::Force => Lacks("apply a force to base_link at each step"),
        Aspect::Place => Lacks("put ground with another material there"),
        Aspect::Time => Lacks("set the friction of the materials while it runs"),
    }
}
