//! Contradictions in words.

use super::{Contradiction, OtherClock};
use crate::sensor::Nuisance;
use std::fmt::{Display, Formatter, Result};
use trackdyn_core::{PerSide, Side};
use trackdyn_recording::{PoseUnit, unit};

/// χ of usual robots, by which units of length are named.
const USUAL_EFFICIENCIES: [f64; 2] = [0.35, 0.95];

impl Display for Contradiction {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match *self {
            Self::Method { method, found, fit } => write!(
                f,
                "x_r - x_l is {fit:.3} m by least squares and {found:.3} m by {method}: clocks, \
                 units or track speeds of a part of the drive may be wrong"
            ),
            Self::Efficiency { chi } => write!(
                f,
                "chi = {chi:.2}: the ICRs lie on the tracks' centre-lines or between them, where \
                 friction cannot put them: check the gauge, and what makes the track speeds: the \
                 wheel radius, which joints were taken, or of a twist the --separation, by which \
                 its driver may correct for slip; or these poses or speeds are computed without \
                 slip"
            ),
            Self::Apart { chi } => apart(f, chi),
            Self::Follows { left } => write!(
                f,
                "the poses follow the track speeds over seconds, and not as through a filter, \
                 which leaves {:.0} % of the turning: commands that the tracks do not keep up with \
                 in place of measured speeds? Expected what encoders measure (of a bag \
                 --joint-signal, --tracks-topic or --left-signal), or each command held until the \
                 robot follows",
                100.0 * left
            ),
            Self::Response { gap, fit } => write!(
                f,
                "x_r - x_l is {fit:.3} m by the fit and {gap:.3} m by turning over seconds: the \
                 poses do not follow the track speeds as one robot does: check whether speeds or \
                 poses are filtered, and whether speeds are commands (of a bag --joint-signal, \
                 --tracks-topic)"
            ),
            Self::Way { left, mount, during } => way(f, left, mount, during),
            Self::Alpha { side, alpha, ratio } => {
                let side = if side == Side::Left { "l" } else { "r" };
                let more = if alpha < 1.0 { "less" } else { "more" };
                write!(
                    f,
                    "alpha_{side} = {alpha:.2}: a track hardly moves that much {more} than its \
                     encoder says: "
                )?;
                match ratio.and_then(|ratio| Some((ratio, unit::mixed_up(ratio)?))) {
                    Some((ratio, units)) => write!(
                        f,
                        "the track speeds are {ratio:.3} times what the poses show, as {units} \
                         would be: {}",
                        unit::remedy(ratio)
                    ),
                    None => f.write_str(
                        "check the wheel radius, the unit (--speed-unit) and the joints, or drive \
                         more straight stretches",
                    ),
                }
            }
            Self::Factors { alphas: PerSide { left, right }, ratio } => write!(
                f,
                "with constant factors on the track speeds, {left:.3} left and {right:.3} right, \
                 the residuals are {ratio:.1} times smaller, which no slip explains: check wheel \
                 radii, gears and units of each side; the fit with these factors holds"
            ),
            Self::RunClock(OtherClock { run, tau, of_all }) => write!(
                f,
                "the poses of run {run} are {tau:.2} s late by themselves, and {of_all:.2} s where \
                 all runs share one clock: take runs of one clock (--runs), or give their stamps \
                 one"
            ),
            Self::Turning { left } => write!(
                f,
                "the fit leaves {:.0} % of the turning: tracks and poses do not tell of one drive: \
                 check clocks, units, and which joints were taken",
                100.0 * left
            ),
            Self::WheelOdometry { left } => write!(
                f,
                "the fit leaves {:.2} % of the turning, and the ICRs are those of an ideal drive: \
                 these poses are wheel odometry, computed from the tracks, and show no slip (or \
                 the gauge is not the distance between the tracks' centre-lines). Poses have to \
                 come from something else: lidar, GNSS, motion capture",
                100.0 * left
            ),
        }
    }
}

/// ICRs further from each other than friction puts them.
fn apart(f: &mut Formatter<'_>, chi: f64) -> Result {
    write!(
        f,
        "chi = {chi:.3}: the ICRs lie {:.1} gauges from each other, which friction \
         cannot do: ",
        1.0 / chi
    )?;
    // Poses and track speeds may share a unit where the gauge is in m.
    let usual = |unit: &PoseUnit| {
        let [low, high] = USUAL_EFFICIENCIES;
        (low..high).contains(&(chi / unit.factor()))
    };
    f.write_str("check the units of poses and track speeds (--speed-unit)")?;
    if let Some(unit) = PoseUnit::ALL.into_iter().rev().find(usual) {
        write!(
            f,
            ", which in {} would make it {:.2} (--columns reads lengths in ft, cm \
             and mm)",
            unit.word(),
            chi / unit.factor()
        )?;
    }
    f.write_str(", and the gauge")
}

/// Poses that move where the tracks do not drive.
fn way(f: &mut Formatter<'_>, left: f64, mount: Option<f64>, during: Option<[f64; 2]>) -> Result {
    write!(
        f,
        "the fit leaves {:.0} % of the way: the poses move where the tracks do not \
         drive: ",
        100.0 * left
    )?;
    if let Some([from, until]) = during {
        return write!(
            f,
            "from {from:.0} s to {until:.0} s alone, and elsewhere they follow: look \
             what happened to the poses there, and take the rest (--time)"
        );
    }
    match mount {
        Some(mount) => write!(
            f,
            "the sensor is turned on the robot by some {0:.0} degrees (--mount-yaw {0:.0}, added \
             to one that was given, takes it back, --fit {1} finds the rest), or its yaw is not \
             that of the robot",
            mount.to_degrees(),
            Nuisance::SensorYaw
        ),
        None => f.write_str(
            "check the wheel radius and the units, whether x and y are swapped or \
             mirrored, and whether these poses measure positions at all (on ice a robot \
             may slide as far)",
        ),
    }
}
