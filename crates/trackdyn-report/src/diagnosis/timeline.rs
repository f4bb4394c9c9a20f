//! Residuals and track speeds over time.

use super::log::{Entry, Log};
use super::sheet::{self, AFTER_COLOUR, BEFORE_COLOUR, quantile};
use super::words::CHANNELS;
use super::{Subject, View};
use crate::colour::{FRAME, GREY, GRID};
use crate::figure::{
    Area, Axis, Boxes, Figure, Label, Legend, Line, Paint, Panel, Rule, Swatch, entry_colour,
};
use crate::text::{Horizontal, Style, Vertical, width};
use crate::ticks::number;
use trackdyn_core::real;

const LEFT: i32 = 158;
const WIDTH: i32 = 2182;
const TOP: i32 = sheet::TOP + 130;
/// Height of a panel, and distance of their tops.
const ROW: [i32; 2] = [260, 376];
const HEIGHT: i32 = TOP + 3 * ROW[1] + ROW[0] + 100 + sheet::FOOT;

/// Columns of time that a log is cut into where it has more samples: about one for each pixel at
/// which the page shows the figure.
const COLUMNS: usize = 1000;

/// Share of the residuals that are inside the frame.
const SHOWN_SHARE: f64 = 0.998;
/// Half the range of residuals at least, σ.
const MIN_EXTENT: f64 = 4.0;
/// Colours of the left and the right track among those of entries.
const TRACKS: [usize; 2] = [2, 3];
/// Names of the lines.
const NAMES: [[&str; 2]; 2] = [["left track", "right track"], ["before", "after"]];

/// Values at a time: left and right track speed, then the residual of each channel before and
/// after; none where not measured.
type Values = [Option<f64>; 8];

/// A row of values without gaps.
type Row = Vec<(f64, Values)>;

/// Track speeds and residuals; none of a table of steady points.
pub(super) fn figure(subject: &Subject) -> Option<Figure> {
    let log = Log::of(subject)?;
    let rows = rows(&log);
    let thinned = thinned(&log).unwrap_or_default();
    let explanation = format!(
        "Observed minus predicted motion of each segment, in standard deviations of the noise; \
         runs one after the other, held-out runs on grey. {thinned}"
    );
    let title = "When observation and model differ";
    let mut figure = sheet::sheet("time", HEIGHT, title, &explanation, subject.caption);
    let line = |entry: usize| Swatch::Line(entry_colour(entry), 6.0);
    let entries = [
        (line(TRACKS[0]), NAMES[0][0]),
        (line(TRACKS[1]), NAMES[0][1]),
        (line(BEFORE_COLOUR), "residual before"),
        (line(AFTER_COLOUR), "residual after"),
    ];
    figure.legends.push(Legend::of_marks([LEFT, sheet::TOP + 20], sheet::RIGHT, entries));
    let fastest = extent(&rows, 0..2, 1.0, 0.0).max(1e-3);
    figure.panels.push(panel(&log, &rows, 0, ["Track speeds", "speed", "m/s"], fastest));
    let most = extent(&rows, 2..8, SHOWN_SHARE, MIN_EXTENT);
    for (channel, name) in CHANNELS.iter().enumerate() {
        let title = format!("Residual, {name}");
        figure.panels.push(panel(&log, &rows, 1 + channel, [&title, "residual", "σ"], most));
    }
    Some(figure)
}

/// What is shown of a log that has more samples than columns of time; none where it has not.
pub(super) fn thinned(log: &Log) -> Option<String> {
    let column = number(log.duration() / real(COLUMNS), 2);
    is_thinned(log)
        .then(|| format!("Of every {column} s the smallest and the largest value are shown."))
}

/// Whether several samples share a column of time.
fn is_thinned(log: &Log) -> bool {
    log.entries.len() > 2 * COLUMNS
}

/// Half the range of these values.
fn extent(rows: &[Row], of: std::ops::Range<usize>, share: f64, least: f64) -> f64 {
    let values = rows.iter().flatten().flat_map(|(_, values)| &values[of.clone()]);
    let sizes = values.flatten().map(|value| value.abs());
    1.06 * quantile(sizes, share).unwrap_or(0.0).max(least)
}

fn panel(
    log: &Log,
    rows: &[Row],
    row: usize,
    [title, quantity, unit]: [&str; 3],
    extent: f64,
) -> Panel {
    let last = row == 3;
    let place = Area::new(LEFT, TOP + sheet::rows(row) * ROW[1], WIDTH, ROW[0]);
    let quantities = ["time since the log began", "time driven, runs one after the other"];
    let quantity_of_time = quantities[usize::from(log.runs.len() > 1)];
    let end = log.duration().max(1e-3);
    let x = Axis { is_labelled: last, ..Axis::new(quantity_of_time, "s", [0.0, end]) };
    // the first panel has room for the numbers of the runs
    let top = if row == 0 { 1.4 * extent } else { extent };
    let mut panel = Panel::new(title, place, x, Axis::new(quantity, unit, [-extent, top]));
    let held_out = log.runs.iter().filter(|run| run.is_held_out);
    let held_out = held_out.map(|run| [[run.at, -extent], [run.at + run.duration, top]]);
    let held_out: Vec<_> = held_out.collect();
    if !held_out.is_empty() {
        panel.show_as("held out", Boxes::new(held_out, Paint::One(HELD_OUT)));
    }
    for run in log.runs.iter().skip(1) {
        panel.show(Rule::upright(run.at, 2.0, GRID));
    }
    panel.show(Rule::level(0.0, 2.0, FRAME));
    let (first, colours) =
        if row == 0 { (0, TRACKS) } else { (2 * row, [BEFORE_COLOUR, AFTER_COLOUR]) };
    for (k, colour) in colours.into_iter().enumerate() {
        for points in rows {
            let points: Vec<_> =
                points.iter().filter_map(|(t, values)| Some([*t, values[first + k]?])).collect();
            if !points.is_empty() {
                let line = Line { points, thickness: 3.0, colour: entry_colour(colour) };
                panel.show_as(NAMES[usize::from(row > 0)][k], line);
            }
        }
    }
    if row > 0 && !rows.iter().flatten().any(|(_, values)| values[first].is_some()) {
        panel.explain_emptiness("not measured");
    }
    if row == 0 {
        name_runs(&mut panel, log);
    }
    panel
}

/// Paper of held-out runs.
const HELD_OUT: crate::colour::Rgb = [240, 240, 240];
const NAME_SIZE: f32 = 20.0;

/// Numbers of the runs at the top of a panel, where there is room for each.
fn name_runs(panel: &mut Panel, log: &Log) {
    const GAP: f64 = 12.0;
    let scale = panel.scale();
    let top = panel.y.range[1];
    for run in &log.runs {
        let star = if run.is_held_out { "*" } else { "" };
        let name = format!("run {}{star}", run.name);
        if f64::from(width(&name, NAME_SIZE)) + GAP < scale * run.duration {
            let style = Style::new(NAME_SIZE).colour(GREY).anchor(Horizontal::Left, Vertical::Top);
            panel.labels.push(Label::new(name, [run.at, top], style).shifted([8, 8]));
        }
    }
}

/// Rows of values without gaps, thinned where a log has more samples than columns.
fn rows(log: &Log) -> Vec<Row> {
    let lost: Vec<Vec<bool>> = log.views.iter().map(lost).collect();
    let is_kept = |entry: &Entry| !lost[entry.view][entry.index];
    let kept: Vec<&Entry> = log.entries.iter().filter(|entry| is_kept(entry)).collect();
    let column = log.duration() / real(COLUMNS);
    let rows = kept.chunk_by(|a, b| Log::follows(a, b));
    let thinned = is_thinned(log);
    rows.map(|row| {
        let row = row.iter().map(|entry| point(log, entry)).collect::<Row>();
        if thinned { thinner(&row, column) } else { row }
    })
    .collect()
}

/// Which samples of a view are left out as outliers: nothing is known of their residuals.
fn lost(view: &View) -> Vec<bool> {
    view.evidence.motions().iter().map(|seen| seen.is_lost).collect()
}

/// The middle of a sample, and its values.
fn point(log: &Log, entry: &Entry) -> (f64, Values) {
    let view = &log.views[entry.view];
    let mut values = [None; 8];
    values[0] = Some(entry.sample.speeds.left);
    values[1] = Some(entry.sample.speeds.right);
    for channel in (0..3).filter(|&one| view.evidence.is_measured(entry.index, one)) {
        for (k, residuals) in view.residuals.iter().enumerate() {
            let value = residuals[entry.index][channel];
            values[2 + 2 * channel + k] = Some(value).filter(|value| value.is_finite());
        }
    }
    (f64::midpoint(entry.span[0], entry.span[1]), values)
}

/// The smallest and the largest of each value in every column of time, in their order.
fn thinner(row: &Row, column: f64) -> Row {
    let place = |(t, _): &(f64, Values)| (t / column).floor();
    let columns = row.chunk_by(|a, b| place(a) == place(b));
    let mut thinned = Row::new();
    for points in columns {
        let [(first, values)] = points else {
            let start = place(&points[0]) * column;
            let ends: [[Option<f64>; 2]; 8] = std::array::from_fn(|k| ends(points, k));
            for (k, share) in [0.25, 0.75].into_iter().enumerate() {
                thinned.push((start + share * column, ends.map(|ends| ends[k])));
            }
            continue;
        };
        thinned.push((*first, *values));
    }
    thinned
}

/// The smallest and the largest of one value, in their order.
fn ends(points: &[(f64, Values)], k: usize) -> [Option<f64>; 2] {
    let values =
        || points.iter().enumerate().filter_map(|(at, (_, values))| Some((at, values[k]?)));
    let least = values().min_by(|(_, a), (_, b)| a.total_cmp(b));
    let most = values().max_by(|(_, a), (_, b)| a.total_cmp(b));
    let (Some((at, least)), Some((after, most))) = (least, most) else { return [None; 2] };
    if at <= after { [Some(least), Some(most)] } else { [Some(most), Some(least)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_smallest_and_the_largest_in_their_order() {
        let point =
            |t: f64, value: f64| (t, [Some(value), None, None, None, None, None, None, None]);
        let row = vec![point(0.1, 1.0), point(0.2, 5.0), point(0.3, -2.0), point(0.4, 0.0)];
        let thinned = thinner(&[row, vec![point(1.5, 7.0)]].concat(), 1.0);
        let values: Vec<_> = thinned.iter().map(|(t, values)| (*t, values[0])).collect();
        assert_eq!(values, [(0.25, Some(5.0)), (0.75, Some(-2.0)), (1.5, Some(7.0))]);
        assert!(thinned.iter().all(|(_, values)| values[1].is_none()));
    }
    #[test]
    fn a_long_log_has_two_points_in_a_column() {
        let rest = [None; 7];
        let values = |value: f64| {
            let mut values = [Some(value); 8];
            values[1..].copy_from_slice(&rest);
            values
        };
        let row: Row =
            (0..100_000).map(|k| (0.1 * f64::from(k), values(f64::from(k).sin()))).collect();
        let thinned = thinner(&row, 1e4 / real(COLUMNS));
        assert_eq!(thinned.len(), 2 * COLUMNS);
        assert!(thinned.windows(2).all(|pair| pair[0].0 < pair[1].0));
        let most = thinned.iter().filter_map(|(_, values)| values[0]).fold(0.0, f64::max);
        assert!(most > 0.999, "{most}");
    }
}
