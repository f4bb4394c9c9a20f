//! Residuals over the plane of both track speeds.

use super::sheet::{self, quantile};
use super::words::CHANNELS;
use super::{Subject, View};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{BLUE_RED, BLUES, ColourMap, FRAME, GREY, GRID};
use crate::colour_bar;
use crate::panel::{Labels, Panel, TICK_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;
use trackdyn_diagnose::evidence::Origin;

const HEIGHT: i32 = 1420;
const SIDE: i32 = 400;
const COLUMNS: [i32; 4] = [158, 668, 1178, 1846];
const ROWS: [i32; 2] = [260, 830];
const BARS: [i32; 2] = [1606, 2270];

/// Cells along each axis; odd, so that a track at rest is in the middle of a cell.
const CELLS: usize = 17;

/// Radius of a steady point, pixels.
const POINT: f64 = 6.0;

/// One panel: what stands for a place of the plane.
struct Spot {
    at: [f64; 2],
    value: f64,
}

/// Draws the mean residual of each channel and the size of all, before and after.
pub(super) fn draw(subject: &Subject) -> Result<Vec<u8>, Error> {
    let explanation = "What the model leaves unexplained of the motion, by the speeds of the left and the \
                       right track, in standard deviations of the noise; the same scale above and below. White: \
                       nothing, or not driven. Of all cells the largest 2 % share the last colour.";
    let title = "Where observation and model differ";
    let mut canvas = sheet::sheet(HEIGHT, title, explanation, subject.caption)?;
    let views = subject.views();
    let fastest = views
        .iter()
        .flat_map(|view| view.evidence.samples())
        .map(|sample| sample.speeds.left.abs().max(sample.speeds.right.abs()))
        .fold(0.0, f64::max);
    let shape = match subject.evidence().origin() {
        Origin::Drive(_) => Shape::Cells,
        Origin::SteadyPoints(_) => Shape::Points,
    };
    let room = match shape {
        Shape::Cells => 1.03,
        Shape::Points => 1.08,
    };
    let extent = if fastest > 0.0 { room * fastest } else { 1.0 };
    let means = [0, 1].map(|when| {
        [0, 1, 2].map(|channel| {
            spots(&views, shape, extent, |view, index| {
                let measured = view.evidence.is_measured(index, channel);
                measured.then(|| view.residuals[when][index][channel])
            })
        })
    });
    let sizes = [0, 1].map(|when| {
        let mut spots = spots(&views, shape, extent, |view, index| square(view, when, index));
        for spot in &mut spots {
            spot.value = spot.value.sqrt();
        }
        spots
    });
    let limit = |values: &mut dyn Iterator<Item = f64>, least: f64| {
        quantile(values, 0.98).unwrap_or(0.0).max(least)
    };
    let most = limit(&mut means.iter().flatten().flatten().map(|spot| spot.value.abs()), 1.0);
    let largest = limit(&mut sizes.iter().flatten().map(|spot| spot.value), 1.5);
    for (row, when) in ["before", "after"].into_iter().enumerate() {
        for channel in 0..3 {
            let area = Area::new(COLUMNS[channel], ROWS[row], SIDE, SIDE);
            let title = format!("{}, {when}", CHANNELS[channel]);
            let share = |value: f64| f64::midpoint(value / most, 1.0);
            let spots = &means[row][channel];
            panel(&mut canvas, area, extent, &title, (spots.as_slice(), shape), &BLUE_RED, share)?;
        }
        let area = Area::new(COLUMNS[3], ROWS[row], SIDE, SIDE);
        let title = format!("size of all, {when}");
        let spots = (sizes[row].as_slice(), shape);
        panel(&mut canvas, area, extent, &title, spots, &BLUES, |v| v / largest)?;
        let bar = |column: usize| Area::new(BARS[column], ROWS[row], 26, SIDE);
        colour_bar::draw(&mut canvas, bar(0), &BLUE_RED, [-most, most], "mean, σ");
        colour_bar::draw(&mut canvas, bar(1), &BLUES, [0.0, largest], "rms, σ");
    }
    canvas.to_small_png()
}

/// Mean square of what was measured of a sample, before (0) or after (1).
fn square(view: &View, when: usize, index: usize) -> Option<f64> {
    let measured = (0..3).filter(|&channel| view.evidence.is_measured(index, channel));
    let squares: Vec<f64> =
        measured.map(|channel| view.residuals[when][index][channel].powi(2)).collect();
    (!squares.is_empty()).then(|| squares.iter().sum::<f64>() / real(squares.len()))
}

/// How places are drawn.
#[derive(Clone, Copy)]
enum Shape {
    /// As squares that share samples.
    Cells,
    /// As discs, one each.
    Points,
}

/// Means over cells of the plane; of a table of steady motions each point for itself.
fn spots(
    views: &[View],
    shape: Shape,
    extent: f64,
    of: impl Fn(&View, usize) -> Option<f64>,
) -> Vec<Spot> {
    let samples = views.iter().flat_map(|view| {
        view.evidence.samples().iter().enumerate().map(move |(index, sample)| (view, index, sample))
    });
    let values = samples.filter_map(|(view, index, sample)| {
        let value = of(view, index).filter(|value| value.is_finite())?;
        Some(Spot { at: [sample.speeds.left, sample.speeds.right], value })
    });
    if let Shape::Points = shape {
        return values.collect();
    }
    let mut sums = vec![(0.0, 0.0); CELLS * CELLS];
    let place = |speed: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
        let cell = (f64::midpoint(speed / extent, 1.0) * real(CELLS)) as usize;
        cell.min(CELLS - 1)
    };
    for Spot { at: [left, right], value } in values {
        let (sum, count) = &mut sums[place(right) * CELLS + place(left)];
        *sum += value;
        *count += 1.0;
    }
    let middle = |cell: usize| extent * ((2.0 * real(cell) + 1.0) / real(CELLS) - 1.0);
    let sums = sums.into_iter().enumerate().filter(|(_, (_, count))| *count > 0.0);
    sums.map(|(index, (sum, count))| Spot {
        at: [middle(index % CELLS), middle(index / CELLS)],
        value: sum / count,
    })
    .collect()
}

fn panel(
    canvas: &mut Canvas,
    area: Area,
    extent: f64,
    title: &str,
    (spots, shape): (&[Spot], Shape),
    colours: &ColourMap,
    share: impl Fn(f64) -> f64,
) -> Result<(), Error> {
    let panel = Panel { plot: area, x: [-extent, extent], y: [-extent, extent] };
    let y = if area.left == COLUMNS[0] { "Vᵣ (m/s)" } else { "" };
    panel.frame(canvas, &Labels { title, x: "Vₗ (m/s)", y }, true)?;
    if spots.is_empty() {
        let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Centre, Vertical::Middle);
        canvas.text("not measured", [area.left + SIDE / 2, area.top + SIDE / 2], &style);
        return Ok(());
    }
    let half = extent / real(CELLS);
    canvas.clip(area, |canvas| {
        for Spot { at: [left, right], value } in spots {
            let colour = colours.at(share(*value));
            match shape {
                Shape::Cells => {
                    let corners = [[left - half, right - half], [left + half, right + half]];
                    let cell = panel.area(corners[0], corners[1]);
                    canvas.fill(cell, colour);
                    canvas.outline(cell, 1, GRID);
                }
                Shape::Points => {
                    canvas.disc(panel.pixel([*left, *right]), POINT + 1.0, FRAME);
                    canvas.disc(panel.pixel([*left, *right]), POINT, colour);
                }
            }
        }
    });
    panel.border(canvas);
    Ok(())
}
