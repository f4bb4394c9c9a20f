//! Power: shares against how strongly something shows.

use super::{Entrant, beside, legend};
use crate::colour::GREY;
use crate::figure::{Area, Axis, Estimates, Figure, Label, Panel, Rule};
use crate::sheet;
use crate::ticks::number;
use trackdyn_core::real;

const HEIGHT: i32 = 1680;
/// The four panels in reading order.
const PLOTS: [Area; 4] = [
    Area::new(170, 330, 930, 460),
    Area::new(1390, 330, 930, 460),
    Area::new(170, 1010, 930, 460),
    Area::new(1390, 1010, 930, 460),
];
/// Room above shares of one, in which the numbers of cases stand.
const ROOM_ABOVE: f64 = 0.14;
/// Room below shares of zero, for markers.
const ROOM_BELOW: f64 = 0.06;
const SMALL_TEXT: f32 = 20.0;

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
pub fn power(panels: &[Power; 4], caption: &str) -> Figure {
    let explanation = "Cases with one effect of the catalogue, without the class of constants, by \
                       how strongly it shows: z_det is its size in standard deviations of the \
                       noise, z_iso what is left of it beside the effect that comes closest. \
                       Numbers at the top: cases. Nothing is drawn where there are none.";
    let title = "What is found against what could be found";
    let mut figure = sheet::sheet("power", HEIGHT, title, explanation, caption);
    figure.legends.push(legend(panels[0].entrants.iter().map(|entrant| entrant.name)));
    figure.panels = panels.iter().zip(PLOTS).map(|(of, plot)| panel(of, plot)).collect();
    figure
}

fn panel(of: &Power, place: Area) -> Panel {
    let bins = of.limits.len().saturating_sub(1);
    let shown = |limit: f64| {
        if limit.is_finite() {
            number(limit, usize::from(limit.fract() > 0.0))
        } else {
            "more".to_owned()
        }
    };
    let ticks = of.limits.iter().enumerate().map(|(k, limit)| (real(k), shown(*limit)));
    let x = Axis::new(of.z, "standard deviations of the noise", [0.0, real(bins.max(1))]);
    let y = Axis::new("share of cases", "", [-ROOM_BELOW, 1.0 + ROOM_ABOVE]);
    let mut panel = Panel::new(of.title, place, x.at(ticks.collect()), y);
    let (z, meaning) = of.mark;
    if let Some(x) = position(of.limits, z) {
        panel.show_as(meaning, Rule::upright(x, 3.0, GREY).dashed());
        panel.remark = format!("dashed: {meaning} from z = {} on", number(z, 0));
    }
    for bin in 0..bins {
        if let Some(cases) = cases(of, bin) {
            let at = [real(bin) + 0.5, 1.0 + ROOM_ABOVE / 2.0];
            panel.labels.push(Label::on(&cases, at, (SMALL_TEXT, GREY)).on_white());
        }
    }
    for (entry, entrant) in of.entrants.iter().enumerate() {
        let shown = entrant.shares.iter().enumerate().filter_map(|(bin, share)| {
            let (share, interval) = share.as_ref()?.shown()?;
            Some(([real(bin) + beside(entry, of.entrants.len()), share], Some(interval)))
        });
        panel.show_as(entrant.name, Estimates::of_entry(entry, shown).joined(3.0));
    }
    panel
}

/// How many cases an interval has: of all programs alike, or from the least to the most.
fn cases(of: &Power, bin: usize) -> Option<String> {
    let cases = of.entrants.iter().filter_map(|entrant| Some((*entrant.shares.get(bin)?)?.cases));
    let (least, most) = cases.fold((usize::MAX, 0), |(low, high), n| (low.min(n), high.max(n)));
    let text = if least == most { most.to_string() } else { format!("{least}-{most}") };
    (most > 0).then_some(text)
}

/// Where a z lies among the limits: by its logarithm between two of them.
fn position(limits: &[f64], z: f64) -> Option<f64> {
    let bin = limits.windows(2).position(|pair| (pair[0]..pair[1]).contains(&z))?;
    let (low, high) = (limits[bin], limits[bin + 1]);
    let share =
        if low > 0.0 && high.is_finite() { (z / low).ln() / (high / low).ln() } else { 0.5 };
    Some(real(bin) + share)
}
