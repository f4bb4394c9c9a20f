//! ln evidence of all candidates as bars.

use super::Subject;
use super::candidates::{Candidate, Outcome};
use super::sheet::{self, rows};
use super::words::id;
use crate::colour::{FRAME, GREY, INK, Rgb};
use crate::figure::{
    Area, Axis, Boxes, Figure, Label, Legend, Paint, Panel, Rule, Swatch, entry_colour,
};
use crate::text::fitted;
use crate::ticks::number;
use trackdyn_core::real;

const TOP: i32 = sheet::TOP + 80;
const ROW: i32 = 44;
const LABELS: i32 = 400;
const PANEL: i32 = 900;
/// Size of numbers and reasons.
const REASON: f32 = 22.0;
const LOST_COLOUR: Rgb = [140, 140, 140];
/// Half the height of a bar, rows.
const HALF_BAR: f64 = 0.32;

/// One row per candidate.
pub(super) fn figure(subject: &Subject, candidates: &[Candidate]) -> Figure {
    let count = candidates.len().max(1);
    let height = TOP + rows(count) * ROW + 140 + sheet::FOOT;
    let explanation = "Gain of ln evidence: how much more probable the recording becomes with the \
                       effect, as a logarithm, its added freedom paid for. What is claimed is \
                       compared with the best model without it, the others each by itself. 3 is \
                       worth keeping, 5 may be claimed.";
    let title = "What speaks for each effect, and why it lost";
    let mut figure = sheet::sheet("evidence", height, title, explanation, subject.caption);
    let entries = [
        (Swatch::Box(colour(Outcome::Claimed)), "claimed"),
        (Swatch::Box(colour(Outcome::Twin)), "cannot be told from what is claimed"),
        (Swatch::Box(colour(Outcome::Lost)), "not claimed"),
    ];
    figure.legends.push(Legend::of_marks([LABELS, sheet::TOP + 14], sheet::RIGHT, entries));
    let gains = || candidates.iter().filter_map(|one| one.gain);
    let most = gains().fold(10.0, f64::max);
    let least = gains().fold(-3.0, f64::min).max(-10.0);
    let [low, high] = [1.15 * least, 1.6 * most];
    let mut ticks = vec![-3.0, 0.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 1e5];
    ticks.retain(|value| (low..=high).contains(value));
    let ticks = ticks.iter().map(|&value| (stretched(value), number(value, 0))).collect();
    let range = [stretched(low), stretched(high)];
    let x = Axis::new("gain of ln evidence (stretched near 0)", "", range).at(ticks);
    let place = Area::new(LABELS, TOP, PANEL, rows(count) * ROW);
    let mut panel = Panel::new("", place, x, Axis::rows(count));
    panel.show(Rule::upright(0.0, 2.0, FRAME));
    panel.show_as("may be claimed", Rule::upright(stretched(5.0), 2.0, GREY).dashed());
    let (mut boxes, mut colours) = (Vec::new(), Vec::new());
    for (row, one) in candidates.iter().enumerate() {
        let middle = real(row) + 0.5;
        panel.name(id(one.effect), [range[0], middle], 16);
        if let Some(gain) = one.gain {
            let end = stretched(gain).clamp(range[0], range[1]);
            boxes.push([[end.min(0.0), middle + HALF_BAR], [end.max(0.0), middle - HALF_BAR]]);
            colours.push(colour(one.outcome));
        }
        let shade = if one.outcome == Outcome::Claimed { INK } else { GREY };
        let gain = one.gain.map_or("–".to_owned(), |gain| number(gain, 1));
        let reason = fitted(&one.reason, REASON, sheet::RIGHT - (LABELS + PANEL + 124));
        let at = [range[1], middle];
        panel.labels.push(Label::left_of(&gain, at, -100, (REASON, shade)));
        panel.labels.push(Label::right_of(&reason, at, 124, (REASON, shade)));
    }
    panel.show_as("gain of ln evidence", Boxes::new(boxes, Paint::Each(colours)));
    figure.panels.push(panel);
    figure
}

fn colour(outcome: Outcome) -> Rgb {
    match outcome {
        Outcome::Claimed => entry_colour(1),
        Outcome::Twin => entry_colour(5),
        _ => LOST_COLOUR,
    }
}

/// Near linear below about 3, logarithmic beyond.
fn stretched(value: f64) -> f64 {
    (value / 2.0).asinh()
}
