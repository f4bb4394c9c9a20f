//! `trackdyn export`: files of other programs.

use crate::Workplace;
use std::path::PathBuf;

/// A folder with the default vehicle's kinematics.
fn with_kinematics(effects: &str) -> Workplace {
    let place = Workplace::new();
    let run = place.run(&format!("map --cog -0.015,0.04 --grid 5 --out map {effects}"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    let kinematics = place.read("map/kinematics.toml");
    std::fs::remove_dir_all(place.path().join("map")).expect("removed");
    place.write("kinematics.toml", &String::from_utf8(kinematics).expect("text"));
    place
}

fn text(place: &Workplace, name: &str) -> String {
    String::from_utf8(place.read(name)).expect("text")
}

#[test]
fn ros2_writes_parameters_and_launch_file() {
    let place = with_kinematics("");
    let run = place.run("export ros2 kinematics.toml --out ros --wheel-radius 0.1");
    assert_eq!((run.status, run.stdout.as_str()), (0, ""), "{}", run.stderr);
    assert!(
        run.stderr.contains("wrote ros/diff_drive_controller.yaml and ros/icr_frame.launch.py")
            && !run.stderr.contains("warning"),
        "{}",
        run.stderr
    );

    let yaml = text(&place, "ros/diff_drive_controller.yaml");
    let parsed: serde_yaml_ng::Value = serde_yaml_ng::from_str(&yaml).expect("YAML");
    let parameters = &parsed["diff_drive_controller"]["ros__parameters"];
    // The gauge of the vehicle, which the kinematics file does not hold.
    assert_eq!(parameters["wheel_separation"].as_f64(), Some(0.42));
    let multiplier = parameters["wheel_separation_multiplier"].as_f64().expect("a number");
    assert!((multiplier - 1.0 / 0.50437).abs() < 1e-4, "{multiplier}");
    assert_eq!(parameters["left_wheel_radius_multiplier"].as_f64(), Some(1.0));
    assert_eq!(parameters["left_wheel_names"][0].as_str(), Some("left_wheel_joint"));

    let launch = text(&place, "ros/icr_frame.launch.py");
    // Base link behind and left of the point between the ICRs: -y and (x_r + x_l)/2.
    assert!(launch.contains("\"--x\", \"-0.0492"), "{launch}");
    assert!(launch.contains("\"--y\", \"0.0409"), "{launch}");
    for file in [yaml, launch] {
        assert!(file.contains("# command: trackdyn export ros2 kinematics.toml"), "{file}");
        assert!(file.contains("# source: kinematics.toml, SHA-256 "), "{file}");
        assert!(file.contains(env!("CARGO_PKG_VERSION")), "{file}");
    }
}

#[test]
fn urdf_frames_and_gz_write_xml() {
    let place = with_kinematics("");
    for (arguments, file, root, parts) in [
        (
            "urdf-frames kinematics.toml --base-frame base_footprint --contact-centre -0.1,0",
            "out/icr_frame.urdf.xacro",
            "robot",
            ["<child link=\"base_footprint\"/>", "xyz=\"0.050"],
        ),
        (
            "gz kinematics.toml --left-track l1 --left-track l2",
            "out/tracked_vehicle.sdf",
            "plugin",
            ["<tracks_separation>0.42</tracks_separation>", "<link>l2</link>"],
        ),
    ] {
        let run = place.run(&format!("export {arguments}"));
        assert_eq!(run.status, 0, "{}", run.stderr);
        assert!(run.stderr.contains(&format!("wrote {file}; Auriga-alpha")), "{}", run.stderr);
        let xml = text(&place, file);
        let document = roxmltree::Document::parse(&xml).expect("XML");
        assert_eq!(document.root_element().tag_name().name(), root);
        for part in parts {
            assert!(xml.contains(part), "{part} is not in:\n{xml}");
        }
    }
}

/// A log whose speeds are numbers of messages has no joints; one may have joints that are reversed.
#[test]
fn joints_that_the_log_does_not_tell_are_said() {
    let place = with_kinematics("");
    let of_map = text(&place, "kinematics.toml");
    let bag = "[source.bag]\nwheel_radius_m = 0.165\ntrack_topics = [\"/status\"]\n";
    place.write("kinematics.toml", &(of_map.clone() + bag));
    let run = place.run("export ros2 kinematics.toml");
    assert_eq!(run.status, 0, "{}", run.stderr);
    let said = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    let part = "left joints left_wheel_joint; right joints right_wheel_joint: the usual names, for \
                the log of kinematics.toml names no wheel joints";
    assert!(said.contains(part), "{said}");
    let bag = "[source.bag]\nleft_joints = [\"l\"]\nright_joints = [\"-r\"]\n";
    place.write("kinematics.toml", &(of_map + bag));
    let run = place.run("export ros2 kinematics.toml --wheel-radius 0.1");
    let said = run.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    let part = "--right-joint: r counts backwards in the log";
    assert!(run.status != 0 && said.contains(part) && !said.contains("-r "), "{said}");
    let run = place.run("export ros2 kinematics.toml --wheel-radius 0.1 --right-joint r");
    assert_eq!(run.status, 0, "{}", run.stderr);
}

/// What the log says of the robot, where the parameters come from one.
#[test]
fn names_of_the_log_are_taken_and_said() {
    let place = with_kinematics("");
    let of_map = text(&place, "kinematics.toml");
    let bag = "[source.bag]\nleft_joints = [\"front_left\", \"rear_left\"]\n\
               right_joints = [\"front_right\", \"rear_right\"]\nwheel_radius_m = 0.165\n\
               parent_frame = \"map\"\nchild_frame = \"base_footprint\"\n";
    place.write("kinematics.toml", &(of_map + bag));
    let run = place.run("export ros2 kinematics.toml");
    assert_eq!(run.status, 0, "{}", run.stderr);
    for part in [
        "left joints front_left, rear_left; right joints front_right, rear_right; wheel radius \
         0.165 m: those of the log of kinematics.toml",
        "base frame base_footprint: the one whose poses the log has",
    ] {
        assert!(run.stderr.contains(part), "{part:?} is not in:\n{}", run.stderr);
    }
    let yaml = text(&place, "out/diff_drive_controller.yaml");
    let parsed: serde_yaml_ng::Value = serde_yaml_ng::from_str(&yaml).expect("YAML");
    let parameters = &parsed["diff_drive_controller"]["ros__parameters"];
    assert_eq!(parameters["left_wheel_names"][1].as_str(), Some("rear_left"));
    assert_eq!(parameters["wheel_radius"].as_f64(), Some(0.165));
    // the frame of the log's poses is no odometry
    assert_eq!(parameters["odom_frame_id"].as_str(), Some("odom"));
    assert!(text(&place, "out/icr_frame.launch.py").contains("base_footprint"));
    let options = "--left-joint l --right-joint r --wheel-radius 0.1 --base-frame chassis";
    let run = place.run(&format!("export ros2 kinematics.toml {options} --out chosen"));
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(!run.stderr.contains("of the log of"), "{}", run.stderr);
    let part = "ICRs are measured in base_footprint, whose poses the log has: --contact-centre";
    assert!(run.stderr.contains(part), "{}", run.stderr);
    let yaml = text(&place, "chosen/diff_drive_controller.yaml");
    assert!(yaml.contains("wheel_radius: 0.1\n") && yaml.contains("[\"l\"]"), "{yaml}");
    let run = place.run("export urdf-frames kinematics.toml --out urdf");
    assert!(run.stderr.contains("base frame base_footprint"), "{}", run.stderr);
}

#[test]
fn piecewise_kinematics_are_exported_with_a_warning() {
    let place = with_kinematics("--effect motion-resistance:coefficient=0.05");
    let run = place.run("export gz kinematics.toml");
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stderr.contains("warning: kinematics.toml is piecewise with"), "{}", run.stderr);
}

#[test]
fn bad_input_writes_nothing() {
    let place = with_kinematics("");
    let good = text(&place, "kinematics.toml");
    place.write("schema.toml", &good.replace("trackdyn.kinematics/1", "trackdyn.vehicle/1"));
    let line = good.lines().position(|line| line.starts_with("steering_efficiency"));
    let line = line.expect("a line") + 1;
    place.write(
        "zero.toml",
        &good.replace("\nsteering_efficiency = 0", "\nsteering_efficiency = -0"),
    );
    let before = place.files();
    let zero = format!("zero.toml:{line}: steering_efficiency = -0.");
    for (arguments, part) in [
        ("ros2 missing.toml --wheel-radius 0.1", "missing.toml: cannot be read"),
        ("ros2 schema.toml --wheel-radius 0.1", "schema.toml:1: schema = \"trackdyn.vehicle/1\""),
        ("gz schema.toml", "expected \"trackdyn.kinematics/1\""),
        ("gz zero.toml", zero.as_str()),
        ("ros2 kinematics.toml", "--wheel-radius"),
        (
            "ros2 kinematics.toml --wheel-radius 0",
            "--wheel-radius = 0: expected a radius of 1e-6 to 1e4 m",
        ),
        ("ros2 kinematics.toml --wheel-radius -0.1", "--wheel-radius = -0.1: expected"),
        ("ros2 kinematics.toml --wheel-radius nan", "--wheel-radius = NaN: expected"),
        (
            "ros2 kinematics.toml --wheel-radius 1 --left-joint a --left-joint b",
            "--right-joint: 1 names, left-joint: 2 names",
        ),
        ("ros2 kinematics.toml --wheel-radius 1e-320", "expected a radius of 1e-6 to 1e4 m"),
        ("urdf-frames kinematics.toml --contact-centre 1e300,0", "expected at most 1e4 m"),
        ("urdf-frames kinematics.toml --base-frame a:b", "\"a:b\": expected a name"),
        ("urdf-frames kinematics.toml --base-frame icr_link", "two different frames"),
        ("urdf-frames kinematics.toml --contact-centre 1", "two numbers separated by a comma"),
        ("ros3 kinematics.toml", "ros2"),
    ] {
        let run = place.run(&format!("export {arguments} --out new"));
        assert_eq!(run.status, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
        assert!(run.stdout.is_empty(), "{arguments}: {}", run.stdout);
        assert!(!place.path().join("new").exists(), "{arguments}");
    }
    assert_eq!(place.files(), before);
    assert_eq!(before.len(), 3);
    place.write("file", "in the way");
    let run = place.run("export gz kinematics.toml --out file/out");
    assert_eq!(run.status, 1);
    assert!(run.stderr.contains("file/out: cannot be written"), "{}", run.stderr);
    assert!(place.files().contains(&PathBuf::from("file")));
}
