//! ln evidence of all candidates as bars.

use super::Subject;
use super::candidates::{Candidate, Outcome};
use super::sheet::{self, Mark, label_left_of, label_right_of, px, rows};
use crate::Error;
use crate::canvas::Area;
use crate::colour::{FRAME, GREY, INK, Rgb};
use crate::look;
use crate::panel::ticks::number;
use crate::panel::{Panel, TICK_SIZE};
use trackdyn_core::real;

const TOP: i32 = sheet::TOP + 80;
const ROW: i32 = 44;
const LABELS: i32 = 400;
const PANEL: i32 = 900;
const LOST: Rgb = [140, 140, 140];

/// Draws one row per candidate.
pub(super) fn draw(subject: &Subject, candidates: &[Candidate]) -> Result<Vec<u8>, Error> {
    let count = candidates.len().max(1);
    let height = TOP + rows(count) * ROW + 140 + sheet::FOOT;
    let explanation = "Gain of ln evidence: how much more probable the recording becomes with the effect, as \
                       a logarithm, its added freedom paid for. What is claimed is compared with the best model \
                       without it, the others each by itself. 3 is worth keeping, 5 may be claimed.";
    let title = "What speaks for each effect, and why it lost";
    let mut canvas = sheet::sheet(height, title, explanation, subject.caption)?;
    let entries = [
        (Mark::Box(colour(Outcome::Claimed)), "claimed"),
        (Mark::Box(colour(Outcome::Twin)), "cannot be told from what is claimed"),
        (Mark::Box(colour(Outcome::Lost)), "not claimed"),
    ];
    sheet::legend(&mut canvas, [LABELS, sheet::TOP + 14], &entries);
    let gains = || candidates.iter().filter_map(|one| one.gain);
    let most = gains().fold(10.0, f64::max);
    let least = gains().fold(-3.0, f64::min).max(-10.0);
    let plot = Area::new(LABELS, TOP, PANEL, rows(count) * ROW);
    let panel =
        Panel { plot, x: [stretched(1.15 * least), stretched(1.6 * most)], y: [real(count), 0.0] };
    let mut ticks = vec![-3.0, 0.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 1e5];
    ticks.retain(|value| (1.15 * least..=1.6 * most).contains(value));
    let ticks: Vec<(f64, String)> =
        ticks.iter().map(|&value| (stretched(value), number(value, 0))).collect();
    sheet::axis_below(&mut canvas, &panel, &ticks, "gain of ln evidence (stretched near 0)");
    let zero = px(panel.pixel([0.0, 0.0])[0]);
    canvas.fill(Area::new(zero - 1, TOP, 2, plot.height), FRAME);
    let worth = px(panel.pixel([stretched(5.0), 0.0])[0]);
    for row in (TOP..plot.bottom()).step_by(14) {
        canvas.fill(Area::new(worth, row, 2, 7), GREY);
    }
    for (row, one) in candidates.iter().enumerate() {
        let middle = TOP + rows(row) * ROW + ROW / 2;
        let name = super::words::id(one.effect);
        label_left_of(&mut canvas, name, [LABELS - 16, middle], TICK_SIZE, INK);
        let end = match one.gain {
            Some(gain) => {
                let value = stretched(gain).clamp(panel.x[0], panel.x[1]);
                let end = px(panel.pixel([value, 0.0])[0]);
                let bar = Area::new(zero.min(end), middle - 14, (end - zero).abs(), 28);
                canvas.fill(bar, colour(one.outcome));
                number(gain, 1)
            }
            None => "–".to_owned(),
        };
        let bold = matches!(one.outcome, Outcome::Claimed);
        let shade = if bold { INK } else { GREY };
        let text = canvas.fitted(&one.reason, 22.0, sheet::RIGHT - (LABELS + PANEL + 124));
        label_left_of(&mut canvas, &end, [LABELS + PANEL + 100, middle], 22.0, shade);
        label_right_of(&mut canvas, &text, [LABELS + PANEL + 124, middle], 22.0, shade);
    }
    panel.border(&mut canvas);
    canvas.to_small_png()
}

fn colour(outcome: Outcome) -> Rgb {
    match outcome {
        Outcome::Claimed => look::colour(1),
        Outcome::Twin => look::colour(5),
        _ => LOST,
    }
}

/// Near linear below about 3, logarithmic beyond.
fn stretched(value: f64) -> f64 {
    (value / 2.0).asinh()
}
