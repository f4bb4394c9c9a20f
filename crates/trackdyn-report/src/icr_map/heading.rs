//! Title and caption.

use super::{HEIGHT, LEFT, WIDTH};
use crate::colour::{GREY, INK};
use crate::figure::Figure;
use crate::text::{Style, fitted, width};
use crate::ticks::number;
use trackdyn_model::IcrMap;
use trackdyn_model::Model;
use trackdyn_model::map::Statistics;

/// Writes the title and the two lines below it, and the caption at the foot.
pub(super) fn write(
    figure: &mut Figure,
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
    let foot = HEIGHT - 32;
    for (text, row, sizes, colour) in [
        (format!("{}: ICR map", model.vehicle().name), 82, [46.0, 36.0, 28.0], INK),
        (effects, 134, [30.0, 26.0, 22.0], INK),
        (numbers, 182, [30.0, 26.0, 22.0], INK),
        (caption.to_owned(), foot, [22.0; 3], GREY),
    ] {
        let room = WIDTH - 2 * LEFT;
        let fits = |size: &f32| width(&text, *size) <= room;
        let size = sizes.into_iter().find(fits).unwrap_or(sizes[2]);
        figure.write(fitted(&text, size, room), [LEFT, row], Style::new(size).colour(colour));
    }
}
