//! Shares, one row each.

use super::{Entrant, beside, legend};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{GREY, GRID, INK};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{Panel, TICK_SIZE};
use crate::sheet::{self, Mark, label_left_of, label_right_of, px, rows};
use trackdyn_core::real;

const TOP: i32 = sheet::TOP + 70;
/// Least and most room for the names of the rows, and room for the counts right of the plot.
const LABELS: [i32; 2] = [300, 1010];
const COUNTS: i32 = 240;
/// Height of a row, and what each further program adds.
const ROW: [i32; 2] = [44, 36];
const BELOW: i32 = 120;

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

/// Shares with their intervals, one row each. `caption` stands below, for what the figure was made from.
///
/// Returns the bytes of a PNG. They depend on the arguments only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no share is the cause of one.
pub fn shares(of: &Shares, caption: &str) -> Result<Vec<u8>, Error> {
    let pitch = ROW[0] + ROW[1] * rows(of.entrants.len().saturating_sub(1));
    let room = Canvas::new(1, 1)?;
    let longest = of.rows.iter().map(|name| room.text_width(name, TICK_SIZE)).max().unwrap_or(0);
    let labels = (sheet::LEFT + longest + 40).clamp(LABELS[0], LABELS[1]);
    let width = sheet::RIGHT - COUNTS - labels;
    let plot = Area::new(labels, TOP, width, pitch * rows(of.rows.len().max(1)));
    let height = plot.bottom() + BELOW + sheet::FOOT;
    let mut canvas = sheet::sheet(height, of.title, of.explanation, caption)?;
    let names = of.entrants.iter().map(|entrant| entrant.name);
    let bars = (Mark::Line(INK, 3.0), "bars: 95 % intervals");
    legend(&mut canvas, [sheet::LEFT, sheet::TOP + 20], names, &[bars]);
    let panel = Panel { plot, x: [-2.0, 102.0], y: [real(of.rows.len().max(1)), 0.0] };
    let ticks = [0.0, 20.0, 40.0, 60.0, 80.0, 100.0].map(|tick| (tick, number(tick, 0)));
    sheet::axis_below(&mut canvas, &panel, &ticks, &format!("share of {} (%)", of.of));
    if let Some(wanted) = of.wanted {
        sheet::dashes(&mut canvas, &panel, 100.0 * wanted, INK);
    }
    for (row, name) in of.rows.iter().enumerate() {
        let top = plot.top + rows(row) * pitch;
        if row > 0 {
            canvas.fill(Area::new(plot.left, top, plot.width, 1), GRID);
        }
        let name = canvas.fitted(name, TICK_SIZE, labels - sheet::LEFT - 20);
        label_left_of(&mut canvas, &name, [labels - 16, top + pitch / 2], TICK_SIZE, INK);
        for (entry, entrant) in of.entrants.iter().enumerate() {
            let Some(share) = entrant.shares.get(row).copied().flatten() else { continue };
            let middle = panel.pixel([0.0, real(row) + beside(entry, of.entrants.len())])[1];
            if let Some((value, interval)) = share.shown() {
                let column = |value: f64| panel.pixel([100.0 * value, 0.0])[0];
                sheet::whisker(&mut canvas, interval.map(column), middle, look::colour(entry));
                look::marker(&mut canvas, entry, [column(value), middle]);
            }
            let text = format!("{} of {}", share.successes, share.cases);
            label_right_of(&mut canvas, &text, [plot.right() + 16, px(middle)], 20.0, GREY);
        }
    }
    panel.border(&mut canvas);
    canvas.to_small_png()
}
