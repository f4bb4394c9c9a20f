//! Power: shares against how strongly something shows.

use super::{Entrant, beside, legend};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{GREY, INK};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{Panel, TITLE_SIZE};
use crate::sheet::{self, Mark, px};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_core::real;

const HEIGHT: i32 = 1680;
/// Legend, and the four panels in reading order.
const LEGEND: [i32; 2] = [sheet::LEFT, sheet::TOP + 20];
const PLOTS: [Area; 4] = [
    Area::new(170, 330, 930, 460),
    Area::new(1390, 330, 930, 460),
    Area::new(170, 1010, 930, 460),
    Area::new(1390, 1010, 930, 460),
];
/// Room above shares of one, in which the numbers of cases stand.
const ABOVE: f64 = 0.14;
/// Room below shares of zero, for markers.
const BELOW: f64 = 0.06;
const SMALL: f32 = 20.0;

/// Shares of the cases within limits of z.
#[derive(Clone, Debug)]
pub struct Power<'a> {
    /// What is counted.
    pub title: &'a str,
    /// Which z.
    pub z: &'a str,
    /// A z that means something, and what.
    pub mark: (f64, &'a str),
    /// Limits of z, ascending; the first is zero and the last infinite.
    pub limits: &'a [f64],
    /// Programs with one share for each interval between two limits.
    pub entrants: Vec<Entrant<'a>>,
}

/// Four panels of power, for reading from left to right and down. `caption` stands below, for what
/// the figure was made from.
///
/// Returns the bytes of a PNG. They depend on the arguments only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no share is the cause of one.
pub fn power(panels: &[Power; 4], caption: &str) -> Result<Vec<u8>, Error> {
    let explanation = "Cases with one effect of the catalogue, without the class of constants, by how strongly it shows: z_det is its size in \
                       standard deviations of the noise, z_iso what is left of it beside the effect that \
                       comes closest. Numbers at the top: cases. Nothing is drawn where there are none.";
    let title = "What is found against what could be found";
    let mut canvas = sheet::sheet(HEIGHT, title, explanation, caption)?;
    let names = panels[0].entrants.iter().map(|entrant| entrant.name);
    legend(&mut canvas, LEGEND, names, &[(Mark::Line(INK, 3.0), "bars: 95 % intervals")]);
    for (of, plot) in panels.iter().zip(PLOTS) {
        draw(&mut canvas, of, plot);
    }
    canvas.to_small_png()
}

fn draw(canvas: &mut Canvas, of: &Power, plot: Area) {
    let bins = of.limits.len().saturating_sub(1);
    let panel = Panel { plot, x: [0.0, real(bins.max(1))], y: [-BELOW, 1.0 + ABOVE] };
    sheet::axis_left(canvas, &panel, "share of cases");
    let shown = |limit: f64| {
        if limit.is_finite() {
            number(limit, usize::from(limit.fract() > 0.0))
        } else {
            "more".to_owned()
        }
    };
    let label = format!("{} (standard deviations of the noise)", of.z);
    let ticks = of.limits.iter().enumerate().map(|(k, limit)| (real(k), shown(*limit)));
    sheet::axis_below(canvas, &panel, &ticks.collect::<Vec<_>>(), &label);
    let style = Style::new(TITLE_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text(of.title, [plot.left, plot.top - 16], &style);
    let (z, meaning) = of.mark;
    if let Some(x) = place(of.limits, z) {
        // below the numbers of cases
        let top = px(panel.pixel([0.0, 1.0 + ABOVE / 4.0])[1]);
        let below = Area::new(plot.left, top, plot.width, plot.bottom() - top);
        sheet::dashes(canvas, &Panel { plot: below, ..panel }, x, GREY);
        panel.remark(canvas, &format!("dashed: {meaning} from z = {} on", number(z, 0)));
    }
    for bin in 0..bins {
        counts(canvas, of, &panel, bin);
    }
    for (entry, entrant) in of.entrants.iter().enumerate() {
        let column =
            |bin: usize| panel.pixel([real(bin) + beside(entry, of.entrants.len()), 0.0])[0];
        let row = |share: f64| panel.pixel([0.0, share])[1];
        let shown = entrant.shares.iter().enumerate().filter_map(|(bin, share)| {
            let (share, interval) = share.as_ref()?.shown()?;
            Some(([column(bin), row(share)], interval.map(row)))
        });
        let shown: Vec<_> = shown.collect();
        look::line(canvas, shown.iter().map(|(at, _)| *at), 3.0, look::colour(entry));
        for (at, rows) in shown {
            look::whisker(canvas, at[0], rows, look::colour(entry));
            look::marker(canvas, entry, at);
        }
    }
    panel.border(canvas);
}

/// Writes how many cases an interval has: of all programs alike, or from the least to the most.
fn counts(canvas: &mut Canvas, of: &Power, panel: &Panel, bin: usize) {
    let cases = of.entrants.iter().filter_map(|entrant| Some((*entrant.shares.get(bin)?)?.cases));
    let (least, most) = cases.fold((usize::MAX, 0), |(low, high), n| (low.min(n), high.max(n)));
    if most == 0 {
        return;
    }
    let text = if least == most { most.to_string() } else { format!("{least}-{most}") };
    let [column, row] = panel.pixel([real(bin) + 0.5, 1.0 + ABOVE / 2.0]).map(px);
    let style = Style::new(SMALL).colour(GREY).anchor(Horizontal::Centre, Vertical::Middle);
    canvas.text(&text, [column, row], &style);
}

/// Where a z lies among the limits: by its logarithm between two of them.
fn place(limits: &[f64], z: f64) -> Option<f64> {
    let bin = limits.windows(2).position(|pair| (pair[0]..pair[1]).contains(&z))?;
    let (low, high) = (limits[bin], limits[bin + 1]);
    let share =
        if low > 0.0 && high.is_finite() { (z / low).ln() / (high / low).ln() } else { 0.5 };
    Some(real(bin) + share)
}
