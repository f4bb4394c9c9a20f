//! Parameters of `diff_drive_controller`.

use crate::number::number;
use crate::ros2::Wheels;
use crate::{EquivalentDrive, Frames, Name, Provenance, TextFile};

/// The parameter file.
pub(super) fn parameters(
    drive: &EquivalentDrive,
    frames: &Frames,
    wheels: &Wheels,
    controller: &Name,
    provenance: &Provenance,
) -> TextFile {
    let (icr, odom, base) = (frames.icr(), frames.odom(), frames.base());
    let notes = format!(
        "Parameters of ros2_control's diff_drive_controller for a tracked robot.\n\
         {icr} is the point midway between the ICRs of the tracks, at which the robot moves as an ideal\n\
         differential drive; icr_frame.launch.py (or the URDF of `trackdyn export urdf-frames`) ties it\n\
         to {base}. Commands and odometry are those of {icr}.\n"
    );
    let left = list(&wheels.left);
    let right = list(&wheels.right);
    let radius = number(wheels.radius);
    let gauge = number(drive.gauge);
    // 1/χ = (x_r − x_l)/L, eq. (12)
    let multiplier = number(drive.separation / drive.gauge);
    let (alpha_left, alpha_right) = (number(drive.alpha.left), number(drive.alpha.right));
    let body = format!(
        "{controller}:
  ros__parameters:
    type: \"diff_drive_controller/DiffDriveController\"
    left_wheel_names: {left}
    right_wheel_names: {right}

    # m: gauge = steering_efficiency * (x_icr_right_m - x_icr_left_m)
    wheel_separation: {gauge}
    # 1 / steering_efficiency
    wheel_separation_multiplier: {multiplier}
    # m of belt per rad of the wheel joint
    wheel_radius: {radius}
    # alpha_left, alpha_right: true over measured track speed; 1 where not fitted
    left_wheel_radius_multiplier: {alpha_left}
    right_wheel_radius_multiplier: {alpha_right}

    odom_frame_id: \"{odom}\"
    # Not {base}: the static transform {icr} -> {base} carries eccentricity and y_icr_m.
    base_frame_id: \"{icr}\"
    enable_odom_tf: true
    open_loop: false
    position_feedback: true

    # pose_covariance_diagonal and twist_covariance_diagonal keep the defaults of the controller: the
    # kinematics file has no covariance. The defaults are zeros; set them before a filter reads them.
"
    );
    let text = provenance.hash_comment(&notes) + &body;
    TextFile { name: "diff_drive_controller.yaml", text }
}

fn list(names: &[Name]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    format!("[{}]", quoted.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drive::tests::drive;
    use crate::frames::tests::frames;
    use serde_yaml_ng::Value;

    #[test]
    fn parameters_have_the_types_that_ros_expects() {
        let name = |text: &str| text.parse::<Name>().expect("a name");
        let wheels = Wheels::new(1.0, vec![name("a"), name("b")], vec![name("c"), name("d")]);
        let file = parameters(
            &drive(),
            &frames(),
            &wheels.expect("wheels"),
            &name("base_controller"),
            &Provenance::default(),
        );
        let yaml: Value = serde_yaml_ng::from_str(&file.text).expect("YAML");
        let parameters = &yaml["base_controller"]["ros__parameters"];
        for key in [
            "wheel_separation",
            "wheel_separation_multiplier",
            "wheel_radius",
            "left_wheel_radius_multiplier",
            "right_wheel_radius_multiplier",
        ] {
            assert!(parameters[key].is_f64(), "{key}: {:?}", parameters[key]);
        }
        assert_eq!(parameters["wheel_separation"].as_f64(), Some(0.42));
        assert_eq!(parameters["left_wheel_radius_multiplier"].as_f64(), Some(0.97));
        assert_eq!(parameters["base_frame_id"].as_str(), Some("icr_link"));
        assert_eq!(parameters["open_loop"].as_bool(), Some(false));
        assert_eq!(parameters["right_wheel_names"][1].as_str(), Some("d"));
        assert!(parameters.get("pose_covariance_diagonal").is_none());
    }
}
