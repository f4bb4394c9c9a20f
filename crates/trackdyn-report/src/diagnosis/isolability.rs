//! Which effects this evidence can tell apart.

use super::Subject;
use super::sheet::{self, rows};
use super::words::{id, ids};
use crate::colour::{BLUES, GREY, INK, Rgb};
use crate::figure::{
    Area, Axis, Boxes, ColourBar, Figure, Label, Matrix, Paint, Panel, Rule, Scale,
};
use crate::text::{Horizontal, Style, TITLE_SIZE, Vertical, two_lines};
use crate::ticks::number;
use trackdyn_core::real;
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::isolability::Isolability;
use trackdyn_model::EffectId;

const TOP: i32 = sheet::TOP + 90;
const CELL: i32 = 50;
const LABELS: i32 = 400;
/// Room for names that read upwards.
const ROOM_BELOW: i32 = 400;
/// Longest bar, pixels.
const MAX_BAR: i32 = 640;
/// Size of names and remarks.
const NAME: f32 = 22.0;
/// Resemblance from which on its number is written.
const MIN_WRITTEN_RESEMBLANCE: f64 = 0.5;
/// Standard deviations, at a typical size, below which an effect only moves what is fitted anyway.
const MIN_VISIBLE_Z: f64 = 0.05;

/// The matrix of |cosine| and what each effect would stand out by.
pub(super) fn figure(subject: &Subject) -> Figure {
    let of = &subject.diagnosis.limits.resemblance;
    let order = order(of);
    let side = rows(order.len()) * CELL;
    let height = TOP + side.max(500) + ROOM_BELOW + sheet::FOOT;
    let explanation = "Resemblance of what two effects would change in this very evidence, with \
                       all that is fitted anyway taken out: 100 means twins, 0 means that nothing \
                       is shared. Bars: by how much an effect of typical size would stand out.";
    let title = "Which effects this evidence can tell apart";
    let mut figure = sheet::sheet("isolability", height, title, explanation, subject.caption);
    if order.is_empty() {
        let text = "This evidence shows no effect of the catalogue.";
        figure.write(text, [LABELS, TOP], Style::new(TITLE_SIZE));
        return figure;
    }
    figure.panels.push(matrix(subject, &order, Area::new(LABELS, TOP, side, side)));
    figure.panels.push(strengths(of, &order, LABELS + side + 190));
    let unseen: Vec<EffectId> =
        (0..of.effects.len()).filter(|k| !order.contains(k)).map(|k| of.effects[k]).collect();
    if !unseen.is_empty() {
        let text =
            format!("Not visible beyond constant ICRs, clock and sensor: {}", ids(&unseen, ", "));
        let lines = two_lines(&text, NAME, sheet::RIGHT - sheet::LEFT);
        for (line, row) in lines.iter().zip([height - sheet::FOOT - 34, height - sheet::FOOT - 4]) {
            sheet::line(&mut figure, line, row, Style::new(NAME).colour(GREY));
        }
    }
    figure
}

fn matrix(subject: &Subject, order: &[usize], place: Area) -> Panel {
    let of = &subject.diagnosis.limits.resemblance;
    let names: Vec<_> = order.iter().map(|&k| name(subject, of.effects[k])).collect();
    let pairs = order.iter().flat_map(|&a| order.iter().map(move |&b| (a, b)));
    let cells = pairs.map(|(a, b)| {
        let cosine = of.cosines[(a, b)];
        (cosine, (a != b && cosine >= MIN_WRITTEN_RESEMBLANCE).then(|| number(100.0 * cosine, 0)))
    });
    let scale = Scale::new(BLUES, [0.0, 1.0], "|cosine|");
    let bar = Area::new(place.right() + 40, place.top, 28, 400.min(place.height));
    let bar = ColourBar { place: bar, scale: scale.clone() };
    let (rows, columns, cells) = (names.clone(), names, cells.collect());
    let mut panel = Matrix { rows, columns, sizes: [NAME, 18.0], cells, scale }.panel(place, None);
    panel.colour_bars.push(bar);
    panel
}

/// Bars of z at each effect's typical size, beside the rows.
fn strengths(of: &Isolability, order: &[usize], left: i32) -> Panel {
    let width = (sheet::RIGHT - left - 110).min(MAX_BAR);
    let most = order.iter().map(|&k| of.detection[k]).fold(10.0, f64::max);
    let stretched = |z: f64| (1.0 + z).ln();
    let x = Axis::new("standard deviations at a typical size", "", [0.0, stretched(most)]);
    let place = Area::new(left, TOP, width, rows(order.len()) * CELL);
    let title = "stands out by (σ)";
    let mut panel = Panel::new(title, place, x, Axis::rows(order.len()));
    panel.is_framed = false;
    let (mut boxes, mut colours) = (Vec::new(), Vec::new());
    for (row, &k) in order.iter().enumerate() {
        let z = of.detection[k];
        let (end, middle) = (stretched(z), real(row) + 0.5);
        boxes.push([[0.0, middle + 0.22], [end, middle - 0.22]]);
        colours.push(BLUES.at(if z >= of.min_detected_z { 0.7 } else { 0.3 }));
        let text = number(z, usize::from(z < 10.0));
        panel.labels.push(Label::right_of(&text, [end, middle], 10, (20.0, GREY)).on_white());
    }
    panel.show_as("found", Rule::upright(stretched(of.min_detected_z), 2.0, INK).dashed());
    panel.show_as("standard deviations", Boxes::new(boxes, Paint::Each(colours)));
    let style = Style::new(20.0).colour(GREY).anchor(Horizontal::Centre, Vertical::Top);
    let foot = [stretched(of.min_detected_z), real(order.len())];
    let text = format!("{}: would be found", number(of.min_detected_z, 0));
    panel.labels.push(Label::new(text, foot, style).shifted([0, 14]));
    panel
}

/// A name and its colour: ink for what is claimed, grey for others.
fn name(subject: &Subject, effect: EffectId) -> (String, Rgb) {
    let claimed =
        subject.diagnosis.answer.missing.iter().any(|missing| {
            missing.kind != Kind::Constant && missing.verdict.one_of.contains(&effect)
        });
    if claimed { (format!("→ {}", id(effect)), INK) } else { (id(effect).to_owned(), GREY) }
}

/// The visible effects such that like ones are neighbours: from the strongest on to the one that is
/// most like the last.
fn order(of: &Isolability) -> Vec<usize> {
    let mut left: Vec<usize> =
        (0..of.effects.len()).filter(|&k| of.detection[k] > MIN_VISIBLE_Z).collect();
    let strongest =
        left.iter().copied().max_by(|&a, &b| of.detection[a].total_cmp(&of.detection[b]));
    let Some(mut last) = strongest else { return Vec::new() };
    let mut order = vec![last];
    left.retain(|k| *k != last);
    while !left.is_empty() {
        let next = left.iter().copied().max_by(|&a, &b| {
            of.cosines[(last, a)].total_cmp(&of.cosines[(last, b)]).then(b.cmp(&a))
        });
        let Some(next) = next else { break };
        left.retain(|k| *k != next);
        order.push(next);
        last = next;
    }
    order
}
