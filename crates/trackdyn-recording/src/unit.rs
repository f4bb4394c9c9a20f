//! Units of track speeds and of positions, and which of them were mixed up.

use std::f64::consts::TAU;
use std::fmt::{self, Write};
use std::str::FromStr;
use trackdyn_core::named::by_name;

mod pose;

pub use pose::PoseUnit;

/// Unit of the numbers that are speeds of the tracks or of their wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedUnit {
    /// m/s, of the tracks themselves.
    MetresPerSecond,
    /// mm/s, of the tracks themselves.
    MillimetresPerSecond,
    /// cm/s, of the tracks themselves.
    CentimetresPerSecond,
    /// km/h, of the tracks themselves.
    KilometresPerHour,
    /// Miles per hour, of the tracks themselves.
    MilesPerHour,
    /// Feet per second, of the tracks themselves.
    FeetPerSecond,
    /// rad/s, of the wheels.
    RadiansPerSecond,
    /// Turns per minute, of the wheels.
    TurnsPerMinute,
    /// Turns per second, of the wheels.
    TurnsPerSecond,
    /// Degrees per second, of the wheels.
    DegreesPerSecond,
}

impl SpeedUnit {
    /// All units.
    pub const ALL: [Self; 10] = [
        Self::MetresPerSecond,
        Self::MillimetresPerSecond,
        Self::CentimetresPerSecond,
        Self::KilometresPerHour,
        Self::MilesPerHour,
        Self::FeetPerSecond,
        Self::RadiansPerSecond,
        Self::TurnsPerMinute,
        Self::TurnsPerSecond,
        Self::DegreesPerSecond,
    ];

    /// Its name, as the option takes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::MetresPerSecond => "m/s",
            Self::MillimetresPerSecond => "mm/s",
            Self::CentimetresPerSecond => "cm/s",
            Self::KilometresPerHour => "km/h",
            Self::MilesPerHour => "mph",
            Self::FeetPerSecond => "ft/s",
            Self::RadiansPerSecond => "rad/s",
            Self::TurnsPerMinute => "rpm",
            Self::TurnsPerSecond => "turns/s",
            Self::DegreesPerSecond => "deg/s",
        }
    }

    /// Whether it is of wheels, whose radius makes speeds of the tracks of them.
    pub fn is_of_wheels(self) -> bool {
        matches!(
            self,
            Self::RadiansPerSecond
                | Self::TurnsPerMinute
                | Self::TurnsPerSecond
                | Self::DegreesPerSecond
        )
    }

    /// rad/s, or m/s where it is of the tracks themselves, per unit.
    pub fn factor(self) -> f64 {
        match self {
            Self::MetresPerSecond | Self::RadiansPerSecond => 1.0,
            Self::MillimetresPerSecond => 1e-3,
            Self::CentimetresPerSecond => 1e-2,
            Self::KilometresPerHour => 1.0 / 3.6,
            Self::MilesPerHour => 1609.344 / 3600.0,
            Self::FeetPerSecond => 0.3048,
            Self::TurnsPerMinute => TAU / 60.0,
            Self::TurnsPerSecond => TAU,
            Self::DegreesPerSecond => TAU / 360.0,
        }
    }
}

impl fmt::Display for SpeedUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for SpeedUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        by_name(&Self::ALL, Self::name, text)
    }
}

/// Largest factor between a ratio and that of two units; slip and a rough radius are in between.
const MAX_ERROR: f64 = 1.3;

/// This factor where slip alone may explain the ratio.
const MAX_ERROR_OF_SMALL: f64 = 1.1;

/// Ratio that no slip explains.
const MAX_SLIP_RATIO: f64 = 5.0;

/// Radii of wheels and sprockets, m.
const RADII: [f64; 2] = [0.03, 0.6];

/// A ratio of units that are mixed up: what stands in place of what, and the unit that mends it
/// where the larger numbers are those of the tracks.
const MIXED_UNITS: [(f64, &str, Option<SpeedUnit>); 10] = [
    (360.0 / TAU, "degrees in place of radians", Some(SpeedUnit::DegreesPerSecond)),
    (1000.0, "millimetres in place of metres", Some(SpeedUnit::MillimetresPerSecond)),
    (100.0, "centimetres in place of metres", Some(SpeedUnit::CentimetresPerSecond)),
    (39.37, "inches in place of metres", None),
    (25.4, "millimetres in place of inches", None),
    (60.0 / TAU, "turns per minute in place of rad/s", Some(SpeedUnit::TurnsPerMinute)),
    (TAU, "turns in place of radians", None),
    (3.6, "km/h in place of m/s", Some(SpeedUnit::KilometresPerHour)),
    (3.281, "feet in place of metres", Some(SpeedUnit::FeetPerSecond)),
    (2.237, "miles per hour in place of m/s", Some(SpeedUnit::MilesPerHour)),
];

/// The units whose ratio is nearest to one of two ways, either of which may be the longer one; none
/// where no usual ones are near.
pub fn mixed_up(ratio: f64) -> Option<&'static str> {
    nearest(ratio.max(1.0 / ratio)).map(|(_, name, _)| name)
}

/// How far the nearest ratio of units is from a ratio, as a factor of at least 1.
pub(crate) fn error(ratio: f64) -> Option<f64> {
    let size = ratio.max(1.0 / ratio);
    nearest(size).map(|(unit, ..)| (size / unit).max(unit / size))
}

/// The options that read speeds in another unit, or poses: for speeds that were taken for those of
/// the tracks and are so many times those of the poses. Units of wheels need a radius.
pub fn remedy(ratio: f64) -> String {
    with_poses(ratio, of_speeds(ratio))
}

/// What is said of speeds, after what explains this ratio by the positions.
fn with_poses(ratio: f64, of_speeds: String) -> String {
    match PoseUnit::remedy(1.0 / ratio, allowed) {
        Some(of_poses) => format!("{of_poses}; where the poses are right, {of_speeds}"),
        None => of_speeds,
    }
}

fn of_speeds(ratio: f64) -> String {
    let unit = if ratio > 1.0 { nearest(ratio).and_then(|(.., unit)| unit) } else { None };
    let mut text = match unit.filter(|unit| !unit.is_of_wheels()) {
        Some(unit) => format!("read them with --speed-unit {unit}"),
        None => "expected m/s of tracks or rad/s of joints; --speed-unit takes others".to_owned(),
    };
    let wheels = [SpeedUnit::RadiansPerSecond, SpeedUnit::TurnsPerMinute];
    for wheel in wheels {
        let radius = 1.0 / (ratio * wheel.factor());
        if (RADII[0]..=RADII[1]).contains(&radius) {
            let _ = write!(
                text,
                "; a table of speeds of wheels in {wheel} has this ratio where their radius is \
                 some {radius:.3} m (--speed-unit {wheel} --wheel-radius METRES)"
            );
        }
    }
    text + "; for joints, --wheel-radius is in m per radian, with any gear"
}

/// Factor between the distances of two explanations from a ratio, below which both are named.
const MIN_CONTRAST: f64 = 1.15;

/// What ways of the tracks that are so many times those of the poses may mean besides units, where
/// speeds are taken for those of wheels of a radius, m: speeds of the tracks themselves. Names what
/// stands in place of what, and the options that read it.
fn of_tracks(ratio: f64, radius: f64) -> Option<(&'static str, String)> {
    // Speeds of the tracks are multiplied by the radius once too often.
    let off = (ratio / radius).max(radius / ratio);
    let unit = error(ratio).unwrap_or(f64::INFINITY);
    if off > MAX_ERROR || off > MIN_CONTRAST * unit {
        return None;
    }
    let of_tracks = format!(
        "--speed-unit {} reads speeds, or positions, of the tracks themselves",
        SpeedUnit::MetresPerSecond
    );
    if unit > MIN_CONTRAST * off {
        return Some(("metres of the tracks in place of radians of the wheels", of_tracks));
    }
    let both = "metres of the tracks in place of radians of the wheels, and as well of other \
                units, too near to tell";
    let is_of_turns = ratio < 1.0 && mixed_up(ratio) == Some(MIXED_UNITS[6].1);
    if is_of_turns {
        let both = "metres of the tracks in place of radians of the wheels, and as well of turns \
                    in place of radians, too near to tell";
        let turns = SpeedUnit::TurnsPerSecond;
        return Some((both, format!("{of_tracks}, --speed-unit {turns} reads turns")));
    }
    Some((both, of_tracks))
}

/// Units in which a radius is given by mistake: its name, numbers per metre, what stands in place
/// of what.
const RADIUS_UNITS: [(&str, f64, &str); 3] = [
    ("mm", 1000.0, MIXED_UNITS[1].1),
    ("cm", 100.0, MIXED_UNITS[2].1),
    ("inches", 39.37, MIXED_UNITS[3].1),
];

/// What ways of the tracks that are so many times those of the poses mean where speeds are taken
/// for those of wheels, in this unit and of this radius, m. Names what stands in place of what, and
/// the options that read it; they can all be given beside the radius.
pub(crate) fn of_wheels(
    ratio: f64,
    unit: SpeedUnit,
    radius: f64,
) -> (Option<&'static str>, String) {
    let off = |ratio: f64| ratio.max(1.0 / ratio);
    // no wheel has such a radius, whatever else is wrong
    let is_large = radius > RADII[1];
    let of_radius = RADIUS_UNITS
        .into_iter()
        .filter(|(_, per_metre, _)| is_large && off(ratio / per_metre) <= MAX_ERROR);
    let nearest =
        of_radius.min_by(|(_, a, _), (_, b, _)| off(ratio / a).total_cmp(&off(ratio / b)));
    if let Some((name, per_metre, units)) = nearest {
        let metres = radius / per_metre;
        let text = format!(
            "--wheel-radius {radius} looks as if it were given in {name}: expected metres, \
             {metres:.3}"
        );
        return (Some(units), text);
    }
    if unit == SpeedUnit::RadiansPerSecond
        && let Some((units, text)) = of_tracks(ratio, radius)
    {
        return (Some(units), text);
    }
    // speeds in another unit are multiplied by this factor
    let error = |other: SpeedUnit| off(ratio * other.factor() / unit.factor());
    let others = SpeedUnit::ALL.into_iter().filter(|other| other.is_of_wheels() && *other != unit);
    let other = others.min_by(|a, b| error(*a).total_cmp(&error(*b)));
    let mut text = match other.filter(|other| error(*other) <= MAX_ERROR) {
        Some(other) => format!("read them with --speed-unit {other}"),
        None => format!("expected speeds of the wheels in {unit}; --speed-unit takes others"),
    };
    let fitting = radius / ratio;
    if (RADII[0]..=RADII[1]).contains(&fitting) {
        let _ = write!(text, "; --wheel-radius {fitting:.3} would explain it");
    }
    text += "; --wheel-radius is in m per radian, with any gear";
    (mixed_up(ratio), with_poses(ratio, text))
}

/// Largest factor between a ratio and that of two units.
fn allowed(unit: f64) -> f64 {
    if unit < MAX_SLIP_RATIO { MAX_ERROR_OF_SMALL } else { MAX_ERROR }
}

fn nearest(size: f64) -> Option<(f64, &'static str, Option<SpeedUnit>)> {
    let off = |unit: f64| (size / unit).max(unit / size);
    let near = MIXED_UNITS.into_iter().filter(|(unit, ..)| off(*unit) <= allowed(*unit));
    near.min_by(|(a, ..), (b, ..)| off(*a).total_cmp(&off(*b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_by_their_names() {
        for unit in SpeedUnit::ALL {
            assert_eq!(unit.name().parse(), Ok(unit));
        }
        assert!("furlongs".parse::<SpeedUnit>().is_err_and(|text| text.contains("km/h")));
    }

    #[test]
    fn a_ratio_names_the_units_and_the_option() {
        assert_eq!(mixed_up(3.5), Some("km/h in place of m/s"));
        assert!(remedy(3.5).contains("--speed-unit km/h"));
        assert!(remedy(6.06).contains("some 0.165 m (--speed-unit rad/s --wheel-radius METRES)"));
        // A unit of wheels is refused without a radius.
        for ratio in [9.3, 57.3, 1.0 / 6.2] {
            let text = remedy(ratio);
            assert!(text.starts_with("expected m/s of tracks"), "{text}");
        }
        assert_eq!(mixed_up(1.2), None);
    }

    #[test]
    fn positions_in_another_unit_are_named_beside_the_speeds() {
        for (times, name, unit) in [
            (995.0, "millimetres", "mm"),
            (100.5, "centimetres", "cm"),
            (3.25, "feet", "ft"),
            (39.1, "inches", "in"),
        ] {
            let (_, wheels) = of_wheels(1.0 / times, SpeedUnit::RadiansPerSecond, 0.165);
            let start = format!(
                "where the track speeds are right, the positions look like {name}: --pose-unit \
                 {unit} reads them; where the poses are right, expected "
            );
            for text in [remedy(1.0 / times), wheels] {
                assert!(text.starts_with(&start), "{text}");
            }
            assert!(!remedy(times).contains("--pose-unit"));
        }
        for unit in PoseUnit::ALL {
            assert_eq!(unit.name().parse(), Ok(unit));
        }
        assert!("furlongs".parse::<PoseUnit>().is_err_and(|text| text.contains("mm")));
    }

    #[test]
    fn a_ratio_near_the_radius_names_speeds_of_the_tracks() {
        // 1/0.165 = 6.06 lies too near to 2 pi to tell, 1/0.05 = 20 far from any ratio of units
        let (both, options) = of_tracks(1.0 / 6.1, 0.165).expect("near");
        assert!(both.contains("turns in place of radians, too near to tell"), "{both}");
        assert!(options.contains("m/s") && options.contains("turns/s"), "{options}");
        let (only, options) = of_tracks(1.0 / 19.6, 0.05).expect("near");
        assert!(!only.contains("too near"), "{only}");
        assert!(options.contains("--speed-unit m/s") && !options.contains("turns"), "{options}");
        assert_eq!(of_tracks(1.0 / 6.2, 0.05), None);
        assert_eq!(of_tracks(9.5, 0.165), None);
    }

    #[test]
    fn a_radius_in_another_unit_is_named_with_the_metres() {
        let radians = SpeedUnit::RadiansPerSecond;
        for (ratio, radius, unit) in
            [(999.7, 165.0, "mm"), (101.0, 16.5, "cm"), (39.4, 6.5, "inches")]
        {
            let (units, text) = of_wheels(ratio, radians, radius);
            assert!(units.is_some_and(|units| units.ends_with("in place of metres")), "{units:?}");
            let expected = format!("--wheel-radius {radius} looks as if it were given in {unit}");
            assert!(text.starts_with(&expected) && text.ends_with("metres, 0.165"), "{text}");
        }
    }

    /// A unit of tracks is refused beside a radius.
    #[test]
    fn beside_a_radius_only_units_of_wheels_are_named() {
        let (radians, turns) = (SpeedUnit::RadiansPerSecond, SpeedUnit::TurnsPerMinute);
        let (_, text) = of_wheels(9.3, radians, 0.165);
        assert!(text.contains("--speed-unit rpm;"), "{text}");
        let (_, text) = of_wheels(1.0 / 9.3, turns, 0.165);
        assert!(text.contains("--speed-unit rad/s;"), "{text}");
        for ratio in [1000.0, 100.0, 3.6] {
            let (_, text) = of_wheels(ratio, radians, 0.3);
            assert!(text.starts_with("expected speeds of the wheels in rad/s"), "{text}");
        }
        let (_, text) = of_wheels(3.6, radians, 0.594);
        assert!(text.contains("--wheel-radius 0.165 would explain it"), "{text}");
    }
}
