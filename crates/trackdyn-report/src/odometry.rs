//! The figure of an odometry replay.

mod bars;
mod growth;
mod paths;

use crate::Error;
use crate::canvas::{Area, Canvas};
use crate::colour::GREY;
use crate::legend;
use crate::panel::ticks::number;
use crate::text::{Horizontal, Style, Vertical};
use trackdyn_estimate::odometry::comparison::SetErrors;
use trackdyn_estimate::odometry::{Comparison, ParameterSet};

const WIDTH: u16 = 2400;
const HEIGHT: u16 = 1350;
/// Left end of all lines of text.
const LEFT: i32 = 40;

const LEGEND: Area = Area::new(LEFT, 120, 2320, 70);
const PATHS: Area = Area::new(LEFT + 118, 270, 940, 900);
const GROWTH: [Area; 2] = [Area::new(1290, 270, 440, 360), Area::new(1900, 270, 440, 360)];
const BARS: [Area; 2] = [Area::new(1290, 840, 620, 330), Area::new(2070, 840, 270, 330)];

/// A quantity of the errors and how it is shown.
struct Quantity {
    name: &'static str,
    unit: &'static str,
    /// Shown per SI unit.
    scale: f64,
    of: fn(&SetErrors) -> &trackdyn_estimate::odometry::comparison::Component,
}

/// A replay as a picture: a recorded path with the predicted ones, as in Figs 8-12; how errors grow
/// with distance or time; and errors over segments. `name` is that of the recording, `caption` stands
/// below, for what the figure was made from.
///
/// Returns the bytes of a PNG. They depend on the arguments only.
///
/// # Errors
/// [`Error`] where a part cannot be drawn; no result is the cause of one.
pub fn odometry(result: &Comparison, name: &str, caption: &str) -> Result<Vec<u8>, Error> {
    let mut canvas = Canvas::new(WIDTH, HEIGHT)?;
    heading(&mut canvas, result, name, caption);
    let names = result.sets.iter().map(ParameterSet::name);
    legend::draw(&mut canvas, LEGEND, "recorded", names);
    paths::draw(&mut canvas, PATHS, result)?;
    let position = Quantity {
        name: "Growth of the error of place",
        unit: "m",
        scale: 1.0,
        of: |set| &set.position,
    };
    let yaw = Quantity {
        name: "Growth of the error of yaw",
        unit: "°",
        scale: 1.0_f64.to_degrees(),
        of: |set| &set.yaw,
    };
    for (area, quantity) in GROWTH.into_iter().zip([position, yaw]) {
        growth::draw(&mut canvas, area, result, &quantity)?;
    }
    let along = Quantity { name: "along", unit: "mm", scale: 1e3, of: |set| &set.along };
    let across = Quantity { name: "across", unit: "mm", scale: 1e3, of: |set| &set.across };
    let yaw = Quantity { name: "yaw", unit: "°", scale: 1.0_f64.to_degrees(), of: |set| &set.yaw };
    bars::draw(&mut canvas, BARS[0], result, &[along, across]);
    bars::draw(&mut canvas, BARS[1], result, &[yaw]);
    canvas.to_png()
}

fn heading(canvas: &mut Canvas, result: &Comparison, name: &str, caption: &str) {
    let style = |size| Style::new(size).anchor(Horizontal::Left, Vertical::Baseline);
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
    let right = i32::from(WIDTH) - LEFT;
    let title = canvas.fitted(&title, 40.0, right - LEFT);
    canvas.text(&title, [LEFT, 72], &style(40.0));
    let below = format!(
        "Whiskers: 95 % confidence, {}; marks of one length stand side by side. {caption}",
        result.blocks.description()
    );
    let below = canvas.fitted(&below, 24.0, right - LEFT);
    canvas.text(&below, [LEFT, i32::from(HEIGHT) - 28], &style(24.0).colour(GREY));
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
        let draw = || odometry(&result, "synthetic", "caption").expect("drawn");
        assert!(draw() == draw());
    }

    #[test]
    fn short_runs_and_many_sets_can_be_drawn() {
        for (duration, sets) in [(0.2, 1), (2.0, 12)] {
            odometry(&result(duration, sets), "a name", "").expect("drawn");
        }
    }
}
