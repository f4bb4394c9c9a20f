//! `diff_drive_controller` with our parameters and our static transform drives and locates the
//! robot as our own kinematics do.
//!
//! Source: ros2_controllers, `diff_drive_controller/src/odometry.cpp` and
//! `diff_drive_controller.cpp`; the equations are in `docs/theory/export.md`.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use trackdyn_core::document::Document;
use trackdyn_core::frames::{paper_from_ros, ros_twist_from_paper};
use trackdyn_core::{PerSide, Pose, Twist};
use trackdyn_export::ros2::{self, Wheels};
use trackdyn_export::{EquivalentDrive, Frames, Name, Provenance, gz, urdf};
use trackdyn_model::Kinematics;
use trackdyn_model::kinematics::KinematicsFile;
use trackdyn_tests::uniform;

/// Floating-point noise of 3000 steps over some 100 m, with room; far below any sensor.
const TOLERANCE: f64 = 1e-9;

/// The controller, by its documented equations.
#[derive(Debug)]
struct Controller {
    separation: f64,
    radius: PerSide<f64>,
    /// Joint angles at the last update, rad.
    angle: PerSide<f64>,
    /// Pose `odom_from_icr`.
    pose: Pose,
}

impl Controller {
    /// Parameters times their multipliers, as the controller reads them.
    fn from_yaml(text: &str) -> Self {
        let yaml: serde_yaml_ng::Value = serde_yaml_ng::from_str(text).expect("YAML");
        let parameters = &yaml["diff_drive_controller"]["ros__parameters"];
        let of = |key: &str| parameters[key].as_f64().expect(key);
        assert_eq!(parameters["base_frame_id"].as_str(), Some("icr_link"));
        Self {
            separation: of("wheel_separation_multiplier") * of("wheel_separation"),
            radius: PerSide::new(
                of("left_wheel_radius_multiplier") * of("wheel_radius"),
                of("right_wheel_radius_multiplier") * of("wheel_radius"),
            ),
            angle: PerSide::new(0.0, 0.0),
            pose: Pose::default(),
        }
    }

    /// Odometry from joint angles, rad: exact on arcs, midpoint rule on what is nearly straight.
    fn update(&mut self, angle: PerSide<f64>) {
        let left = angle.left * self.radius.left - self.angle.left * self.radius.left;
        let right = angle.right * self.radius.right - self.angle.right * self.radius.right;
        self.angle = angle;
        let (travel, turn) = (f64::midpoint(left, right), (right - left) / self.separation);
        let Pose { x, y, yaw } = self.pose;
        self.pose = if turn.abs() < 1e-6 {
            let (sin, cos) = (yaw + turn / 2.0).sin_cos();
            Pose::new(x + travel * cos, y + travel * sin, yaw + turn)
        } else {
            let (arc, after) = (travel / turn, yaw + turn);
            Pose::new(
                x + arc * (after.sin() - yaw.sin()),
                y - arc * (after.cos() - yaw.cos()),
                after,
            )
        };
    }

    /// Joint rates, rad/s, for a forward speed and a yaw rate of its frame.
    fn joint_rates(&self, forward: f64, yaw_rate: f64) -> PerSide<f64> {
        let across = yaw_rate * self.separation / 2.0;
        PerSide::new((forward - across) / self.radius.left, (forward + across) / self.radius.right)
    }
}

/// A kinematics file with any ICRs, with or without factors.
fn kinematics_file(random: &mut ChaCha8Rng, alpha: Option<[f64; 2]>) -> Document {
    let left = uniform(random, -1.5, -0.05);
    let right = uniform(random, 0.05, 1.5);
    let (y, efficiency) = (uniform(random, -0.5, 0.5), uniform(random, 0.2, 1.0));
    let eccentricity = (right + left) / (right - left);
    let alpha = alpha.map_or(String::new(), |[left, right]| {
        format!("alpha_left = {left:?}\nalpha_right = {right:?}\n")
    });
    let text = format!(
        "schema = \"trackdyn.kinematics/1\"\nframe = \"paper\"\n\
         x_icr_left_m = {left:?}\nx_icr_right_m = {right:?}\ny_icr_m = {y:?}\n\
         steering_efficiency = {efficiency:?}\neccentricity = {eccentricity:?}\n{alpha}\
         [source]\ncommand = \"\"\nversion = \"\"\nvehicle = \"\"\nfingerprint = \"\"\n"
    );
    Document::new("kinematics.toml", text)
}

/// The exported texts: parameters, launch file, URDF fragment.
fn exported(drive: &EquivalentDrive, radius: f64) -> [String; 3] {
    let name = |text: &str| text.parse::<Name>().expect("a name");
    let frames =
        Frames::new(name("odom"), name("icr_link"), name("base_link"), [0.0, 0.0]).expect("frames");
    let wheels = Wheels::new(radius, vec![name("l")], vec![name("r")]).expect("wheels");
    let provenance = Provenance::default();
    let controller = "diff_drive_controller".parse().expect("a name of a node");
    let files = ros2::files(drive, &frames, &wheels, &controller, None, &provenance);
    let [parameters, launch] = <[_; 2]>::try_from(files).expect("two files").map(|file| file.text);
    [parameters, launch, urdf::fragment(drive, &frames, &provenance).text]
}

/// Translation of the base link from the ICR link, in a URDF.
fn transform_of_urdf(text: &str) -> Pose {
    let document = roxmltree::Document::parse(text).expect("XML");
    let joint = document.descendants().find(|node| node.has_tag_name("joint")).expect("a joint");
    let of = |element: &str, attribute: &str| {
        let child = joint.children().find(|node| node.has_tag_name(element)).expect(element);
        child.attribute(attribute).expect(attribute).to_owned()
    };
    assert_eq!(
        (of("parent", "link"), of("child", "link")),
        ("icr_link".into(), "base_link".into())
    );
    assert_eq!(joint.attribute("type"), Some("fixed"));
    let xyz: Vec<f64> =
        of("origin", "xyz").split(' ').map(|number| number.parse().expect("a number")).collect();
    Pose::new(xyz[0], xyz[1], 0.0)
}

/// The transform from the arguments of the static transform publisher in a launch file.
fn transform_of_launch_file(text: &str) -> Pose {
    let of = |option: &str| {
        let rest = text.split(&format!("\"--{option}\", \"")).nth(1).expect(option);
        rest.split('"').next().expect("a value").to_owned()
    };
    assert_eq!((of("frame-id"), of("child-frame-id")), ("icr_link".into(), "base_link".into()));
    let number = |option| of(option).parse().expect("a number");
    Pose::new(number("x"), number("y"), number("yaw"))
}

/// A duration, s, and track speeds as measured, m/s: now and then straight, nearly straight, or at
/// rest.
fn command(random: &mut ChaCha8Rng, step: usize) -> (f64, PerSide<f64>) {
    let left = uniform(random, -1.5, 1.5);
    let right = match step % 10 {
        3 => left,
        6 => left + uniform(random, -1e-6, 1e-6),
        _ => uniform(random, -1.5, 1.5),
    };
    let speed = if step % 50 == 7 { PerSide::new(0.0, 0.0) } else { PerSide::new(left, right) };
    (uniform(random, 0.005, 0.2), speed)
}

fn distance(a: &Pose, b: &Pose) -> f64 {
    (a.x - b.x).abs().max((a.y - b.y).abs()).max((a.yaw - b.yaw).abs())
}

/// Files of ten random robots, half with factors.
fn robots(random: &mut ChaCha8Rng) -> Vec<(EquivalentDrive, Kinematics)> {
    (0..10)
        .map(|k| {
            let alpha = [uniform(random, 0.8, 1.2), uniform(random, 0.8, 1.2)];
            let document = kinematics_file(random, (k % 2 == 1).then_some(alpha));
            let file = KinematicsFile::from_document(&document).expect("valid");
            (EquivalentDrive::from_document(&document).expect("valid"), file.kinematics())
        })
        .collect()
}

#[test]
fn its_odometry_is_ours() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for (drive, kinematics) in robots(&mut random) {
        let radius = uniform(&mut random, 0.03, 0.4);
        let [parameters, launch, urdf] = exported(&drive, radius);
        let mut controller = Controller::from_yaml(&parameters);
        let icr_from_base = transform_of_urdf(&urdf);
        assert_eq!(icr_from_base, transform_of_launch_file(&launch));

        let mut ours = Pose::default();
        let mut angle = PerSide::new(0.0, 0.0);
        for step in 0..3000 {
            let (duration, speed) = command(&mut random, step);
            let twist = ros_twist_from_paper(&kinematics.twist(speed));
            ours = ours.compose(&Pose::exp(&twist, duration));
            // The joints turn by the measured belt travel over the nominal radius.
            angle.left += speed.left * duration / radius;
            angle.right += speed.right * duration / radius;
            controller.update(angle);
            // odom_from_base, seen from where the base stood at the start, which is not odom's
            // origin
            let theirs = icr_from_base.relative(&controller.pose.compose(&icr_from_base));
            let error = distance(&theirs, &ours);
            assert!(error < TOLERANCE, "step {step}: {error:e}, {controller:?} {ours:?}");
        }
    }
}

#[test]
fn its_commands_reach_what_they_ask_for() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for (drive, kinematics) in robots(&mut random) {
        let radius = uniform(&mut random, 0.03, 0.4);
        let [parameters, _, urdf] = exported(&drive, radius);
        let controller = Controller::from_yaml(&parameters);
        let base_from_icr = transform_of_urdf(&urdf).inverse();
        for _ in 0..100 {
            let forward = uniform(&mut random, -1.0, 1.0);
            let yaw_rate = uniform(&mut random, -1.0, 1.0);
            let rates = controller.joint_rates(forward, yaw_rate);
            let measured = PerSide::new(rates.left * radius, rates.right * radius);
            let twist: Twist = kinematics.twist(measured);
            let icr = paper_from_ros([base_from_icr.x, base_from_icr.y]);
            let [lateral, reached] = twist.velocity_at(icr);
            assert!((reached - forward).abs() < TOLERANCE && lateral.abs() < TOLERANCE);
            assert!((twist.w - yaw_rate).abs() < TOLERANCE);
        }
    }
}

/// TrackedVehicle.cc: V_r,l = v ± ω separation/(2 efficiency).
#[test]
fn gazebo_commands_the_same_tracks() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for (drive, kinematics) in robots(&mut random) {
        let name = |text: &str| [text.parse::<Name>().expect("a name")];
        let plugin = gz::plugin(&drive, &name("l"), &name("r"), &Provenance::default());
        let text = plugin.expect("two links").text;
        let document = roxmltree::Document::parse(&text).expect("XML");
        let of = |tag: &str| -> f64 {
            let element = document.descendants().find(|node| node.has_tag_name(tag)).expect(tag);
            element.text().expect(tag).parse().expect("a number")
        };
        let (v, w) = (uniform(&mut random, -1.0, 1.0), uniform(&mut random, -1.0, 1.0));
        let across = w * of("tracks_separation") / (2.0 * of("steering_efficiency"));
        // At the point between the ICRs v is that of the hull's origin and w times its way to the
        // side.
        let [_, left] = drive.point;
        let ours = kinematics.track_speeds(v + w * left, w);
        assert!((v - across - ours.left * kinematics.alpha.left).abs() < TOLERANCE);
        assert!((v + across - ours.right * kinematics.alpha.right).abs() < TOLERANCE);
    }
}
