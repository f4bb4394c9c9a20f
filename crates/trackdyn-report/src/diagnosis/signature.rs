//! What was seen against what an effect would change.

use super::Subject;
use super::sheet::{self, quantile, rows};
use super::words::{CHANNELS, id};
use crate::colour::{GREY, INK, Rgb};
use crate::figure::{
    Area, Axis, Estimates, Figure, Label, Legend, Line, Marker, Panel, Points, Swatch,
};
use crate::text::{Horizontal, Style, TITLE_SIZE, Vertical};
use crate::ticks::number;
use std::collections::HashSet;
use trackdyn_core::real;
use trackdyn_diagnose::exposure::Exposure;
use trackdyn_estimate::interval::NORMAL_QUANTILE;

const TOP: i32 = sheet::TOP + 140;
const PLOT: [i32; 2] = [620, 420];
const COLUMNS: [i32; 3] = [158, 918, 1678];
const ROW: i32 = 640;
const POINT: Rgb = [176, 196, 214];
/// Radius of a sample, pixels.
const RADIUS: f64 = 3.0;
/// Samples that the figure shows at most, and those of a panel: the page carries them all.
const MAX_SHOWN_SAMPLES: [usize; 2] = [8400, 700];
/// Means of about this many groups of samples.
const GROUPS: f64 = 14.0;
/// Samples that a group needs.
const MIN_SAMPLES: usize = 12;
/// Part of the largest change below which a channel shows nothing of the effect.
const MIN_CHANGE: f64 = 0.01;
/// Half interval of a slope from which on it says nothing.
const MAX_SLOPE_ERROR: f64 = 2.0;

/// A row of channels for each claimed effect, or for the best candidate.
pub(super) fn figure(subject: &Subject) -> Figure {
    let exposures = &subject.diagnosis.evidence.exposures;
    let height = TOP - 40 + rows(exposures.len().max(1)) * ROW + sheet::FOOT;
    let explanation = "Observed departure without the effect, against the change that the effect \
                       predicts; what else is free is taken out of both. An effect that is there \
                       puts the means on the line, one that is not there on zero.";
    let title = if subject.claims_nothing() {
        "Nothing is claimed: the best candidate against the evidence"
    } else {
        "What is claimed against the evidence"
    };
    let mut figure = sheet::sheet("signatures", height, title, explanation, subject.caption);
    let entries = [
        (Swatch::disc(POINT), "samples, one for those on each other"),
        (Swatch::entry(1), "means of samples of like change, with 95 % intervals"),
        (Swatch::Line(INK, 3.0), "predicted: slope one"),
    ];
    figure.legends.push(Legend::of_marks([158, sheet::TOP + 20], sheet::RIGHT, entries));
    if exposures.is_empty() {
        let text = "No effect of the catalogue changes anything that this evidence can see.";
        figure.write(text, [158, TOP + 40], Style::new(TITLE_SIZE));
    }
    let most = (MAX_SHOWN_SAMPLES[0] / (3 * exposures.len().max(1))).min(MAX_SHOWN_SAMPLES[1]);
    for (row, exposure) in exposures.iter().enumerate() {
        figure.panels.extend(effect(subject, exposure, TOP + rows(row) * ROW, most));
    }
    figure
}

fn effect(subject: &Subject, exposure: &Exposure, top: i32, most: usize) -> [Panel; 3] {
    let changes = exposure.predicted.iter().flat_map(|change| change.iter().copied());
    let extent = 1.1 * quantile(changes.map(f64::abs), 0.997).unwrap_or(0.0);
    let extent = if extent > 0.0 { extent } else { 1.0 };
    let all: [Vec<[f64; 2]>; 3] = [0, 1, 2].map(|channel| points(subject, exposure, channel));
    let groups = all.each_ref().map(|points| groups(points));
    let highest = groups.iter().flatten().map(|group| group.mean[1].abs() + group.half);
    let highest = highest.fold(1.15 * extent, f64::max);
    [0, 1, 2].map(|channel| {
        let place = Area::new(COLUMNS[channel], top, PLOT[0], PLOT[1]);
        let x = Axis::new("predicted change", "σ of the noise", [-extent, extent]);
        let y = Axis::new("observed departure", "σ of the noise", [-highest, highest]);
        let y = Axis { is_labelled: channel == 0, ..y };
        let title = format!("{}: {}", id(exposure.effect), CHANNELS[channel]);
        let mut panel = Panel::new(&title, place, x, y);
        show(&mut panel, &all[channel], &groups[channel], most);
        panel
    })
}

/// Samples and their means in a panel.
fn show(panel: &mut Panel, points: &[[f64; 2]], groups: &[Group], most: usize) {
    let extent = panel.x.range[1];
    let largest = points.iter().fold(0.0_f64, |most, point| most.max(point[0].abs()));
    if largest < MIN_CHANGE * extent {
        let is_measured = !points.is_empty();
        let reason = if is_measured { "it changes nothing here" } else { "not measured" };
        return panel.explain_emptiness(reason);
    }
    let shown = apart(points, panel, most);
    panel.show_as("samples", Points::new(shown, Marker::disc(RADIUS, POINT)));
    let ends = vec![[-extent, -extent], [extent, extent]];
    panel.show_as("predicted", Line { points: ends, thickness: 3.0, colour: INK });
    let means =
        groups.iter().map(|Group { mean, half }| (*mean, Some([mean[1] - half, mean[1] + half])));
    panel.show_as("means", Estimates::of_entry(1, means));
    if let Some((slope, error)) = slope(points) {
        panel.remark = if error < MAX_SLOPE_ERROR {
            format!("slope {} ± {}", number(slope, 2), number(error, 2))
        } else {
            "too small to see".to_owned()
        };
    }
    let hidden = points.iter().filter(|point| !panel.contains(**point)).count();
    if hidden > 0 {
        let style = Style::new(18.0).colour(GREY).anchor(Horizontal::Right, Vertical::Baseline);
        let corner = [extent, panel.y.range[0]];
        let label = Label::new(format!("beyond the frame: {hidden}"), corner, style);
        panel.labels.push(label.shifted([-12, -12]).on_white());
    }
}

/// Points of which one stands for all that lie on it; for further ones, too, where more than
/// `most` would be left.
fn apart(points: &[[f64; 2]], panel: &Panel, most: usize) -> Vec<[f64; 2]> {
    let mut distance = 2.0 * RADIUS;
    loop {
        let mut taken = HashSet::new();
        #[expect(clippy::cast_possible_truncation, reason = "places on the sheet")]
        let cell = |point: [f64; 2]| panel.pixel(point).map(|place| (place / distance) as i64);
        let is_first = |point: &&[f64; 2]| panel.contains(**point) && taken.insert(cell(**point));
        let shown: Vec<_> = points.iter().filter(is_first).copied().collect();
        if shown.len() <= most {
            return shown;
        }
        distance *= 1.5;
    }
}

/// Predicted change and observed departure of the samples that count in the fit.
fn points(subject: &Subject, exposure: &Exposure, channel: usize) -> Vec<[f64; 2]> {
    (0..exposure.predicted.len())
        .filter(|&index| subject.evidence().is_measured(index, channel))
        .map(|index| [exposure.predicted[index][channel], exposure.observed[index][channel]])
        .filter(|point| point.iter().all(|value| value.is_finite()))
        .collect()
}

/// The slope of the departure over the change, and half its 95 % interval where the noise is one.
fn slope(points: &[[f64; 2]]) -> Option<(f64, f64)> {
    let square: f64 = points.iter().map(|[x, _]| x * x).sum();
    let product: f64 = points.iter().map(|[x, y]| x * y).sum();
    (square > 0.0).then(|| (product / square, NORMAL_QUANTILE / square.sqrt()))
}

/// Samples of like change.
struct Group {
    mean: [f64; 2],
    /// Half the 95 % interval of the mean departure.
    half: f64,
}

/// Groups by the change, such that each has about the same part of all changes: where most samples
/// feel nothing, the few that do are not lost among them.
fn groups(points: &[[f64; 2]]) -> Vec<Group> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mean = sorted.iter().map(|[x, _]| x.abs()).sum::<f64>() / real(sorted.len().max(1));
    let weight = |point: &[f64; 2]| point[0].abs() + 0.3 * mean;
    let whole: f64 = sorted.iter().map(weight).sum();
    let (mut groups, mut inside, mut taken) = (Vec::new(), Vec::new(), 0.0);
    for point in sorted {
        taken += weight(&point);
        inside.push(point);
        if taken >= whole / GROUPS && inside.len() >= MIN_SAMPLES {
            groups.extend(group(&inside));
            (inside, taken) = (Vec::new(), 0.0);
        }
    }
    if inside.len() >= MIN_SAMPLES {
        groups.extend(group(&inside));
    }
    groups
}

fn group(points: &[[f64; 2]]) -> Option<Group> {
    let count = real(points.len());
    let mean = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let squares: f64 = points.iter().map(|point| (point[1] - mean[1]).powi(2)).sum();
    let half = NORMAL_QUANTILE * (squares / (count * (count - 1.0))).sqrt();
    half.is_finite().then_some(Group { mean, half })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_few_samples_that_feel_an_effect_have_groups_of_their_own() {
        let mut points = vec![[0.0, 0.1]; 900];
        points.extend(vec![[5.0, 5.2]; 60]);
        let groups = groups(&points);
        assert!(groups.iter().any(|group| (group.mean[0] - 5.0).abs() < 1e-9));
        assert!(super::groups(&[]).is_empty());
    }

    #[test]
    fn of_many_samples_a_few_stand_for_all() {
        let axis = || Axis::new("", "", [-1.0, 1.0]);
        let panel = Panel::new("", Area::new(0, 0, PLOT[0], PLOT[1]), axis(), axis());
        // Fibonacci's lattice fills the panel evenly
        let place = |k: i32, step: f64| 2.0 * (f64::from(k) * step).fract() - 1.0;
        let points: Vec<_> = (0..20_000).map(|k| [place(k, 0.618_034), place(k, 5e-5)]).collect();
        let most = MAX_SHOWN_SAMPLES[1];
        let shown = apart(&points, &panel, most);
        assert!((most / 3..=most).contains(&shown.len()), "{}", shown.len());
        assert!(shown.iter().all(|point| points.contains(point)));
        let few: Vec<_> = points.iter().step_by(1000).copied().collect();
        assert_eq!(apart(&few, &panel, most), few);
        assert!(apart(&[[2.0, 0.0]], &panel, most).is_empty());
    }
}
