//! The result of a map as text.

use crate::wrapped::wrapped;
use std::fmt::Write;
use trackdyn::crates::model::IcrMap as Solved;
use trackdyn::crates::model::map::{Sector, Statistics};
use trackdyn::{IcrMap, Vehicle};

/// One screen: parameters, what kinds of motion the map holds, sectors.
pub fn text(vehicle: &Vehicle, map: &IcrMap) -> String {
    let mut text = String::new();
    let effects: Vec<String> = vehicle.effects().iter().map(ToString::to_string).collect();
    let solved = map.solved();
    let (points, speed) = (solved.grid.points(), solved.grid.max_speed());
    let _ =
        writeln!(text, "{}, {points} x {points} track speeds up to {speed} m/s", vehicle.name());
    let _ = match effects.as_slice() {
        [] => writeln!(text, "base model: no effects\n"),
        effects => writeln!(text, "{}", wrapped("effects: ", &effects.join("  "))),
    };
    match map.statistics() {
        Some(statistics) => parameters(&mut text, statistics),
        None => text += "  No pair of speeds turns the robot: it has no ICRs.\n",
    }
    motions(&mut text, solved);
    sectors(&mut text, solved);
    text
}

fn parameters(text: &mut String, statistics: &Statistics) {
    let Statistics { mean, spread, .. } = statistics;
    let _ = writeln!(text, "  {:34}{:>12}{:>14}", "", "mean", "spread");
    for (name, mean, spread) in [
        ("x_l  ICR of the left track", mean.x_left, spread.x_left),
        ("x_r  ICR of the right track", mean.x_right, spread.x_right),
        ("y    ICR of both, forward", mean.y, spread.y),
    ] {
        let (mean, spread) = (unrounded(mean), 1e3 * unrounded(spread));
        let _ = writeln!(text, "  {name:34}{mean:>10.5} m{spread:>11.3} mm");
    }
    let _ = writeln!(text, "\n  {:34}{:>12}{:>14}", "", "of the means", "mean over map");
    for (name, of_means, over_map) in [
        (
            "chi  steering efficiency",
            statistics.steering_efficiency,
            statistics.mean_steering_efficiency,
        ),
        ("e    eccentricity", statistics.eccentricity, statistics.mean_eccentricity),
    ] {
        let (of_means, over_map) = (unrounded(of_means), unrounded(over_map));
        let _ = writeln!(text, "  {name:34}{of_means:>12.5}{over_map:>14.5}");
    }
}

/// A number without what rounding makes of none: it is neither a spread nor a sign.
fn unrounded(value: f64) -> f64 {
    if value.abs() < 1e-9 { 0.0 } else { value }
}

fn motions(text: &mut String, map: &Solved) {
    // In the order of Status::NAMES.
    let meaning = [
        "turn and enter the means",
        "are straight: both tracks stick",
        "are held straight by one track",
        "tip the robot over: gaps",
        "have no balance of forces that was found: gaps",
    ];
    let parts: Vec<String> = map
        .counts()
        .iter()
        .zip(meaning)
        .filter(|(count, _)| **count > 0)
        .map(|(count, meaning)| format!("{count} {meaning}"))
        .collect();
    text.push('\n');
    let (pairs, parts) = (map.solutions.len(), parts.join(", "));
    let lifted = match map.lifted().count() {
        0 => String::new(),
        lifted => format!(" In {lifted} of them part of the contact has lifted."),
    };
    *text += &wrapped("  ", &format!("Of {pairs} pairs of speeds {parts}.{lifted}"));
}

fn sectors(text: &mut String, map: &Solved) {
    let sectors = map.sectors();
    if sectors.is_empty() {
        return;
    }
    text.push_str(
        "\n  The map is piecewise: parameters by the signs of V_l, V_r and |V_r| - |V_l|\n",
    );
    let _ = writeln!(
        text,
        "  {:>10}{:>11}{:>11}{:>10}{:>10}{:>7}  signs",
        "x_l [m]", "x_r [m]", "y [m]", "chi", "e", "pairs"
    );
    for (signs, statistics) in merged(&sectors) {
        let _ = writeln!(
            text,
            "  {:>10.5}{:>11.5}{:>11.5}{:>10.5}{:>10.5}{:>7}  {}",
            statistics.mean.x_left,
            statistics.mean.x_right,
            unrounded(statistics.mean.y),
            statistics.steering_efficiency,
            unrounded(statistics.eccentricity),
            statistics.count,
            signs.join(" ")
        );
    }
}

/// Sectors with equal parameters as one row.
fn merged(sectors: &[Sector]) -> Vec<(Vec<String>, Statistics)> {
    let mut rows: Vec<(Vec<String>, Statistics)> = Vec::new();
    for sector in sectors {
        let signs = sector.signs.iter().map(|sign| match sign {
            0 => '0',
            1.. => '+',
            _ => '-',
        });
        let signs: String = signs.collect();
        let distance = |other: &Statistics| {
            let (a, b) = (sector.statistics.mean.to_array(), other.mean.to_array());
            a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        match rows.iter_mut().find(|(_, other)| distance(other) < 1e-9) {
            Some((all, statistics)) => {
                all.push(signs);
                statistics.count += sector.statistics.count;
            }
            None => rows.push((vec![signs], sector.statistics)),
        }
    }
    rows
}
