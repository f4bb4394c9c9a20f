//! One run replayed: dead reckoning with the model as filed and as corrected.

use super::sheet::{self, AFTER, BEFORE, Mark};
use super::{Subject, View};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{INK, WHITE};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{Labels, Panel};
use nalgebra::Vector3;
use trackdyn_core::Pose;
use trackdyn_diagnose::Evidence;
use trackdyn_diagnose::evidence::Origin;
use trackdyn_diagnose::hypothesis::Hypothesis;
use trackdyn_diagnose::mechanics::{Instruments, Mechanics};
use trackdyn_model::VehicleFile;

const HEIGHT: i32 = 1380;
const PATHS: Area = Area::new(158, sheet::TOP + 130, 960, 900);
const ERRORS: [Area; 2] =
    [Area::new(1310, sheet::TOP + 130, 1030, 360), Area::new(1310, sheet::TOP + 670, 1030, 360)];

/// Longest time that is replayed, s: later the paths only cross themselves.
const LONGEST: f64 = 60.0;

/// A run, as observed and as replayed, from one start.
struct Replay {
    run: i64,
    is_held_out: bool,
    times: Vec<f64>,
    observed: Vec<Pose>,
    /// Before and after.
    replayed: [Vec<Pose>; 2],
}

/// Draws the paths and their errors; none where there are no paths.
pub(super) fn draw(subject: &Subject) -> Result<Option<Vec<u8>>, Error> {
    let Some(replay) = replay(subject) else { return Ok(None) };
    let held_out = if replay.is_held_out { ", held out of the fit" } else { "" };
    let title = format!("Dead reckoning of run {}{held_out}", replay.run);
    let explanation = "Where the recorded track speeds alone lead, from the first observed pose on: with the \
                       vehicle file as it is, and as the diagnosis corrects it. Both use the recording's own \
                       clock offset.";
    let mut canvas = sheet::sheet(HEIGHT, &title, explanation, subject.caption)?;
    let line = |entry| Mark::Line(look::colour(entry), 5.0);
    let entries = [
        (Mark::Line(INK, 8.0), "observed"),
        (line(BEFORE), "as filed"),
        (line(AFTER), "corrected"),
        (Mark::Ring(INK), "start"),
    ];
    sheet::legend(&mut canvas, [158, sheet::TOP + 20], &entries);
    paths(&mut canvas, &replay)?;
    let distance = |a: &Pose, b: &Pose| (a.x - b.x).hypot(a.y - b.y);
    let turn = |a: &Pose, b: &Pose| a.relative(b).yaw.to_degrees();
    let place = Labels { title: "Error of place", x: "time (s)", y: "error (m)" };
    errors(&mut canvas, ERRORS[0], &place, &replay, distance, "m")?;
    let heading = Labels { title: "Error of heading", x: "time (s)", y: "error (°)" };
    errors(&mut canvas, ERRORS[1], &heading, &replay, turn, "°")?;
    canvas.to_small_png().map(Some)
}

/// The longest of the held-out runs, or of all where none was held out.
fn replay(subject: &Subject) -> Option<Replay> {
    let View { evidence, is_held_out, .. } = subject.judging();
    if matches!(evidence.origin(), Origin::SteadyPoints(_)) {
        return None;
    }
    let samples = evidence.samples();
    let time = |run: usize| -> f64 {
        samples.iter().filter(|sample| sample.run == run).map(|sample| sample.duration).sum()
    };
    let run =
        (0..evidence.runs().len()).max_by(|&a, &b| time(a).total_cmp(&time(b)).then(b.cmp(&a)))?;
    let first = samples.iter().position(|sample| sample.run == run)?;
    let start = samples[first].start;
    let count = samples[first..]
        .iter()
        .take_while(|sample| sample.run == run && sample.start - start <= LONGEST)
        .count();
    let chosen = first..first + count;
    let observed = poses(evidence, chosen.clone(), |index| samples[index].motion);
    let replayed = [subject.vehicle, &subject.diagnosis.corrected].map(|file| {
        let motions = motions(evidence, file);
        chained(evidence, chosen.clone(), &observed, &motions)
    });
    let times = chosen.clone().map(|index| samples[index].start - start);
    let last = samples[first + count - 1];
    let times = times.chain([last.start + last.duration - start]).collect();
    Some(Replay { run: evidence.runs()[run], is_held_out, times, observed, replayed })
}

/// The motion of every sample with a vehicle file, moved by the recording's clock where the file says nothing
/// of it.
fn motions(evidence: &Evidence, file: &VehicleFile) -> Vec<Vector3<f64>> {
    let hypothesis = Hypothesis::filed(file);
    let mut instruments = Instruments::of(&hypothesis);
    if instruments.sensor.delay == 0.0 {
        instruments.sensor.delay = evidence.tau();
    }
    Mechanics::new(&hypothesis, evidence).predict(&instruments, evidence)
}

fn pose(motion: &Vector3<f64>) -> Pose {
    Pose::new(motion[0], motion[1], motion[2])
}

/// Observed poses at the beginning of each sample and at the end of the last.
fn poses(
    evidence: &Evidence,
    chosen: std::ops::Range<usize>,
    motion: impl Fn(usize) -> Vector3<f64>,
) -> Vec<Pose> {
    let samples = evidence.samples();
    let mut poses: Vec<Pose> = chosen.clone().map(|index| samples[index].pose).collect();
    if let (Some(last), Some(pose_then)) = (chosen.last(), poses.last().copied()) {
        poses.push(pose_then.compose(&pose(&motion(last))));
    }
    poses
}

/// Predicted motions in a row. Where samples leave a gap, the observed motion bridges it.
fn chained(
    evidence: &Evidence,
    chosen: std::ops::Range<usize>,
    observed: &[Pose],
    motions: &[Vector3<f64>],
) -> Vec<Pose> {
    const GAP: f64 = 1e-6;
    let samples = evidence.samples();
    let Some(mut at) = observed.first().copied() else { return Vec::new() };
    let mut path = vec![at];
    for index in chosen.clone() {
        at = at.compose(&pose(&motions[index]));
        let next = index + 1;
        if chosen.contains(&next)
            && samples[next].start > samples[index].start + samples[index].duration + GAP
        {
            let end = samples[index].pose.compose(&pose(&samples[index].motion));
            at = at.compose(&end.relative(&samples[next].pose));
        }
        path.push(at);
    }
    path
}

fn paths(canvas: &mut Canvas, replay: &Replay) -> Result<(), Error> {
    let points = |poses: &[Pose]| poses.iter().map(|pose| [pose.x, pose.y]).collect::<Vec<_>>();
    let further = replay.replayed.iter().flat_map(|path| points(path));
    let panel = Panel::around(PATHS, points(&replay.observed), further);
    panel.frame(canvas, &Labels { title: "Paths", x: "x (m)", y: "y (m)" }, true)?;
    canvas.clip(PATHS, |canvas| {
        let place = |pose: &Pose| panel.pixel([pose.x, pose.y]);
        look::line(canvas, replay.observed.iter().map(place), 8.0, INK);
        for (entry, path) in replay.replayed.iter().enumerate() {
            look::line(canvas, path.iter().map(place), 4.0, look::colour(entry));
        }
        for (entry, path) in replay.replayed.iter().enumerate() {
            if let Some(end) = path.last() {
                look::marker(canvas, entry, place(end));
            }
        }
        if let (Some(start), Some(end)) = (replay.observed.first(), replay.observed.last()) {
            canvas.disc(place(end), 12.0, INK);
            canvas.disc(place(start), 12.0, WHITE);
            canvas.ring(place(start), 12.0, 4.0, INK);
        }
    });
    panel.border(canvas);
    let length: f64 = replay
        .observed
        .windows(2)
        .map(|pair| (pair[1].x - pair[0].x).hypot(pair[1].y - pair[0].y))
        .sum();
    let time = replay.times.last().copied().unwrap_or(0.0);
    panel.remark(canvas, &format!("{} m in {} s", number(length, 1), number(time, 0)));
    Ok(())
}

fn errors(
    canvas: &mut Canvas,
    area: Area,
    labels: &Labels,
    replay: &Replay,
    of: impl Fn(&Pose, &Pose) -> f64,
    unit: &str,
) -> Result<(), Error> {
    let errors = replay.replayed.each_ref().map(|path| -> Vec<f64> {
        path.iter().zip(&replay.observed).map(|(path, observed)| of(observed, path)).collect()
    });
    let all = || errors.iter().flatten().copied().filter(|error| error.is_finite());
    let (low, high) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let room = 0.06 * (high - low).max(1e-6);
    let low = if low < 0.0 { low - room } else { 0.0 };
    let end = replay.times.last().copied().unwrap_or(1.0).max(1e-3);
    let panel = Panel { plot: area, x: [0.0, end], y: [low, high + room] };
    panel.frame(canvas, labels, true)?;
    canvas.clip(area, |canvas| {
        for (entry, errors) in errors.iter().enumerate() {
            let places =
                replay.times.iter().zip(errors).map(|(time, error)| panel.pixel([*time, *error]));
            look::line(canvas, places, 4.0, look::colour(entry));
        }
    });
    panel.border(canvas);
    let last = errors.each_ref().map(|errors| errors.last().copied().unwrap_or(0.0));
    let text = format!(
        "at the end {} {unit} as filed, {} {unit} corrected",
        number(last[0], 2),
        number(last[1], 2)
    );
    panel.remark(canvas, &text);
    Ok(())
}
