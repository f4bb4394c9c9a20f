//! The judgement of a recording as text: one screen.

use crate::wrapped::wrapped;
use std::f64::consts::TAU;
use std::fmt::Write;
use trackdyn::Inspection;
use trackdyn::crates::core::lines::counted;
use trackdyn::inspect::{Content, Driving, Lack, Rows, Verdict};
use trackdyn::recording::{PointsTable, Topic};

/// Topics of no use that are named.
const MAX_OTHER_TOPICS: usize = 12;

/// What is there, what it is good for, what looks wrong, what it lacks.
pub fn text(found: &Inspection) -> String {
    let mut text = heading(found);
    let vehicle = found.gauge.as_ref().map_or_else(
        || "not given: ICRs are not compared with its gauge".to_owned(),
        |of| {
            let name = of.vehicle().strip_prefix("vehicle ").unwrap_or(of.vehicle());
            format!("{name}, gauge {} m", of.metres())
        },
    );
    text += &wrapped("vehicle: ", &vehicle);
    topics(&mut text, &found.topics);
    match &found.content {
        Content::Motion(driving) => motion(&mut text, found, driving),
        Content::Points(table) => points(&mut text, table),
        Content::Poses(poses) => {
            text += "\nwhat is there\n";
            let [first, last] = poses.stamps;
            let _ = writeln!(text, "  poses     {}, t = {first:.3} to {last:.3} s", rows(poses));
        }
        _ => {}
    }
    text += "\nwhat it is good for\n";
    for of in &found.readiness {
        let verdict = match &of.verdict {
            Verdict::Ready => "yes".to_owned(),
            Verdict::Partly(reason) => format!("in part: {reason}"),
            Verdict::No(reason) => format!("no: {reason}"),
        };
        text += &wrapped(&format!("  {:10}", of.what.command()), &verdict);
    }
    if !found.findings.is_empty() {
        text += "\nwhat looks wrong\n";
        for finding in &found.findings {
            text += &wrapped("  - ", &finding.to_string());
        }
    }
    lacks(&mut text, &found.lacks);
    text
}

fn heading(found: &Inspection) -> String {
    let name = &found.name;
    match &found.content {
        Content::Motion(driving) => {
            let Driving { robot, runs, duration, .. } = &**driving;
            let runs = counted(*runs, "run");
            let fingerprint = found.fingerprint.as_deref().unwrap_or_default();
            let line = format!("robot {robot}, {runs}, {duration:.0} s, fingerprint {fingerprint}");
            wrapped(&format!("{name}: "), &line)
        }
        Content::Points(_) => format!("{name}: a table of steady points\n"),
        Content::Poses(_) => format!("{name}: a trajectory\n"),
        _ => format!("{name}: a bag\n"),
    }
}

/// Topics that hold something of use, and the names of some others.
fn topics(text: &mut String, topics: &[Topic]) {
    if topics.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{:>9} {:>9}  {:30} type", "messages", "seconds", "topic");
    let (of_use, others): (Vec<&Topic>, Vec<&Topic>) =
        topics.iter().partition(|topic| topic.role.is_some());
    for topic in of_use {
        let (count, seconds) = (topic.messages, topic.duration);
        let _ = writeln!(text, "{count:>9} {seconds:>9.1}  {:30} {}", topic.name, topic.kind);
        if !topic.joints.is_empty() {
            let (joints, signals) = (topic.joints.join(", "), topic.signals.join(", "));
            *text += &wrapped(&format!("{:21}joints: ", ""), &format!("{joints} ({signals})"));
        }
        if !topic.frames.is_empty() {
            let frames: Vec<String> =
                topic.frames.iter().map(|(parent, child)| format!("{parent} -> {child}")).collect();
            *text += &wrapped(&format!("{:21}frames: ", ""), &frames.join(", "));
        }
    }
    if !others.is_empty() {
        let named = others.iter().take(MAX_OTHER_TOPICS);
        let mut names: Vec<String> =
            named.map(|topic| format!("{} ({})", topic.name, topic.kind)).collect();
        let more = others.len() - names.len();
        if more > 0 {
            names.push(format!("and {more} more"));
        }
        *text += &wrapped("   not of use: ", &names.join(", "));
    }
}

fn motion(text: &mut String, found: &Inspection, driving: &Driving) {
    *text += "\nwhat is there\n";
    let is_known = !found.lacks.iter().any(|lack| matches!(lack, Lack::WheelRadius { .. }));
    let of_length = |text: String| if is_known { text } else { String::new() };
    let fastest = of_length(format!(", up to {:.2} m/s", driving.fastest));
    let _ = writeln!(text, "  tracks    {}{fastest}", rows(&driving.tracks));
    let way =
        of_length(format!("; {:.0} m, {:.0} m of it straight", driving.distance, driving.straight));
    let turns = driving.turned.map(|angle| (angle / TAU).max(0.0));
    let spins = driving.spun.map(|angle| (angle / TAU).max(0.0));
    let kind = if driving.has_positions { "" } else { " (yaw alone)" };
    let _ = writeln!(text, "  poses     {}{kind}", rows(&driving.poses));
    let _ = writeln!(text, "  gyro      {}", rows(&driving.imu));
    match &driving.gyroscope {
        Some(Ok(found)) => *text += &wrapped("            ", &found.to_string()),
        Some(Err(reason)) => {
            *text += &wrapped("            ", &format!("it does not serve beside poses: {reason}"));
        }
        None => {}
    }
    *text += &wrapped(
        "  driving   ",
        &format!(
            "{} segments{way}; {:.1} turns left and {:.1} right, on the spot {:.1} and {:.1}; \
             {:.0} s at rest",
            driving.segments, turns.left, turns.right, spins.left, spins.right, driving.standing
        ),
    );
    if let Ok(clock) = &driving.clock {
        *text +=
            &wrapped("  clock     ", &late(clock.tau(), clock.standard_error(), clock.reason()));
    }
    if let Ok(separation) = driving.separation.as_ref().map(|of| of.gap) {
        let (value, half) = (separation.value, separation.half_width());
        let _ = if is_known {
            writeln!(
                text,
                "  turning   x_r - x_l = {value:.3} m ({:.3} to {:.3} m, 95 %), by yaw alone",
                separation.low, separation.high
            )
        } else {
            let percent = 100.0 * half / value;
            writeln!(
                text,
                "  turning   x_r - x_l known to {percent:.2} %, once the wheel radius is"
            )
        };
    }
    for taken in &found.taken {
        *text += &wrapped("  taken     ", taken);
    }
}

/// A table of operating points: its speeds, and what was measured.
fn points(text: &mut String, table: &PointsTable) {
    let points = table.points();
    let count = |of: Vec<Option<f64>>| of.into_iter().flatten().count();
    let _ = writeln!(
        text,
        "\nwhat is there\n  {} steady operating points; measured: {} forward speeds, {} lateral \
         speeds, {} yaw rates",
        points.len(),
        count(points.iter().map(|point| point.v_forward).collect()),
        count(points.iter().map(|point| point.v_lateral).collect()),
        count(points.iter().map(|point| point.yaw_rate).collect())
    );
    for (side, speeds) in [
        ("left", points.iter().map(|point| point.v_left).collect::<Vec<_>>()),
        ("right", points.iter().map(|point| point.v_right).collect()),
    ] {
        let low = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let high = speeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let _ = writeln!(text, "  {side} track {low:.3} to {high:.3} m/s");
    }
    *text += &crate::commands::identify::lagging_points(points);
}

/// How late poses are, s, with the standard error; or why that is not known.
fn late(tau: f64, error: Option<f64>, unknown: Option<&str>) -> String {
    if let Some(reason) = unknown {
        return format!("taken as equal: {reason}");
    }
    let error = match error {
        Some(error) if error.is_finite() => format!(" (standard error {error:.3} s)"),
        Some(_) => " (its error is not known)".to_owned(),
        None => String::new(),
    };
    format!("poses come {tau:.3} s after the tracks{error}")
}

fn rows(rows: &Rows) -> String {
    match rows.count {
        0 => "none".to_owned(),
        1 => "1".to_owned(),
        count => format!("{count}, one every {:.3} s", rows.interval),
    }
}

fn lacks(text: &mut String, lacks: &[Lack]) {
    if lacks.is_empty() {
        return;
    }
    *text += "\nwhat it lacks (docs/recording.md: how to record)\n";
    for lack in lacks {
        *text += &wrapped("  - ", &format!("{lack}: {}", lack.advice()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_is_not_known_is_no_number() {
        assert_eq!(
            late(0.1, Some(f64::INFINITY), None),
            "poses come 0.100 s after the tracks (its error is not known)"
        );
        assert!(late(0.1, Some(0.02), None).ends_with("(standard error 0.020 s)"));
    }
}
