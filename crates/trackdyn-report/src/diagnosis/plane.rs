//! Residuals over the plane of both track speeds.

use super::log::Log;
use super::sheet::{self, quantile};
use super::words::CHANNELS;
use super::{Subject, View};
use crate::colour::{BLUE_RED, BLUES, FRAME, GRID};
use crate::figure::{
    Area, Axis, Boxes, ColourBar, Figure, Paint, Panel, Points, Scale, Series, Shape,
};
use trackdyn_core::real;
use trackdyn_diagnose::evidence::Origin;

const HEIGHT: i32 = 1420;
const SIDE: i32 = 400;
const COLUMNS: [i32; 4] = [158, 668, 1178, 1846];
const ROWS: [i32; 2] = [260, 830];
const BARS: [i32; 2] = [1606, 2270];

/// Cells along each axis; odd, so that a track at rest is in the middle of a cell.
const CELLS: usize = 17;

/// Pixels of the log as a page shows it.
const PIXELS: f64 = 1000.0;
/// Most stretches of a cell.
const MAX_STRETCHES: usize = 40;

/// Radius of a steady point, pixels.
const POINT: f64 = 6.0;
/// Most steady points that are shown one by one: more of them would overlap.
const MAX_POINTS: usize = 1500;

/// What a spot of the plane stands for: the samples of a cell, or one steady point.
#[derive(Clone, Copy)]
enum Stands {
    Cell,
    Point,
}

/// A value at a place of the plane.
struct Spot {
    at: [f64; 2],
    value: f64,
    /// The cell that it stands for.
    cell: usize,
}

/// The mean residual of each channel and the size of all, before and after.
pub(super) fn figure(subject: &Subject) -> Figure {
    let explanation = "What the model leaves unexplained of the motion, by the speeds of the left \
                       and the right track, in standard deviations of the noise; the same scale \
                       above and below. Without colour: nothing, or not driven. Of all cells the \
                       largest 2 % share the last colour.";
    let title = "Where observation and model differ";
    let mut figure = sheet::sheet("plane", HEIGHT, title, explanation, subject.caption);
    let views = subject.views();
    let fastest = views
        .iter()
        .flat_map(|view| view.evidence.samples())
        .map(|sample| sample.speeds.left.abs().max(sample.speeds.right.abs()))
        .fold(0.0, f64::max);
    let count: usize = views.iter().map(|view| view.evidence.samples().len()).sum();
    let shape = match subject.evidence().origin() {
        Origin::SteadyPoints(_) if count <= MAX_POINTS => Stands::Point,
        Origin::SteadyPoints(_) | Origin::Drive(_) => Stands::Cell,
    };
    let room = match shape {
        Stands::Cell => 1.03,
        Stands::Point => 1.08,
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
    let stretches = match shape {
        Stands::Cell => stretches(subject, extent),
        Stands::Point => Vec::new(),
    };
    let limit = |values: &mut dyn Iterator<Item = f64>, least: f64| {
        quantile(values, 0.98).unwrap_or(0.0).max(least)
    };
    let most = limit(&mut means.iter().flatten().flatten().map(|spot| spot.value.abs()), 1.0);
    let largest = limit(&mut sizes.iter().flatten().map(|spot| spot.value), 1.5);
    let mean = Scale::new(BLUE_RED, [-most, most], "mean, σ");
    let size = Scale::new(BLUES, [0.0, largest], "rms, σ");
    for (row, when) in ["before", "after"].into_iter().enumerate() {
        let channels = CHANNELS.iter().zip(&means[row]).map(|(name, spots)| (*name, spots, &mean));
        let all = channels.chain([("size of all", &sizes[row], &size)]);
        for (column, (name, spots, scale)) in all.enumerate() {
            let place = Area::new(COLUMNS[column], ROWS[row], SIDE, SIDE);
            let title = format!("{name}, {when}");
            let mut panel = panel(place, extent, &title);
            if spots.is_empty() {
                panel.explain_emptiness("not measured");
            } else {
                let of = |spot: &Spot| stretches.get(spot.cell).cloned();
                let seen = spots.iter().map_while(of).collect();
                panel.show_as(&title, shapes(spots, scale, extent, shape).from_stretches(seen));
            }
            let bar = |column: usize| Area::new(BARS[column], ROWS[row], 26, SIDE);
            if let Some(k) = [2, 3].iter().position(|last| *last == column) {
                panel.colour_bars.push(ColourBar { place: bar(k), scale: scale.clone() });
            }
            figure.panels.push(panel);
        }
    }
    figure
}

/// Mean square of what was measured of a sample, before (0) or after (1).
fn square(view: &View, when: usize, index: usize) -> Option<f64> {
    let measured = (0..3).filter(|&channel| view.evidence.is_measured(index, channel));
    let squares: Vec<f64> =
        measured.map(|channel| view.residuals[when][index][channel].powi(2)).collect();
    (!squares.is_empty()).then(|| squares.iter().sum::<f64>() / real(squares.len()))
}

/// Means over cells of the plane; of a table of steady motions each point for itself.
fn spots(
    views: &[View],
    shape: Stands,
    extent: f64,
    of: impl Fn(&View, usize) -> Option<f64>,
) -> Vec<Spot> {
    let samples = views.iter().flat_map(|view| {
        view.evidence.samples().iter().enumerate().map(move |(index, sample)| (view, index, sample))
    });
    let values = samples.filter_map(|(view, index, sample)| {
        let value = of(view, index).filter(|value| value.is_finite())?;
        Some(Spot { at: [sample.speeds.left, sample.speeds.right], value, cell: 0 })
    });
    if let Stands::Point = shape {
        return values.collect();
    }
    let mut sums = vec![(0.0, 0.0); CELLS * CELLS];
    for Spot { at, value, .. } in values {
        let (sum, count) = &mut sums[cell(at, extent)];
        *sum += value;
        *count += 1.0;
    }
    let middle = |cell: usize| extent * ((2.0 * real(cell) + 1.0) / real(CELLS) - 1.0);
    let sums = sums.into_iter().enumerate().filter(|(_, (_, count))| *count > 0.0);
    sums.map(|(index, (sum, count))| Spot {
        at: [middle(index % CELLS), middle(index / CELLS)],
        value: sum / count,
        cell: index,
    })
    .collect()
}

/// The cell that holds both track speeds.
fn cell([left, right]: [f64; 2], extent: f64) -> usize {
    let place = |speed: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
        let cell = (f64::midpoint(speed / extent, 1.0) * real(CELLS)) as usize;
        cell.min(CELLS - 1)
    };
    place(right) * CELLS + place(left)
}

/// Stretches of the log in which the tracks run as in each cell, the longest ones in the order of
/// time; those less than a pixel of the log apart are one.
fn stretches(subject: &Subject, extent: f64) -> Vec<Vec<[f64; 2]>> {
    let mut stretches: Vec<Vec<[f64; 2]>> = vec![Vec::new(); CELLS * CELLS];
    let Some(log) = Log::of(subject) else { return Vec::new() };
    let pixel = log.duration() / PIXELS;
    let mut runs = vec![None; CELLS * CELLS];
    for entry in &log.entries {
        let speeds = entry.sample.speeds;
        let cell = cell([speeds.left, speeds.right], extent);
        let run = Some(entry.sample.run);
        let is_same = std::mem::replace(&mut runs[cell], run) == run;
        match stretches[cell].last_mut() {
            Some(last) if is_same && entry.span[0] - last[1] < pixel => last[1] = entry.span[1],
            _ => stretches[cell].push(entry.span),
        }
    }
    for of_cell in &mut stretches {
        let length = |[start, end]: &[f64; 2]| end - start;
        of_cell.sort_by(|a, b| length(b).total_cmp(&length(a)));
        of_cell.truncate(MAX_STRETCHES);
        of_cell.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    stretches
}

/// An empty plane.
fn panel(place: Area, extent: f64, title: &str) -> Panel {
    let x = Axis::new("Vₗ", "m/s", [-extent, extent]);
    let is_labelled = place.left == COLUMNS[0];
    let y = Axis { is_labelled, ..Axis::new("Vᵣ", "m/s", [-extent, extent]) };
    Panel::new(title, place, x, y)
}

/// Squares that share samples; of a table of steady motions discs, one each.
fn shapes(spots: &[Spot], scale: &Scale, extent: f64, shape: Stands) -> Series {
    let values = spots.iter().map(|spot| spot.value).collect();
    let paint = Paint::Values { values, scale: scale.clone() };
    if let Stands::Point = shape {
        let points = spots.iter().map(|spot| spot.at).collect();
        return Points { points, shape: Shape::Disc(POINT), paint, edge: Some(FRAME) }.into();
    }
    let half = extent / real(CELLS);
    let square = |[x, y]: [f64; 2]| [[x - half, y - half], [x + half, y + half]];
    let boxes = spots.iter().map(|spot| square(spot.at)).collect();
    Boxes::new(boxes, paint).edged(1, GRID).into()
}
