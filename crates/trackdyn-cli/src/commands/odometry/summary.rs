//! The result of a replay as text.

use crate::shell::path;
use crate::wrapped::wrapped;
use std::fmt::Write;
use std::path::Path;
use trackdyn::Odometry;
use trackdyn::crates::core::lines::counted;
use trackdyn::crates::estimate::odometry::comparison::{Component, SpanErrors};
use trackdyn::crates::estimate::odometry::{Comparison, Estimate, Span};
use trackdyn::odometry::{Advice, Compared};

/// One screen: what was replayed, errors per segment, drift, and how sets compare with the ideal.
pub fn text(odometry: &Odometry) -> String {
    let mut text = String::new();
    let (result, clock) = (&odometry.comparison, &odometry.clock);
    let (recording, gauge) = (odometry.recording(), odometry.gauge());
    let _ = writeln!(
        text,
        "{}, {} of {}, {:.0} s, {:.1} m",
        recording.name(),
        result.paths.len(),
        counted(recording.runs().len(), "run"),
        result.duration(),
        result.distance()
    );
    let _ = write!(text, "clock offset {:.3} s", clock.tau());
    let _ = match clock.standard_error().filter(|error| error.is_finite()) {
        Some(error) => write!(text, " (estimated, standard error {error:.3} s)"),
        None => write!(text, " ({})", clock.origin()),
    };
    let (gauge, name) = (gauge.metres(), gauge.vehicle());
    let _ = writeln!(text, "; ideal drive: gauge {gauge} m ({name})");
    let _ = writeln!(text, "± 95 % confidence, {}", result.blocks.description());
    let width = result.sets.iter().map(|set| set.name().len()).max().unwrap_or(0).clamp(10, 26) + 6;
    if let Some(segments) = result.segments() {
        residuals(&mut text, result, segments, width);
    }
    if let Some(span) = result.drift() {
        drift(&mut text, odometry, span, width);
        advice(&mut text, &odometry.advice(), span);
    }
    text
}

/// Root mean squares over segments, and over those of the ideal drive.
fn residuals(text: &mut String, result: &Comparison, segments: &SpanErrors, width: usize) {
    let SpanErrors { count, mean_duration, mean_distance, .. } = segments;
    let _ = writeln!(
        text,
        "\n  rms over {count} segments of {mean_duration:.2} s, {mean_distance:.3} m (mean)"
    );
    let _ = writeln!(
        text,
        "  {:width$} {:>15} {:>15} {:>15}",
        "parameters", "along [mm]", "across [mm]", "yaw [deg]"
    );
    for (set, errors) in result.sets.iter().zip(&segments.sets) {
        let _ = writeln!(
            text,
            "  {:width$} {:>15} {:>15} {:>15}",
            short(set.name(), width),
            number(errors.along.rms, 1e3, 2),
            number(errors.across.rms, 1e3, 2),
            number(errors.yaw.rms, 1.0_f64.to_degrees(), 3),
        );
    }
    for (set, errors) in result.sets.iter().zip(&segments.sets).skip(1) {
        let over = |component: &Component| {
            component.over_first.map_or_else(|| "-".to_owned(), |ratio| number(ratio, 1.0, 3))
        };
        let _ = writeln!(
            text,
            "  {:width$} {:>15} {:>15} {:>15}",
            format!("{}/ideal", short(set.name(), width - 6)),
            over(&errors.along),
            over(&errors.across),
            over(&errors.yaw),
        );
    }
}

/// Drift over the longest pieces, and errors at the end.
fn drift(text: &mut String, odometry: &Odometry, span: &SpanErrors, width: usize) {
    let result = &odometry.comparison;
    let runs = result.paths.len();
    #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
    let mean_distance = result.distance() / runs as f64;
    let _ = writeln!(
        text,
        "\n  drift per metre over {} {}; error at the end, rms over {} of {:.1} m",
        span.count,
        pieces(span),
        counted(runs, "run"),
        mean_distance
    );
    let _ = writeln!(
        text,
        "  {:width$} {:>15} {:>15} {:>11} {:>11}",
        "parameters", "position [mm/m]", "yaw [deg/m]", "end [m]", "end [deg]"
    );
    for (index, (set, errors)) in result.sets.iter().zip(&span.sets).enumerate() {
        let [place, yaw] = odometry.error_at_end(index);
        let per_metre = |component: &Component, scale, decimals| {
            component
                .per_metre
                .map_or_else(|| "-".to_owned(), |drift| number(drift, scale, decimals))
        };
        let _ = writeln!(
            text,
            "  {:width$} {:>15} {:>15} {place:>11.3} {:>11.2}",
            short(set.name(), width),
            per_metre(&errors.position, 1e3, 1),
            per_metre(&errors.yaw, 1.0_f64.to_degrees(), 2),
            yaw.to_degrees(),
        );
    }
}

fn pieces(span: &SpanErrors) -> String {
    match span.span {
        Span::Segment => "segments".to_owned(),
        Span::Distance(length) => format!("pieces of {length} m"),
        Span::Duration(length) => format!("pieces of {length} s"),
    }
}

/// Which parameters to take, with the numbers that decide it.
fn advice(text: &mut String, advice: &Advice, span: &SpanErrors) {
    let choice = match advice {
        Advice::File { file, .. } => path(Path::new(file)),
        Advice::Physics { vehicle, .. } => format!("the forces on {vehicle}"),
        Advice::Ideal { .. } => "the ideal drive, its gauge alone: no file is surely better".into(),
        Advice::Undecided { reason } => {
            text.push('\n');
            *text += &wrapped("take  not decided: ", reason);
            return;
        }
        _ => return,
    };
    let _ = writeln!(text, "\ntake  {choice}");
    for Compared { with, place, yaw } in advice.compared() {
        let (place, yaw) = (number(*place, 1.0, 3), number(*yaw, 1.0, 3));
        let pieces = pieces(span);
        let shares =
            format!("errors over {pieces} as shares of {with}'s: place {place}, yaw {yaw}");
        *text += &wrapped("      ", &shares);
    }
}

fn number(estimate: Estimate, scale: f64, decimals: usize) -> String {
    let value = scale * estimate.value;
    match estimate.half_width {
        Some(half) => format!("{value:.decimals$} ± {:.decimals$}", scale * half),
        None => format!("{value:.decimals$}"),
    }
}

fn short(name: &str, width: usize) -> String {
    name.chars().take(width).collect()
}
