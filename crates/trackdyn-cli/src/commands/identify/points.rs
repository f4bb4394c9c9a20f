//! `trackdyn identify` on a table of steady operating points.

use super::Options;
use crate::commands::Outcome;
use crate::options::{command_line, refuse_for_points};
use crate::stdout::show;
use std::fmt::Write;
use std::path::Path;
use trackdyn::crates::core::document::Document;
use trackdyn::crates::core::output::{fingerprint, prepare_folder};
use trackdyn::crates::estimate::least_squares::Loss;
use trackdyn::crates::estimate::steady::{SteadyEstimate, lagging};
use trackdyn::crates::estimate::{Doubt, Error, Free, Parameters, fit_points};
use trackdyn::crates::model::Kinematics;
use trackdyn::crates::model::VehicleFile;
use trackdyn::crates::model::kinematics::{KinematicsFile, Source};
use trackdyn::crates::recording::{OperatingPoint, OperatingPoints};

/// Points with the largest residuals that are shown.
const WORST: usize = 5;

/// Fits the ICRs, and the ICRs with α; prints both and writes what the table determines.
///
/// # Errors
/// A message that names the file, line and column.
pub fn run(path: &Path, vehicle: &VehicleFile, options: &Options) -> Outcome {
    refuse_for_points(&options.of_motion(), path)?;
    let table = OperatingPoints::read(path)?;
    prepare_folder(&options.out)?;
    let gauge = vehicle.vehicle.gauge;
    let start = Parameters::of(&Kinematics::ideal(gauge));
    let squares = fit_points(&table.points, &start, Free::Icrs, Loss::Squares);
    let fits = [Free::Icrs, Free::IcrsAndAlphas]
        .map(|free| (free, fit_points(&table.points, &start, free, Loss::Huber)));

    let mut text = format!(
        "{}: {} steady points; {}, gauge {gauge} m\n",
        table.name,
        table.points.len(),
        vehicle.vehicle.name
    );
    for (free, fit) in &fits {
        self::fit(&mut text, *free, fit, gauge);
    }
    if let Ok(squares) = &squares {
        let gap = squares.gap().value;
        let _ = writeln!(text, "\n  plain squares, without alphas: x_r - x_l = {gap:.4} m");
    }
    text += &lagging_points(&table.points);
    if let (_, Ok(fit)) = &fits[0] {
        worst(&mut text, &table.points, fit);
    }
    let fingerprint = fingerprint(Document::read(path)?.text().as_bytes());
    let files = fits.iter().map(|(free, fit)| {
        let fit = fit.as_ref().ok().filter(|fit| fit.doubts(gauge).is_empty())?;
        let source = Source {
            command: command_line(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            vehicle: vehicle.vehicle.name.clone(),
            fingerprint: fingerprint.clone(),
            recording: Some(table.name.clone()),
            ..Source::default()
        };
        let rows = fit.covariance_of_parameters();
        let kinematics = fit.parameters.kinematics();
        let with_alphas = *free == Free::IcrsAndAlphas;
        Some(KinematicsFile::of_fit(&kinematics, gauge, with_alphas, rows, source))
    });
    let exit = super::keep(&options.out, files)?;
    show(&text)?;
    Ok(exit)
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
            let _ = writeln!(text, "    {reason}");
            return;
        }
    };
    let doubts = fit.doubts(gauge);
    if !doubts.is_empty() {
        text.push_str("    not determined by this table:\n");
        for doubt in &doubts {
            let _ = writeln!(text, "    - {doubt}");
        }
        if doubts != [Doubt::NoLateralSpeed] {
            return;
        }
    }
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
        "\n  points that turn less than one that is driven less: a track did not run at its speed\n",
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
    for index in fit.worst().into_iter().take(WORST) {
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
