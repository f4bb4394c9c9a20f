//! Clocks of topics: stamps against the times of logging.
//!
//! # Law
//! A message is logged shortly after its stamp. Two topics have one clock where their medians of
//! stamp − logging differ by no more than a sensor may be late. It is enough that those of the
//! messages that are logged soonest do: a driver that logs in bursts holds the others back. Where
//! both differ by more while both topics were logged over one time, their stamps cannot be
//! compared, and logging dates both.
//!
//! Messages without stamps are dated by their logging; where the clock of the tracks runs at
//! another [rate], they are dated by the time that it shows then.
//!
//! Stamps are too coarse where most readings have the stamp of the one before but other values.
//! Logging then dates the readings, if it separates them.
//!
//! A stamp that steps back and stays back while logging goes on is a clock that was set anew, as by
//! the reset of a simulation: what follows is another run.

use super::date::{Received, seconds};
use super::options::Dating;
use crate::recording::Warning;
use crate::stray_stamps::{self, Parts};
use trackdyn_core::robust::{median, quantile};

mod coarse;
mod rate;

use coarse::{Reading, are_coarse};
use rate::Rate;

/// Latest that a stamped message may be logged after those of other topics, s: a slow SLAM.
const MAX_LATENESS: f64 = 2.0;

/// Length of the parts of the logging, s. Within each, a driver that logs in bursts logs some
/// message at once.
const PART_DURATION: f64 = 15.0;

/// Smallest difference of two clocks that is told, s.
const MIN_REPORTED_OFFSET: f64 = 0.2;

/// Latest stamp after its own logging, s: rounding and clocks kept equal by a network.
const MAX_STAMP_LEAD: f64 = 0.1;

/// Smallest step back of a clock that was set anew, ns.
const MIN_RESET_NS: i64 = 1_000_000_000;

/// Messages that have to stay back after a reset.
const RESET_WITNESSES: usize = 3;

/// Largest ratio of the time between first and last stamp to that between their logging, or the
/// reverse: bags may have been logged anew, at another speed.
const MAX_SPEED_RATIO: f64 = 1.25;

/// By what the messages of all topics are dated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum By {
    /// Their stamps.
    Header,
    /// Their logging.
    Log,
}

/// The clock of a topic.
#[derive(Clone, Debug)]
pub(super) struct Clock {
    pub(super) topic: String,
    count: usize,
    undated: usize,
    /// Stamps outside of which are wrong, ns.
    right: [i64; 2],
    wrong: usize,
    /// Both sides of a long gap have many stamps.
    broken: bool,
    /// Median of stamp − logging, s.
    ahead: f64,
    /// Stamp − logging of the messages that are logged soonest, s: quartiles over time.
    soonest: [f64; 2],
    /// Most stamps are those of another reading.
    coarse: bool,
    /// Time covered by the stamps, and by their logging, s.
    covered: [f64; 2],
    /// First and last logging, ns.
    logged: [i64; 2],
    /// Loggings at which the stamps begin anew, ns.
    resets: Vec<i64>,
    /// What its stamps show at a logging, where they run at another rate.
    rate: Option<Rate>,
    /// The topic whose clock dates messages without stamps, and what that shows.
    shown: Option<(String, Rate)>,
}

impl Clock {
    /// The clock of a topic by all its messages.
    pub(super) fn of<T: Reading>(topic: &str, received: &[Received<T>]) -> Self {
        let count = received.len();
        let coarse = are_coarse(received);
        let mut pairs: Vec<(i64, i64)> =
            received.iter().filter_map(|one| Some((one.log_ns, one.stamp_ns?))).collect();
        let undated = count - pairs.len();
        pairs.sort_by_key(|(logged, _)| *logged);
        let (right, broken) = right_stamps(pairs.iter().map(|(_, stamp)| *stamp).collect());
        let dated = pairs.len();
        pairs.retain(|(_, stamp)| (right[0]..=right[1]).contains(stamp));
        let resets = resets(&pairs);
        let mut covered = [0.0; 2];
        let segments = pairs.chunk_by(|a, b| segment(&resets, a.0) == segment(&resets, b.0));
        for pairs in segments {
            let stamps = || pairs.iter().map(|(_, stamp)| *stamp);
            let [Some(first), Some(last)] = [stamps().min(), stamps().max()] else { continue };
            covered[0] += seconds(first, last);
            covered[1] += seconds(pairs[0].0, pairs[pairs.len() - 1].0);
        }
        let mut ahead: Vec<f64> =
            pairs.iter().map(|(logged, stamp)| seconds(*logged, *stamp)).collect();
        let logged = received.iter().map(|one| one.log_ns);
        Self {
            topic: topic.to_owned(),
            count,
            undated,
            right,
            wrong: dated - pairs.len(),
            broken,
            ahead: median(&mut ahead).unwrap_or_default(),
            soonest: soonest(&pairs),
            coarse,
            covered,
            logged: [logged.clone().min().unwrap_or_default(), logged.max().unwrap_or_default()],
            rate: Rate::of(&pairs).filter(|_| !broken && resets.is_empty()),
            shown: None,
            resets,
        }
    }

    /// Loggings at which another run begins, ns.
    pub(super) fn resets(&self) -> &[i64] {
        &self.resets
    }

    fn is_stamped(&self) -> bool {
        self.undated < self.count
    }

    /// When a message was measured; none where that is not known.
    pub(super) fn date<T>(&self, by: By, one: &Received<T>) -> Option<i64> {
        if by == By::Log {
            return Some(one.log_ns);
        }
        if let Some((_, rate)) = &self.shown {
            return rate.at(one.log_ns);
        }
        if !self.is_stamped() {
            return Some(one.log_ns);
        }
        one.stamp_ns.filter(|stamp| (self.right[0]..=self.right[1]).contains(stamp))
    }

    /// What is to be said of messages without a right stamp.
    pub(super) fn warnings(&self, by: By) -> Vec<Warning> {
        let skipped = |count: usize, reason: &str| {
            let (topic, reason) = (self.topic.clone(), reason.to_owned());
            (count > 0).then_some(Warning::MessagesSkipped { topic, count: count as u64, reason })
        };
        if let Some((clock, _)) = self.shown.as_ref().filter(|_| by == By::Header) {
            let (topic, count, clock) = (self.topic.clone(), self.count as u64, clock.clone());
            return vec![Warning::ShownTime { topic, count, clock }];
        }
        match by {
            By::Header if self.is_stamped() => [
                skipped(self.undated, "it has no stamp, as others have"),
                skipped(self.wrong, "its stamp is far from all others: the clock was set later"),
            ]
            .into_iter()
            .flatten()
            .collect(),
            By::Header => {
                let (topic, count) = (self.topic.clone(), self.count as u64);
                Some(Warning::LogTime { topic, count }).filter(|_| count > 0).into_iter().collect()
            }
            By::Log => Vec::new(),
        }
    }

    /// Whether stamps and logging cover one length of time.
    fn is_as_logged(&self) -> bool {
        let [stamps, logging] = self.covered;
        let ratio = stamps / logging;
        !self.is_stamped() || (1.0 / MAX_SPEED_RATIO..=MAX_SPEED_RATIO).contains(&ratio)
    }

    /// Whether the stamps of two topics differ by more than a delay explains.
    pub(super) fn is_apart_from(&self, other: &Self) -> bool {
        self.broken || self.differs_from(other)
    }

    /// Whether the stamps of two topics differ by more than a delay or bursts explain.
    fn differs_from(&self, other: &Self) -> bool {
        let differ = |a: f64, b: f64| (a - b).abs() > MAX_LATENESS;
        differ(self.ahead, other.ahead)
            && (0..2).any(|quartile| differ(self.soonest[quartile], other.soonest[quartile]))
    }

    /// Whether two topics were logged over one time, at least half of the shorter one.
    fn was_logged_with(&self, other: &Self) -> bool {
        let length = |of: &Self| seconds(of.logged[0], of.logged[1]);
        let start = self.logged[0].max(other.logged[0]);
        let end = self.logged[1].min(other.logged[1]);
        2.0 * seconds(start, end) >= length(self).min(length(other))
    }
}

/// Dates messages without stamps, or with those of another clock, by the clock of the first topic,
/// where that runs at another rate than logging.
pub(super) fn share_rate(clocks: &mut [Clock]) {
    let Some((first, others)) = clocks.split_first_mut() else { return };
    let Some(rate) = &first.rate else { return };
    let has_other_clock = |other: &Clock| !other.is_stamped() || other.differs_from(first);
    for other in others.iter_mut().filter(|other| other.count > 0 && has_other_clock(other)) {
        other.shown = Some((first.topic.clone(), rate.clone()));
    }
}

/// By what to date the messages of these topics, the one of the tracks first.
pub(super) fn decide(clocks: &[Clock], dating: Dating) -> (By, Vec<Warning>) {
    let mut warnings = Vec::new();
    let by = match dating {
        Dating::Header => return (By::Header, warnings),
        Dating::Log => return (By::Log, warnings),
        Dating::Any => by_evidence(clocks, &mut warnings),
    };
    (by, warnings)
}

fn by_evidence(clocks: &[Clock], warnings: &mut Vec<Warning>) -> By {
    let Some(first) = clocks.first() else { return By::Header };
    let can_log = |clock: &Clock| clock.was_logged_with(first);
    let mut by = By::Header;
    if let Some(broken) = clocks.iter().find(|clock| clock.broken && can_log(clock)) {
        warnings.push(Warning::ClockSet { topic: broken.topic.clone() });
        by = By::Log;
    }
    if let Some(coarse) = clocks.iter().find(|clock| clock.coarse && by == By::Header) {
        warnings.push(Warning::CoarseStamps { topic: coarse.topic.clone() });
        by = By::Log;
    }
    for other in &clocks[1.min(clocks.len())..] {
        let offset = other.ahead - first.ahead;
        let is_shown = other.shown.is_some();
        if offset.abs() <= MIN_REPORTED_OFFSET || by == By::Log || other.count == 0 || is_shown {
            continue;
        }
        let is_as_logged = first.is_as_logged() && other.is_as_logged() && can_log(other);
        // What is logged before its stamp has another clock than the logger.
        let is_ahead = first.ahead.max(other.ahead) > MAX_STAMP_LEAD
            && first.ahead.min(other.ahead).abs() <= MAX_STAMP_LEAD;
        let differ = is_as_logged && (is_ahead || other.differs_from(first));
        if differ {
            by = By::Log;
        }
        warnings.push(Warning::ClocksDiffer {
            topics: [first.topic.clone(), other.topic.clone()],
            offset,
            by_log: differ,
        });
    }
    by
}

/// Quartiles over time of stamp − logging of the message that is logged soonest, s: a clock that
/// was set has others for a part of the time. Pairs of logging and stamp are in the order of
/// logging.
fn soonest(pairs: &[(i64, i64)]) -> [f64; 2] {
    let Some(&(first, _)) = pairs.first() else { return [0.0; 2] };
    let time = |pair: &(i64, i64)| (seconds(first, pair.0) / PART_DURATION).floor();
    let ahead = |pair: &(i64, i64)| seconds(pair.0, pair.1);
    let parts = pairs.chunk_by(|a, b| time(a) == time(b));
    let largest = parts.map(|part| part.iter().map(ahead).fold(f64::NEG_INFINITY, f64::max));
    let mut largest: Vec<f64> = largest.collect();
    [0.25, 0.75].map(|share| quantile(&mut largest, share).unwrap_or_default())
}

/// The run that a message belongs to, by the loggings at which the clock begins anew.
pub(super) fn segment(resets: &[i64], log_ns: i64) -> usize {
    resets.partition_point(|reset| *reset <= log_ns)
}

/// Between which stamps all right ones lie, and whether many lie on both sides of a long gap.
fn right_stamps(mut stamps: Vec<i64>) -> ([i64; 2], bool) {
    const ALL: [i64; 2] = [i64::MIN, i64::MAX];
    stamps.sort_unstable();
    let Some(&first) = stamps.first() else { return (ALL, false) };
    let times: Vec<f64> = stamps.iter().map(|stamp| seconds(first, *stamp)).collect();
    let Parts::Main(main) = stray_stamps::parts(&times) else { return (ALL, true) };
    // Other joints of the topic have stamps close to these: bounds lie within the gaps.
    let within_gap = |after: usize| {
        let before = stamps.get(after.checked_sub(1)?)?;
        Some(i64::midpoint(*before, *stamps.get(after)?))
    };
    ([within_gap(main.start).unwrap_or(ALL[0]), within_gap(main.end).unwrap_or(ALL[1])], false)
}

/// Loggings at which stamps step back and stay back. Pairs of logging and stamp, by logging.
fn resets(pairs: &[(i64, i64)]) -> Vec<i64> {
    let mut resets = Vec::new();
    let mut latest = i64::MIN;
    for (place, &(logged, stamp)) in pairs.iter().enumerate() {
        let is_back = |stamp: i64| stamp < latest.saturating_sub(MIN_RESET_NS);
        if is_back(stamp)
            && pairs[place..].iter().take(RESET_WITNESSES).all(|(_, stamp)| is_back(*stamp))
        {
            resets.push(logged);
            latest = stamp;
        }
        latest = latest.max(stamp);
    }
    // Publishers with clocks of their own step back all the time: no clock was set anew.
    if 100 * resets.len() > pairs.len() { Vec::new() } else { resets }
}

#[cfg(test)]
mod tests;
