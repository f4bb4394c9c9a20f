//! Command lines for a user to copy.

use trackdyn::crates::core::rounding::Digits;
use trackdyn::recording::{Dating, JointSignal, PoseAxes, PoseUnit, SpeedUnit};
use trackdyn::{Part, ReadOptions};

/// A word as a POSIX shell takes it for one: quoted where it has to be.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:=,@%+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// A path as an argument: one that begins with a hyphen is no option.
pub fn path(path: &std::path::Path) -> String {
    let text = path.display().to_string();
    quoted(&if text.starts_with('-') { format!("./{text}") } else { text })
}

/// An option with its value.
pub fn option(name: &str, value: &str) -> String {
    format!("--{name} {}", quoted(value))
}

/// The options that read a recording so; a wheel radius that has to be given and is not stands as
/// METRES.
pub fn reading(options: &ReadOptions, needs_radius: bool) -> Vec<String> {
    let bag = &options.bag;
    let mut words = Vec::new();
    let mut add = |name: &str, value: Option<&str>| {
        words.extend(value.map(|value| option(name, value)));
    };
    let tracks = options.tracks.as_ref().map(|path| path.display().to_string());
    add("tracks", tracks.as_deref());
    let columns = options.columns.as_ref().map(ToString::to_string);
    add("columns", columns.as_deref());
    add("tracks-topic", bag.tracks_topic.as_deref());
    for joint in &bag.left_joints {
        add("left-joint", Some(joint));
    }
    for joint in &bag.right_joints {
        add("right-joint", Some(joint));
    }
    add(
        "joint-signal",
        match bag.joint_signal {
            JointSignal::Any => None,
            JointSignal::Velocity => Some("velocity"),
            JointSignal::Position => Some("position"),
        },
    );
    for signal in &bag.left_signals {
        add("left-signal", Some(signal));
    }
    for signal in &bag.right_signals {
        add("right-signal", Some(signal));
    }
    add("speed-unit", bag.speed_unit.map(SpeedUnit::name));
    let messages = bag.msg_dir.as_ref().map(|path| path.display().to_string());
    add("msg-dir", messages.as_deref());
    add("twist-topic", bag.twist_topic.as_deref());
    let separation = bag.separation.map(|separation| separation.to_string());
    let needs_separation = bag.twist_topic.is_some().then_some("METRES");
    add("separation", separation.as_deref().or(needs_separation));
    let radius = bag.wheel_radius.map(|radius| radius.to_string());
    add("wheel-radius", radius.as_deref().or(needs_radius.then_some("METRES")));
    add("pose-topic", bag.pose_topic.as_deref());
    let index = bag.pose_index.map(|index| index.to_string());
    add("pose-index", index.as_deref());
    add("parent-frame", bag.parent_frame.as_deref());
    add("child-frame", bag.child_frame.as_deref());
    add("imu-topic", bag.imu_topic.as_deref());
    add(
        "dated-by",
        match bag.dated_by {
            Dating::Any => None,
            Dating::Header => Some("header"),
            Dating::Log => Some("log"),
        },
    );
    let unit = bag.pose_unit;
    add("pose-unit", (unit != PoseUnit::Metres).then_some(unit.name()));
    add("pose-axes", (bag.pose_axes != PoseAxes::Ros).then_some(bag.pose_axes.name()));
    let yaw = bag.mount_yaw.map(|yaw| degrees(yaw).to_string());
    add("mount-yaw", yaw.as_deref());
    add("gyro-unit", bag.gyro_in_degrees.then_some("deg/s"));
    for doubt in &bag.accepted {
        add("accept", Some(doubt.name()));
    }
    words
}

/// An angle in degrees as it was typed: without what its way to radians and back adds.
fn degrees(angle: f64) -> f64 {
    Digits::Decimals(9).round(angle.to_degrees())
}

/// The options that take a part of a recording.
pub fn part(part: &Part) -> Vec<String> {
    let runs = part.runs.as_ref().map(|runs| option("runs", &runs.to_string()));
    let time = part.time.map(|[from, until]| option("time", &format!("{from},{until}")));
    runs.into_iter().chain(time).collect()
}

/// A command line in as many lines as it needs, each but the last with a backslash at its end.
pub fn command(words: &[String], width: usize) -> String {
    let mut lines = vec![String::new()];
    for word in words {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line > 0 && line + word.chars().count() + 3 > width {
            lines.push("    ".to_owned());
        }
        if let Some(line) = lines.last_mut() {
            if !line.trim().is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join(" \\\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_a_shell() {
        assert_eq!(quoted("/joint_states"), "/joint_states");
        assert_eq!(quoted("my drive"), "'my drive'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted("$(rm)"), "'$(rm)'");
        assert_eq!(quoted("~"), "'~'");
        assert_eq!(quoted(""), "''");
        assert_eq!(path(std::path::Path::new("-x.mcap")), "./-x.mcap");
    }

    #[test]
    fn angles_come_back_as_they_were_typed() {
        for typed in [24.0, -0.1, 180.0, 1.0 / 3.0] {
            let shown = degrees(f64::to_radians(typed)).to_string();
            assert!(shown.len() <= 12, "{shown}");
            assert!((shown.parse::<f64>().expect("a number") - typed).abs() < 1e-9, "{shown}");
        }
        assert_eq!(degrees(24.0_f64.to_radians()).to_string(), "24");
    }

    #[test]
    fn long_commands_go_on_behind_a_backslash() {
        let words: Vec<String> = (0..9).map(|k| format!("--option-{k} value")).collect();
        let text = command(&words, 40);
        assert!(text.lines().count() > 2 && text.lines().all(|line| line.len() <= 40), "{text}");
        let back: Vec<&str> = text.split_whitespace().filter(|word| *word != "\\").collect();
        assert_eq!(back.join(" "), words.join(" "));
    }
}
