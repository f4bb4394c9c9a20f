//! The joints of wheels or sprockets, as the messages of a bag tell them.
//!
//! Messages of one topic that list other joints, or have other signals, are kept apart: they may
//! come from another publisher.

use super::date::Received;
use super::names::{self, Part};
use super::options::RosbagOptions;
use super::payload::{Payload, PayloadError};
use crate::unit::SpeedUnit;
use std::collections::BTreeMap;
use std::convert::Infallible;
use trackdyn_core::{PerSide, Side};

/// Messages of one topic with these joints and signals.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub(super) topic: String,
    /// All joints of a message, in its order.
    pub(super) names: Vec<String>,
    /// Whether each joint has a position and a velocity.
    has: [bool; 2],
    /// Number of messages.
    pub(super) messages: u64,
    /// Times of the messages; empty where no joint counts.
    pub(super) received: Vec<Received<()>>,
    /// The joints that may count for a side.
    pub(super) columns: Vec<Column>,
}

/// A joint that may count for a side, and its signals in all messages of its source.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// Its place in a message.
    place: usize,
    pub(super) name: String,
    pub(super) side: Side,
    /// -1 where it counts backwards.
    pub(super) sign: f64,
    /// What it moves; a wheel where the options name it.
    pub(super) part: Part,
    /// Positions, rad; empty where the messages have none.
    pub(super) positions: Vec<f64>,
    /// Velocities, rad/s; empty where the messages have none.
    pub(super) velocities: Vec<f64>,
}

impl Column {
    /// Position and velocity in a message; NaN where there is none.
    pub(super) fn signals(&self, row: usize) -> [f64; 2] {
        [&self.positions, &self.velocities].map(|all| all.get(row).copied().unwrap_or(f64::NAN))
    }
}

/// Takes the joints of all messages.
#[derive(Clone, Debug)]
pub(super) struct Joints {
    named: PerSide<Vec<String>>,
    /// rad or rad/s, or m/s where they are speeds of the tracks, per unit of the numbers.
    factor: f64,
    sources: Vec<Source>,
    /// Where the last message belonged.
    last: usize,
}

impl Joints {
    pub(super) fn new(options: &RosbagOptions) -> Self {
        let named = PerSide::new(options.left_joints.clone(), options.right_joints.clone());
        let factor = options.speed_unit.map_or(1.0, SpeedUnit::factor);
        Self { named, factor, sources: Vec::new(), last: 0 }
    }

    /// Whether a joint may turn a track by its name, or by the options.
    pub(super) fn has_any(&self) -> bool {
        self.columns().any(|column| column.part != Part::Other)
    }

    /// All joints that may turn a track.
    pub(super) fn columns(&self) -> impl Iterator<Item = &Column> {
        self.sources.iter().flat_map(|source| &source.columns)
    }

    /// How many messages each topic has.
    pub(super) fn messages_by_topic(&self) -> BTreeMap<String, u64> {
        let mut messages = BTreeMap::new();
        for source in &self.sources {
            *messages.entry(source.topic.clone()).or_insert(0) += source.messages;
        }
        messages
    }

    /// What all messages told.
    pub(super) fn into_sources(self) -> Vec<Source> {
        self.sources
    }

    /// Takes a `sensor_msgs/JointState` after its header: `string[] name, float64[] position,
    /// velocity, effort`.
    pub(super) fn take(
        &mut self,
        topic: &str,
        received: Received<()>,
        cdr: &mut Payload,
    ) -> Result<(), PayloadError> {
        let count = cdr.length()?;
        let mut names = Vec::with_capacity(count.min(64));
        for _ in 0..count {
            names.push(cdr.text()?);
        }
        let signals = [cdr.f64_sequence()?, cdr.f64_sequence()?];
        let has = [0, 1].map(|signal| count > 0 && signals[signal].1 == count);
        let mut places = signals.map(|(place, _)| place);
        self.enter(topic, received, &names, has, |signal| places[signal].f64())
    }

    /// Takes joints with positions and velocities; a signal that none of them has is empty.
    pub(super) fn take_signals(
        &mut self,
        topic: &str,
        received: Received<()>,
        names: &[&str],
        signals: [&[f64]; 2],
    ) {
        let has = signals.map(|values| !values.is_empty());
        let mut rest = signals.map(<[f64]>::iter);
        let next =
            |signal: usize| Ok::<_, Infallible>(rest[signal].next().copied().unwrap_or(f64::NAN));
        let Ok(()) = self.enter(topic, received, names, has, next);
    }

    /// Takes the signals of joints that `has` says to be there: all positions, then all velocities,
    /// in the order of the names.
    fn enter<E>(
        &mut self,
        topic: &str,
        received: Received<()>,
        names: &[&str],
        has: [bool; 2],
        mut next: impl FnMut(usize) -> Result<f64, E>,
    ) -> Result<(), E> {
        let is_it =
            |source: &Source| source.has == has && source.topic == topic && source.names == names;
        if !self.sources.get(self.last).is_some_and(is_it) {
            self.last = self.sources.iter().position(is_it).unwrap_or_else(|| {
                let source = Source::new(&self.named, topic, names, has);
                self.sources.push(source);
                self.sources.len() - 1
            });
        }
        let source = &mut self.sources[self.last];
        source.messages += 1;
        if source.columns.is_empty() || has == [false; 2] {
            return Ok(());
        }
        for signal in [0, 1].into_iter().filter(|&signal| has[signal]) {
            let mut columns = source.columns.iter_mut().peekable();
            for place in 0..names.len() {
                let value = self.factor * next(signal)?;
                while let Some(column) = columns.next_if(|column| column.place == place) {
                    let all =
                        if signal == 0 { &mut column.positions } else { &mut column.velocities };
                    all.push(value);
                }
            }
        }
        source.received.push(received);
        Ok(())
    }
}

impl Source {
    fn new(named: &PerSide<Vec<String>>, topic: &str, names: &[&str], has: [bool; 2]) -> Self {
        let column = |place: usize, side: Side| {
            let name = names[place];
            let (sign, part) = if named[side].is_empty() {
                (taken_by_name(topic, name) == Some(side)).then(|| (1.0, part(topic, name)))
            } else {
                sign(&named[side], name).map(|sign| (sign, Part::Wheel))
            }?;
            let (positions, velocities) = (Vec::new(), Vec::new());
            Some(Column { place, name: name.to_owned(), side, sign, part, positions, velocities })
        };
        let places = 0..names.len();
        let columns = places.flat_map(|place| Side::BOTH.map(|side| column(place, side)));
        Self {
            topic: topic.to_owned(),
            names: names.iter().map(|&name| name.to_owned()).collect(),
            has,
            messages: 0,
            received: Vec::new(),
            columns: columns.flatten().collect(),
        }
    }
}

/// The side of a joint by its name, else by that of its topic.
fn taken_by_name(topic: &str, name: &str) -> Option<Side> {
    names::side(name).or_else(|| names::side(topic))
}

/// What a joint moves by its name, else by that of its topic.
fn part(topic: &str, name: &str) -> Part {
    match names::part(name) {
        Part::Unknown if names::side(name).is_none() => names::part(topic),
        part => part,
    }
}

/// +1 or -1 for a joint that is named, which a `-` before the name reverses.
fn sign(named: &[String], joint: &str) -> Option<f64> {
    named.iter().find_map(|name| match name.strip_prefix('-') {
        Some(reversed) if reversed == joint => Some(-1.0),
        _ => (name == joint).then_some(1.0),
    })
}

/// The joints of a list that are taken for those of a side by their names.
pub(super) fn of_side(joints: &[String], side: Side) -> Vec<String> {
    let on_side = joints.iter().filter(|joint| names::side(joint) == Some(side));
    let best = on_side.clone().map(|joint| names::part(joint)).max();
    let taken = on_side.filter(|joint| Some(names::part(joint)) == best);
    taken.filter(|_| best != Some(Part::Other)).cloned().collect()
}

/// The names of the joints in a message and the signals it has (position, velocity).
pub(super) fn names<'a>(cdr: &mut Payload<'a>) -> Result<(Vec<&'a str>, bool, bool), PayloadError> {
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
    fn messages_with_other_joints_or_signals_are_kept_apart() {
        let mut joints = Joints::new(&RosbagOptions::default());
        let mut take = |names: &[&str], positions: &[f64], velocities: &[f64], log_ns: i64| {
            let bytes = message(names, [positions, velocities]);
            let received = Received { stamp_ns: None, log_ns, value: () };
            joints.take("/joints", received, &mut Payload::new(&bytes).expect("CDR"))
        };
        take(&["lidar", "wheel_left", "wheel_right"], &[1.0, 2.0, 3.0], &[], 0).expect("a message");
        take(&["wheel_left"], &[5.0], &[6.0], 1).expect("a message");
        take(&["lidar", "wheel_left", "wheel_right"], &[4.0, 8.0, 9.0], &[], 2).expect("a message");
        take(&["lidar"], &[4.0], &[], 3).expect("a message");
        let sources = joints.into_sources();
        assert_eq!(sources.len(), 3);
        let names: Vec<&str> = sources[0].columns.iter().map(|one| one.name.as_str()).collect();
        assert_eq!(names, ["wheel_left", "wheel_right"]);
        assert_eq!(sources[0].columns[0].positions, [2.0, 8.0]);
        assert_eq!(sources[0].columns[1].positions, [3.0, 9.0]);
        assert!(sources[0].columns[1].signals(1)[1].is_nan());
        assert_eq!(sources[1].columns[0].signals(0), [5.0, 6.0]);
        assert_eq!((sources[2].messages, sources[2].received.len()), (1, 0));
    }

    #[test]
    fn topics_name_the_side_where_joints_do_not() {
        let options = RosbagOptions { right_joints: vec!["-w".into()], ..Default::default() };
        for (topic, side, sign) in
            [("/left_wheel/state", Side::Left, 1.0), ("/x", Side::Right, -1.0)]
        {
            let mut joints = Joints::new(&options);
            let bytes = message(&["w"], [&[1.0], &[]]);
            let received = Received { stamp_ns: None, log_ns: 0, value: () };
            joints
                .take(topic, received, &mut Payload::new(&bytes).expect("CDR"))
                .expect("a message");
            let sources = joints.into_sources();
            assert!(sources[0].columns.iter().any(|one| (one.side, one.sign) == (side, sign)));
        }
    }
}
