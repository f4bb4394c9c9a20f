//! Track speeds from the joints of wheels or sprockets.

use super::options::{JointSignal, RosbagOptions};
use super::payload::{Payload as Cdr, PayloadError as CdrError};
use crate::recording::Warning;
use trackdyn_core::{PerSide, Side};

/// Mean of a side's joints in one message.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reading {
    /// Speed in rad/s or position in rad.
    pub(super) sides: PerSide<f64>,
    /// The single positions behind the means; empty where these are speeds.
    pub(super) angles: Vec<JointAngle>,
    /// Whether it is a position.
    pub(super) is_position: bool,
}

/// Position of one joint in one message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JointAngle {
    /// Its place in [`Joints::met`].
    pub(super) joint: usize,
    /// The side it counts for.
    pub(super) side: Side,
    /// What a radian of it adds to the mean of its side: a sign over a count.
    pub(super) share: f64,
    /// As reported, rad.
    pub(super) angle: f64,
}

/// Why a message gives no reading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum JointProblem {
    /// It cannot be decoded.
    Cdr(CdrError),
    /// Joints of a side are not in it.
    Absent {
        /// The side.
        side: Side,
        /// Its joints; none where any with its name would have done.
        wanted: Vec<String>,
        /// The joints of the message.
        found: Vec<String>,
    },
    /// It has neither velocities nor positions of the kind wanted.
    NoSignal,
}

impl std::fmt::Display for JointProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Cdr(error) => error.fmt(f),
            Self::Absent { side, wanted, found } => {
                let (side, found) = (word(*side), found.join(", "));
                let wanted = match &wanted[..] {
                    [] => format!("no joint has \"{side}\" in its name"),
                    wanted => {
                        format!("not all of the {side} joints ({}) are in it", wanted.join(", "))
                    }
                };
                write!(f, "{wanted}, but {found}")
            }
            Self::NoSignal => write!(f, "the joints have no such signal"),
        }
    }
}

impl From<CdrError> for JointProblem {
    fn from(error: CdrError) -> Self {
        Self::Cdr(error)
    }
}

/// Which joints belong to which side.
#[derive(Clone, Debug)]
pub(super) struct Joints {
    names: PerSide<Vec<String>>,
    signal: JointSignal,
    /// Joints whose positions were read, in the order in which they turned up.
    met: Vec<String>,
    /// Joints that were taken for those of a side by their names, where none were named.
    taken: PerSide<Vec<String>>,
}

impl Joints {
    pub(super) fn new(options: &RosbagOptions) -> Self {
        let names = PerSide::new(options.left_joints.clone(), options.right_joints.clone());
        let taken = PerSide::new(Vec::new(), Vec::new());
        Self { names, signal: options.joint_signal, met: Vec::new(), taken }
    }

    /// +1 or −1 for a joint of this side, `None` for any other.
    fn sign(&self, side: Side, joint: &str) -> Option<f64> {
        let names = &self.names[side];
        if names.is_empty() {
            return joint.to_lowercase().contains(word(side)).then_some(1.0);
        }
        names.iter().find_map(|name| match name.strip_prefix('-') {
            Some(reversed) if reversed == joint => Some(-1.0),
            _ => (name == joint).then_some(1.0),
        })
    }

    /// Names of the joints whose positions were read, by [`JointAngle::joint`].
    pub(super) fn met(&self) -> &[String] {
        &self.met
    }

    fn place(&mut self, joint: &str) -> usize {
        self.met.iter().position(|name| name == joint).unwrap_or_else(|| {
            self.met.push(joint.to_owned());
            self.met.len() - 1
        })
    }

    /// How many joints a side must have in a message; at least one where none is named.
    fn needed(&self, side: Side) -> usize {
        self.names[side].len().max(1)
    }

    /// Whether the joints of both sides have numbers.
    fn are_finite(&self, mut names: Cdr, mut values: Cdr, count: usize) -> Result<bool, CdrError> {
        for _ in 0..count {
            let (name, value) = (names.text()?, values.f64()?);
            let is_taken = Side::BOTH.into_iter().any(|side| self.sign(side, name).is_some());
            if is_taken && !value.is_finite() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// What was taken for the joints of a side by its name alone.
    pub(super) fn guessed(&self) -> Vec<Warning> {
        let sides = [(Side::Left, "left joints"), (Side::Right, "right joints")];
        let guessed = sides.into_iter().filter(|(side, _)| !self.taken[*side].is_empty());
        let warning = |(side, what)| Warning::Chosen { what, taken: self.taken[side].join(", ") };
        guessed.map(warning).collect()
    }

    /// The reading of a `sensor_msgs/JointState` after its header: `string[] name, float64[]
    /// position, velocity, effort`.
    pub(super) fn reading(&mut self, cdr: &mut Cdr) -> Result<Reading, JointProblem> {
        let count = cdr.length()?;
        let names_at = cdr.clone();
        for _ in 0..count {
            cdr.text()?;
        }
        let (positions, position_count) = cdr.f64_sequence()?;
        let (velocities, velocity_count) = cdr.f64_sequence()?;
        // a driver that has no velocities may send numbers that are none
        let has_velocity = count > 0
            && velocity_count == count
            && self.are_finite(names_at.clone(), velocities.clone(), count)?;
        let has_position = count > 0 && position_count == count;
        let is_position = match self.signal {
            JointSignal::Any => !has_velocity && has_position,
            JointSignal::Velocity => false,
            JointSignal::Position => true,
        };
        if !(if is_position { has_position } else { has_velocity }) {
            return Err(JointProblem::NoSignal);
        }
        let mut all = names_at.clone();
        let (mut names, mut values) = (names_at, if is_position { positions } else { velocities });
        let mut angles = Vec::new();
        let mut sums = PerSide::new(0.0, 0.0);
        let mut found = PerSide::new(0_u32, 0_u32);
        for _ in 0..count {
            let (name, value) = (names.text()?, values.f64()?);
            for side in Side::BOTH {
                if let Some(sign) = self.sign(side, name) {
                    sums[side] += sign * value;
                    found[side] += 1;
                    if self.names[side].is_empty()
                        && !self.taken[side].iter().any(|one| one == name)
                    {
                        self.taken[side].push(name.to_owned());
                    }
                    if is_position {
                        let joint = self.place(name);
                        angles.push(JointAngle { joint, side, share: sign, angle: value });
                    }
                }
            }
        }
        for side in Side::BOTH {
            if (found[side] as usize) < self.needed(side) {
                let found = (0..count).map(|_| Ok(all.text()?.to_owned()));
                let found = found.collect::<Result<_, CdrError>>()?;
                let wanted = self.names[side].clone();
                return Err(JointProblem::Absent { side, wanted, found });
            }
        }
        let sides = PerSide::from_fn(|side| sums[side] / f64::from(found[side]));
        for angle in &mut angles {
            angle.share /= f64::from(found[angle.side]);
        }
        Ok(Reading { sides, angles, is_position })
    }
}

/// The name of a side.
fn word(side: Side) -> &'static str {
    match side {
        Side::Left => "left",
        Side::Right => "right",
    }
}

/// The names of the joints in a message and the signals it has (position, velocity).
pub(super) fn names<'a>(cdr: &mut Cdr<'a>) -> Result<(Vec<&'a str>, bool, bool), CdrError> {
    let count = cdr.length()?;
    let mut names = Vec::new();
    for _ in 0..count {
        names.push(cdr.text()?);
    }
    let (_, positions) = cdr.f64_sequence()?;
    let (_, velocities) = cdr.f64_sequence()?;
    Ok((names, positions == count && count > 0, velocities == count && count > 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message after its header: names, positions, velocities, no effort, as CDR of little-endian
    /// numbers.
    fn message(names: &[&str], numbers: [&[f64]; 2]) -> Vec<u8> {
        let mut bytes = vec![0, 1, 0, 0];
        let pad = |bytes: &mut Vec<u8>, to: usize| {
            while !(bytes.len() - 4).is_multiple_of(to) {
                bytes.push(0);
            }
        };
        let count = |bytes: &mut Vec<u8>, count: usize| {
            pad(bytes, 4);
            bytes.extend(u32::try_from(count).expect("small").to_le_bytes());
        };
        count(&mut bytes, names.len());
        for name in names {
            count(&mut bytes, name.len() + 1);
            bytes.extend(name.bytes().chain([0]));
        }
        for numbers in numbers {
            count(&mut bytes, numbers.len());
            pad(&mut bytes, 8);
            bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        }
        count(&mut bytes, 0);
        bytes
    }

    #[test]
    fn velocities_that_are_no_numbers_give_way_to_positions() {
        let names = ["wheel_left", "wheel_right", "lidar"];
        let mut joints = Joints::new(&RosbagOptions::default());
        let mut read = |velocities: &[f64]| {
            let bytes = message(&names, [&[1.0, 2.0, 3.0], velocities]);
            joints.reading(&mut Cdr::new(&bytes).expect("CDR")).expect("a reading")
        };
        let reading = read(&[f64::NAN, f64::NAN, 0.1]);
        assert!(reading.is_position);
        assert_eq!(reading.sides, PerSide::new(1.0, 2.0));
        // those of other joints do not count
        let reading = read(&[0.4, 0.5, f64::NAN]);
        assert!(!reading.is_position);
        assert_eq!(reading.sides, PerSide::new(0.4, 0.5));
    }
}
