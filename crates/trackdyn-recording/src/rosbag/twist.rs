//! Track speeds from the speeds of the body, where a log has none of the joints.
//!
//! They are read as the joints of wheels whose radius is 1 m, which turn as fast as the belts move.

use super::options::RosbagOptions;
use super::payload::{Payload, PayloadError};
use super::topic::{Layout, Topic};
use super::words::words;
use crate::Error;
use crate::recording::Warning;
use std::borrow::Cow;
use std::path::Path;

/// Names of the joints that stand for the tracks, left and right.
pub(super) const JOINTS: [&str; 2] = ["left", "right"];

/// Words of topics that say how fast a robot should be.
const COMMAND_WORDS: [&str; 6] = ["cmd", "command", "commands", "setpoint", "target", "teleop"];

/// Words of topics that say how fast it was, whatever else is in the name, such as `cmd_odom`.
const MEASUREMENT_WORDS: [&str; 8] =
    ["odom", "odometry", "feedback", "measured", "actual", "state", "status", "encoder"];

/// The options by which the speeds of a body are read as joints; others as they are.
///
/// # Errors
/// [`Error::Options`] for a topic without a separation that can be, and the reverse.
pub(super) fn effective<'a>(
    path: &Path,
    options: &'a RosbagOptions,
) -> Result<Cow<'a, RosbagOptions>, Error> {
    let refuse = |problem: String| Error::Options { path: path.to_owned(), problem };
    let Some(topic) = &options.twist_topic else {
        return match options.separation {
            None => Ok(Cow::Borrowed(options)),
            Some(_) => Err(refuse(
                "--separation is that of the driver of a twist: expected with --twist-topic TOPIC"
                    .to_owned(),
            )),
        };
    };
    if !options.separation.is_some_and(|b| b.is_finite() && b > 0.0) {
        return Err(refuse(format!(
            "--twist-topic {topic} needs the separation of the tracks that its driver computes \
             with: expected --separation METRES, a number above zero"
        )));
    }
    if options.wheel_radius.is_some() {
        return Err(refuse(format!(
            "--wheel-radius: the speeds of --twist-topic {topic} are those of the body in m/s and \
             rad/s, and no wheel counts: expected no radius"
        )));
    }
    if let Some(option) = options.of_joints() {
        return Err(refuse(format!(
            "{option} chooses joints, and --twist-topic {topic} takes their place: expected one of \
             them"
        )));
    }
    let [left, right] = JOINTS.map(|name| vec![name.to_owned()]);
    Ok(Cow::Owned(RosbagOptions {
        tracks_topic: Some(topic.clone()),
        left_joints: left,
        right_joints: right,
        wheel_radius: Some(1.0),
        ..options.clone()
    }))
}

/// What is to be said of track speeds from the speeds of a body.
pub(super) fn warning(options: &RosbagOptions) -> Option<Warning> {
    let (topic, separation) = (options.twist_topic.clone()?, options.separation?);
    Some(Warning::FromTwist { topic, separation })
}

/// Whether the messages of a topic have speeds of the body that are no commands.
pub(super) fn is_offered(name: &str, kind: &str) -> bool {
    has_twist(kind) && !is_command(name)
}

/// Whether messages of a type have speeds of the body.
fn has_twist(kind: &str) -> bool {
    match Layout::of_kind(kind) {
        Some(Layout::Twist | Layout::TwistStamped) => true,
        Some(Layout::PoseOfChild) => kind.ends_with("/Odometry"),
        _ => false,
    }
}

/// Whether a topic says how fast a robot should be, by its name.
pub(super) fn is_command(name: &str) -> bool {
    let words = words(name);
    let has = |some: &[&str]| words.iter().any(|word| some.contains(&word.as_str()));
    has(&COMMAND_WORDS) && !has(&MEASUREMENT_WORDS)
}

/// What a log without joints has instead, and the options that read it.
pub(super) fn offer(seen: &[Topic]) -> Option<String> {
    let twists = seen.iter().filter(|topic| topic.layout().is_some() && has_twist(&topic.kind));
    let (commands, measured): (Vec<&Topic>, Vec<&Topic>) =
        twists.partition(|topic| is_command(&topic.name));
    if let Some((first, names)) = first_and_all(&measured) {
        return Some(format!(
            "speeds of the body (twist) are in {names}: where they come from the encoders alone, \
             track speeds are made of them by --twist-topic {first} --separation METRES"
        ));
    }
    let (first, names) = first_and_all(&commands)?;
    Some(format!(
        "speeds of the body (twist) are in {names}, by the name what the robot should do, and of \
         no use then: only where a driver computes them from the encoders, --twist-topic {first} \
         --separation METRES reads them"
    ))
}

/// The first name of topics, and all of them.
fn first_and_all<'a>(topics: &[&'a Topic]) -> Option<(&'a str, String)> {
    let names: Vec<&str> = topics.iter().map(|topic| topic.name.as_str()).collect();
    Some((*names.first()?, names.join(", ")))
}

/// Speed forward and yaw rate of the body in a message after its header.
///
/// # Errors
/// A message that ends too early.
pub(super) fn body_speeds(layout: Layout, payload: &mut Payload) -> Result<[f64; 2], PayloadError> {
    if layout == Layout::PoseOfChild {
        // nav_msgs/Odometry: child frame, pose and its covariance
        payload.text()?;
        payload.skip_f64s(7 + 36)?;
    }
    let [forward, _, _, _, _, yaw_rate] = payload.f64s()?;
    Ok([forward, yaw_rate])
}

/// Speeds of the tracks, m/s, left and right. `b` is their separation, m.
pub(super) fn track_speeds([forward, yaw_rate]: [f64; 2], b: f64) -> [f64; 2] {
    // v_l = v - ω b/2, v_r = v + ω b/2
    [forward - yaw_rate * b / 2.0, forward + yaw_rate * b / 2.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_that_turns_left_has_the_faster_track_on_the_right() {
        assert_eq!(track_speeds([1.0, 0.5], 0.8), [0.8, 1.2]);
    }

    #[test]
    fn commands_are_not_offered_as_measured() {
        let topic = |name: &str, kind: &str| Topic {
            name: name.to_owned(),
            kind: kind.to_owned(),
            encoding: "cdr".to_owned(),
        };
        let odometry = topic("/odom", "nav_msgs/msg/Odometry");
        let command = topic("/robot/cmd_vel", "geometry_msgs/msg/Twist");
        let alone = offer(std::slice::from_ref(&command)).expect("told");
        assert!(alone.contains("only where a driver computes them"), "{alone}");
        let both = offer(&[command, odometry]).expect("an offer");
        assert!(both.contains("--twist-topic /odom") && !both.contains("cmd_vel"), "{both}");
        // a driver's odometry, whatever else is in its name
        let named = topic("/cmd_odom", "geometry_msgs/msg/TwistStamped");
        let named = offer(&[named]).expect("an offer");
        assert!(named.contains("by --twist-topic /cmd_odom --separation METRES"), "{named}");
    }

    #[test]
    fn a_topic_needs_a_separation() {
        let mut options =
            RosbagOptions { twist_topic: Some("/odom".to_owned()), ..RosbagOptions::default() };
        for separation in [None, Some(0.0), Some(f64::NAN)] {
            options.separation = separation;
            let refused = effective(Path::new("a.mcap"), &options).expect_err("refused");
            assert!(refused.to_string().contains("--separation METRES"), "{refused}");
        }
        options.separation = Some(0.6);
        let effective = effective(Path::new("a.mcap"), &options).expect("accepted");
        assert_eq!((effective.wheel_radius, effective.left_joints.len()), (Some(1.0), 1));
    }
}
