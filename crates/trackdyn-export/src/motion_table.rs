//! The stationary motion of a vehicle for a robot's computer: a table, and a C header.

use crate::{Provenance, TextFile};
use serde::Serialize;
use std::fmt::Write;
use trackdyn_core::PerSide;
use trackdyn_core::rounding::Digits;
use trackdyn_model::MotionTable;
use trackdyn_model::motion_table::TOLERANCE;

/// Digits of the coefficients, m, 1 and 1/m: far below [`TOLERANCE`] at any speed of a robot.
const DIGITS: Digits = Digits::Decimals(10);

/// Coefficients in a line of the header.
const IN_A_LINE: usize = 16;

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
        logarithmic_range: table.range,
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

/// The table as a function of C99, or of C++.
fn header(
    table: &MotionTable,
    coefficients: &[[f64; 3]],
    left_out: &LeftOut,
    provenance: &Provenance,
) -> String {
    let MotionTable { gain, largest, range, slips, orders: [sizes, angles], error, .. } = table;
    let PerSide { left, right } = gain;
    let mut notes = String::from(
        "Steady motion of the robot at the speeds that its encoders show, and its derivatives.\n",
    );
    let _ = writeln!(
        notes,
        "Largest difference from the model: {error:.1e} m/s; the yaw rate counts as a track speed."
    );
    if *error > TOLERANCE {
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
    let mut text = provenance.c_comment(&notes);
    let place = range.map_or_else(
        || "norm / largest".to_owned(),
        |range| format!("norm > 0.0 ? 1.0 + log(norm / largest) / {:?} : 0.0", range.ln()),
    );
    let by_norm = range
        .map_or_else(|| "1.0 / largest".to_owned(), |range| format!("per_norm / {:?}", range.ln()));
    let (scale, scale_by_left, scale_by_right) = if *slips {
        ("norm", "belt[0] * per_norm", "belt[1] * per_norm")
    } else {
        ("belt[1] - belt[0]", "-1.0", "1.0")
    };
    let _ = write!(
        text,
        "#ifndef TRACKDYN_MOTION_H\n#define TRACKDYN_MOTION_H\n\n#include <math.h>\n\n\
         #define TRACKDYN_SIZES {sizes}\n#define TRACKDYN_ANGLES {angles}\n\n\
         /* Of each sector, of each polynomial in the speed, of each in the direction: forward, \
         left, yaw. */\n\
         static const double trackdyn_coefficients[8 * TRACKDYN_SIZES * TRACKDYN_ANGLES][3] = {{\n"
    );
    for line in coefficients.chunks(IN_A_LINE) {
        let numbers = line.iter().map(|[a, b, c]| format!("{{{a:?}, {b:?}, {c:?}}},"));
        let _ = writeln!(text, "    {}", numbers.collect::<Vec<_>>().join(" "));
    }
    let _ = write!(
        text,
        r"}};

/* Chebyshev's polynomials at 2 x - 1, and their derivatives by x. */
static inline void trackdyn_chebyshev(int count, double x, double *value, double *slope)
{{
    double z = 2.0 * x - 1.0;
    value[0] = 1.0;
    slope[0] = 0.0;
    if (count > 1) {{
        value[1] = z;
        slope[1] = 2.0;
    }}
    for (int k = 2; k < count; ++k) {{
        value[k] = 2.0 * z * value[k - 1] - value[k - 2];
        slope[k] = 4.0 * value[k - 1] + 2.0 * z * slope[k - 1] - slope[k - 2];
    }}
}}

/* Twist in ROS axes (forward m/s, left m/s, yaw rad/s) at the speeds of the left and the right
   encoder, m/s, and its derivatives by these two speeds. */
static inline void trackdyn_motion(double v_left, double v_right, double twist[3],
                                   double by_speed[3][2])
{{
    const double gain[2] = {{{left:?}, {right:?}}};
    const double largest = {largest:?};
    const double eighth = 0.78539816339744830962;
    double belt[2] = {{gain[0] * v_left, gain[1] * v_right}};
    double norm = sqrt(belt[0] * belt[0] + belt[1] * belt[1]);
    double per_norm = norm > 0.0 ? 1.0 / norm : 0.0;
    double size = {place};
    double size_by_norm = size >= 0.0 && size <= 1.0 ? {by_norm} : 0.0;
    size = size < 0.0 ? 0.0 : size > 1.0 ? 1.0 : size;
    double turn = atan2(belt[1], belt[0]) / eighth;
    turn = turn < 0.0 ? turn + 8.0 : turn;
    int sector = (int)turn;
    sector = sector > 7 ? 7 : sector;

    double t_s[TRACKDYN_SIZES + 1], d_s[TRACKDYN_SIZES + 1];
    double t_a[TRACKDYN_ANGLES + 1], d_a[TRACKDYN_ANGLES + 1];
    trackdyn_chebyshev(TRACKDYN_SIZES, size, t_s, d_s);
    trackdyn_chebyshev(TRACKDYN_ANGLES, turn - sector, t_a, d_a);
    double value[3] = {{0.0}}, by_size[3] = {{0.0}}, by_angle[3] = {{0.0}};
    for (int j = 0; j < TRACKDYN_SIZES; ++j) {{
        for (int k = 0; k < TRACKDYN_ANGLES; ++k) {{
            const double *c =
                trackdyn_coefficients[(sector * TRACKDYN_SIZES + j) * TRACKDYN_ANGLES + k];
            for (int i = 0; i < 3; ++i) {{
                value[i] += t_s[j] * t_a[k] * c[i];
                by_size[i] += d_s[j] * t_a[k] * c[i];
                by_angle[i] += t_s[j] * d_a[k] * c[i];
            }}
        }}
    }}

    double scale = {scale};
    const double scale_by[2] = {{{scale_by_left}, {scale_by_right}}};
    const double size_by[2] = {{size_by_norm * belt[0] * per_norm,
                               size_by_norm * belt[1] * per_norm}};
    double per_angle = per_norm * per_norm / eighth;
    const double angle_by[2] = {{-belt[1] * per_angle, belt[0] * per_angle}};
    for (int i = 0; i < 3; ++i) {{
        twist[i] = value[i] * scale + (i == 0 ? 0.5 * (belt[0] + belt[1]) : 0.0);
        for (int side = 0; side < 2; ++side) {{
            double by_place = by_size[i] * size_by[side] + by_angle[i] * angle_by[side];
            by_speed[i][side] = gain[side] * (by_place * scale + value[i] * scale_by[side]
                                              + (i == 0 ? 0.5 : 0.0));
        }}
    }}
}}

#endif
"
    );
    text
}
