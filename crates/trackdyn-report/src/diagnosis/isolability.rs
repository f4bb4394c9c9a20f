//! Which effects this evidence can tell apart.

use super::Subject;
use super::sheet::{self, label_left_of, px, rows};
use super::words::{id, ids};
use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::{BLUES, FRAME, GREY, INK, WHITE};
use crate::colour_bar;
use crate::panel::ticks::number;
use crate::panel::{TICK_SIZE, TITLE_SIZE};
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::isolability::Isolability;
use trackdyn_model::EffectId;

const TOP: i32 = sheet::TOP + 90;
const CELL: i32 = 50;
const LABELS: i32 = 400;
/// Room for names that read upwards.
const BELOW: i32 = 400;
/// Longest bar, pixels.
const WIDEST: i32 = 640;
/// Resemblance from which on its number is written.
const WRITTEN: f64 = 0.5;

/// Standard deviations, at a typical size, below which an effect only moves what is fitted anyway.
const VISIBLE: f64 = 0.05;

/// Draws the matrix of |cosine| and what each effect would stand out by.
pub(super) fn draw(subject: &Subject) -> Result<Vec<u8>, Error> {
    let of = &subject.diagnosis.resemblance;
    let order = order(of);
    let side = rows(order.len()) * CELL;
    let height = TOP + side.max(500) + BELOW + sheet::FOOT;
    let explanation = "Resemblance of what two effects would change in this very evidence, with all that \
                       is fitted anyway taken out: 100 means twins, 0 means that nothing is shared.";
    let title = "Which effects this evidence can tell apart";
    let mut canvas = sheet::sheet(height, title, explanation, subject.caption)?;
    if order.is_empty() {
        canvas.text(
            "This evidence shows no effect of the catalogue.",
            [LABELS, TOP],
            &Style::new(TITLE_SIZE),
        );
        return canvas.to_small_png();
    }
    let small = Style::new(18.0).anchor(Horizontal::Centre, Vertical::Middle);
    for (row, &a) in order.iter().enumerate() {
        let at = TOP + rows(row) * CELL;
        name(&mut canvas, subject, of.effects[a], [LABELS - 16, at + CELL / 2], false);
        let column = LABELS + rows(row) * CELL + CELL / 2;
        name(&mut canvas, subject, of.effects[a], [column, TOP + side + 16], true);
        for (column, &b) in order.iter().enumerate() {
            let cosine = of.cosines[(a, b)];
            let cell = Area::new(LABELS + rows(column) * CELL, at, CELL, CELL);
            canvas.fill(cell, BLUES.at(cosine));
            if a != b && cosine >= WRITTEN {
                let colour = if cosine > 0.6 { WHITE } else { INK };
                let middle = [cell.left + CELL / 2, at + CELL / 2];
                canvas.text(&number(100.0 * cosine, 0), middle, &small.colour(colour));
            }
        }
    }
    canvas.outline(Area::new(LABELS - 1, TOP - 1, side + 2, side + 2), 2, FRAME);
    let bar = Area::new(LABELS + side + 40, TOP, 28, 400.min(side));
    colour_bar::draw(&mut canvas, bar, &BLUES, [0.0, 1.0], "|cosine|");
    strengths(&mut canvas, subject, &order, LABELS + side + 190);
    let unseen: Vec<EffectId> =
        (0..of.effects.len()).filter(|k| !order.contains(k)).map(|k| of.effects[k]).collect();
    if !unseen.is_empty() {
        let text =
            format!("Not visible beyond constant ICRs, clock and sensor: {}", ids(&unseen, ", "));
        let lines = sheet::two_lines(&canvas, &text, 22.0);
        for (line, row) in lines.iter().zip([height - sheet::FOOT - 34, height - sheet::FOOT - 4]) {
            let line = canvas.fitted(line, 22.0, sheet::RIGHT - sheet::LEFT);
            canvas.text(&line, [sheet::LEFT, row], &Style::new(22.0).colour(GREY));
        }
    }
    canvas.to_small_png()
}

/// Bars of z at each effect's typical size, beside the rows.
fn strengths(canvas: &mut Canvas, subject: &Subject, order: &[usize], left: i32) {
    let of = &subject.diagnosis.resemblance;
    let width = f64::from((sheet::RIGHT - left - 110).min(WIDEST));
    let most = order.iter().map(|&k| of.detection[k]).fold(10.0, f64::max);
    let style = Style::new(TICK_SIZE).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text("would stand out by (σ, at a typical size)", [left, TOP - 16], &style);
    let share = |z: f64| (1.0 + z).ln() / (1.0 + most).ln();
    let five = left + px(width * share(trackdyn_diagnose::isolability::DETECTED));
    let bottom = TOP + rows(order.len()) * CELL;
    for row in (TOP..bottom).step_by(14) {
        canvas.fill(Area::new(five, row, 2, 7), INK);
    }
    for (row, &k) in order.iter().enumerate() {
        let middle = TOP + rows(row) * CELL + CELL / 2;
        let bar = Area::new(left, middle - 11, px(width * share(of.detection[k])), 22);
        let seen = of.detection[k] >= trackdyn_diagnose::isolability::DETECTED;
        canvas.fill(bar, if seen { BLUES.at(0.7) } else { BLUES.at(0.3) });
        let text = number(of.detection[k], usize::from(of.detection[k] < 10.0));
        let beside = bar.right() + 10;
        let width = canvas.text_width(&text, 20.0);
        canvas.fill(Area::new(beside - 4, middle - 12, width + 8, 24), WHITE);
        sheet::label_right_of(canvas, &text, [beside, middle], 20.0, GREY);
    }
    let style = Style::new(20.0).colour(GREY).anchor(Horizontal::Centre, Vertical::Top);
    canvas.text("5: would be found", [five.max(left + 90), bottom + 14], &style);
}

/// Writes a name; that of what is claimed in ink, others in grey.
fn name(canvas: &mut Canvas, subject: &Subject, effect: EffectId, at: [i32; 2], upwards: bool) {
    let claimed =
        subject.diagnosis.missing.iter().any(|missing| {
            missing.kind != Kind::Constant && missing.verdict.one_of.contains(&effect)
        });
    let colour = if claimed { INK } else { GREY };
    let text = if claimed { format!("→ {}", id(effect)) } else { id(effect).to_owned() };
    if upwards {
        let style = Style { upwards: true, ..Style::new(22.0) }.colour(colour);
        canvas.text(&text, at, &style.anchor(Horizontal::Right, Vertical::Middle));
    } else {
        label_left_of(canvas, &text, at, 22.0, colour);
    }
}

/// The visible effects such that like ones are neighbours: from the strongest on to the one that is most like
/// the last.
fn order(of: &Isolability) -> Vec<usize> {
    let mut left: Vec<usize> =
        (0..of.effects.len()).filter(|&k| of.detection[k] > VISIBLE).collect();
    let strongest =
        left.iter().copied().max_by(|&a, &b| of.detection[a].total_cmp(&of.detection[b]));
    let Some(mut last) = strongest else { return Vec::new() };
    let mut order = vec![last];
    left.retain(|k| *k != last);
    while !left.is_empty() {
        let next = left.iter().copied().max_by(|&a, &b| {
            of.cosines[(last, a)].total_cmp(&of.cosines[(last, b)]).then(b.cmp(&a))
        });
        let Some(next) = next else { break };
        left.retain(|k| *k != next);
        order.push(next);
        last = next;
    }
    order
}
