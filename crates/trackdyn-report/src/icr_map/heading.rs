//! Title and caption.

use super::{HEIGHT, LEFT, WIDTH};
use crate::canvas::Canvas;
use crate::colour::{GREY, INK};
use crate::panel::ticks::number;
use crate::text::Style;
use trackdyn_model::IcrMap;
use trackdyn_model::Model;
use trackdyn_model::map::Statistics;

/// Draws the title and the two lines below it, and the caption at the foot.
pub(super) fn draw(
    canvas: &mut Canvas,
    map: &IcrMap,
    model: &Model,
    statistics: Option<&Statistics>,
    caption: &str,
) {
    let effects: Vec<String> = model.effects().iter().map(ToString::to_string).collect();
    let effects = if effects.is_empty() { "base model".to_owned() } else { effects.join(", ") };
    let grid = format!(
        "{points} × {points} track speeds from −{speed} to {speed} m/s",
        points = map.grid.points(),
        speed = map.grid.max_speed(),
    );
    let numbers = match statistics {
        Some(statistics) => format!(
            "{grid};   χ = {}, e = {} of the mean ICRs",
            number(statistics.steering_efficiency, 4),
            number(statistics.eccentricity, 4),
        ),
        None => format!("{grid};   the robot never turns"),
    };
    let foot = i32::from(HEIGHT) - 32;
    for (text, row, sizes, colour) in [
        (format!("{}: ICR map", model.vehicle().name), 82, [46.0, 36.0, 28.0], INK),
        (effects, 134, [30.0, 26.0, 22.0], INK),
        (numbers, 182, [30.0, 26.0, 22.0], INK),
        (caption.to_owned(), foot, [22.0; 3], GREY),
    ] {
        let room = i32::from(WIDTH) - 2 * LEFT;
        let fits = |size: &f32| canvas.text_width(&text, *size) <= room;
        let size = sizes.into_iter().find(fits).unwrap_or(sizes[2]);
        let fitted = canvas.fitted(&text, size, room);
        canvas.text(&fitted, [LEFT, row], &Style::new(size).colour(colour));
    }
}
