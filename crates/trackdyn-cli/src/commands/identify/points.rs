//! `trackdyn identify` on a table of steady operating points.

use super::summary::contradicted;
use crate::wrapped::wrapped;
use std::fmt::Write;
use trackdyn::crates::estimate::steady::{SteadyEstimate, lagging};
use trackdyn::crates::estimate::{Doubt, Error, Free, Parameters};
use trackdyn::crates::recording::OperatingPoint;
use trackdyn::identify::PointsFit;
use trackdyn::recording::PointsTable;
use trackdyn::{Gauge, Recording};

/// Points with the largest residuals that are shown.
const MAX_SHOWN_POINTS: usize = 5;

/// One screen: the table, and both fits.
pub fn text(recording: &Recording, gauge: &Gauge, found: &PointsFit) -> String {
    let points = recording.points().map_or(&[][..], PointsTable::points);
    let (vehicle, gauge) = (gauge.vehicle(), gauge.metres());
    let mut text = format!(
        "{}: {} steady points; {vehicle}, gauge {gauge} m\n",
        recording.name(),
        points.len()
    );
    for (free, fit) in &found.fits {
        self::fit(&mut text, *free, fit, gauge);
    }
    if let Ok(squares) = &found.squares {
        let gap = squares.gap().value;
        let _ = writeln!(text, "\n  plain squares, without alphas: x_r - x_l = {gap:.4} m");
    }
    text += &lagging_points(points);
    if let (_, Ok(fit)) = &found.fits[0] {
        worst(&mut text, points, fit);
    }
    text
}

fn fit(text: &mut String, free: Free, fit: &Result<SteadyEstimate, Error>, gauge: f64) {
    let title = match free {
        Free::Icrs => "ICRs, track speeds as measured",
        Free::IcrsAndAlphas => "ICRs and factors on the track speeds",
    };
    let _ = writeln!(text, "\n  {title}");
    let fit = match fit {
        Ok(fit) => fit,
        Err(reason) => {
            *text += &wrapped("    ", &reason.to_string());
            return;
        }
    };
    let doubts = fit.doubts(gauge);
    if !doubts.is_empty() {
        text.push_str("    not determined by this table:\n");
        for doubt in &doubts {
            *text += &wrapped("    - ", &doubt.to_string());
        }
        if doubts != [Doubt::NoLateralSpeed] {
            return;
        }
    }
    contradicted(text, &fit.contradictions(gauge));
    let _ = writeln!(text, "    {:9}{:>9}{:>24}", "", "estimate", "95 % interval");
    let named = (0..free.count()).filter_map(|k| Some((Parameters::NAMES[k], fit.interval(k)?)));
    let known = named.filter(|(_, interval)| interval.deviation.is_finite());
    for (name, interval) in known.chain([("x_r - x_l", fit.gap())]) {
        let range = format!("{:.4} to {:.4}", interval.low, interval.high);
        let unit = if name.starts_with("alpha") { "" } else { " m" };
        let _ = writeln!(text, "    {name:9}{:>9.4}{range:>24}{unit}", interval.value);
    }
    let icrs = fit.parameters.kinematics().icrs;
    let _ = writeln!(text, "    {:9}{:>9.4}", "chi", icrs.steering_efficiency(gauge));
    if doubts.is_empty() {
        let _ = writeln!(text, "    {:9}{:>9.4}", "e", icrs.eccentricity());
    }
    let scatter = |channel: usize, unit: &str| match fit.scatter[channel] {
        Some(scatter) => format!("{:.1} {unit}", 1e3 * scatter),
        None => "not measured".to_owned(),
    };
    let _ = writeln!(
        text,
        "    scatter: forward {}, lateral {}, yaw rate {}; intervals by leaving out {} {}",
        scatter(0, "mm/s"),
        scatter(1, "mm/s"),
        scatter(2, "mrad/s"),
        fit.groups,
        fit.grouping.name()
    );
}

/// The points that turn less than others that are driven less.
pub fn lagging_points(points: &[OperatingPoint]) -> String {
    let lags = lagging(points);
    if lags.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "\n  points that turn less than one that is driven less: a track did not run at its \
        speed\n",
    );
    for lag in lags {
        let (point, than) = (points[lag.point], points[lag.than]);
        let _ = writeln!(
            text,
            "    left {:.3}, right {:.3} m/s: {:.3} rad/s less than left {:.3}, right {:.3} m/s",
            point.v_left, point.v_right, lag.shortfall, than.v_left, than.v_right
        );
    }
    text
}

/// The points that the ICRs explain worst.
fn worst(text: &mut String, points: &[OperatingPoint], fit: &SteadyEstimate) {
    text.push_str(
        "\n  largest residuals without alphas, in scatters (forward, lateral, yaw rate)\n",
    );
    for index in fit.worst().into_iter().take(MAX_SHOWN_POINTS) {
        let (point, residuals) = (points[index], fit.residuals[index]);
        let residuals = residuals.map(|r| r.map_or_else(|| "-".to_owned(), |r| format!("{r:.1}")));
        let _ = writeln!(
            text,
            "    left {:.3}, right {:.3} m/s: {}",
            point.v_left,
            point.v_right,
            residuals.join(", ")
        );
    }
}
