//! Parameters of `diff_drive_controller`.

use crate::number::number;
use crate::ros2::{Published, Wheels};
use crate::{EquivalentDrive, Frames, Name, NodeName, Provenance, Residuals, TextFile};

/// The parameter file.
pub(super) fn parameters(
    drive: &EquivalentDrive,
    frames: &Frames,
    wheels: &Wheels,
    controller: &NodeName,
    published: Option<&Published>,
    provenance: &Provenance,
) -> TextFile {
    let (icr, odom, base) = (frames.icr(), frames.odom(), frames.base());
    let notes = format!(
        "Parameters of ros2_control's diff_drive_controller for a tracked robot.\n\
         {icr} is the point midway between the ICRs of the tracks, at which the robot moves as an \
         ideal\n\
         differential drive; icr_frame.launch.py (or the URDF of `trackdyn export urdf-frames`) \
         ties it\n\
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

"
    );
    let covariances = published
        .map_or_else(|| NO_COVARIANCES.to_owned(), |published| covariances(drive, icr, published));
    let text = provenance.hash_comment(&notes) + &body + &covariances;
    TextFile { name: "diff_drive_controller.yaml", text }
}

const NO_COVARIANCES: &str = concat!(
    "    # pose_covariance_diagonal and twist_covariance_diagonal keep the defaults of the ",
    "controller: no\n    # residuals were given (--residuals). The defaults are zeros; set them ",
    "before a filter reads them.\n",
);

/// The rate and both diagonals, with where they come from.
fn covariances(drive: &EquivalentDrive, icr: &Name, published: &Published) -> String {
    let Published { residuals, rate } = published;
    let Residuals { source, pieces, duration, runs, distance, .. } = residuals;
    let source = source.replace(char::is_control, " ");
    let held_out = if residuals.held_out {
        "runs that the parameters were not fitted to"
    } else {
        "runs that the parameters were fitted to, so that they are too small"
    };
    let twist = diagonal(residuals.twist_diagonal(drive, *rate));
    let pose = diagonal(residuals.pose_diagonal());
    let rate = number(*rate);
    format!(
        "    # Covariances from the residuals in {source},
    # of {held_out}.
    # Order: x, y, z, roll, pitch, yaw; 1000000.0 stands for what is not measured.

    # Hz; the variance of the twist goes with it
    publish_rate: {rate}
    # (m/s)^2, (rad/s)^2: residual^2 * rate / time, over {pieces} pieces of {duration:.2} s. y is \
         the slip\n    # aside of {icr}, which the controller reports as 0.
    twist_covariance_diagonal: {twist}
    # m^2, rad^2: at the end of a drive of {distance:.1} m (mean of {runs} runs); less before, \
         more after.\n    # Let a filter fuse the twist and not the pose.
    pose_covariance_diagonal: {pose}
"
    )
}

/// Six variances to four digits.
fn diagonal(variances: [f64; 6]) -> String {
    let rounded = |variance: f64| format!("{variance:.3e}").parse().unwrap_or(variance);
    let texts: Vec<String> = variances.into_iter().map(|v| number(rounded(v))).collect();
    format!("[{}]", texts.join(", "))
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
            &"base_controller".parse().expect("a name"),
            None,
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

    #[test]
    fn covariances_are_six_numbers_each() {
        let name = |text: &str| text.parse::<Name>().expect("a name");
        let wheels = Wheels::new(1.0, vec![name("a")], vec![name("c")]).expect("wheels");
        let residuals = crate::covariance::tests::residuals();
        let published = Published::new(residuals.clone(), 20.0).expect("a rate");
        let file = parameters(
            &drive(),
            &frames(),
            &wheels,
            &"c".parse().expect("a name"),
            Some(&published),
            &Provenance::default(),
        );
        let yaml: Value = serde_yaml_ng::from_str(&file.text).expect("YAML");
        let parameters = &yaml["c"]["ros__parameters"];
        assert_eq!(parameters["publish_rate"].as_f64(), Some(20.0));
        for (key, expected) in [
            ("twist_covariance_diagonal", residuals.twist_diagonal(&drive(), 20.0)),
            ("pose_covariance_diagonal", residuals.pose_diagonal()),
        ] {
            let numbers = parameters[key].as_sequence().expect(key);
            assert_eq!(numbers.len(), 6);
            for (number, expected) in numbers.iter().zip(expected) {
                // Four digits
                assert!(
                    number.is_f64() && (number.as_f64().expect(key) / expected - 1.0).abs() < 1e-3
                );
            }
        }
        assert!(Published::new(residuals, 0.0).is_err());
    }
}
