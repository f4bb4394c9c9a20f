//! `trackdyn kinematics`: direct and inverse kinematics, eqs (7)-(11).

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::options::{CircumstanceOptions, ModelOptions, note_what_steady_icrs_leave_out, pair};
use crate::stderr::note;
use crate::stdout::show;
use clap::{ArgGroup, Args};
use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use trackdyn::crates::core::frames::ros_twist_from_paper;
use trackdyn::crates::core::{PerSide, Twist};
use trackdyn::{Grid, Kinematics, MapSettings, Parameters, Provenance, icr_map};

/// Options of `trackdyn kinematics`.
#[derive(Args)]
#[command(group(ArgGroup::new("given").required(true).args(["speeds", "twist"])))]
pub struct Options {
    /// Track speeds in m/s; prints the motion of the robot
    #[arg(long, value_name = "LEFT,RIGHT", value_parser = pair, allow_hyphen_values = true)]
    speeds: Option<[f64; 2]>,
    /// Forward speed in m/s and yaw rate in rad/s; prints the track speeds
    #[arg(long, value_name = "FORWARD,YAW_RATE", value_parser = pair, allow_hyphen_values = true)]
    twist: Option<[f64; 2]>,
    /// Parameters from a file (schema trackdyn.kinematics/1) [default: the mean of the vehicle's
    /// map up to 1 m/s]
    #[arg(long, value_name = "FILE",
          conflicts_with_all = ["vehicle", "cog", "effects", "heading", "position", "time"])]
    kinematics: Option<PathBuf>,
    #[command(flatten)]
    model: ModelOptions,
    #[command(flatten)]
    circumstance: CircumstanceOptions,
}

/// Prints the motion for track speeds, or track speeds for a motion.
pub fn run(options: &Options) -> Outcome {
    let file = parameters(options)?;
    let (speed, kinematics) = match (options.speeds, options.twist) {
        (Some([left, right]), _) => {
            let speed = PerSide::new(left, right);
            (speed, file.kinematics_at(speed))
        }
        (None, Some([forward, yaw_rate])) => file.track_speeds(forward, yaw_rate),
        (None, None) => return Err("one of --speeds and --twist is needed".into()),
    };
    show(&(format!("  vehicle       {}\n", file.vehicle()) + &motion(speed, &kinematics)))?;
    Ok(Exit::Done)
}

/// The kinematics file, or one made from the vehicle's map.
fn parameters(options: &Options) -> Result<Parameters, Box<dyn Error>> {
    if let Some(path) = &options.kinematics {
        return Ok(Parameters::open(path)?);
    }
    let vehicle = options.model.vehicle()?;
    note_what_steady_icrs_leave_out(vehicle.effects());
    let circumstance = options.circumstance.circumstance();
    let map = icr_map(&vehicle, &MapSettings { circumstance, ..MapSettings::default() });
    let none = "the vehicle does not turn at any pair of track speeds: it has no ICRs";
    if let Some(spread) = map.untold_spread() {
        note(format_args!(
            "the ICRs of this vehicle go with the speeds, by {:.1} mm up to {} m/s: these \
            are their means",
            1e3 * spread,
            Grid::PAPER_SPEED
        ));
    }
    Ok(map.parameters(&Provenance::default()).ok_or(none)?)
}

/// The motion in both frames.
fn motion(speed: PerSide<f64>, kinematics: &Kinematics) -> String {
    let twist = kinematics.twist(speed);
    let Twist { v_x: forward, v_y: left, w } = ros_twist_from_paper(&twist);
    let icrs = kinematics.icrs;
    let mut text = format!(
        "  ICRs          x_l {:.5}  x_r {:.5}  y {:.5} m\n",
        icrs.x_left, icrs.x_right, icrs.y
    );
    if kinematics.alpha != PerSide::new(1.0, 1.0) {
        let _ = writeln!(
            text,
            "  alpha         left {:.5}  right {:.5}",
            kinematics.alpha.left, kinematics.alpha.right
        );
    }
    let _ = writeln!(
        text,
        "  track speeds  left {}  right {} m/s",
        readable(speed.left),
        readable(speed.right)
    );
    let _ = writeln!(
        text,
        "  paper frame   v_x {} (right)  v_y {} (forward) m/s  w {} rad/s",
        readable(twist.v_x),
        readable(twist.v_y),
        readable(w)
    );
    let _ = writeln!(
        text,
        "  ROS frame     v_x {} (forward)  v_y {} (left) m/s  w {} rad/s",
        readable(forward),
        readable(left),
        readable(w)
    );
    text
}

/// The number with five decimals, or with an exponent where that would be too long to read.
fn readable(value: f64) -> String {
    const MAX_DECIMAL_VALUE: f64 = 1e6;
    if value.abs() < MAX_DECIMAL_VALUE { format!("{value:.5}") } else { format!("{value:.5e}") }
}
