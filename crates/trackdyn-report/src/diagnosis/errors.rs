//! Errors before and after against the floor of the noise.

use super::sheet::{self, AFTER_COLOUR, BEFORE_COLOUR};
use super::words::CHANNELS;
use super::{Subject, View};
use crate::colour::Rgb;
use crate::figure::{
    Area, Axis, Boxes, Figure, Label, Legend, Paint, Panel, Rule, Swatch, entry_colour,
};
use crate::text::{Horizontal, LABEL_SIZE, Style, TICK_SIZE, Vertical, fitted, width};
use crate::ticks::number;
use trackdyn_core::real;
use trackdyn_diagnose::evidence::{Origin, Sample};
use trackdyn_diagnose::locate::excess_of;

const HEIGHT: i32 = 1000;
const TOP: i32 = sheet::TOP + 130;
const FLOOR: Rgb = [120, 120, 120];
/// Runs that have a place of their own, at most.
const MAX_RUNS: usize = 40;
/// Places whose bars have numbers, at most.
const MAX_NUMBERED_PLACES: usize = 4;

/// Places of the groups with and without that of the runs.
const NARROW_PLACES: [Area; 3] =
    [Area::new(158, TOP, 500, 480), Area::new(838, TOP, 560, 480), Area::new(1578, TOP, 760, 480)];
const WIDE_PLACES: [Area; 2] = [Area::new(158, TOP, 900, 480), Area::new(1238, TOP, 1100, 480)];

/// Places with their bars.
struct Bars {
    title: String,
    places: Vec<(String, Vec<(Rgb, f64)>)>,
}

/// The error on the runs that judge, by channel and run by run.
pub(super) fn figure(subject: &Subject) -> Figure {
    let fit = &subject.diagnosis.evidence.errors;
    let explanation = "Root mean square of the residuals in standard deviations of the noise. \
                       Floor: what is left when everything that could move ICRs or instruments, \
                       known or not, is fitted away.";
    let title = if fit.are_held_out {
        "Error where nothing was fitted or chosen"
    } else {
        "Error on what was fitted (nothing was held out)"
    };
    let mut figure = sheet::sheet("errors", HEIGHT, title, explanation, subject.caption);
    let [before, after] = [BEFORE_COLOUR, AFTER_COLOUR].map(entry_colour);
    let entries = [
        (Swatch::Box(before), "before"),
        (Swatch::Box(after), "after"),
        (Swatch::Box(FLOOR), "noise floor"),
    ];
    figure.legends.push(Legend::of_marks([158, sheet::TOP + 20], sheet::RIGHT, entries));
    let which = if fit.are_held_out { "held-out" } else { "all" };
    let what = subject.evidence().origin().runs();
    let place = |text: &str, bars: Vec<(Rgb, f64)>| (text.to_owned(), bars);
    let whole = Bars {
        title: format!("{which} {what}"),
        places: vec![
            place("before", vec![(before, fit.before)]),
            place("after", vec![(after, fit.after)]),
            place("floor", vec![(FLOOR, fit.noise_floor)]),
        ],
    };
    let View { evidence, residuals, .. } = subject.judging();
    let channels = Bars {
        title: "by channel".to_owned(),
        places: (0..3)
            .map(|channel| {
                if !(0..evidence.samples().len()).any(|index| evidence.is_measured(index, channel))
                {
                    return (format!("{}: not measured", CHANNELS[channel]), Vec::new());
                }
                let of = |_: &Sample, one| one == channel;
                let [a, b] = residuals.map(|residual| excess_of(evidence, residual, of));
                place(CHANNELS[channel], vec![(before, a), (after, b)])
            })
            .collect(),
    };
    let runs = runs(subject, [before, after]);
    let areas =
        if runs.places.is_empty() { WIDE_PLACES.as_slice() } else { NARROW_PLACES.as_slice() };
    for (area, bars) in areas.iter().zip([whole, channels, runs]) {
        figure.panels.push(group(*area, &bars, fit.noise_floor));
    }
    let text = match fit.excess_explained() {
        Some(share) => format!(
            "{} % of the excess over the noise floor is explained.",
            number(100.0 * share, 1)
        ),
        None => "There is no excess over the noise floor to explain.".to_owned(),
    };
    figure.write(text, [158, HEIGHT - 106], Style::new(LABEL_SIZE));
    figure
}

/// Before and after of every run; none where there are too many.
fn runs(subject: &Subject, colours: [Rgb; 2]) -> Bars {
    let names = subject.evidence().runs();
    let mut bars = Bars { title: "run by run (* held out)".to_owned(), places: Vec::new() };
    let is_table = matches!(subject.evidence().origin(), Origin::SteadyPoints(_));
    if is_table || names.len() > MAX_RUNS {
        return bars;
    }
    for (run, name) in names.iter().enumerate() {
        for View { evidence, residuals, is_held_out } in subject.views() {
            let of = |sample: &Sample, _| sample.run == run;
            if !evidence.samples().iter().any(|sample| sample.run == run) {
                continue;
            }
            let values = residuals.map(|residual| excess_of(evidence, residual, of));
            let star = if is_held_out { "*" } else { "" };
            bars.places.push((format!("{name}{star}"), colours.into_iter().zip(values).collect()));
        }
    }
    bars
}

fn group(area: Area, bars: &Bars, floor: f64) -> Panel {
    let all = bars.places.iter().flat_map(|(_, bars)| bars).map(|(_, value)| *value);
    let highest = 1.12 * all.filter(|value| value.is_finite()).fold(floor.max(1.0), f64::max);
    let x = Axis::unmarked([0.0, real(bars.places.len())]).at(names(bars, area)).without_grid();
    let y = Axis::new("rms residual", "σ", [0.0, highest]);
    let mut panel = Panel::new(&bars.title, area, x, y);
    let (mut boxes, mut colours) = (Vec::new(), Vec::new());
    for (place, (_, values)) in bars.places.iter().enumerate() {
        let width = 0.7 / real(values.len().max(1));
        for (k, (colour, value)) in values.iter().enumerate() {
            let left = real(place) + 0.15 + width * real(k);
            let right = left + 0.94 * width;
            boxes.push([[left, 0.0], [right, value.min(highest)]]);
            colours.push(*colour);
            if bars.places.len() <= MAX_NUMBERED_PLACES {
                let style = Style::new(20.0).anchor(Horizontal::Centre, Vertical::Baseline);
                let at = [f64::midpoint(left, right), value.min(highest)];
                let text = number(*value, if *value < 10.0 { 3 } else { 1 });
                panel.labels.push(Label::new(text, at, style).shifted([0, -8]));
            }
        }
    }
    panel.show_as(&bars.title, Boxes::new(boxes, Paint::Each(colours)));
    panel.show_as("noise floor", Rule::level(floor, 3.0, FLOOR).dashed());
    panel
}

/// Names of the places, as many as there is room for.
fn names(bars: &Bars, area: Area) -> Vec<(f64, String)> {
    const GAP: i32 = 10;
    let count = bars.places.len().max(1);
    let pitch = area.width / sheet::rows(count);
    let widest = bars.places.iter().map(|(name, _)| width(name, TICK_SIZE)).max().unwrap_or(0);
    let is_crowded = count > MAX_NUMBERED_PLACES && widest + GAP > pitch;
    let each = if is_crowded { (widest + GAP).div_euclid(pitch.max(1)) + 1 } else { 1 };
    let names = bars.places.iter().enumerate().step_by(each.unsigned_abs() as usize);
    let room = pitch * each - GAP;
    names.map(|(place, (name, _))| (real(place) + 0.5, fitted(name, TICK_SIZE, room))).collect()
}
