//! The tests of symmetries.

use super::Subject;
use super::sheet::{self, AFTER_COLOUR, BEFORE_COLOUR, rows};
use super::words::{probability, symmetry};
use crate::colour::{FRAME, GREY, GRID, INK};
use crate::figure::{
    Area, Axis, Figure, Label, Legend, Line, Marker, Panel, Points, Rule, Shape, Swatch,
    entry_colour,
};
use crate::text::{Horizontal, LABEL_SIZE, Style, TICK_SIZE, Vertical};
use crate::ticks::number;
use trackdyn_core::real;
use trackdyn_diagnose::diagnosis::Examined;
use trackdyn_diagnose::locate::SymmetryTest;

const TOP: i32 = sheet::TOP + 110;
const ROW: i32 = 96;
const LABELS: i32 = 640;
const PANEL: i32 = 1020;
/// Places of the states in a row.
const STATE_PLACES: [f64; 3] = [0.22, 0.5, 0.78];
/// Distance of the columns of p.
const COLUMN: i32 = 215;
/// Place among the colours of what is taken as the file has it.
const FILED_COLOUR: usize = 2;

/// One row per symmetry: its statistic per degree of freedom.
pub(super) fn figure(subject: &Subject) -> Figure {
    let Examined { filed, before: fitted, after, .. } = &subject.diagnosis.evidence;
    let states = [
        (&filed.tests, FILED_COLOUR, "as filed", "p as filed"),
        (&fitted.tests, BEFORE_COLOUR, "clock and sensor fitted", "p fitted"),
        (&after.tests, AFTER_COLOUR, "after", "p after"),
    ];
    let count = fitted.tests.len().max(1);
    let height = TOP + rows(count) * ROW + 140 + sheet::FOOT;
    let explanation = "A robot with constant ICRs drives alike in both cases that a symmetry \
                       compares. Statistic: squared departure per number tested; noise makes 1 \
                       within a block of time, and p compares blocks. Broken: by the vehicle as \
                       filed or with clock and sensor fitted, or surely by the corrected one.";
    let title = "Which symmetries of driving are broken";
    let mut figure = sheet::sheet("symmetries", height, title, explanation, subject.caption);
    let [max_p, _] = fitted.max_p;
    let broken = format!("filled: broken (p < {max_p} among all tests)");
    let of_states =
        states.iter().map(|(_, entry, name, _)| (Swatch::disc(entry_colour(*entry)), *name));
    let of_tests = [(Swatch::disc(INK), broken.as_str()), (Swatch::ring(), "open: may be chance")];
    let at = [LABELS - 120, sheet::TOP + 20];
    figure.legends.push(Legend::of_marks(at, sheet::RIGHT, of_states.chain(of_tests)));
    let ratios = states.iter().flat_map(|(tests, ..)| *tests).filter_map(ratio);
    let (low, high) = ratios.fold((0.3, 10.0), |(low, high): (f64, f64), value| {
        (low.min(0.8 * value).max(0.02), high.max(2.0 * value))
    });
    let range = [low.log10(), high.log10()];
    let x = Axis::new("statistic per degree of freedom (logarithmic)", "", range);
    let place = Area::new(LABELS, TOP, PANEL, rows(count) * ROW);
    let mut panel = Panel::new("", place, x.at(ticks(low, high)), Axis::rows(count));
    let above =
        |anchor, (size, colour)| Style::new(size).colour(colour).anchor(anchor, Vertical::Baseline);
    let style = above(Horizontal::Centre, (TICK_SIZE, GREY));
    panel.labels.push(Label::new("noise alone", [0.0, 0.0], style).shifted([0, -14]));
    for row in 1..fitted.tests.len() {
        panel.show(Rule::level(real(row), 1.0, GRID));
    }
    panel.show_as("noise alone", Rule::upright(0.0, 3.0, FRAME));
    for (row, test) in fitted.tests.iter().enumerate() {
        let at = [range[0], real(row) + 0.5];
        let [name, meaning] = symmetry(test.symmetry);
        let names = [(name, (LABEL_SIZE, INK), -17), (meaning, (20.0, GREY), 19)];
        for (text, style, down) in names {
            let label = Label::left_of(text, at, 24, style);
            panel.labels.push(Label { shift: [-24, down], ..label });
        }
    }
    for (state, (tests, entry, name, title)) in states.into_iter().enumerate() {
        let beside = 40 + rows(state) * COLUMN;
        let style = above(Horizontal::Left, (LABEL_SIZE, INK));
        panel.labels.push(Label::new(title, [range[1], 0.0], style).shifted([beside, -14]));
        for (row, test) in fitted.tests.iter().enumerate() {
            let test = tests.iter().find(|other| other.symmetry == test.symmetry);
            let Some(test) = test else { continue };
            let is_broken = test.test.p < max_p;
            let style = (TICK_SIZE, if is_broken { INK } else { GREY });
            let (p, at) = (probability(test.test.p), [range[1], real(row) + 0.5]);
            panel.labels.push(Label::right_of(&p, at, beside, style));
            let Some(ratio) = ratio(test) else { continue };
            let (end, row) = (ratio.max(low).log10(), real(row) + STATE_PLACES[state]);
            let colour = entry_colour(entry);
            let points = vec![[0.0, row], [end, row]];
            panel.show_as(name, Line { points, thickness: 4.0, colour });
            let shape = if is_broken { Shape::Disc(13.0) } else { Shape::Open(11.0, 4.0) };
            panel.show_as(name, Points::new(vec![[end, row]], Marker { shape, colour }));
        }
    }
    figure.panels.push(panel);
    figure
}

/// Numbers along a logarithmic axis.
fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let values = (-2..7).flat_map(|decade| [1.0, 3.0].map(|k| k * 10.0_f64.powi(decade)));
    let inside = values.filter(|value| (low..=high).contains(value));
    let text = |value| number(value, if value < 0.1 { 2 } else { usize::from(value < 1.0) });
    inside.map(|value| (value.log10(), text(value))).collect()
}

fn ratio(test: &SymmetryTest) -> Option<f64> {
    let ratio = test.test.statistic / real(test.test.degrees);
    (test.test.degrees > 0 && ratio.is_finite() && ratio > 0.0).then_some(ratio)
}
