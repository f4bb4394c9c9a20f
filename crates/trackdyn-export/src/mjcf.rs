//! MuJoCo: MJCF with rollers that drive.
//!
//! MuJoCo has no belt: a contact has no velocity of its own. A track is a row of rollers here, each
//! with a velocity actuator. A roller stands on a spring, so that the pressure is that of a rigid
//! hull on equal springs, and rolls freely about the line on the ground along the track, so that
//! the pressure is even across.
//!
//! Rollers are capsules: of the shapes that roll on a plane, MuJoCo lays the friction directions of
//! a capsule's contacts along its axis, which is the axle. The first is then across the track.
//!
//! Numbers of the solver follow from the size of the robot. `docs/theory/export.md` has the figures
//! behind them.

use crate::simulator::notes::{self, Expression, digits, row};
use crate::simulator::points::{contact_points, icrs, matched, rollers};
use crate::simulator::{Aspect, Robot, Roller};
use crate::{Provenance, TextFile};
use std::fmt::Write;
use trackdyn_core::{STANDARD_GRAVITY, real};
use trackdyn_model::contact::Friction;

/// Share of the mass in all rollers. Light rollers stay on the ground: a contact that slips at v
/// pushes itself off with μ b v, which must stay below its load over the mass of the roller.
const ROLLER_SHARE: f64 = 0.01;

/// Radius of a roller over the length of the contact.
const RADIUS: f64 = 0.15;

/// Penetration of a roller at rest over its radius, by which its belt is too slow.
const PENETRATION: f64 = 0.002;

/// Deflection of the springs at rest over the length of the contact.
const DEFLECTION: f64 = 0.003;

/// Impedance of a contact. From 0.2 to 0.4 is steady.
const IMPEDANCE: f64 = 0.3;

/// Damping of a contact, 1/s.
const DAMPING: f64 = 100.0;

/// Largest ratio of the impedances of friction and normal force: it keeps the creep of dry friction
/// small.
const IMPEDANCE_RATIO: f64 = 10_000.0;

/// Product of the time step and the natural frequency of a contact.
const STEP: f64 = 0.85;

/// Inertia that a contact sees, over that of the roller at its middle. Measured with MuJoCo 4.0.
const CONTACT_INERTIA: f64 = 1.67;

/// Slip over that at which a contact pushes itself off, from which on rollers lift: loads swing by
/// some times their mean. Auriga-alpha, spinning at 1.5 m/s, is there.
const SHARE_OF_LIFTING: f64 = 1.0 / 16.0;

/// Speed that an actuator loses where a track has full traction, m/s.
const DROOP: f64 = 1e-4;

/// Steps in which a roller follows its actuator. Contacts are solved for rollers without actuators:
/// a light roller would seem to run away from the force that only just accelerates it, and would
/// drag the hull along at full friction. A rotor (armature) makes it as slow as its actuator.
const ROTOR_LAG_STEPS: f64 = 5.0;

/// The numbers of a roller and its contact.
struct Suspension {
    mass: f64,
    radius: f64,
    /// N/m, N s/m, and the deflection at rest, m.
    stiffness: f64,
    damping: f64,
    deflection: f64,
    /// N m s.
    roll_damping: f64,
    /// 1/s².
    contact_stiffness: f64,
    timestep: f64,
}

impl Suspension {
    fn of(robot: &Robot, count: usize) -> Self {
        let (weight, count) = (robot.mass * STANDARD_GRAVITY, real(count));
        let [length, ..] = robot.hull();
        let (radius, deflection) = (RADIUS * length, DEFLECTION * length);
        let mass = ROLLER_SHARE * robot.mass / count;
        let stiffness = weight / count / deflection;
        let softness = (1.0 - IMPEDANCE) / IMPEDANCE;
        // Half the load of a roller over the mass that the contact sees, m/s²
        let push = weight / count / 2.0 / mass * CONTACT_INERTIA * softness;
        let contact_stiffness = push / (PENETRATION * radius);
        let half = Roller::half_width(robot.width);
        let rolling = 2.0 * weight / count / 2.0 / (PENETRATION * radius) * half * half;
        Self {
            mass,
            radius,
            stiffness,
            // Critical for the hull on its springs, and for a roller that rolls on two contacts.
            damping: 2.0 * (stiffness * robot.mass / count).sqrt(),
            deflection,
            roll_damping: 2.0 * (rolling * mass * radius * radius).sqrt(),
            contact_stiffness,
            timestep: STEP / (IMPEDANCE * contact_stiffness).sqrt(),
        }
    }
}

/// The model `vehicle.mjcf.xml`.
pub fn model(robot: &Robot, provenance: &Provenance) -> TextFile {
    let mut rollers = rollers(robot);
    let matching = matched(robot, &rollers);
    let factor = matching.map_or(1.0, |(factor, _)| factor);
    for roller in &mut rollers {
        roller.friction.across *= factor;
    }
    let suspension = Suspension::of(robot, rollers.len());
    let Suspension { mass, radius, timestep, .. } = suspension;
    let parts: Vec<_> =
        rollers.iter().map(|one| ([one.place[0], one.place[1], radius], mass)).collect();
    let (chassis, [x, y, z], inertia) = robot.chassis(&parts);
    let [length, width, height] = robot.hull().map(|side| side / 2.0);
    let [rear, front] = robot.ends();
    let [lever_x, lever_y] = trackdyn_core::frames::ros_from_paper(robot.model.sensor().lever);

    let mut text = String::from("<?xml version=\"1.0\"?>\n");
    text += &provenance.xml_comment(&notes(robot, &rollers, factor, matching.is_none()));
    let _ = write!(
        text,
        "<mujoco model=\"{name}\">
  <compiler angle=\"radian\"/>
  <option timestep=\"{timestep}\" integrator=\"implicitfast\" cone=\"elliptic\" \
         impratio=\"{ratio}\" gravity=\"{gravity}\"/>
  <worldbody>
    <geom name=\"ground\" type=\"plane\" size=\"100 100 1\" contype=\"0\" conaffinity=\"0\"/>
    <body name=\"base_link\">
      <freejoint name=\"base_link\"/>
      <inertial pos=\"{cog}\" mass=\"{chassis}\" diaginertia=\"{inertia}\"/>
      <geom name=\"hull\" type=\"box\" pos=\"{hull}\" size=\"{sizes}\" contype=\"0\" \
         conaffinity=\"0\" group=\"1\"/>
      <site name=\"pose_sensor\" pos=\"{lever}\" euler=\"0.0 0.0 {yaw}\"/>
",
        name = robot.name,
        timestep = digits(timestep),
        ratio = digits(impedance_ratio(robot)),
        gravity = row(&robot.gravity),
        cog = row(&[x, y, z]),
        chassis = digits(chassis),
        inertia = row(&inertia),
        hull = row(&[f64::midpoint(rear, front), 0.0, radius + height]),
        sizes = row(&[length, width, height]),
        lever = row(&[lever_x, lever_y, 0.0]),
        yaw = digits(robot.model.sensor().yaw),
    );
    for roller in &rollers {
        text += &body(robot, roller, &suspension, rollers.len());
    }
    text += "    </body>\n  </worldbody>\n  <contact>\n";
    for roller in &rollers {
        let Friction { across, along } = roller.friction;
        let _ = writeln!(
            text,
            "    <pair geom1=\"ground\" geom2=\"{}\" condim=\"3\" friction=\"{} 0.0 0.0 0.0\" \
             solref=\"{}\" solimp=\"{} 0.001\"/>",
            name(roller),
            row(&[across, along]),
            row(&[-suspension.contact_stiffness, -DAMPING]),
            row(&[IMPEDANCE, IMPEDANCE]),
        );
    }
    text += "  </contact>\n  <actuator>\n";
    for roller in &rollers {
        text += &actuator(robot, roller, &suspension, rollers.len());
    }
    text += "  </actuator>\n  <sensor>\n    <framepos name=\"position\" objtype=\"site\" \
             objname=\"pose_sensor\"/>\n    <framequat name=\"attitude\" objtype=\"site\" \
             objname=\"pose_sensor\"/>\n    <gyro name=\"gyro\" site=\"pose_sensor\"/>\n  \
             </sensor>\n</mujoco>\n";
    TextFile { name: "vehicle.mjcf.xml", text }
}

fn name(roller: &Roller) -> String {
    format!("{}_{}", roller.side.name(), roller.index)
}

/// A roller on its spring.
fn body(robot: &Robot, roller: &Roller, suspension: &Suspension, count: usize) -> String {
    let Suspension { mass, radius, stiffness, damping, deflection, roll_damping, timestep, .. } =
        suspension;
    // I = k_v r² times the time in which it follows
    let rotor = gain(robot, roller, count) * radius * radius * ROTOR_LAG_STEPS * timestep;
    let name = name(roller);
    let half = digits(Roller::half_width(robot.width));
    let [x, y] = roller.place;
    format!(
        "      <body name=\"{name}\" pos=\"{place}\">
        <joint name=\"{name}_spring\" type=\"slide\" axis=\"0 0 1\" stiffness=\"{stiffness}\" \
         damping=\"{damping}\" springref=\"{rest}\"/>
        <joint name=\"{name}_roll\" type=\"hinge\" axis=\"1 0 0\" pos=\"0.0 0.0 {ground}\" \
         damping=\"{roll_damping}\"/>
        <joint name=\"{name}_drive\" type=\"hinge\" axis=\"0 1 0\" armature=\"{rotor}\"/>
        <inertial pos=\"0 0 0\" mass=\"{mass}\" diaginertia=\"{inertia}\"/>
        <geom name=\"{name}\" type=\"capsule\" fromto=\"0.0 -{half} 0.0 0.0 {half} 0.0\" \
         size=\"{radius}\" contype=\"0\" conaffinity=\"0\"/>
      </body>
",
        place = row(&[x, y, *radius]),
        stiffness = digits(*stiffness),
        damping = digits(*damping),
        rest = digits(-deflection * roller.preload),
        ground = digits(-radius),
        roll_damping = digits(*roll_damping),
        rotor = digits(rotor),
        mass = digits(*mass),
        inertia = row(&[mass * radius * radius; 3]),
        radius = digits(*radius),
    )
}

/// Force of an actuator per speed that its roller lacks, N s/m.
fn gain(robot: &Robot, roller: &Roller, count: usize) -> f64 {
    let Friction { across, along } = roller.friction;
    across.max(along) * robot.mass * STANDARD_GRAVITY / real(count) / DROOP
}

/// The actuator that keeps a roller at the speed of its belt, m/s.
fn actuator(robot: &Robot, roller: &Roller, suspension: &Suspension, count: usize) -> String {
    let name = name(roller);
    // F = k_v (α V − V_belt)
    let gain = gain(robot, roller, count);
    let drive = robot.model.drive();
    let lag = match drive.time_constant[roller.side] {
        lag if lag > 0.0 => format!(" dyntype=\"filterexact\" dynprm=\"{}\"", digits(lag)),
        _ => String::new(),
    };
    format!(
        "    <general name=\"{name}\" joint=\"{name}_drive\" gear=\"{radius}\"{lag} \
         gainprm=\"{scaled}\" biastype=\"affine\" biasprm=\"0.0 0.0 -{gain}\"/>\n",
        radius = digits(suspension.radius),
        scaled = digits(gain * drive.gain[roller.side]),
        gain = digits(gain),
    )
}

/// What the file says and does not say.
fn notes(robot: &Robot, rollers: &[Roller], factor: f64, is_unmatched: bool) -> String {
    let mut text = notes::wrapped(
        "ctrl of each actuator is the speed that the encoder of its side shows, m/s. Actuators are \
         left_0, left_1, ... and right_0, right_1, ...; all of a side get the same. At rest the \
         origin of base_link is on the ground, in the centre of the contact.",
        "",
    );
    let exported = icrs(&contact_points(robot, rollers));
    if let Some(exported) = exported {
        text += &notes::turning(robot, &exported, "these contacts, by friction on an ellipse");
    }
    text += "\nWhat MuJoCo cannot say:\n";
    let Friction { across, along } = robot.friction.left;
    let [pushed_off, creep] = slip_limits(robot, impedance_ratio(robot));
    let mut limits = vec![
        "A contact has no belt speed: a track is a row of rollers. Pairs with other geoms than \
         the ground need a line each in <contact>."
            .to_owned(),
        "Friction of different size across and along: MuJoCo opposes slip as much as the ellipse \
         of friction allows (force as mu_i^2 s_i), and equation (22) of the vehicle does not \
         (force as mu_i s_i/|s|). Pyramids (cone=\"pyramidal\") would resist more along their \
         diagonals."
            .to_owned(),
        format!(
            "Dry friction: it is full above about {:.1} mm/s of slip, and creeps below. A robot at \
             rest on a slope slides by less than that.",
            1e3 * creep
        ),
        format!(
            "Fast slip: a contact that slips pushes itself off. At {:.1} m/s of slip rollers lift \
             for moments, and the robot turns by about 2 % less.",
            pushed_off * SHARE_OF_LIFTING
        ),
    ];
    limits.push(if is_unmatched {
        "Friction across is the vehicle's; no other value turns with its chi.".to_owned()
    } else {
        format!(
            "So friction across is {:.4} in the pairs, {factor:.3} times the vehicle's \
             {across:.4}: with it the rollers turn with its chi. Along it is the vehicle's \
             {along:.4}. Forces across are wrong by that factor.",
            factor * across
        )
    });
    for limit in &limits {
        text += &notes::wrapped(limit, "- ");
    }
    text += &notes::assumed(robot);
    text + &notes::effects(robot, express)
}

/// Ratio of the impedances of friction and normal force that saturates friction at the creep speed
/// of the vehicle: the slip speed at which its friction would be full if it rose on as it does from
/// rest. At most that of dry friction.
fn impedance_ratio(robot: &Robot) -> f64 {
    let [_, of_dry_friction] = slip_limits(robot, IMPEDANCE_RATIO);
    let creep = robot.body.creep_speed.max(of_dry_friction);
    (IMPEDANCE_RATIO * of_dry_friction / creep).max(1.0)
}

/// Slip at which a contact pushes itself off with its own load, and that at which friction is full
/// by a ratio of impedances, m/s.
///
/// # Law
/// μ b v = N/m_c (1 − d)/d, with half a roller's load N and the mass m_c that its contact sees;
/// b v times the ratio of impedances is μ times that.
fn slip_limits(robot: &Robot, impedance_ratio: f64) -> [f64; 2] {
    let Friction { across, along } = robot.friction.left;
    let friction = across.max(along);
    let push =
        STANDARD_GRAVITY / (2.0 * ROLLER_SHARE) * CONTACT_INERTIA * (1.0 - IMPEDANCE) / IMPEDANCE;
    [push / (DAMPING * friction), push * friction / (DAMPING * impedance_ratio)]
}

/// Which aspects MuJoCo has.
fn express(aspect: Aspect) -> Expression {
    use Expression::{By, Lacks};
    match aspect {
        Aspect::Body => By("mass and centre of gravity of base_link"),
        Aspect::Friction => By("friction of the pairs of each side"),
        Aspect::Gravity => By("gravity, which is inclined to the plane of the ground"),
        Aspect::BeltGain => By("gain of the actuators"),
        Aspect::BeltGainVaries => Lacks("change the controls by direction and time"),
        Aspect::BeltLag => By("filter of the actuators"),
        Aspect::BeltSlip => Lacks("lower ctrl by the traction, from actuator_force, at each step"),
        Aspect::Mount => By("site pose_sensor"),
        Aspect::Delay => Lacks("read the sensors late"),
        Aspect::YawRateBias => {
            Lacks("add it to the yaw rate that is read, and its integral to yaw")
        }
        Aspect::CogHeight => By("height of the centre of gravity of base_link"),
        Aspect::Inertia => By("a rigid body has it; friction is divided by the strength"),
        Aspect::FrictionAlong => By("friction of the pairs, roller by roller"),
        Aspect::Pressure => By("springref of the rollers"),
        Aspect::Creep => By("impratio, as far as the creep above"),
        Aspect::Constant => By("friction across, in the chi that it is chosen for"),
        Aspect::ShearLaw => Lacks("set pair_friction of the model from the slip, at each step"),
        Aspect::Force => Lacks("set xfrc_applied of base_link, at each step"),
        Aspect::Place => Lacks("set pair_friction of the model from the place, at each step"),
        Aspect::Time => Lacks("set pair_friction of the model from the time, at each step"),
    }
}
