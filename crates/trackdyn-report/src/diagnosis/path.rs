//! One run replayed: dead reckoning with the model as filed and as corrected.

use super::sheet::{self, AFTER_COLOUR, BEFORE_COLOUR};
use super::{Subject, View};
use crate::colour::INK;
use crate::figure::{Area, Axis, Figure, Legend, Line, Panel, Swatch, around, entry_colour};
use crate::paths::{self, Named};
use crate::ticks::number;
use std::ops::Range;
use trackdyn_core::Pose;
use trackdyn_diagnose::evidence::{Origin, Sample};
use trackdyn_diagnose::replay;

const HEIGHT: i32 = 1380;
const PATHS: Area = Area::new(158, sheet::TOP + 130, 960, 900);
const ERRORS: [Area; 2] =
    [Area::new(1310, sheet::TOP + 130, 1030, 360), Area::new(1310, sheet::TOP + 670, 1030, 360)];

/// Longest time that is replayed, s: later the paths only cross themselves.
const MAX_TIME: f64 = 60.0;
/// What is replayed.
const NAMES: [&str; 2] = ["as filed", "corrected"];

/// A run, or a piece of one, as observed and as replayed, from one start.
struct Replay {
    run: i64,
    is_held_out: bool,
    times: Vec<f64>,
    observed: Vec<Pose>,
    /// Before and after; empty without a motion.
    replayed: [Vec<Pose>; 2],
}

/// A piece of the log, replayed.
pub(super) struct Piece {
    /// Index of its run in the evidence.
    pub run: usize,
    /// When it begins, s since the recording began.
    pub start: f64,
    /// Its paths.
    pub figure: Figure,
}

/// The paths and their errors; none where there are no paths.
pub(super) fn figure(subject: &Subject) -> Option<Figure> {
    let view = subject.judging();
    let chosen = longest(&view)?;
    let replays = Replays::of(subject, view);
    Some(drawn(subject, &replays.replay(chosen, 1)))
}

/// The whole log in pieces of at most [`MAX_TIME`], each replayed from where it begins; of the
/// poses one in `each`.
pub(super) fn pieces(subject: &Subject, each: usize) -> Vec<Piece> {
    let mut pieces = Vec::new();
    if matches!(subject.evidence().origin(), Origin::SteadyPoints(_)) {
        return pieces;
    }
    for view in subject.views() {
        let samples = view.evidence.samples();
        let replays = Replays::of(subject, view);
        let mut first = 0;
        while first < samples.len() {
            let chosen = piece(samples, first);
            let Sample { run, start, .. } = samples[first];
            first = chosen.end;
            let figure = drawn(subject, &replays.replay(chosen, each));
            pieces.push(Piece { run, start, figure });
        }
    }
    pieces.sort_by(|a, b| a.run.cmp(&b.run).then(a.start.total_cmp(&b.start)));
    pieces
}

/// The samples from one on that are of its run and not too late to be replayed with it.
fn piece(samples: &[Sample], first: usize) -> Range<usize> {
    let Sample { run, start, .. } = samples[first];
    let inside = |sample: &&Sample| sample.run == run && sample.start - start < MAX_TIME;
    first..first + samples[first..].iter().take_while(inside).count().max(1)
}

/// The first piece of the longest of the held-out runs, or of all where none was held out.
fn longest(view: &View) -> Option<Range<usize>> {
    let evidence = view.evidence;
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
    Some(piece(samples, first))
}

/// Evidence with the motions that both vehicle files predict, where they have one.
struct Replays<'a> {
    view: View<'a>,
    motions: [Option<Vec<Pose>>; 2],
}

impl<'a> Replays<'a> {
    fn of(subject: &Subject, view: View<'a>) -> Self {
        let motions = [subject.vehicle, &subject.diagnosis.answer.corrected]
            .map(|file| replay::motions(view.evidence, file));
        Self { view, motions }
    }

    /// Some samples in a row, every so many of their poses.
    fn replay(&self, chosen: Range<usize>, each: usize) -> Replay {
        let View { evidence, is_held_out, .. } = self.view;
        let first = &evidence.samples()[chosen.start];
        let times = replay::times(evidence, chosen.clone());
        let times: Vec<f64> = times.iter().map(|time| time - first.start).collect();
        let observed = replay::observed(evidence, chosen.clone());
        let chained =
            |motions: &Vec<Pose>| every(&replay::chained(evidence, chosen.clone(), motions), each);
        let replayed = self.motions.each_ref().map(|of| of.as_ref().map_or_else(Vec::new, chained));
        Replay {
            run: evidence.runs()[first.run],
            is_held_out,
            times: every(&times, each),
            observed: every(&observed, each),
            replayed,
        }
    }
}

/// Every so many of some values, and the last one.
fn every<T: Copy>(values: &[T], each: usize) -> Vec<T> {
    let last = values.len().saturating_sub(1);
    let kept = values.iter().enumerate().filter(|(k, _)| k % each == 0 || *k == last);
    kept.map(|(_, value)| *value).collect()
}

fn drawn(subject: &Subject, replay: &Replay) -> Figure {
    let held_out = if replay.is_held_out { ", held out of the fit" } else { "" };
    let title = format!("Dead reckoning of run {}{held_out}", replay.run);
    let moves = |entry: &usize| !replay.replayed[*entry].is_empty();
    let stops: Vec<&str> = [BEFORE_COLOUR, AFTER_COLOUR]
        .into_iter()
        .filter(|entry| !moves(entry))
        .map(|entry| NAMES[entry])
        .collect();
    let stops = if stops.is_empty() {
        String::new()
    } else {
        format!(" The vehicle {} tips over, or no forces balance.", stops.join(" and "))
    };
    let explanation = format!(
        "Where the recorded track speeds alone lead, from the first observed pose on: with the \
         vehicle file as it is, and as the diagnosis corrects it, each at the clock offset that \
         suits its turning best.{stops}"
    );
    let mut figure = sheet::sheet("path", HEIGHT, &title, &explanation, subject.caption);
    let line = |entry: usize| (Swatch::Line(entry_colour(entry), 5.0), NAMES[entry]);
    let models = [BEFORE_COLOUR, AFTER_COLOUR].into_iter().filter(moves).map(line);
    let entries = std::iter::once((Swatch::Line(INK, 8.0), "observed"));
    let entries = entries.chain(models).chain([(Swatch::ring(), "start")]);
    figure.legends.push(Legend::of_marks([158, sheet::TOP + 20], sheet::RIGHT, entries));
    figure.panels.push(paths(replay));
    let distance = |a: &Pose, b: &Pose| (a.x - b.x).hypot(a.y - b.y);
    let turn = |a: &Pose, b: &Pose| a.relative(b).yaw.to_degrees();
    figure.panels.push(errors(ERRORS[0], ["Error of place", "m"], replay, distance));
    figure.panels.push(errors(ERRORS[1], ["Error of heading", "°"], replay, turn));
    figure
}

fn paths(replay: &Replay) -> Panel {
    let points = |poses: &[Pose]| poses.iter().map(|pose| [pose.x, pose.y]).collect::<Vec<_>>();
    let further = replay.replayed.iter().flat_map(|path| points(path));
    let ranges = around(PATHS, points(&replay.observed), further);
    let paths = replay.replayed.iter().map(|path| points(path));
    let paths: Vec<Named> = NAMES.into_iter().zip(paths).collect();
    let mut panel = paths::panel(PATHS, ranges, ("observed", points(&replay.observed)), &paths);
    let length: f64 = replay
        .observed
        .windows(2)
        .map(|pair| (pair[1].x - pair[0].x).hypot(pair[1].y - pair[0].y))
        .sum();
    let time = replay.times.last().copied().unwrap_or(0.0);
    panel.remark = format!("{} m in {} s", number(length, 1), number(time, 0));
    panel
}

fn errors(
    place: Area,
    [title, unit]: [&str; 2],
    replay: &Replay,
    of: impl Fn(&Pose, &Pose) -> f64,
) -> Panel {
    let errors = replay.replayed.each_ref().map(|path| -> Vec<f64> {
        path.iter().zip(&replay.observed).map(|(path, observed)| of(observed, path)).collect()
    });
    let all = || errors.iter().flatten().copied().filter(|error| error.is_finite());
    let (low, high) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let room = 0.06 * (high - low).max(1e-6);
    let low = if low < 0.0 { low - room } else { 0.0 };
    let end = replay.times.last().copied().unwrap_or(1.0).max(1e-3);
    let y = Axis::new("error", unit, [low, high + room]);
    let mut panel = Panel::new(title, place, Axis::new("time", "s", [0.0, end]), y);
    for (entry, errors) in errors.iter().enumerate() {
        let points = replay.times.iter().zip(errors).map(|(time, error)| [*time, *error]).collect();
        let line = Line { points, thickness: 4.0, colour: entry_colour(entry) };
        panel.show_as(NAMES[entry], line);
    }
    let last = NAMES.iter().zip(&errors).filter_map(|(name, errors)| {
        let last = errors.last()?;
        Some(format!("{} {unit} {name}", number(*last, 2)))
    });
    let last: Vec<String> = last.collect();
    if !last.is_empty() {
        panel.remark = format!("at the end {}", last.join(", "));
    }
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An error of zero would be that of a perfect vehicle.
    #[test]
    fn a_vehicle_without_a_path_has_no_error() {
        let path = [0.0, 1.0].map(|x| Pose::new(x, 0.0, 0.0)).to_vec();
        let replay = |replayed| Replay {
            run: 0,
            is_held_out: false,
            times: vec![0.0, 1.0],
            observed: [0.0, 1.5].map(|x| Pose::new(x, 0.0, 0.0)).to_vec(),
            replayed,
        };
        let remark = |replayed| {
            let far = |a: &Pose, b: &Pose| (a.x - b.x).abs();
            errors(ERRORS[0], ["Error of place", "m"], &replay(replayed), far).remark
        };
        let both = remark([path.clone(), path.clone()]);
        assert_eq!(both, "at the end 0.50 m as filed, 0.50 m corrected");
        assert_eq!(remark([Vec::new(), path]), "at the end 0.50 m corrected");
        assert_eq!(remark([Vec::new(), Vec::new()]), "");
    }
}
