//! The figure of an odometry replay.

mod bars;
mod growth;
mod paths;

use crate::colour::GREY;
use crate::figure::{Area, Figure, Legend};
use crate::sheet::{self, LEFT, RIGHT};
use crate::text::{Style, fitted};
use crate::ticks::number;
use trackdyn_estimate::odometry::comparison::SetErrors;
use trackdyn_estimate::odometry::{Comparison, ParameterSet};

const HEIGHT: i32 = 1350;
const LEGEND: [i32; 2] = [LEFT, 140];
const PATHS: Area = Area::new(LEFT + 118, 270, 940, 900);
const GROWTH: [Area; 2] = [Area::new(1290, 270, 440, 360), Area::new(1900, 270, 440, 360)];
const BARS: [Area; 2] = [Area::new(1290, 840, 620, 330), Area::new(2070, 840, 270, 330)];
/// Longest name in the legend, pixels.
const MAX_NAME: i32 = 420;

/// A quantity of the errors and how it is shown.
struct Quantity {
    name: &'static str,
    unit: &'static str,
    /// Shown per SI unit.
    scale: f64,
    of: fn(&SetErrors) -> &trackdyn_estimate::odometry::comparison::Component,
}

/// A replay as a picture: a recorded path with the predicted ones, as in Figs 8-12; how errors grow
/// with distance or time; and errors over segments. `name` is that of the recording, `caption`
/// stands below, for what the figure was made from.
pub fn odometry(result: &Comparison, name: &str, caption: &str) -> Figure {
    let mut figure = Figure::new("odometry", [sheet::WIDTH, HEIGHT]);
    heading(&mut figure, result, name, caption);
    figure.legends.push(legend("recorded", result.sets.iter().map(ParameterSet::name)));
    figure.panels.extend(paths::panel(PATHS, result));
    let yaw = |name| Quantity { name, unit: "°", scale: 1.0_f64.to_degrees(), of: |set| &set.yaw };
    let position = Quantity {
        name: "Growth of the error of place",
        unit: "m",
        scale: 1.0,
        of: |set| &set.position,
    };
    for (area, quantity) in GROWTH.into_iter().zip([position, yaw("Growth of the error of yaw")]) {
        figure.panels.push(growth::panel(area, result, &quantity));
    }
    let along = Quantity { name: "along", unit: "mm", scale: 1e3, of: |set| &set.along };
    let across = Quantity { name: "across", unit: "mm", scale: 1e3, of: |set| &set.across };
    figure.panels.extend(bars::panel(BARS[0], result, &[along, across]));
    figure.panels.extend(bars::panel(BARS[1], result, &[yaw("yaw")]));
    figure
}

/// A legend of what is compared with the first.
pub(crate) fn legend<'a>(first: &str, names: impl Iterator<Item = &'a str>) -> Legend {
    let names: Vec<String> = names.map(|name| fitted(name, 26.0, MAX_NAME)).collect();
    Legend::of_lines(LEGEND, RIGHT, first, names.iter().map(String::as_str))
}

fn heading(figure: &mut Figure, result: &Comparison, name: &str, caption: &str) {
    let runs = match result.paths.len() {
        1 => "1 run".to_owned(),
        count => format!("{count} runs"),
    };
    let title = format!(
        "Dead reckoning: {name}, {runs}, {} s, {} m, clock offset {} s",
        number(result.duration(), 0),
        number(result.distance(), 1),
        number(result.tau, 3)
    );
    sheet::line(figure, &title, 72, Style::new(40.0));
    let whiskers = format!(
        "Whiskers: 95 % confidence, {}; marks of one length stand side by side.",
        result.blocks.description()
    );
    for (text, from_below) in [(&*whiskers, 60), (caption, 28)] {
        sheet::line(figure, text, HEIGHT - from_below, Style::new(24.0).colour(GREY));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_estimate::odometry::ParameterSet;
    use trackdyn_estimate::synthetic::{Synthetic, random_steps};
    use trackdyn_model::{Icrs, Kinematics};

    fn result(duration: f64, sets: usize) -> Comparison {
        let schedules = (0..3).map(|seed| random_steps(6, duration, 1.0, seed)).collect();
        let synthetic = Synthetic { schedules, position_noise: 1e-3, ..Synthetic::default() };
        let recording = synthetic.recording().expect("a recording");
        let set = |k: usize| {
            #[expect(clippy::cast_precision_loss, reason = "a few sets")]
            let x = 0.2 + 0.05 * k as f64;
            let icrs = Icrs { x_left: -x, x_right: x, y: 0.0 };
            ParameterSet::new(format!("set {k}"), Kinematics::new(icrs))
        };
        Comparison::new(&recording, (0..sets).map(set).collect(), 0.0).expect("it moves")
    }

    #[test]
    fn the_same_result_gives_the_same_bytes() {
        let result = result(6.0, 3);
        let draw = || odometry(&result, "synthetic", "caption").to_png().expect("drawn");
        assert!(draw() == draw());
    }

    #[test]
    fn short_runs_and_many_sets_can_be_drawn() {
        for (duration, sets) in [(0.2, 1), (2.0, 12)] {
            let figure = odometry(&result(duration, sets), "a name", "");
            figure.to_png().expect("drawn");
            assert_eq!(figure.panels.len(), 5);
        }
    }
}
