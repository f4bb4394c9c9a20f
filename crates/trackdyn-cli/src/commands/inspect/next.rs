//! The commands to go on with.

use crate::options::GaugeOptions;
use crate::shell::{self, command, option, part, path};
use crate::wrapped::{WIDTH, wrapped};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use trackdyn::Inspection;
use trackdyn::Part;
use trackdyn::inspect::{Content, Lack, Use};

/// What a user asked for, which the commands repeat.
pub struct Asked<'a> {
    /// The recording.
    pub path: &'a Path,
    /// The vehicle, or its gauge.
    pub gauge: &'a GaugeOptions,
    /// The part of the recording.
    pub part: &'a Part,
    /// The clock offset, s.
    pub tau: Option<f64>,
    /// The folder for what is written.
    pub out: &'a Path,
}

/// The commands that this recording is good for, with the options that it needs.
pub fn text(found: &Inspection, asked: &Asked) -> String {
    let commands = commands(found, asked);
    if commands.is_empty() {
        return String::new();
    }
    let mut text = String::from("\ngo on with\n");
    for command in &commands {
        let _ = writeln!(text, "  {}", command.replace('\n', "\n  "));
    }
    let has = |word: &str| commands.iter().any(|command| command.contains(word));
    if has("--separation METRES") {
        text += &wrapped("  METRES        ", "the separation that the driver of the twist uses");
    } else if has("METRES") {
        text +=
            &wrapped("  METRES        ", "the wheel radius: belt travel per radian of the joints");
    }
    if has("LEFT") {
        let joints = joints(found).collect::<Vec<_>>().join(", ");
        let text_of = format!("a joint of that side, each repeatable, of {joints}");
        text += &wrapped("  LEFT, RIGHT   ", &text_of);
    }
    if has("VEHICLE.toml") {
        let made = "a vehicle file: trackdyn init writes one from a few measured numbers; identify \
                    and odometry need its gauge only (--gauge, in m)";
        text += &wrapped("  VEHICLE.toml  ", made);
    }
    if has("TRACKS.csv") {
        text += &wrapped("  TRACKS.csv    ", "the track speeds, t,v_left,v_right in s and m/s");
    }
    text
}

/// Whether it is a bag with joints of which no side is known.
fn has_unnamed_sides(found: &Inspection) -> bool {
    let bag = &found.options.bag;
    let names = [&bag.left_joints, &bag.right_joints, &bag.left_signals, &bag.right_signals];
    let asks_for_joints =
        matches!(&found.content, Content::Unread(reason) if reason.contains("-joint"));
    asks_for_joints
        && names.into_iter().all(Vec::is_empty)
        && bag.twist_topic.is_none()
        && joints(found).next().is_some()
}

/// The joints of a bag.
fn joints(found: &Inspection) -> impl Iterator<Item = &str> {
    let names = found.topics.iter().flat_map(|topic| &topic.joints).map(String::as_str);
    names.collect::<BTreeSet<_>>().into_iter()
}

fn commands(found: &Inspection, asked: &Asked) -> Vec<String> {
    let recording = path(asked.path);
    if matches!(found.content, Content::Poses(_)) {
        let words = ["trackdyn inspect".to_owned(), recording, option("tracks", "TRACKS.csv")];
        return vec![command(&words, WIDTH)];
    }
    let needs_radius = found.lacks.iter().any(|lack| matches!(lack, Lack::WheelRadius { .. }));
    let reading = shell::reading(&found.options, needs_radius);
    let bag = &found.options.bag;
    if matches!(found.content, Content::Unread(_))
        && bag.twist_topic.is_some()
        && bag.separation.is_none()
        && !found.lacks.contains(&Lack::Poses)
    {
        let words = ["trackdyn inspect".to_owned(), recording];
        return vec![command(&words.into_iter().chain(reading).collect::<Vec<_>>(), WIDTH)];
    }
    if !found.choices.is_empty() || has_unnamed_sides(found) {
        let line = |options: &[String]| {
            let words = ["trackdyn inspect".to_owned(), recording.clone()];
            command(&words.into_iter().chain(options.iter().cloned()).collect::<Vec<_>>(), WIDTH)
        };
        let sides = [option("left-joint", "LEFT"), option("right-joint", "RIGHT")];
        return match found.choices.as_slice() {
            [] => vec![line(&sides.into_iter().chain(reading).collect::<Vec<_>>())],
            choices => choices.iter().map(|of| line(&shell::reading(of, false))).collect(),
        };
    }
    let tau = asked.tau.map(|tau| option("tau", &tau.to_string()));
    let open = || "--vehicle VEHICLE.toml".to_owned();
    let vehicle = asked.gauge.vehicle_option().unwrap_or_else(open);
    let gauge = asked.gauge.gauge_option().unwrap_or_else(|| vehicle.clone());
    let is_ready = |what: Use| found.readiness.iter().any(|of| of.what == what && of.is_ready());
    let is_split = is_ready(Use::Identify) && is_ready(Use::Odometry);
    let parts = found.parts.as_ref().filter(|_| is_split);
    let of_part = |place: usize| part(parts.map_or(asked.part, |parts| &parts[place]));
    let line = |what: Use, further: &[Vec<String>]| {
        let mut words = vec![format!("trackdyn {}", what.command()), recording.clone()];
        words.extend(reading.iter().cloned());
        words.push(if what == Use::Diagnose { vehicle.clone() } else { gauge.clone() });
        words.extend(further.iter().flatten().cloned());
        command(&words, WIDTH)
    };
    let given_tau: Vec<String> = tau.into_iter().collect();
    let out = |is_default: bool, folder: &Path| {
        if is_default { Vec::new() } else { vec![format!("--out {}", path(folder))] }
    };
    let is_default = asked.out == Path::new("out");
    let mut commands = Vec::new();
    let is_identified = is_ready(Use::Identify);
    if is_identified {
        let further = [of_part(0), given_tau.clone(), out(is_default, asked.out)];
        commands.push(line(Use::Identify, &further));
    }
    if is_ready(Use::Odometry) {
        let files = found.readiness.iter().flat_map(|of| &of.files);
        let files = files.map(|name| path(&asked.out.join(name)));
        let kinematics = files.map(|file| format!("--kinematics {file}")).collect();
        let further = [of_part(1), given_tau, kinematics, out(is_default, asked.out)];
        commands.push(line(Use::Odometry, &further));
    }
    if is_ready(Use::Diagnose) {
        let folder = asked.out.join("diagnosis");
        let serves =
            matches!(&found.content, Content::Motion(of) if matches!(of.gyroscope, Some(Ok(_))));
        let gyroscope = serves.then(|| "--gyroscope".to_owned()).into_iter().collect();
        commands.push(line(Use::Diagnose, &[gyroscope, out(is_default, &folder)]));
    }
    commands
}
