//! The tests of symmetries.

use super::Subject;
use super::sheet::{self, AFTER, BEFORE, Mark, label_left_of, label_right_of, px, rows};
use super::words::{probability, symmetry};
use crate::Error;
use crate::canvas::Area;
use crate::colour::{FRAME, GREY, GRID, INK};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{LABEL_SIZE, Panel, TICK_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;
use trackdyn_diagnose::diagnosis::Examined;
use trackdyn_diagnose::locate::{SIGNIFICANT, SymmetryTest};

const TOP: i32 = sheet::TOP + 110;
const ROW: i32 = 96;
const LABELS: i32 = 640;
const PANEL: i32 = 1020;
/// Places of the states in a row.
const ASIDE: [f64; 3] = [0.22, 0.5, 0.78];
/// Distance of the columns of p.
const COLUMN: i32 = 215;
/// Place among the colours of what is taken as the file has it.
const FILED: usize = 2;

/// Draws one row per symmetry: its statistic per degree of freedom.
pub(super) fn draw(subject: &Subject) -> Result<Vec<u8>, Error> {
    let Examined { filed, before: fitted, after, .. } = &subject.diagnosis.evidence;
    let states = [
        (&filed.tests, FILED, "as filed", "p as filed"),
        (&fitted.tests, BEFORE, "clock and sensor fitted", "p fitted"),
        (&after.tests, AFTER, "after", "p after"),
    ];
    let count = fitted.tests.len().max(1);
    let height = TOP + rows(count) * ROW + 140 + sheet::FOOT;
    let explanation = "A robot with constant ICRs drives alike in both cases that a symmetry compares. \
                       Statistic: squared departure per number tested; noise makes 1 within a block of time, \
                       and p compares blocks. Broken: by the vehicle as filed or with clock and sensor fitted, \
                       or surely by the corrected one.";
    let title = "Which symmetries of driving are broken";
    let mut canvas = sheet::sheet(height, title, explanation, subject.caption)?;
    let broken = format!("filled: broken (p < {SIGNIFICANT} among all tests)");
    let of_states =
        states.iter().map(|(_, entry, name, _)| (Mark::Disc(look::colour(*entry)), *name));
    let of_tests = [(Mark::Disc(INK), broken.as_str()), (Mark::Ring(INK), "open: may be chance")];
    let entries: Vec<(Mark, &str)> = of_states.chain(of_tests).collect();
    sheet::legend(&mut canvas, [LABELS - 120, sheet::TOP + 20], &entries);
    let ratios = states.iter().flat_map(|(tests, ..)| *tests).filter_map(ratio);
    let (low, high) = ratios.fold((0.3, 10.0), |(low, high): (f64, f64), value| {
        (low.min(0.8 * value).max(0.02), high.max(2.0 * value))
    });
    let plot = Area::new(LABELS, TOP, PANEL, rows(count) * ROW);
    let panel = Panel { plot, x: [low.log10(), high.log10()], y: [real(count), 0.0] };
    let mut ticks = Vec::new();
    for decade in -2..7 {
        for factor in [1.0, 3.0] {
            let value = factor * 10.0_f64.powi(decade);
            if value >= low && value <= high {
                let decimals = if value < 0.1 { 2 } else { usize::from(value < 1.0) };
                ticks.push((value.log10(), number(value, decimals)));
            }
        }
    }
    sheet::axis_below(&mut canvas, &panel, &ticks, "statistic per degree of freedom (logarithmic)");
    let one = px(panel.pixel([0.0, 0.0])[0]);
    canvas.fill(Area::new(one - 1, TOP, 3, plot.height), FRAME);
    let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Centre, Vertical::Baseline);
    canvas.text("noise alone", [one, TOP - 14], &style);
    let columns = [0, 1, 2].map(|state| LABELS + PANEL + 40 + state * COLUMN);
    let style = Style::new(LABEL_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    for (column, (.., title)) in columns.into_iter().zip(states) {
        canvas.text(title, [column, TOP - 14], &style);
    }
    for (row, test) in fitted.tests.iter().enumerate() {
        let middle = TOP + rows(row) * ROW + ROW / 2;
        let [name, meaning] = symmetry(test.symmetry);
        label_left_of(&mut canvas, name, [LABELS - 24, middle - 17], LABEL_SIZE, INK);
        label_left_of(&mut canvas, meaning, [LABELS - 24, middle + 19], 20.0, GREY);
        if row > 0 {
            canvas.fill(Area::new(LABELS, TOP + rows(row) * ROW, PANEL, 1), GRID);
        }
        for (state, (tests, entry, ..)) in states.into_iter().enumerate() {
            let test = tests.iter().find(|other| other.symmetry == test.symmetry);
            let Some(test) = test else { continue };
            let aside = ASIDE[state];
            let broken = test.test.p < SIGNIFICANT;
            let colour = if broken { INK } else { GREY };
            let text = probability(test.test.p);
            label_right_of(&mut canvas, &text, [columns[state], middle], TICK_SIZE, colour);
            let Some(ratio) = ratio(test) else { continue };
            let at = panel.pixel([ratio.max(low).log10(), real(row) + aside]);
            let foot = [f64::from(one), at[1]];
            canvas.line(foot, at, 4.0, look::colour(entry));
            if broken {
                canvas.disc(at, 13.0, look::colour(entry));
            } else {
                canvas.disc(at, 13.0, crate::colour::WHITE);
                canvas.ring(at, 11.0, 4.0, look::colour(entry));
            }
        }
    }
    panel.border(&mut canvas);
    canvas.to_small_png()
}

fn ratio(test: &SymmetryTest) -> Option<f64> {
    let ratio = test.test.statistic / real(test.test.degrees);
    (test.test.degrees > 0 && ratio.is_finite() && ratio > 0.0).then_some(ratio)
}
