//! The stationary motion of a vehicle for a robot's computer: a table, and a C header.

use crate::{Provenance, TextFile};
use serde::Serialize;
use std::fmt::Write;
use trackdyn_core::rounding::Digits;
use trackdyn_model::MotionTable;
use trackdyn_model::motion_table::TOLERANCE;

/// Digits of the coefficients, m, 1 and 1/m: far below [`TOLERANCE`] at any speed of a robot.
const DIGITS: Digits = Digits::Decimals(10);

/// Coefficients in a line of the header.
const COEFFICIENTS_PER_LINE: usize = 16;

/// What a table of steady driving leaves out of a vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LeftOut {
    /// Effects of place, heading, time or changes of speed.
    pub effects: Vec<String>,
    /// Time constant with which the belts follow the encoders, s; zero for none.
    pub lag: f64,
}

#[derive(Serialize)]
struct File<'a> {
    schema: &'static str,
    frame: &'static str,
    gain_left: f64,
    gain_right: f64,
    largest_m_per_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    logarithmic_range: Option<f64>,
    scale: &'static str,
    error_m_per_s: f64,
    unsolved: f64,
    left_out: &'a [String],
    lag_s: f64,
    /// Of each sector, of each polynomial in s, of each in a.
    coefficients: Vec<Vec<Vec<[f64; 3]>>>,
    source: Source<'a>,
}

#[derive(Serialize)]
struct Source<'a> {
    command: &'a str,
    version: &'a str,
    vehicle: &'a str,
    fingerprint: &'a str,
}

/// `motion_table.toml` (schema `trackdyn.motion-table/1`) and `trackdyn_motion.h`.
///
/// # Panics
/// Never: numbers and texts are TOML.
pub fn files(table: &MotionTable, left_out: &LeftOut, provenance: &Provenance) -> [TextFile; 2] {
    let [sizes, angles] = table.orders;
    let rounded: Vec<[f64; 3]> =
        table.coefficients.iter().map(|c| c.map(|value| DIGITS.round(value))).collect();
    let of_sector = |sector: &[[f64; 3]]| sector.chunks(angles).map(<[_]>::to_vec).collect();
    let file = File {
        schema: "trackdyn.motion-table/1",
        frame: "ros",
        gain_left: table.gain.left,
        gain_right: table.gain.right,
        largest_m_per_s: table.largest,
        logarithmic_range: table.spacing.range(),
        scale: if table.slips { "norm" } else { "difference" },
        error_m_per_s: Digits::Significant(3).round(table.error),
        unsolved: Digits::Significant(3).round(table.unsolved),
        left_out: &left_out.effects,
        lag_s: left_out.lag,
        coefficients: rounded.chunks(sizes * angles).map(of_sector).collect(),
        source: Source {
            command: &provenance.command,
            version: &provenance.version,
            vehicle: &provenance.vehicle,
            fingerprint: &provenance.fingerprint,
        },
    };
    let text = toml::to_string(&file).expect("numbers and texts are TOML");
    let header = header(table, &rounded, left_out, provenance);
    [
        TextFile { name: "motion_table.toml", text },
        TextFile { name: "trackdyn_motion.h", text: header },
    ]
}

/// The header with places for its numbers.
const HEADER: &str = include_str!("motion_table/trackdyn_motion.h");

/// What a user of the table has to know of it.
fn notes(table: &MotionTable, left_out: &LeftOut) -> String {
    let error = table.error;
    let mut notes = format!(
        "Steady motion of the robot at the speeds that its encoders show, and its derivatives.\n\
         Largest difference from the model: {error:.1e} m/s; the yaw rate counts as a track \
         speed.\n"
    );
    if error > TOLERANCE {
        notes += "That is more than rounding: the model has a kink, as where a track starts to \
                  stick.\n";
    }
    if table.unsolved > 0.0 {
        let _ = writeln!(
            notes,
            "At {:.1} % of the speeds the robot tips over; they have the motion of their \
             neighbours.",
            100.0 * table.unsolved
        );
    }
    if !left_out.effects.is_empty() {
        let _ = writeln!(notes, "Steady driving leaves out: {}.", left_out.effects.join(", "));
    }
    if left_out.lag > 0.0 {
        let _ = writeln!(
            notes,
            "The belts follow the encoders with a time constant of {} s: filter the speeds first.",
            left_out.lag
        );
    }
    notes
}

/// The table as a function of C99, or of C++.
fn header(
    table: &MotionTable,
    coefficients: &[[f64; 3]],
    left_out: &LeftOut,
    provenance: &Provenance,
) -> String {
    let MotionTable { gain, largest, spacing, slips, orders: [sizes, angles], .. } = table;
    let ln_range = spacing.range().map(|range| format!("{:?}", range.ln()));
    let size = ln_range.as_ref().map_or_else(
        || "norm / largest".to_owned(),
        |ln_range| format!("norm > 0.0 ? 1.0 + log(norm / largest) / {ln_range} : 0.0"),
    );
    let size_by_norm = ln_range
        .as_ref()
        .map_or_else(|| "1.0 / largest".to_owned(), |ln_range| format!("per_norm / {ln_range}"));
    let [scale, scale_by_left, scale_by_right] = if *slips {
        ["norm", "belt[0] * per_norm", "belt[1] * per_norm"]
    } else {
        ["belt[1] - belt[0]", "-1.0", "1.0"]
    };
    let line = |line: &[[f64; 3]]| {
        let numbers = line.iter().map(|[a, b, c]| format!("{{{a:?}, {b:?}, {c:?}}},"));
        format!("    {}\n", numbers.collect::<Vec<_>>().join(" "))
    };
    let values = [
        ("@SIZES@", sizes.to_string()),
        ("@ANGLES@", angles.to_string()),
        ("@COEFFICIENTS@", coefficients.chunks(COEFFICIENTS_PER_LINE).map(line).collect()),
        ("@GAIN_LEFT@", format!("{:?}", gain.left)),
        ("@GAIN_RIGHT@", format!("{:?}", gain.right)),
        ("@LARGEST@", format!("{largest:?}")),
        ("@SIZE@", size),
        ("@SIZE_BY_NORM@", size_by_norm),
        ("@SCALE@", scale.to_owned()),
        ("@SCALE_BY_LEFT@", scale_by_left.to_owned()),
        ("@SCALE_BY_RIGHT@", scale_by_right.to_owned()),
    ];
    let code = HEADER.to_owned();
    let code = values.iter().fold(code, |code, (place, value)| code.replace(place, value));
    provenance.c_comment(&notes(table, left_out)) + &code
}
