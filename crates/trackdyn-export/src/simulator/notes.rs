//! What a file says of the effects of a vehicle, and what it cannot say.

use super::{Aspect, Robot};
use crate::number::number;
use std::fmt::Write;
use trackdyn_core::lines;
use trackdyn_core::rounding::Digits;
use trackdyn_model::{ActiveEffect, CATALOGUE, Icrs, Model, RigidBody};

/// Whether a format has an aspect, and how, or what to do instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expression {
    /// The part of the file that says it.
    By(&'static str),
    /// What the simulator lacks, and what can be done at run time.
    Lacks(&'static str),
}

/// Longest line of a note, characters.
const WIDTH: usize = 92;

/// Both lists: effects that the file has, and those that it has not.
pub(crate) fn effects(robot: &Robot, express: impl Fn(Aspect) -> Expression) -> String {
    let (mut said, mut lacking) = (String::new(), String::new());
    for effect in robot.model.effects() {
        for aspect in Aspect::of(effect, robot.model.vehicle()) {
            let (list, how) = match express(aspect) {
                Expression::By(how) => (&mut said, how),
                Expression::Lacks(how) => (&mut lacking, how),
            };
            let title = effect.card().title;
            *list += &wrapped(&format!("{effect} ({title}): {how}."), "- ");
        }
    }
    let mut text = String::new();
    for (list, title) in [
        (said, "Effects of the vehicle that this file has:"),
        (lacking, "Effects of the vehicle that this file does not have:"),
    ] {
        if !list.is_empty() {
            let _ = write!(text, "\n{title}\n{list}");
        }
    }
    text
}

/// What is assumed where the vehicle does not say it.
pub(crate) fn assumed(robot: &Robot) -> String {
    let mut text = String::new();
    if robot.body.cog_height == 0.0 {
        let height = statement(robot, |body| body.cog_height);
        text += &wrapped(
            &format!(
                "The height of the centre of gravity is not known. It lies on the ground here, so \
                 no load shifts in turns: the effect {height} says it."
            ),
            "- ",
        );
    }
    if robot.body.gyration.is_none() {
        let gyration = statement(robot, |body| body.gyration);
        text += &wrapped(
            &format!(
                "The moments of inertia are not known: those of an even box over the contact, half \
                 the gauge high. The effect {gyration} says the one about the vertical."
            ),
            "- ",
        );
    } else {
        text += &wrapped(
            "The moment of inertia about the vertical is the vehicle's, the others go with it as \
             in an even box over the contact, half the gauge high.",
            "- ",
        );
    }
    format!("\nAssumed:\n{text}")
}

/// How a vehicle says a property of its body: `EFFECT:KEY=SYMBOL`, by the effect with a parameter
/// that changes it.
fn statement<T: PartialEq>(robot: &Robot, property: fn(&RigidBody) -> T) -> String {
    let with = |id: &str, key: &str, value: f64| {
        let effect = ActiveEffect::new(id, &[(key, value)]).ok()?;
        let effects = [effect].into_iter().collect();
        Some(property(&Model::new(robot.model.vehicle().clone(), effects).rigid_body()))
    };
    let parameters =
        CATALOGUE.iter().flat_map(|card| card.parameters.iter().map(|one| (card.id, one)));
    let mut changing = parameters.filter(|(id, one)| {
        let values = [one.typical, one.typical / 2.0].map(|value| with(id, one.key, value));
        matches!(values, [Some(typical), Some(half)] if typical != half)
    });
    let (id, one) = changing.next().expect("an effect of the catalogue says it");
    format!("{id}:{}={}", one.key, one.symbol.to_uppercase())
}

/// How the file turns, beside the vehicle.
pub(crate) fn turning(robot: &Robot, exported: &Icrs, by: &str) -> String {
    let line = |icrs: &Icrs| {
        let [left, right, y] = icrs.to_array().map(|value| format!("{value:.4}"));
        let efficiency = robot.gauge / (icrs.x_right - icrs.x_left);
        format!("chi {efficiency:.4}, ICRs x_l {left}, x_r {right}, y {y} m")
    };
    format!(
        "\nSteady slow turns (x right, y forward of the centre of the contact):\n- vehicle: \
         {}\n- {by}: {}\n",
        line(&robot.icrs),
        line(exported)
    )
}

/// A number with nine digits that count.
pub(crate) fn digits(value: f64) -> String {
    number(Digits::Significant(9).round(value))
}

/// Numbers with nine digits that count, with blanks between.
pub(crate) fn row(values: &[f64]) -> String {
    values.iter().map(|value| digits(*value)).collect::<Vec<_>>().join(" ")
}

/// A text in lines; the first begins with `head`, the others are as far to the right.
pub(crate) fn wrapped(text: &str, head: &str) -> String {
    lines::wrapped(head, text, WIDTH)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::VehicleFile;

    #[test]
    fn a_property_of_the_body_is_said_by_the_effect_that_changes_it() {
        let robot = Robot::of(&VehicleFile::auriga_alpha()).expect("a robot");
        assert_eq!(statement(&robot, |body| body.cog_height), "load-transfer:cog_height_m=H");
        assert_eq!(statement(&robot, |body| body.gyration), "yaw-inertia:gyration_m=R");
    }
}
