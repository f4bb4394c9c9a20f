//! The figure of an inspection: track speeds and yaw rates of a recording over time.

mod curves;
mod timeline;

use crate::colour::{FRAME, GREY, INK, Rgb};
use crate::figure::{Area, Axis, Entry, Figure, Legend, Line, Panel, Rule, Swatch, entry_colour};
use crate::sheet::{self, LEFT, RIGHT};
use crate::ticks::number;
use curves::{Limits, readings, steps};
use timeline::Timeline;
use trackdyn_estimate::{Rate, YawRates};

const HEIGHT: i32 = 1500;
/// Middle row of the legend.
const LEGEND: i32 = 196;
const PLOT: i32 = LEFT + 130;
const WIDTH: i32 = RIGHT - PLOT;
const SPEEDS: Area = Area::new(PLOT, 280, WIDTH, 300);
const RATES: Area = Area::new(PLOT, 650, WIDTH, 380);
const RESIDUALS: Area = Area::new(PLOT, 1100, WIDTH, 230);

const LEFT_TRACK: usize = 0;
const RIGHT_TRACK: usize = 1;
const PREDICTED_COLOUR: usize = 4;
const RESIDUAL_COLOUR: usize = 2;

/// What an inspection shows over time.
#[derive(Clone, Copy, Debug)]
pub struct Inspected<'a> {
    /// Name of the recording.
    pub name: &'a str,
    /// Speeds and yaw rates.
    pub rates: &'a YawRates,
    /// Track speed for each unit that is shown, m/s: 1, or the radius that was assumed where joints
    /// turn in rad/s and their radius is not known.
    pub speed_unit: f64,
    /// What the prediction is made by; none where nothing could be fitted.
    pub model: Option<&'a str>,
}

/// A recording over time, its runs one after another: speeds of both tracks; yaw rate as measured
/// and as the model makes it of the track speeds; what is left. `caption` stands below, for what
/// the figure was made from.
pub fn inspection(of: &Inspected, caption: &str) -> Figure {
    let runs = of.rates.runs.len();
    let duration: f64 = of.rates.runs.iter().map(|run| run.duration).sum();
    let title = format!(
        "{}: {runs} {}, {} s",
        of.name,
        if runs == 1 { "run" } else { "runs, one after another" },
        number(duration, 0)
    );
    let explanation = match of.model {
        Some(model) => format!(
            "Predicted: {model}. The residual is measured minus predicted yaw rate, each a mean \
             between two poses. What repeats with turns is slip or a wrong number; single spikes \
             are poses or readings that jump; a drift is a gyroscope's bias."
        ),
        None => {
            "No yaw rate is predicted: the recording determines no distance of the ICRs.".to_owned()
        }
    };
    let mut figure = sheet::sheet("inspect", HEIGHT, &title, &explanation, caption);
    figure.legends.push(legend(of));
    let timeline = Timeline::new(&of.rates.runs, WIDTH);
    figure.panels.push(speeds(of, &timeline));
    figure.panels.push(rates(of, &timeline));
    figure.panels.push(residuals(of, &timeline));
    figure
}

fn legend(of: &Inspected) -> Legend {
    let line = |text: &str, thickness: f64, colour: Rgb| Entry {
        text: text.to_owned(),
        swatches: vec![Swatch::Line(colour, thickness)],
    };
    let mut entries = vec![
        line("left track", 4.0, entry_colour(LEFT_TRACK)),
        line("right track", 4.0, entry_colour(RIGHT_TRACK)),
        line("yaw rate measured", 7.0, INK),
    ];
    if of.model.is_some() {
        entries.push(line("predicted", 4.0, entry_colour(PREDICTED_COLOUR)));
        entries.push(line("residual", 4.0, entry_colour(RESIDUAL_COLOUR)));
    }
    Legend { at: [LEFT, LEGEND], right: RIGHT, size: 26.0, sample: 64, gaps: [14, 50], entries }
}

/// A panel over the time of all runs, with a line where a run begins unless these are too many.
fn over_time(title: &str, place: Area, timeline: &Timeline, y: Axis) -> Panel {
    let is_last = place == RESIDUALS;
    let x = Axis { is_labelled: is_last, ..timeline.axis(is_last) };
    let mut panel = Panel::new(title, place, x, y);
    for start in timeline.starts().iter().skip(1).filter(|_| !timeline.is_crowded()) {
        panel.show(Rule::upright(*start, 2.0, GREY));
    }
    panel
}

fn speeds(of: &Inspected, timeline: &Timeline) -> Panel {
    let unit = of.speed_unit;
    let is_known = (unit - 1.0).abs() < f64::EPSILON;
    let both = of.rates.runs.iter().flat_map(|run| &run.tracks);
    let limits = Limits::of(both.flat_map(|[_, left, right]| [left / unit, right / unit]));
    let (quantity, symbol) =
        if is_known { ("track speed", "m/s") } else { ("joint speed", "rad/s") };
    let mut panel = over_time("Tracks", SPEEDS, timeline, limits.axis(quantity, symbol));
    limits.note(&mut panel);
    for (entry, name) in [(LEFT_TRACK, "left track"), (RIGHT_TRACK, "right track")] {
        for (run, start) in of.rates.runs.iter().zip(timeline.starts()) {
            let points = run
                .tracks
                .iter()
                .map(|reading| [start + reading[0], limits.clamp(reading[1 + entry] / unit)]);
            for points in readings(&points.collect::<Vec<_>>(), timeline.column()) {
                panel.show_as(name, Line { points, thickness: 3.0, colour: entry_colour(entry) });
            }
        }
    }
    panel
}

fn rates(of: &Inspected, timeline: &Timeline) -> Panel {
    let all = of.rates.rates();
    let limits = match of.model {
        Some(_) => Limits::of(all.flat_map(|rate| [rate.measured, rate.predicted])),
        None => Limits::of(all.map(|rate| rate.measured)),
    };
    let mut panel = over_time("Yaw rates", RATES, timeline, limits.axis("yaw rate", "rad/s"));
    limits.note(&mut panel);
    if of.rates.rates().next().is_none() {
        panel.explain_emptiness("no two poses that readings of the tracks cover");
    }
    let measured = |rate: &Rate| rate.measured;
    series(&mut panel, "measured", of, timeline, (&measured, &limits), (7.0, INK));
    if of.model.is_some() {
        let predicted = |rate: &Rate| rate.predicted;
        let style = (3.5, entry_colour(PREDICTED_COLOUR));
        series(&mut panel, "predicted", of, timeline, (&predicted, &limits), style);
    }
    panel
}

fn residuals(of: &Inspected, timeline: &Timeline) -> Panel {
    let limits = match of.model {
        Some(_) => Limits::of(of.rates.rates().map(Rate::residual)),
        None => Limits::of(std::iter::empty()),
    };
    let axis = limits.axis("residual", "rad/s");
    let mut panel = over_time("Measured minus predicted", RESIDUALS, timeline, axis);
    limits.note(&mut panel);
    panel.show(Rule::level(0.0, 2.0, FRAME));
    if of.model.is_none() {
        panel.explain_emptiness("nothing is predicted");
        return panel;
    }
    if let Some(deviation) = of.rates.deviation().filter(|_| panel.remark.is_empty()) {
        let digits = number(deviation, 4);
        panel.remark = format!("standard deviation {digits} rad/s, by the median");
    }
    let residual = |rate: &Rate| rate.residual();
    let style = (3.0, entry_colour(RESIDUAL_COLOUR));
    series(&mut panel, "residual", of, timeline, (&residual, &limits), style);
    panel
}

/// A quantity of the segments of all runs.
fn series(
    panel: &mut Panel,
    name: &str,
    of: &Inspected,
    timeline: &Timeline,
    (value, limits): (&dyn Fn(&Rate) -> f64, &Limits),
    (thickness, colour): (f64, Rgb),
) {
    for (run, start) in of.rates.runs.iter().zip(timeline.starts()) {
        let value = |rate: &Rate| limits.clamp(value(rate));
        for points in steps(&run.rates, *start, &value, timeline.column()) {
            panel.show_as(name, Line { points, thickness, colour });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_estimate::RunRates;

    fn run(run: i64, count: u32) -> RunRates {
        let at = |k: u32| 0.5 * f64::from(k);
        let rate = |k: u32| {
            let (measured, predicted) = (at(k).sin(), 0.9 * at(k).sin());
            Rate { start: at(k), end: at(k + 1), measured, predicted, follows: k > 0 }
        };
        let tracks = (0..=count).map(|k| [at(k), 0.5, -0.5]).collect();
        RunRates { run, duration: at(count), tracks, rates: (0..count).map(rate).collect() }
    }

    fn figure(rates: &YawRates, speed_unit: f64) -> Figure {
        let model = Some("x_r − x_l = 1.02 m");
        inspection(&Inspected { name: "a drive", rates, speed_unit, model }, "caption")
    }

    /// Any number of runs, of any length, with an outlier that would flatten all else.
    #[test]
    fn every_recording_can_be_drawn() {
        for (runs, count) in [(0, 0), (1, 0), (1, 1), (1, 5000), (700, 4), (3, 100)] {
            let mut rates = YawRates { runs: (0..runs).map(|id| run(id, count)).collect() };
            let figure = figure(&rates, 1.0);
            assert_eq!(figure.panels.len(), 3);
            figure.to_png().expect("drawn");
            if let Some(rate) = rates.runs.first_mut().and_then(|run| run.rates.get_mut(2)) {
                rate.measured = 1e6;
                let with_outlier = self::figure(&rates, 1.0);
                let residuals = &with_outlier.panels[2];
                assert!(count < 100 || residuals.y.range[1] < 1.0, "{:?}", residuals.y.range);
                assert!(count < 100 || residuals.remark.contains("beyond"), "{}", residuals.remark);
            }
        }
    }

    #[test]
    fn a_recording_without_a_radius_shows_its_joints() {
        let rates = YawRates { runs: vec![run(0, 10)] };
        let speeds = &figure(&rates, 0.1).panels[0];
        assert_eq!((speeds.y.unit.as_str(), speeds.y.quantity.as_str()), ("rad/s", "joint speed"));
        assert!(speeds.y.contains(5.0) && !speeds.y.contains(9.0));
    }
}
