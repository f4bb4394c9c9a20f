//! One CSV table with times, track speeds and poses or the yaw rate of a gyroscope, whose columns
//! are named by the user.
//!
//! A [`Columns`] is written as `KEY=COLUMN`, several with commas between, such as
//! `t=Time:ms,v_l=left_rpm:rpm,v_r=-right_rpm:rpm,x=pos_x,y=pos_y,yaw=heading:deg`. A unit may
//! follow the name after a colon, and a `-` before it reverses the sign. Cells may stand between
//! commas, semicolons (with decimal commas) or tabs. An empty cell was not measured. Times may be
//! dates, or seconds with their nanoseconds in another column. Positions may be latitude and
//! longitude. A row of units may follow the header.

use crate::table::Table;
use crate::unit::SpeedUnit;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt;
use std::str::FromStr;

mod place;
mod rows;
mod time;
mod units;

pub use rows::read;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Time,
    /// What a time has beside its seconds.
    Nanoseconds,
    Left,
    Right,
    X,
    Y,
    Latitude,
    Longitude,
    Yaw,
    Qx,
    Qy,
    Qz,
    Qw,
    Gyro,
    Run,
}

/// Keys by their names; the first name of each is the one that messages use.
const KEYS: [(&str, Key); 17] = [
    ("t", Key::Time),
    ("t_ns", Key::Nanoseconds),
    ("v_l", Key::Left),
    ("v_left", Key::Left),
    ("v_r", Key::Right),
    ("v_right", Key::Right),
    ("x", Key::X),
    ("y", Key::Y),
    ("lat", Key::Latitude),
    ("lon", Key::Longitude),
    ("yaw", Key::Yaw),
    ("qx", Key::Qx),
    ("qy", Key::Qy),
    ("qz", Key::Qz),
    ("qw", Key::Qw),
    ("gyro_z", Key::Gyro),
    ("run", Key::Run),
];

/// What poses are told by.
const POSE: [Key; 9] =
    [Key::X, Key::Y, Key::Latitude, Key::Longitude, Key::Yaw, Key::Qx, Key::Qy, Key::Qz, Key::Qw];

/// Units of times in s, of lengths in m, of angles in rad, and of yaw rates in rad/s.
const TIMES: [(&str, f64); 7] = [
    ("s", 1.0),
    ("ms", 1e-3),
    ("us", 1e-6),
    ("ns", 1e-9),
    ("min", 60.0),
    ("h", 3600.0),
    ("d", 86_400.0),
];
const LENGTHS: [(&str, f64); 5] =
    [("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("km", 1e3), ("ft", 0.3048)];
const ANGLES: [(&str, f64); 2] = [("rad", 1.0), ("deg", TAU / 360.0)];
const RATES: [(&str, f64); 2] = [("rad/s", 1.0), ("deg/s", TAU / 360.0)];

/// The one unit of what a time has beside its seconds, and that of latitude and longitude, degrees.
const NANOSECONDS: [(&str, f64); 1] = [("ns", 1.0)];
const DEGREES: [(&str, f64); 1] = [("deg", 1.0)];

/// The unit of headings of a compass: degrees clockwise from the y axis, which is north.
const COMPASS: &str = "compass";

/// What the numbers of a column are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unit {
    /// The SI unit, or what the options say of speeds.
    Open,
    /// SI units per number.
    Factor(f64),
    /// Of speeds.
    Speed(SpeedUnit),
    /// [`COMPASS`].
    Compass,
}

impl Key {
    fn name(self) -> &'static str {
        KEYS.iter().find(|(_, key)| *key == self).map_or("", |(name, _)| name)
    }

    /// The unit of this name for such a column.
    fn unit(self, name: &str) -> Option<Unit> {
        let factor = |units: &[(&str, f64)]| {
            units.iter().find(|(unit, _)| *unit == name).map(|(_, factor)| Unit::Factor(*factor))
        };
        match self {
            Self::Time => factor(&TIMES),
            Self::Left | Self::Right => name.parse().ok().map(Unit::Speed),
            Self::X | Self::Y => factor(&LENGTHS),
            Self::Yaw if name == COMPASS => Some(Unit::Compass),
            Self::Yaw => factor(&ANGLES),
            Self::Gyro => factor(&RATES),
            Self::Nanoseconds => factor(&NANOSECONDS),
            Self::Latitude | Self::Longitude => factor(&DEGREES),
            Self::Qx | Self::Qy | Self::Qz | Self::Qw | Self::Run => None,
        }
    }
}

/// A column of the user.
#[derive(Clone, Debug, PartialEq)]
struct Column {
    name: String,
    sign: f64,
    unit: Unit,
}

/// Which columns of a table hold times, track speeds, poses and yaw rates.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    text: String,
    columns: BTreeMap<Key, Column>,
}

impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Columns {
    /// Whether they hold poses, be it a yaw alone.
    fn has_poses(&self) -> bool {
        POSE.iter().any(|key| self.columns.contains_key(key))
    }

    /// The place of a key in a table, and its column.
    fn at(&self, key: Key, table: &Table) -> Option<(usize, &Column)> {
        let column = self.columns.get(&key)?;
        Some((table.column(&column.name)?, column))
    }
}

impl FromStr for Columns {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut columns = BTreeMap::new();
        for part in parts(text) {
            let known = part.split_once('=').and_then(|(key, name)| {
                let (_, key) = KEYS.iter().find(|(known, _)| *known == key.trim())?;
                Some((*key, name.trim()))
            });
            let Some((key, name)) = known.filter(|(_, name)| !name.is_empty()) else {
                return Err(format!(
                    "{part:?}: expected KEY=COLUMN with a key of t, t_ns, v_l, v_r, x, y (or \
                     lat, lon), yaw (or qx, qy, qz, qw), gyro_z, run"
                ));
            };
            if columns.insert(key, Column::parse(key, name)).is_some() {
                return Err(format!("{} stands there twice", key.name()));
            }
        }
        let has = |key: Key| columns.contains_key(&key);
        let missing = |keys: &[Key]| keys.iter().copied().find(|key| !has(*key));
        let has_poses = POSE.into_iter().any(has);
        let mut needed = vec![Key::Time, Key::Left, Key::Right];
        let positions = [[Key::X, Key::Y], [Key::Latitude, Key::Longitude]];
        let positions = positions.into_iter().filter(|pair| pair.iter().any(|key| has(*key)));
        needed.extend(positions.flatten());
        if let Some(key) = missing(&needed) {
            return Err(format!("{0} is missing: expected {0}=COLUMN", key.name()));
        }
        if has(Key::X) && has(Key::Latitude) {
            return Err("expected x=COLUMN and y=COLUMN, or lat=COLUMN and lon=COLUMN".into());
        }
        if !has_poses && !has(Key::Gyro) {
            return Err(
                "no pose and no yaw: expected x=COLUMN, y=COLUMN and yaw=COLUMN, or yaw or \
                        gyro_z alone, which tell the distance of the ICRs"
                    .into(),
            );
        }
        if has_poses && has(Key::Yaw) == missing(&[Key::Qz, Key::Qw]).is_none() {
            return Err("expected yaw=COLUMN, or qz=COLUMN and qw=COLUMN of a quaternion".into());
        }
        Ok(Self { text: text.to_owned(), columns })
    }
}

/// The parts between commas, each of which begins with a key: names may have commas.
fn parts(text: &str) -> Vec<String> {
    let begins = |part: &str| {
        part.split_once('=')
            .is_some_and(|(key, _)| KEYS.iter().any(|(known, _)| *known == key.trim()))
    };
    let mut parts: Vec<String> = Vec::new();
    for part in text.split(',') {
        match parts.last_mut().filter(|_| !begins(part)) {
            Some(last) => {
                last.push(',');
                last.push_str(part);
            }
            None => parts.push(part.to_owned()),
        }
    }
    parts
}

impl Column {
    fn parse(key: Key, text: &str) -> Self {
        let (text, unit) = text
            .rsplit_once(':')
            .and_then(|(name, unit)| Some((name.trim(), key.unit(unit.trim())?)))
            .unwrap_or((text, Unit::Open));
        let (name, sign) = text.strip_prefix('-').map_or((text, 1.0), |name| (name, -1.0));
        Self { name: name.to_owned(), sign, unit }
    }

    /// SI units per number; 1 where it is more than a factor.
    fn factor(&self) -> f64 {
        match self.unit {
            Unit::Factor(factor) => self.sign * factor,
            _ => self.sign,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Columns {
        text.parse().expect("columns")
    }

    #[test]
    fn names_units_and_signs_are_parted() {
        let text = "t=Time:ms,v_l=left, front:rpm,v_r=-r:b,x=a,y=b:mm,yaw=heading:compass";
        let columns = parsed(text);
        let of = |key: Key| {
            let Column { name, sign, unit } = columns.columns[&key].clone();
            (name, sign, unit)
        };
        assert_eq!(of(Key::Time), ("Time".into(), 1.0, Unit::Factor(1e-3)));
        let rpm = Unit::Speed(SpeedUnit::TurnsPerMinute);
        assert_eq!(of(Key::Left), ("left, front".into(), 1.0, rpm));
        // a colon that no unit follows is of the name
        assert_eq!(of(Key::Right), ("r:b".into(), -1.0, Unit::Open));
        assert_eq!(of(Key::Yaw), ("heading".into(), 1.0, Unit::Compass));
        assert_eq!(columns.to_string(), text);
    }

    #[test]
    fn what_is_missing_or_twice_is_told() {
        for (text, part) in [
            ("t=a,v_l=b,v_r=c,x=d,y=e", "expected yaw=COLUMN, or qz=COLUMN"),
            ("t=a,v_l=b,x=d,y=e,yaw=f", "v_r is missing"),
            ("t=a,v_l=b,v_left=c,v_r=d,x=d,y=e,yaw=f", "v_l stands there twice"),
            ("t=a,v_l=b,v_r=c", "expected x=COLUMN, y=COLUMN and yaw=COLUMN, or yaw or gyro_z"),
            ("t=a,v_l=b,v_r=c,y=d,yaw=e", "x is missing"),
            ("t=a,v_l=b,v_r=c,qz=d", "expected yaw=COLUMN, or qz=COLUMN"),
            ("t=a,v_l=b,v_r=c,x=d,gyro_z=e", "y is missing"),
            ("t=a,v_l=b,v_r=c,lat=d,yaw=e", "lon is missing"),
            ("t=a,v_l=b,v_r=c,x=d,y=e,lat=f,lon=g,yaw=h", "or lat=COLUMN and lon=COLUMN"),
            ("time=a", "expected KEY=COLUMN"),
            ("t=", "expected KEY=COLUMN"),
        ] {
            let problem = text.parse::<Columns>().expect_err(text);
            assert!(problem.contains(part), "{text}: {problem}");
        }
    }
}
