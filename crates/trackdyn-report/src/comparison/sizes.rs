//! The sizes of both sets on one axis.

use super::Compared;
use crate::colour::{FRAME, GRID, INK};
use crate::figure::{Area, Axis, Estimates, Figure, Legend, Panel, Rule, Swatch};
use crate::sheet::{self, AFTER_COLOUR, BEFORE_COLOUR, rows};
use trackdyn_core::real;
use trackdyn_diagnose::compare::{Estimate, Quantity, Subject, words};

const TOP: i32 = sheet::TOP + 110;
const ROW: i32 = 54;
const LABELS: i32 = 700;
const WIDTH: i32 = 1600;
/// Largest distance that is drawn, typical sizes: beyond it a size is not physical.
const MAX_DISTANCE: f64 = 20.0;

/// One row per number; none where nothing was compared.
pub(super) fn figure(subject: &Compared) -> Option<Figure> {
    let comparison = subject.comparison;
    let all: Vec<(Subject, &Quantity)> = (comparison.differences.iter().chain(&comparison.alike))
        .flat_map(|one| one.group.numbers.iter().map(|number| (one.group.subject, number)))
        .filter(|(_, number)| number.typical > 0.0)
        .collect();
    if all.is_empty() {
        return None;
    }
    let height = TOP + rows(all.len()) * ROW + 130 + sheet::FOOT;
    let explanation = "Distance of each number from the vehicle as filed, or from no such effect, \
                       in units of a typical size of that effect; of a tenth of the gauge for the \
                       constant ICRs.";
    let title = "The sizes in each set";
    let mut figure = sheet::sheet("sizes", height, title, explanation, subject.caption);
    let entries = [
        (Swatch::entry(BEFORE_COLOUR), "SIM"),
        (Swatch::entry(AFTER_COLOUR), "REAL"),
        (Swatch::Line(INK, 3.0), "bars: 95 % intervals"),
    ];
    figure.legends.push(Legend::of_marks([LABELS, sheet::TOP + 20], sheet::RIGHT, entries));
    let away = |number: &Quantity, set: usize| -> [f64; 3] {
        let Estimate { value, low, high } = number.each[set];
        [value, low, high].map(|of| (of - number.prior.mean) / number.typical)
    };
    let ends = all.iter().flat_map(|(_, number)| [away(number, 0), away(number, 1)]).flatten();
    let most = ends.filter(|end| end.is_finite()).map(f64::abs).fold(0.0, f64::max);
    let limit = if most > 0.0 { 1.05 * most.min(MAX_DISTANCE) } else { 1.0 };
    let place = Area::new(LABELS, TOP, WIDTH, rows(all.len()) * ROW);
    let x = Axis::new("distance from none", "typical sizes", [-limit, limit]);
    let mut panel = Panel::new("", place, x, Axis::rows(all.len()));
    for row in 1..all.len() {
        panel.show(Rule::level(real(row), 1.0, GRID));
    }
    panel.show(Rule::upright(0.0, 2.0, FRAME));
    for (entry, aside) in [(BEFORE_COLOUR, 0.32), (AFTER_COLOUR, 0.68)] {
        let estimates = all.iter().enumerate().filter_map(|(row, (_, number))| {
            let [value, low, high] = away(number, entry);
            let are_numbers = [value, low, high].iter().all(|of| of.is_finite());
            let shown = are_numbers && panel.x.contains(value);
            shown.then_some(([value, real(row) + aside], Some([low, high])))
        });
        let estimates: Vec<_> = estimates.collect();
        panel.show_as(["SIM", "REAL"][entry], Estimates::of_entry(entry, estimates).across());
    }
    for (row, (subject, number)) in all.iter().enumerate() {
        let own = words::name(number.number);
        let name = match subject {
            Subject::Effect(effect) => format!("{effect}: {own}"),
            _ => own.to_owned(),
        };
        panel.name(&name, [-limit, real(row) + 0.5], 20);
    }
    figure.panels.push(panel);
    Some(figure)
}
