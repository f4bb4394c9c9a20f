//! Shares, one row each.

use super::{Entrant, beside, legend};
use crate::colour::{GREY, GRID, INK};
use crate::figure::{Area, Axis, Estimates, Figure, Label, Panel, Rule};
use crate::sheet::{self, rows};
use crate::text::{TICK_SIZE, fitted, width};
use crate::ticks::number;
use trackdyn_core::real;

const TOP: i32 = sheet::TOP + 70;
/// Least and most room for the names of the rows, and room for the counts right of the plot.
const LABELS: [i32; 2] = [300, 1010];
const COUNTS: i32 = 240;
/// Height of a row, and what each further program adds.
const ROW: [i32; 2] = [44, 36];
const ROOM_BELOW: i32 = 120;

/// Shares of what stands in the rows.
#[derive(Clone, Copy, Debug)]
pub struct Shares<'a> {
    /// Above the figure.
    pub title: &'a str,
    /// How to read it.
    pub explanation: &'a str,
    /// What they are shares of.
    pub of: &'a str,
    /// Names of the rows.
    pub rows: &'a [String],
    /// Programs with one share per row.
    pub entrants: &'a [Entrant<'a>],
    /// The share that all should have, 0 to 1.
    pub wanted: Option<f64>,
}

/// Shares with their intervals, one row each. `caption` stands below, for what the figure was made
/// from.
pub fn shares(of: &Shares, caption: &str) -> Figure {
    let pitch = ROW[0] + ROW[1] * rows(of.entrants.len().saturating_sub(1));
    let longest = of.rows.iter().map(|name| width(name, TICK_SIZE)).max().unwrap_or(0);
    let labels = (sheet::LEFT + longest + 40).clamp(LABELS[0], LABELS[1]);
    let plot_width = sheet::RIGHT - COUNTS - labels;
    let place = Area::new(labels, TOP, plot_width, pitch * rows(of.rows.len().max(1)));
    let height = place.bottom() + ROOM_BELOW + sheet::FOOT;
    let mut figure = sheet::sheet("shares", height, of.title, of.explanation, caption);
    figure.legends.push(legend(of.entrants.iter().map(|entrant| entrant.name)));
    let ticks = [0.0, 20.0, 40.0, 60.0, 80.0, 100.0].map(|tick| (tick, number(tick, 0)));
    let x = Axis::new(&format!("share of {}", of.of), "%", [-2.0, 102.0]).at(ticks.to_vec());
    let mut panel = Panel::new("", place, x, Axis::rows(of.rows.len()));
    if let Some(wanted) = of.wanted {
        panel.show_as("wanted", Rule::upright(100.0 * wanted, 3.0, INK).dashed());
    }
    for (row, name) in of.rows.iter().enumerate() {
        if row > 0 {
            panel.show(Rule::level(real(row), 1.0, GRID));
        }
        let name = fitted(name, TICK_SIZE, labels - sheet::LEFT - 20);
        panel.name(&name, [-2.0, real(row) + 0.5], 16);
    }
    for (entry, entrant) in of.entrants.iter().enumerate() {
        let at = |row: usize| real(row) + beside(entry, of.entrants.len());
        let shares = entrant.shares.iter().take(of.rows.len()).enumerate();
        let shares = shares.filter_map(|(row, share)| Some((row, (*share)?)));
        for (row, share) in shares.clone() {
            let text = format!("{} of {}", share.successes, share.cases);
            panel.labels.push(Label::right_of(&text, [102.0, at(row)], 16, (20.0, GREY)));
        }
        let shown = shares.filter_map(|(row, share)| {
            let (value, interval) = share.shown()?;
            Some(([100.0 * value, at(row)], Some(interval.map(|end| 100.0 * end))))
        });
        panel.show_as(entrant.name, Estimates::of_entry(entry, shown).across());
    }
    figure.panels.push(panel);
    figure
}
