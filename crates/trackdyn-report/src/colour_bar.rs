//! What the colours mean.

use crate::canvas::{Area, Canvas};
use crate::colour::{ColourMap, DARK_PLASMA, FRAME, GREY, INK};
use crate::panel::TICK_SIZE;
use crate::panel::ticks::{Ticks, number};
use crate::text::{Horizontal, Style, Vertical};

/// Draws an upright bar with numbers at its right and the unit above.
pub(crate) fn draw(
    canvas: &mut Canvas,
    bar: Area,
    colours: &ColourMap,
    range: [f64; 2],
    unit: &str,
) {
    let height = f64::from(bar.height);
    canvas.paint(bar, |_, row| colours.at((f64::from(bar.bottom() - row) - 0.5) / height));
    canvas.outline(Area::new(bar.left - 1, bar.top - 1, bar.width + 2, bar.height + 2), 2, FRAME);
    let ticks = Ticks::along(range, bar.height, 60);
    let style = Style::new(TICK_SIZE).colour(GREY).anchor(Horizontal::Left, Vertical::Middle);
    for value in ticks.values {
        let share = (value - range[0]) / (range[1] - range[0]);
        #[expect(clippy::cast_possible_truncation, reason = "places on the canvas")]
        let row = (f64::from(bar.bottom()) - share * height).round() as i32;
        canvas.fill(Area::new(bar.right(), row - 1, 8, 2), FRAME);
        canvas.text(&number(value, ticks.decimals), [bar.right() + 14, row], &style);
    }
    let style = Style::new(TICK_SIZE).colour(INK).anchor(Horizontal::Left, Vertical::Baseline);
    canvas.text(unit, [bar.left, bar.top - 16], &style);
}

/// Draws the bar of the clouds: the larger track speed.
pub(super) fn of_speed(canvas: &mut Canvas, bar: Area, max_speed: f64) {
    draw(canvas, bar, &DARK_PLASMA, [0.0, max_speed], "m/s");
    let [column, row] = [bar.right() + 98, bar.top + bar.height / 2];
    let style = Style {
        upwards: true,
        ..Style::new(TICK_SIZE).anchor(Horizontal::Centre, Vertical::Bottom)
    };
    canvas.text("larger track speed, max(|Vₗ|, |Vᵣ|)", [column, row], &style);
}
