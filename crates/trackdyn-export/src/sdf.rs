//! Gazebo's gz-sim: SDF of a model with tracks that drive.

use crate::simulator::notes::{self, Expression, digits, row};
use crate::simulator::{Aspect, Robot};
use crate::{Name, Provenance, TextFile, gz};
use std::fmt::Write;
use trackdyn_core::{STANDARD_GRAVITY, Side};
use trackdyn_model::contact::Friction;

/// Share of the mass in the link of each track.
const TRACK_SHARE: f64 = 0.01;

/// Height of a track over the length of the contact.
const TRACK_HEIGHT: f64 = 0.2;

/// Contacts of a box on a plane: its corners.
const CORNERS: f64 = 4.0;

/// The model `vehicle.sdf`.
///
/// # Panics
/// Never: the names of the tracks are names.
pub fn model(robot: &Robot, provenance: &Provenance) -> TextFile {
    let [length, ..] = robot.hull();
    let height = TRACK_HEIGHT * length;
    let mass = TRACK_SHARE * robot.mass;
    let [rear, front] = robot.ends();
    let middle = f64::midpoint(rear, front);
    let place = |side: Side| [middle, -side.sign() * robot.gauge / 2.0, height / 2.0];
    let parts = Side::BOTH.map(|side| (place(side), mass));
    let (chassis, cog, inertia) = robot.chassis(&parts);
    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    text += &provenance.xml_comment(&notes(robot));
    let [hull_length, hull_width, hull_height] = robot.hull();
    let _ = write!(
        text,
        "<sdf version=\"1.9\">
  <model name=\"{name}\">
    <link name=\"base_link\">
{inertial}      <visual name=\"hull\">
        <pose>{hull} 0 0 0</pose>
        <geometry><box><size>{sizes}</size></box></geometry>
      </visual>
    </link>
",
        name = robot.name,
        inertial = inertial(&cog, chassis, &inertia),
        hull = row(&[middle, 0.0, height + hull_height / 2.0]),
        sizes = row(&[hull_length, hull_width - 2.0 * robot.width, hull_height]),
    );
    for side in Side::BOTH {
        text += &track(robot, side, &place(side), [length, robot.width, height], mass);
    }
    for side in Side::BOTH {
        let _ = writeln!(
            text,
            "    <plugin filename=\"gz-sim-track-controller-system\" \
             name=\"gz::sim::systems::TrackController\">\n      \
             <link>{}_track</link>\n    </plugin>",
            side.name()
        );
    }
    let link = |side: Side| -> Name { format!("{}_track", side.name()).parse().expect("a name") };
    text += &gz::element(&robot.drive(), &[link(Side::Left)], &[link(Side::Right)], "    ");
    text += "  </model>\n</sdf>\n";
    TextFile { name: "vehicle.sdf", text }
}

/// Mass properties of a link.
fn inertial(cog: &[f64; 3], mass: f64, [xx, yy, zz]: &[f64; 3]) -> String {
    let (mass, [xx, yy, zz]) = (digits(mass), [xx, yy, zz].map(|moment| digits(*moment)));
    format!(
        "      <inertial>
        <pose>{cog} 0 0 0</pose>
        <mass>{mass}</mass>
        <inertia><ixx>{xx}</ixx><ixy>0</ixy><ixz>0</ixz><iyy>{yy}</iyy><iyz>0</iyz>\
         <izz>{zz}</izz></inertia>
      </inertial>
",
        cog = row(cog)
    )
}

/// The link of a track, with a box under each patch, and the joint that holds it.
fn track(robot: &Robot, side: Side, place: &[f64; 3], size: [f64; 3], mass: f64) -> String {
    let name = format!("{}_track", side.name());
    let [_, width, height] = size;
    // I = m (a² + b²)/12 of a box
    let square = size.map(|edge| edge * edge / 12.0);
    let moments = [square[1] + square[2], square[0] + square[2], square[0] + square[1]];
    let mut text = format!(
        "    <link name=\"{name}\">\n      <pose>{} 0 0 0</pose>\n{}",
        row(place),
        inertial(&[0.0; 3], mass, &moments.map(|moment| mass * moment))
    );
    let Friction { across, along } = robot.friction[side];
    let count = robot.patches.len();
    for (k, [start, end]) in robot.patches.iter().enumerate() {
        let at = row(&[f64::midpoint(*start, *end) - place[0], 0.0, 0.0]);
        let geometry = format!(
            "<geometry><box><size>{}</size></box></geometry>",
            row(&[end - start, width, height])
        );
        let _ = write!(
            text,
            "      <collision name=\"{name}_{k}\">
        <pose>{at} 0 0 0</pose>
        {geometry}
        <surface>
          <friction>
            <ode>
              <mu>{mu}</mu>
              <mu2>{mu2}</mu2>
              <fdir1>1 0 0</fdir1>
{slip}            </ode>
          </friction>
        </surface>
      </collision>
      <visual name=\"{name}_{k}\">
        <pose>{at} 0 0 0</pose>
        {geometry}
      </visual>
",
            mu = digits(along),
            mu2 = digits(across),
            slip = slip(robot, [along, across], count),
        );
    }
    let _ = writeln!(
        text,
        "    </link>\n    <joint name=\"{name}_joint\" type=\"fixed\">\n      \
         <parent>base_link</parent>\n      <child>{name}</child>\n    </joint>"
    );
    text
}

/// Slip compliance along and across the track, m/s per N at a contact.
///
/// # Law
/// F = μ N |s|/v_c at small slip, so s/F = v_c/(μ N).
fn slip(robot: &Robot, friction: [f64; 2], count: usize) -> String {
    let speed = robot.body.creep_speed;
    if speed == 0.0 {
        return String::new();
    }
    let contacts = CORNERS * 2.0 * trackdyn_core::real(count);
    let load = robot.mass * STANDARD_GRAVITY / contacts;
    let [slip1, slip2] = friction.map(|mu| digits(speed / (mu * load)));
    format!("              <slip1>{slip1}</slip1>\n              <slip2>{slip2}</slip2>\n")
}

fn notes(robot: &Robot) -> String {
    let mut text = notes::wrapped(
        "Commands: gz topic /model/NAME/cmd_vel. The origin of the model is on the ground, in the \
         centre of the contact. This file was not run with gz-sim: what is said of it here was \
         read in TrackController.cc (gz-sim, commit 01d9d94).",
        "",
    );
    let drive = robot.drive();
    let [x, y] = drive.point;
    let [length, ..] = robot.hull();
    let half = length / 2.0;
    let distance = |side: f64| half.hypot(f64::midpoint(robot.gauge, side * robot.width));
    let [outer, inner] = [distance(1.0), distance(-1.0)].map(|r| robot.gauge / (2.0 * r));
    let spin = format!(
        "How it turns: TrackController lays the first friction direction along the circle about \
         the commanded centre of rotation, and moves the contact along it by the belt speed. So \
         mu2, fdir1 and the friction law do not decide the turn; a spin has yaw rate V/r of \
         contacts at a distance r from the centre. Corners of these boxes give chi {outer:.3} \
         to {inner:.3}; the vehicle has {:.3}.",
        robot.steering_efficiency()
    );
    let centre = format!(
        "Eccentricity: TrackedVehicle commands the point midway between the ICRs, {x:.4} m \
         forward and {y:.4} m left of the origin. steering_efficiency counts in its commands, not \
         in its odometry."
    );
    text += "\nWhat gz-sim cannot say:\n";
    for limit in [
        spin.as_str(),
        centre.as_str(),
        "Pressure: a box on a plane stands on its corners, and the solver shares the load.",
        "Friction is bounded along and across on its own (a pyramid), not on an ellipse.",
        "The hull has no collision, because its ground clearance is not known.",
    ] {
        text += &notes::wrapped(limit, "- ");
    }
    let level = [0.0, 0.0, -STANDARD_GRAVITY];
    if robot.gravity != level {
        let line = format!(
            "Gravity belongs to the world: write <gravity>{}</gravity> there.",
            row(&robot.gravity)
        );
        text += &notes::wrapped(&line, "- ");
    }
    text += &notes::assumed(robot);
    text + &notes::effects(robot, express)
}

/// Which aspects gz-sim has.
fn express(aspect: Aspect) -> Expression {
    use Expression::{By, Lacks};
    match aspect {
        Aspect::Body => By("mass and centre of gravity of base_link"),
        Aspect::Friction => By("mu along and mu2 across, of each track"),
        Aspect::Gravity => Lacks("write the world's gravity, as above"),
        Aspect::BeltGain => Lacks("multiply the commands of the tracks"),
        Aspect::BeltGainVaries => Lacks("change the commands of the tracks by direction and time"),
        Aspect::BeltLag => Lacks("filter the commands of the tracks"),
        Aspect::BeltSlip => Lacks("a system of your own has to lower the tracks' speeds"),
        Aspect::Mount => Lacks("put the sensor there"),
        Aspect::Delay => Lacks("delay the sensor's messages"),
        Aspect::YawRateBias => Lacks("add it to the noise of the sensor, as a bias"),
        Aspect::CogHeight => By("height of the centre of gravity of base_link"),
        Aspect::Inertia => By("a rigid body has it; friction is divided by the strength"),
        Aspect::FrictionAlong => Lacks("one friction for a collision: cut the boxes in pieces"),
        Aspect::Pressure => Lacks("the solver shares the load"),
        Aspect::Creep => By("slip1 and slip2, the slope of friction at small slip"),
        Aspect::Constant => By("steering_efficiency of the commands, not as a force"),
        Aspect::ShearLaw => Lacks("Coulomb friction is all there is"),
        Aspect::Force => Lacks("the system ApplyLinkWrench or one of your own"),
        Aspect::Place => Lacks("put another ground plane there, with its own friction"),
        Aspect::Time => Lacks("friction does not change with time"),
    }
}
