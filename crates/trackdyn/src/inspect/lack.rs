//! What a recording lacks, and how to record it.

use super::Driving;
use super::finding::of_turning;
use crate::ReadOptions;
use std::f64::consts::TAU;
use std::fmt;
use std::ops::RangeInclusive;
use trackdyn_core::PerSide;
use trackdyn_recording::Recording as Motion;
use trackdyn_recording::rosbag::{Role, TopicSummary};

/// Turning on the spot, each way, rad: the spin test needs half a turn in all.
const MIN_SPIN: f64 = TAU;

/// Turning of any kind, each way, rad.
const MIN_TURN: f64 = TAU;

/// Straight driving, m.
const MIN_STRAIGHT_WAY: f64 = 5.0;

/// Time in all, s.
const MIN_DURATION: f64 = 60.0;

/// Radii of wheels and sprockets, m.
const RADII: RangeInclusive<f64> = 0.01..=1.0;

/// Something that a recording lacks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Lack {
    /// Track speeds of a trajectory.
    Tracks,
    /// Track speeds of a bag.
    TracksOfBag,
    /// Poses that something else than the tracks measured.
    Poses,
    /// The belt travel per radian of the joints; `about` is what poses make of it, m.
    WheelRadius {
        /// Radius by the way of the poses, slip included, m.
        about: Option<f64>,
    },
    /// Positions: poses have a yaw alone.
    Positions,
    /// Turning both ways.
    Turning(PerSide<f64>),
    /// Turning on the spot both ways.
    Spins(PerSide<f64>),
    /// Straight driving, m.
    Straight(f64),
    /// The noise of the poses, which shows at rest or in steady driving.
    Noise,
    /// Time, s.
    Duration(f64),
}

impl Lack {
    /// What to do about it.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::Tracks => {
                "record the joint states of both sides, or give a table t,v_left,v_right with \
                 --tracks"
            }
            Self::TracksOfBag => {
                "record the joint states of both sides; numbers of other messages are named by \
                 --left-signal and --right-signal, speeds of the body by --twist-topic; with a \
                 table of track speeds, a .tum or .txt trajectory of its poses is read by --tracks"
            }
            Self::Poses => {
                "record poses that do not come from the wheels: lidar, GNSS, motion capture; a \
                 gyroscope tells the distance of the ICRs alone"
            }
            Self::WheelRadius { about: Some(about) } if !RADII.contains(about) => {
                "no wheel: do the joints turn before a gear, or are their speeds in another unit \
                 than rad/s? --speed-unit reads rpm, deg/s, turns/s, m/s and others; what is left, \
                 such as a gear or rad/min, --wheel-radius takes as m of the track per radian of \
                 the joint"
            }
            Self::WheelRadius { .. } => {
                "measure it: belt travel in one turn of the joint, divided by 2 pi"
            }
            Self::Positions => "record poses with positions, to know where the ICRs are",
            Self::Turning(_) => "drive curves of different radius, both ways",
            Self::Spins(_) => "turn on the spot, two turns each way, slowly and fast",
            Self::Straight(_) => "drive straight, forward and back, 10 m each",
            Self::Noise => "stand still for ten seconds at the beginning and the end",
            Self::Duration(_) => "record five minutes, or eight drives of half a minute",
        }
    }
}

impl fmt::Display for Lack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let turns = |of: &PerSide<f64>| {
            let of = of.map(|angle| (angle / TAU).max(0.0));
            format!("{:.1} turns left and {:.1} right", of.left, of.right)
        };
        match self {
            Self::Tracks | Self::TracksOfBag => f.write_str("track speeds"),
            Self::Poses => f.write_str("poses"),
            Self::WheelRadius { about: None } => f.write_str("the wheel radius"),
            Self::WheelRadius { about: Some(about) } => {
                // three digits
                let decimals = (2.0 - about.log10().floor()).clamp(0.0, 9.0);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "0 to 9"
                )]
                let decimals = decimals as usize;
                write!(f, "the wheel radius: poses say some {about:.decimals$} m, slip included")
            }
            Self::Positions => f.write_str("positions: only yaw is known"),
            Self::Turning(of) => write!(f, "turning both ways: {}", turns(of)),
            Self::Spins(of) => write!(f, "turning on the spot both ways: {}", turns(of)),
            Self::Straight(of) => write!(f, "straight driving: {of:.1} m"),
            Self::Noise => f.write_str("rest or steady driving, which show the noise of the poses"),
            Self::Duration(of) => write!(f, "time: {of:.0} s"),
        }
    }
}

/// What the driving lacks.
pub(super) fn of_driving(motion: &Motion, driving: &Driving, speed_unit: f64) -> Vec<Lack> {
    let is_known = (speed_unit - 1.0).abs() < f64::EPSILON;
    let both = |of: &PerSide<f64>, least: f64| of.left >= least && of.right >= least;
    let about = driving.travel_ratio.map(|ratio| ratio * speed_unit);
    // Without a radius, ways are in units of an assumed one.
    let straight = if is_known {
        driving.straight
    } else {
        about.unwrap_or(0.0) / speed_unit * driving.straight
    };
    // What was turned cannot be told by tracks that do not show it.
    let shows = of_turning(driving).is_none();
    let lacks = [
        (!is_known, Lack::WheelRadius { about }),
        (!driving.has_positions, Lack::Positions),
        (shows && !both(&driving.turned, MIN_TURN), Lack::Turning(driving.turned)),
        (shows && !both(&driving.spun, MIN_SPIN), Lack::Spins(driving.spun)),
        (driving.has_positions && straight < MIN_STRAIGHT_WAY, Lack::Straight(straight)),
        (motion.stated_noise().is_none() && !driving.has_noise, Lack::Noise),
        (driving.duration < MIN_DURATION, Lack::Duration(driving.duration)),
    ];
    lacks.into_iter().filter_map(|(is_lacking, lack)| is_lacking.then_some(lack)).collect()
}

/// What a bag lacks by its topics.
pub(super) fn of_topics(topics: &[TopicSummary], options: &ReadOptions) -> Vec<Lack> {
    let bag = &options.bag;
    let has = |role: Role| topics.iter().any(|of| of.role == Some(role) && of.messages > 0);
    // Poses beside a twist come from the tracks themselves.
    let has_poses = topics.iter().any(|of| {
        of.role == Some(Role::Poses)
            && of.messages > 0
            && Some(&of.name) != bag.twist_topic.as_ref()
    });
    let is_named = bag.twist_topic.is_some() || !bag.left_signals.is_empty();
    let lacks = [
        (!has(Role::Tracks) && !is_named, Lack::TracksOfBag),
        (!has_poses && !has(Role::Imu), Lack::Poses),
        (!has_poses && has(Role::Imu), Lack::Positions),
        (
            (has(Role::Tracks) || is_named) && bag.wheel_radius.is_none() && bag.counts_wheels(),
            Lack::WheelRadius { about: None },
        ),
    ];
    lacks.into_iter().filter_map(|(is_lacking, lack)| is_lacking.then_some(lack)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// rad/min in place of rad/s: the radius of a wheel divided by 60.
    #[test]
    fn a_radius_of_no_wheel_is_told_in_full_and_asks_for_the_unit() {
        let lack = |about| Lack::WheelRadius { about: Some(about) };
        let of_minutes = lack(0.014 / 60.0);
        assert!(of_minutes.to_string().contains("some 0.000233 m"), "{of_minutes}");
        assert!(of_minutes.advice().contains("--speed-unit"));
        let of_wheel = lack(0.1649);
        assert!(of_wheel.to_string().contains("some 0.165 m"), "{of_wheel}");
        assert!(of_wheel.advice().starts_with("measure it"));
    }
}
