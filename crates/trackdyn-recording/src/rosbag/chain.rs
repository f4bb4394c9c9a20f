//! Poses along a chain of transforms, such as map → odom → base_link.
//!
//! The poses stand at the stamps of the link that changes most often. The other links are
//! interpolated between their neighbouring stamps, as tf2 does it (translation along a line,
//! rotation about one axis), and never beyond them: poses there are left out. Links of a topic that
//! ends in `_static` hold at all times. Where the outermost link is corrected less often than the
//! others move, only the poses at its [`corrections`] are measured: the others are left out.

use super::clock::{By, Clock, decide};
use super::date::{Received, Stamped, dated};
use super::frames::{Frames, Hop, is_of_odometry};
use super::message::{header, planar, rigid};
use super::options::RosbagOptions;
use super::payload::PayloadError;
use super::storage;
use super::topic::{Layout, Topic};
use super::visitor::Visitor;
use crate::Error;
use crate::attitude::Attitude;
use crate::recording::{DeadReckoning, Warning};
use nalgebra::Isometry3;
use std::fmt::Write;
use std::path::Path;
use trackdyn_core::robust::usual_interval;

mod corrections;

use corrections::{MIN_CORRECTIONS, changes, corrections};

/// Where corrections come at every stamp, at most one of so many poses lies between them: some
/// messages are lost.
const POSES_PER_LOST_CORRECTION: usize = 10;

/// Poses along a chain, and what was done for them.
pub(super) struct Chain {
    /// x, y, yaw.
    pub(super) poses: Vec<Stamped<[f64; 3]>>,
    /// How upright they are.
    pub(super) attitude: Attitude,
    /// What dates them, and all other messages.
    pub(super) by: By,
    pub(super) warnings: Vec<Warning>,
}

/// Reads the transforms on the way from `parent` to `child` and composes them. Their clocks are
/// compared with those of the tracks.
///
/// # Errors
/// Frames that no transforms link, or whose transforms share no time.
pub(super) fn read(
    path: &Path,
    options: &RosbagOptions,
    frames: &Frames,
    [parent, child]: [&str; 2],
    tracks: &[Clock],
) -> Result<Chain, Error> {
    let refuse = |problem: String| Error::Topic {
        path: path.to_owned(),
        what: "poses",
        problem,
        available: format!("transforms {frames}"),
    };
    let hops = frames
        .way(parent, child)
        .filter(|hops| !hops.is_empty())
        .ok_or_else(|| refuse(format!("no transforms lead from {parent:?} to {child:?}")))?;
    let links = hops.into_iter().map(Link::new).collect();
    let mut collector = Collector { options, links };
    // The damage of the files was told when their frames were read.
    storage::scan(path, &mut collector)?;
    let (by, mut warnings) = dating(&collector.links, tracks, options);
    let corrected = Corrected::of(&collector.links, by);
    let series = collector.links.into_iter().map(|link| Series::of(link, by, &mut warnings));
    let series: Vec<Series> = series.collect();
    let moving = || series.iter().filter(|link| !link.is_static);
    let Some(leading) = moving().max_by_key(|link| link.changes()) else {
        return Err(refuse(format!("nothing moves between {parent:?} and {child:?}")));
    };
    let stamps = leading.moments.iter().map(|(stamp, _)| *stamp);
    let unit = options.pose_unit.factor();
    let all = Composed::of(&series, unit, stamps.map(|stamp| (stamp, None)));
    if all.poses.is_empty() {
        return Err(refuse(format!("the transforms from {parent:?} to {child:?} share no time")));
    }
    let links: Vec<String> = series.iter().map(Series::to_string).collect();
    let way = format!("{child} in {parent} by {}", links.join(", "));
    if let Some((measured, told)) =
        corrected.and_then(|one| one.measured(&way, &series, unit, &all))
    {
        warnings.extend(told);
        let Composed { poses, attitude, .. } = measured;
        return Ok(Chain { poses, attitude, by, warnings });
    }
    let Composed { poses, attitude, left_out } = all;
    let mut taken = way;
    let _ = write!(taken, "; at the stamps of {}, the others interpolated", leading.name());
    if left_out > 0 {
        let _ = write!(taken, "; {left_out} stamps that a link does not reach are left out");
    }
    warnings.push(Warning::Chosen { what: "poses", taken });
    let odometry = moving().find(|link| is_of_odometry(&link.hop.link.parent));
    warnings.extend(odometry.map(|link| Warning::OwnOdometry { poses: link.name() }));
    Ok(Chain { poses, attitude, by, warnings })
}

/// Poses along a chain at some stamps.
#[derive(Default)]
struct Composed {
    poses: Vec<Stamped<[f64; 3]>>,
    attitude: Attitude,
    /// Stamps that a link does not reach.
    left_out: usize,
}

impl Composed {
    /// At these stamps; where one has it, with this transform of the link at this place. A
    /// transform has so many metres per number.
    fn of<'a>(
        series: &[Series],
        unit: f64,
        stamps: impl Iterator<Item = (i64, Option<(usize, &'a Isometry3<f64>)>)>,
    ) -> Self {
        let mut all = Self::default();
        for (stamp, known) in stamps {
            let mut links = series.iter().enumerate();
            let composed = links.try_fold(Isometry3::identity(), |before, (place, link)| {
                let known = known.filter(|(of, _)| *of == place).map(|(_, transform)| *transform);
                let transform = known.or_else(|| link.at(stamp))?;
                Some(before * if link.hop.inverse { transform.inverse() } else { transform })
            });
            let Some(transform) = composed else {
                all.left_out += 1;
                continue;
            };
            all.attitude.note(transform.rotation.coords.into());
            let [x, y, yaw] = planar(&transform);
            all.poses.push((stamp, [unit * x, unit * y, yaw]));
        }
        all
    }
}

/// A link of a map that is corrected, above links of odometry.
struct Corrected {
    /// Its place, its name, and its child frame.
    place: usize,
    name: String,
    frame: String,
    /// Name of the link of odometry that changes most.
    odometry: String,
    /// The values of the corrected link, when they were measured.
    values: Vec<Stamped<Isometry3<f64>>>,
}

impl Corrected {
    /// The outermost link that is corrected; none where nothing moves between it and the body, or
    /// where the way leads up to a frame and down again: no map is above both ends then.
    fn of(links: &[Link], by: By) -> Option<Self> {
        let is_up = links.first()?.hop.inverse;
        if links.iter().any(|link| link.hop.inverse != is_up) {
            return None;
        }
        let moves = |place: &usize| !links[*place].is_static && links[*place].changes() > 0;
        let mut moving: Vec<usize> = (0..links.len()).filter(moves).collect();
        if is_up {
            moving.reverse();
        }
        let count = |place: &usize| changes(&links[*place].received).count();
        let first = moving.iter().position(|place| count(place) >= MIN_CORRECTIONS)?;
        let place = moving[first];
        let below = moving[first + 1..].iter().map(|place| &links[*place]);
        let odometry = below.max_by_key(|link| link.changes())?;
        Some(Self {
            place,
            name: links[place].hop.link.name(),
            frame: links[place].hop.link.child.clone(),
            odometry: odometry.hop.link.name(),
            values: corrections(&links[place].received, &odometry.received, by),
        })
    }

    /// The poses at the corrections, and what is said of the others; none where almost all poses
    /// stand there, or too few do.
    fn measured(
        self,
        way: &str,
        series: &[Series],
        unit: f64,
        all: &Composed,
    ) -> Option<(Composed, [Warning; 2])> {
        let stamps = self.values.iter().map(|(stamp, value)| (*stamp, Some((self.place, value))));
        let measured = Composed::of(series, unit, stamps);
        let [corrections, of] = [measured.poses.len(), all.poses.len()];
        let left_out = of.saturating_sub(corrections);
        if corrections < MIN_CORRECTIONS || POSES_PER_LOST_CORRECTION * left_out <= of {
            return None;
        }
        let interval = usual_interval(measured.poses.iter().map(|(stamp, _)| seconds(*stamp)));
        let Self { name, frame, odometry, .. } = self;
        let taken = format!("{way}; where {name} is corrected");
        let chosen = Warning::Chosen { what: "poses", taken };
        let told = Warning::DeadReckoning(DeadReckoning {
            corrected: name,
            frame,
            corrections,
            interval,
            odometry,
            left_out,
        });
        Some((measured, [chosen, told]))
    }
}

/// What dates all messages, by the clocks of the tracks and of the links. The link that changes
/// most counts as a topic of poses does; corrections, such as map → odom, are often stamped ahead,
/// and count only where no delay explains their stamps.
fn dating(links: &[Link], tracks: &[Clock], options: &RosbagOptions) -> (By, Vec<Warning>) {
    let moving = || links.iter().filter(|link| !link.is_static);
    let Some(leading) = moving().max_by_key(|link| link.changes()) else {
        return (By::Header, Vec::new());
    };
    let mut clocks = tracks.to_vec();
    clocks.push(leading.clock());
    let others = moving().filter(|link| link.hop != leading.hop).map(Link::clock);
    let first = clocks[0].clone();
    clocks.extend(others.filter(|clock| clock.is_apart_from(&first)));
    decide(&clocks, options.dated_by)
}

/// The transforms of a link as they were received.
struct Link {
    hop: Hop,
    is_static: bool,
    /// Topic of the last of them.
    topic: String,
    received: Vec<Received<Isometry3<f64>>>,
}

impl Link {
    fn new(hop: Hop) -> Self {
        Self { hop, is_static: false, topic: String::new(), received: Vec::new() }
    }

    /// How often it is reported to have changed, in the order of the bag.
    fn changes(&self) -> usize {
        self.received.windows(2).filter(|pair| pair[0].value != pair[1].value).count()
    }

    fn clock(&self) -> Clock {
        let name = format!("{} ({})", self.topic, self.hop.link.name());
        Clock::of(&name, &self.received)
    }
}

/// The transforms of a link in the order of time.
struct Series {
    hop: Hop,
    is_static: bool,
    moments: Vec<Stamped<Isometry3<f64>>>,
}

impl Series {
    /// In the order of time, the first of each stamp.
    fn of(link: Link, by: By, warnings: &mut Vec<Warning>) -> Self {
        let Link { hop, is_static, topic, received } = link;
        let (mut moments, warning) = match by {
            By::Header => dated(&topic, received),
            By::Log => (received.into_iter().map(|one| (one.log_ns, one.value)).collect(), None),
        };
        // What holds at all times needs no stamp.
        warnings.extend(warning.filter(|_| !is_static));
        moments.sort_by_key(|(stamp, _)| *stamp);
        moments.dedup_by_key(|(stamp, _)| *stamp);
        Self { hop, is_static, moments }
    }

    fn name(&self) -> String {
        self.hop.link.name()
    }

    /// How often it is reported to have changed: some links are sent again and again as they are.
    fn changes(&self) -> usize {
        self.moments.windows(2).filter(|pair| pair[0].1 != pair[1].1).count()
    }

    /// The transform at a stamp; none where it is not known.
    fn at(&self, stamp: i64) -> Option<Isometry3<f64>> {
        if self.is_static {
            return self.moments.last().map(|(_, transform)| *transform);
        }
        let after = self.moments.partition_point(|(known, _)| *known < stamp);
        let (end, last) = *self.moments.get(after)?;
        if end == stamp {
            return Some(last);
        }
        let (start, first) = *self.moments.get(after.checked_sub(1)?)?;
        // Half a turn between two transforms has no one axis.
        first.try_lerp_slerp(&last, portion(start, stamp, end), 1e-9)
    }

    /// Longest time between two stamps, s.
    fn longest_interval(&self) -> f64 {
        let intervals =
            self.moments.windows(2).map(|pair| seconds(pair[1].0.saturating_sub(pair[0].0)));
        intervals.fold(0.0, f64::max)
    }
}

impl std::fmt::Display for Series {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.name())?;
        if self.hop.inverse {
            write!(f, " (inverse)")?;
        }
        if self.is_static {
            return write!(f, " (static)");
        }
        let (count, longest) = (self.moments.len(), self.longest_interval());
        write!(f, " ({count} stamps, at most {longest:.3} s apart)")
    }
}

#[expect(clippy::cast_precision_loss, reason = "intervals last less than 2⁵³ ns, 104 days")]
fn seconds(ns: i64) -> f64 {
    ns as f64 / 1e9
}

/// Where a stamp lies between two others, from 0 to 1.
fn portion(start: i64, stamp: i64, end: i64) -> f64 {
    seconds(stamp.saturating_sub(start)) / seconds(end.saturating_sub(start))
}

/// Takes the transforms of the chain's links.
struct Collector<'a> {
    options: &'a RosbagOptions,
    links: Vec<Link>,
}

impl Collector<'_> {
    fn take(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) -> Result<(), PayloadError> {
        let mut payload = topic.payload(payload)?;
        for _ in 0..payload.length()? {
            let header = header(&mut payload)?;
            let child = payload.text()?;
            let transform = rigid(&mut payload)?;
            let link = self.links.iter_mut().find(|link| link.hop.link.is(header.frame, child));
            if let (Some(link), Some(value)) = (link, transform) {
                link.is_static |= topic.is_static();
                link.topic.clone_from(&topic.name);
                link.received.push(Received { stamp_ns: header.stamp_ns, log_ns, value });
            }
        }
        Ok(())
    }
}

impl Visitor for Collector<'_> {
    fn wants(&mut self, topic: &Topic) -> bool {
        topic.layout() == Some(Layout::Transforms) && self.options.may_hold_poses(&topic.name)
    }

    fn message(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]) {
        // What cannot be decoded was told when the frames were read.
        let _ = self.take(topic, log_ns, payload);
    }
}
