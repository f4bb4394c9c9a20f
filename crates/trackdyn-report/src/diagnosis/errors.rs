//! Errors before and after against the floor of the noise.

use super::sheet::{self, AFTER, BEFORE, Mark, px};
use super::words::CHANNELS;
use super::{Subject, View};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{FRAME, GREY, GRID, INK, Rgb};
use crate::look;
use crate::panel::ticks::{Ticks, number};
use crate::panel::{LABEL_SIZE, Panel, TICK_SIZE, TITLE_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;
use trackdyn_diagnose::evidence::{Origin, Sample};
use trackdyn_diagnose::locate::excess_of;

const HEIGHT: i32 = 1000;
const TOP: i32 = sheet::TOP + 130;
const FLOOR: Rgb = [120, 120, 120];
/// Runs that have a place of their own.
const MOST_RUNS: usize = 40;
/// Runs that have a name each.
const CROWDED: usize = 16;

/// Places of the groups with and without that of the runs.
const NARROW: [Area; 3] =
    [Area::new(158, TOP, 500, 480), Area::new(838, TOP, 560, 480), Area::new(1578, TOP, 760, 480)];
const WIDE: [Area; 2] = [Area::new(158, TOP, 900, 480), Area::new(1238, TOP, 1100, 480)];

/// Places with their bars.
struct Bars {
    title: String,
    places: Vec<(String, Vec<(Rgb, f64)>)>,
}

/// Draws the error on the runs that judge, by channel and run by run.
pub(super) fn draw(subject: &Subject) -> Result<Vec<u8>, Error> {
    let fit = &subject.diagnosis.held_out;
    let explanation = "Root mean square of the residuals in standard deviations of the noise. Floor: what is \
                       left when everything that could move ICRs or instruments, known or not, is fitted away.";
    let title = if fit.are_held_out {
        "Error where nothing was fitted or chosen"
    } else {
        "Error on what was fitted (nothing was held out)"
    };
    let mut canvas = sheet::sheet(HEIGHT, title, explanation, subject.caption)?;
    let [before, after] = [BEFORE, AFTER].map(look::colour);
    let entries = [
        (Mark::Box(before), "before"),
        (Mark::Box(after), "after"),
        (Mark::Box(FLOOR), "noise floor"),
    ];
    sheet::legend(&mut canvas, [158, sheet::TOP + 20], &entries);
    let which = if fit.are_held_out { "held-out" } else { "all" };
    let what = subject.evidence().origin().runs();
    let place = |text: &str, bars: Vec<(Rgb, f64)>| (text.to_owned(), bars);
    let whole = Bars {
        title: format!("{which} {what}"),
        places: vec![
            place("before", vec![(before, fit.before)]),
            place("after", vec![(after, fit.after)]),
            place("floor", vec![(FLOOR, fit.noise_floor)]),
        ],
    };
    let View { evidence, residuals, .. } = subject.judging();
    let channels = Bars {
        title: "by channel".to_owned(),
        places: (0..3)
            .map(|channel| {
                if !(0..evidence.samples().len()).any(|index| evidence.is_measured(index, channel))
                {
                    return (format!("{}: not measured", CHANNELS[channel]), Vec::new());
                }
                let of = |_: &Sample, one| one == channel;
                let [a, b] = residuals.map(|residual| excess_of(evidence, residual, of));
                place(CHANNELS[channel], vec![(before, a), (after, b)])
            })
            .collect(),
    };
    let runs = runs(subject, [before, after]);
    let areas = if runs.places.is_empty() { WIDE.as_slice() } else { NARROW.as_slice() };
    for (area, bars) in areas.iter().zip([whole, channels, runs]) {
        group(&mut canvas, *area, &bars, fit.noise_floor);
    }
    let style = Style::new(LABEL_SIZE).colour(INK);
    let text = match fit.excess_explained() {
        Some(share) => format!(
            "{} % of the excess over the noise floor is explained.",
            number(100.0 * share, 1)
        ),
        None => "There is no excess over the noise floor to explain.".to_owned(),
    };
    canvas.text(&text, [158, HEIGHT - 106], &style);
    canvas.to_small_png()
}

/// Before and after of every run; none where there are too many.
fn runs(subject: &Subject, colours: [Rgb; 2]) -> Bars {
    let names = subject.evidence().runs();
    let mut bars = Bars { title: "run by run (* held out)".to_owned(), places: Vec::new() };
    let is_table = matches!(subject.evidence().origin(), Origin::SteadyPoints(_));
    if is_table || names.len() > MOST_RUNS {
        return bars;
    }
    for (run, name) in names.iter().enumerate() {
        for View { evidence, residuals, is_held_out } in subject.views() {
            let of = |sample: &Sample, _| sample.run == run;
            if !evidence.samples().iter().any(|sample| sample.run == run) {
                continue;
            }
            let values = residuals.map(|residual| excess_of(evidence, residual, of));
            let star = if is_held_out { "*" } else { "" };
            bars.places.push((format!("{name}{star}"), colours.into_iter().zip(values).collect()));
        }
    }
    bars
}

fn group(canvas: &mut Canvas, area: Area, bars: &Bars, floor: f64) {
    let all = bars.places.iter().flat_map(|(_, bars)| bars).map(|(_, value)| *value);
    let highest = 1.12 * all.filter(|value| value.is_finite()).fold(floor.max(1.0), f64::max);
    let panel = Panel { plot: area, x: [0.0, real(bars.places.len())], y: [0.0, highest] };
    let ticks = Ticks::along(panel.y, area.height, 60);
    let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Right, Vertical::Middle);
    for value in &ticks.values {
        let row = px(panel.pixel([0.0, *value])[1]);
        canvas.fill(Area::new(area.left, row, area.width, 1), GRID);
        canvas.text(&number(*value, ticks.decimals), [area.left - 14, row], &style);
    }
    for (place, (name, values)) in bars.places.iter().enumerate() {
        let width = 0.7 / real(values.len().max(1));
        for (k, (colour, value)) in values.iter().enumerate() {
            let left = real(place) + 0.15 + width * real(k);
            let bar = panel.area([left, 0.0], [left + 0.94 * width, value.min(highest)]);
            canvas.fill(bar, *colour);
            if bars.places.len() <= 4 {
                let style = Style::new(20.0).anchor(Horizontal::Centre, Vertical::Baseline);
                let middle = bar.left + bar.width / 2;
                let decimals = if *value < 10.0 { 3 } else { 1 };
                canvas.text(&number(*value, decimals), [middle, bar.top - 8], &style);
            }
        }
        let column = px(panel.pixel([real(place) + 0.5, 0.0])[0]);
        let size = if bars.places.len() > 10 { 18.0 } else { TICK_SIZE };
        let style = Style::new(size).anchor(Horizontal::Centre, Vertical::Top);
        let each = if bars.places.len() <= CROWDED { 1 } else { 2 };
        if place % each == 0 {
            let room = px(panel.pixel([real(each), 0.0])[0]) - px(panel.pixel([0.0, 0.0])[0]);
            let name = canvas.fitted(name, size, room - 10);
            canvas.text(&name, [column, area.bottom() + 16], &style);
        }
    }
    let row = px(panel.pixel([0.0, floor])[1]);
    for column in (area.left..area.right()).step_by(16) {
        canvas.fill(Area::new(column, row - 1, 8, 3), FLOOR);
    }
    canvas.outline(
        Area::new(area.left - 1, area.top - 1, area.width + 2, area.height + 2),
        2,
        FRAME,
    );
    let style = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text(&bars.title, [area.left, area.top - 16], &style);
    let style = Style { upwards: true, ..Style::new(LABEL_SIZE) };
    let style = style.anchor(Horizontal::Centre, Vertical::Top);
    canvas.text("rms residual (σ)", [area.left - 118, area.top + area.height / 2], &style);
}
