//! Track speeds from numbers in messages that are named by the paths of their fields.
//!
//! They are read as the velocities of joints, one for each path, or as their positions: counts of
//! encoders, which become speeds as positions of joints do.

use super::definition::{Definition, Field, Route, Texts};
use super::offer;
use super::options::RosbagOptions;
use super::payload::Encoding;
use super::topic::Topic;
use crate::Error;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;
use trackdyn_core::{PerSide, Side};

/// The numbers that are wanted, and what is known of their messages.
#[derive(Default)]
pub(super) struct Signals {
    wanted: Vec<Wanted>,
    texts: Texts,
    /// How messages are read, by topic.
    decoders: BTreeMap<String, Decoder>,
    /// Why a number cannot be read.
    problem: Option<String>,
}

/// A number that is wanted.
struct Wanted {
    /// As it was given, without a `-`.
    name: String,
    option: &'static str,
    topic: String,
    field: Field,
}

/// How the messages of a topic are read.
struct Decoder {
    definition: Definition,
    names: Vec<String>,
    routes: Vec<Route>,
    /// Number of messages, and of those that could not be read; why the first could not.
    counts: [u64; 2],
    reason: String,
}

/// What a message says.
pub(super) struct Read<'a> {
    pub(super) stamp_ns: Option<i64>,
    pub(super) names: Vec<&'a str>,
    /// In the unit of the options.
    pub(super) numbers: Vec<f64>,
}

/// The option that names a number of a side.
fn option(side: Side) -> &'static str {
    match side {
        Side::Left => "--left-signal",
        Side::Right => "--right-signal",
    }
}

/// The numbers of each side as they were given.
fn given(options: &RosbagOptions) -> PerSide<&Vec<String>> {
    PerSide::new(&options.left_signals, &options.right_signals)
}

/// The options by which the numbers are read as joints; others as they are.
///
/// # Errors
/// [`Error::Options`] where options do not go together.
pub(super) fn effective<'a>(
    path: &Path,
    options: Cow<'a, RosbagOptions>,
) -> Result<Cow<'a, RosbagOptions>, Error> {
    let refuse = |problem: String| Err(Error::Options { path: path.to_owned(), problem });
    let given = given(&options);
    let [left, right] = Side::BOTH.map(|side| given[side].clone());
    if left.is_empty() && right.is_empty() {
        if options.msg_dir.is_some() {
            return refuse("--msg-dir: expected with --left-signal and --right-signal".to_owned());
        }
        return of_unit(path, options);
    }
    if let Some(side) = Side::BOTH.into_iter().find(|side| given[*side].is_empty()) {
        return refuse(format!(
            "{} TOPIC:FIELD is missing: expected a number of each side",
            option(side)
        ));
    }
    let other = options.twist_topic.as_ref().map(|_| "--twist-topic");
    // Numbers have both kinds of signals, as joints do.
    let of_joints = options.of_joints().filter(|option| *option != "--joint-signal");
    if let Some(other) = other.or(of_joints) {
        return refuse(format!(
            "{other} chooses other track speeds than --left-signal and --right-signal: expected \
             one of them"
        ));
    }
    let options = of_unit(path, options)?;
    Ok(Cow::Owned(RosbagOptions { left_joints: left, right_joints: right, ..options.into_owned() }))
}

/// The options with a radius of 1 m for speeds of the tracks themselves.
fn of_unit<'a>(
    path: &Path,
    options: Cow<'a, RosbagOptions>,
) -> Result<Cow<'a, RosbagOptions>, Error> {
    let Some(unit) = options.speed_unit else { return Ok(options) };
    let refuse = |problem: String| Err(Error::Options { path: path.to_owned(), problem });
    if options.twist_topic.is_some() {
        return refuse(
            "--speed-unit: a twist is in m/s and rad/s: expected without --twist-topic".to_owned(),
        );
    }
    match options.wheel_radius {
        _ if unit.is_of_wheels() => Ok(options),
        Some(_) => refuse(format!(
            "--wheel-radius: speeds in {unit} (--speed-unit) are those of the tracks already: \
             expected no radius, or rad/s, rpm, turns/s or deg/s"
        )),
        None => {
            let wheel_radius = Some(1.0);
            Ok(Cow::Owned(RosbagOptions { wheel_radius, ..options.into_owned() }))
        }
    }
}

impl Signals {
    /// What options name.
    ///
    /// # Errors
    /// [`Error::Options`] for a path that is none; those of the folder of definitions.
    pub(super) fn new(path: &Path, options: &RosbagOptions) -> Result<Self, Error> {
        let mut wanted = Vec::new();
        let given = given(options);
        for side in Side::BOTH {
            for text in given[side] {
                let bare = text.strip_prefix('-').unwrap_or(text);
                let parts = bare.split_once(':');
                let field = parts.and_then(|(topic, field)| Some((topic, Field::parse(field)?)));
                let Some((topic, field)) = field.filter(|(topic, _)| !topic.is_empty()) else {
                    let option = option(side);
                    let problem = format!(
                        "{option} {text}: expected TOPIC:FIELD, such as /status:motors[0].rpm"
                    );
                    return Err(Error::Options { path: path.to_owned(), problem });
                };
                let (name, topic) = (bare.to_owned(), topic.to_owned());
                wanted.push(Wanted { name, option: option(side), topic, field });
            }
        }
        let texts = match &options.msg_dir {
            Some(folder) => Texts::of_folder(folder)?,
            None => Texts::default(),
        };
        Ok(Self { wanted, texts, ..Self::default() })
    }

    /// Whether numbers are named.
    pub(super) fn are_wanted(&self) -> bool {
        !self.wanted.is_empty()
    }

    /// Takes the definition of a type.
    pub(super) fn define(&mut self, kind: &str, text: &str) {
        self.texts.add(kind, text);
    }

    /// What is said of the numbers of a log without joints.
    pub(super) fn offer(&self, seen: &[Topic]) -> Option<String> {
        offer::offer(&self.texts, seen)
    }

    /// Whether a number of these messages is wanted.
    pub(super) fn are_of(&self, topic: &Topic) -> bool {
        self.wanted.iter().any(|wanted| wanted.topic == topic.name)
    }

    /// Finds the numbers in the messages of a topic.
    pub(super) fn prepare(&mut self, topic: &Topic) {
        if !self.are_of(topic) || self.decoders.contains_key(&topic.name) {
            return;
        }
        match self.decoder(topic) {
            Ok(decoder) => {
                self.decoders.insert(topic.name.clone(), decoder);
            }
            Err(problem) => {
                self.problem.get_or_insert(problem);
            }
        }
    }

    fn decoder(&self, topic: &Topic) -> Result<Decoder, String> {
        let of_topic = || self.wanted.iter().filter(|wanted| wanted.topic == topic.name);
        let refuse = |wanted: &Wanted, problem: String| {
            format!("{} {}: {problem}", wanted.option, wanted.name)
        };
        let first = of_topic().next().ok_or_else(String::new)?;
        if Encoding::of(&topic.encoding).is_none() {
            let problem = format!("messages of encoding {:?} are not read", topic.encoding);
            return Err(refuse(first, problem));
        }
        let definition =
            self.texts.definition(&topic.kind).map_err(|problem| refuse(first, problem))?;
        let mut names: Vec<String> = Vec::new();
        let mut routes = Vec::new();
        for wanted in of_topic() {
            if !names.contains(&wanted.name) {
                let route = definition.route(&wanted.field);
                routes.push(route.map_err(|problem| refuse(wanted, problem))?);
                names.push(wanted.name.clone());
            }
        }
        Ok(Decoder { definition, names, routes, counts: [0; 2], reason: String::new() })
    }

    /// The numbers in a message; none where it has none of them.
    ///
    /// # Errors
    /// A message that ends too early, or has fewer elements.
    pub(super) fn read(
        &mut self,
        topic: &Topic,
        payload: &[u8],
    ) -> Result<Option<Read<'_>>, String> {
        let Some(decoder) = self.decoders.get_mut(&topic.name) else { return Ok(None) };
        decoder.counts[0] += 1;
        match decoder.read(topic, payload) {
            Ok((stamp_ns, numbers)) => {
                let names = decoder.names.iter().map(String::as_str).collect();
                Ok(Some(Read { stamp_ns, names, numbers }))
            }
            Err(reason) => {
                decoder.counts[1] += 1;
                decoder.reason.clone_from(&reason);
                Err(reason)
            }
        }
    }

    /// Why a number cannot be had from a bag with these topics.
    pub(super) fn problem(&self, seen: &[Topic]) -> Option<String> {
        let absent = |wanted: &&Wanted| !seen.iter().any(|topic| topic.name == wanted.topic);
        let absent = self.wanted.iter().find(absent);
        let absent =
            absent.map(|wanted| format!("{} {}: no such topic", wanted.option, wanted.name));
        let unread = self.wanted.iter().find_map(|wanted| {
            let decoder = self.decoders.get(&wanted.topic)?;
            let [all, failed] = decoder.counts;
            let reason = if all == 0 { "there are none" } else { &decoder.reason };
            (all == failed).then(|| {
                let (option, name) = (wanted.option, &wanted.name);
                format!("{option} {name}: none of {all} messages can be read, because {reason}")
            })
        });
        self.problem.clone().or(absent).or(unread)
    }
}

impl Decoder {
    fn read(&self, topic: &Topic, payload: &[u8]) -> Result<(Option<i64>, Vec<f64>), String> {
        let payload = topic.payload(payload).map_err(|error| error.to_string())?;
        let number = |route: &Route| self.definition.number(route, &payload);
        let numbers = self.routes.iter().map(number).collect::<Result<Vec<f64>, String>>()?;
        Ok((self.definition.stamp(&payload)?, numbers))
    }
}
