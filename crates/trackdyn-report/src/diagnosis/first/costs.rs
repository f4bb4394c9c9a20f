//! What the model costs.

use super::Shown;
use crate::diagnosis::Subject;
use crate::diagnosis::words::{significant, sized};
use crate::ticks::number;
use serde::Serialize;
use trackdyn_diagnose::document::{ComparedTable, DiagnosisFile};

/// What it costs before, and what remains after.
#[derive(Serialize)]
pub(super) struct Cost {
    name: &'static str,
    unit: &'static str,
    note: String,
    /// What the noise of the poses makes of it; none where nothing is known.
    noise: Option<Shown>,
    rows: Vec<Row>,
}

/// A number with its interval and the length of its bar.
#[derive(Serialize)]
struct Row {
    when: &'static str,
    value: Shown,
    interval: Option<[Shown; 2]>,
    /// Per cent of the longest bar.
    length: f64,
}

/// Drifts of dead reckoning, and how far it departs from the log.
pub(super) fn of(subject: &Subject) -> Vec<Cost> {
    let DiagnosisFile { fit, drift, .. } = subject.file;
    let turns = |turns: f64| match turns {
        turns if turns >= 1.0 => "turns",
        turns if turns >= 0.5 => "half turns",
        _ => "quarter turns",
    };
    let yaw = drift.yaw_deg_per_turn.as_ref().map(|of| {
        let note = format!("measured on {} {}", of.pieces, turns(of.piece));
        compared("Heading lost per full turn", "°", note, of)
    });
    let place = drift.place_m_per_100_m.as_ref().map(|of| {
        let note = format!("measured on {} pieces of {} m", of.pieces, number(of.piece, 0));
        compared("Place lost per 100 m", " m", note, of)
    });
    let fitted = if subject.diagnosis.blames_instruments() {
        "constant ICRs"
    } else {
        "constant ICRs, clock and sensor"
    };
    // where nothing is missing there is nothing to correct
    let rows = match subject.file.missing.as_slice() {
        [] if fit.held_out_before == fit.held_out_after => {
            vec![("as filed", fit.held_out_before)]
        }
        _ => vec![("before", fit.held_out_before), ("after", fit.held_out_after)],
    };
    let most = fit.held_out_before.max(fit.held_out_after);
    let row = |(when, value): (&'static str, f64)| Row {
        when,
        value: Shown { data: value, text: number(value, 3) },
        interval: None,
        length: share(value, most),
    };
    let departure = Cost {
        name: "Departure from the log",
        unit: " × noise",
        note: format!(
            "noise alone leaves {}; {fitted} fitted before, too",
            number(fit.noise_floor, 3)
        ),
        noise: None,
        rows: rows.into_iter().map(row).collect(),
    };
    yaw.into_iter().chain(place).chain([departure]).collect()
}

fn compared(name: &'static str, unit: &'static str, note: String, of: &ComparedTable) -> Cost {
    let rows = [("as filed", of.before, of.before95), ("corrected", of.after, of.after95)];
    let most = of.before.max(of.after);
    let row = |(when, value, interval): (&'static str, f64, Option<[f64; 2]>)| {
        let [low, high] = interval.unwrap_or([value, value]);
        let [value_text, low_text, high_text] = sized([value, low, high]);
        Row {
            when,
            value: Shown { data: value, text: value_text },
            interval: interval.map(|[low, high]| {
                [Shown { data: low, text: low_text }, Shown { data: high, text: high_text }]
            }),
            length: share(value, most),
        }
    };
    let worse = "; worse as corrected, against what the fit says: do not take it";
    let note = if of.is_worse() { note + worse } else { note };
    // a correction that changes nothing is none
    let count = if of.before == of.after { 1 } else { 2 };
    let noise = Shown { data: of.pose_noise, text: significant(of.pose_noise, 2) };
    Cost {
        name,
        unit,
        note,
        noise: Some(noise),
        rows: rows.into_iter().take(count).map(row).collect(),
    }
}

/// Per cent of the largest, to a tenth.
fn share(value: f64, most: f64) -> f64 {
    if most > 0.0 { (1000.0 * value / most).round() / 10.0 } else { 0.0 }
}
