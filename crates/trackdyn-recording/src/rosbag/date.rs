//! When the value of a message was measured.

use crate::recording::Warning;

/// A value and when it was measured, Unix time in nanoseconds.
pub(super) type Stamped<T> = (i64, T);

/// A value as it was received.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Received<T> {
    /// Stamp of its message, Unix time in nanoseconds; none where it is zero.
    pub(super) stamp_ns: Option<i64>,
    /// Time of its logging, Unix time in nanoseconds.
    pub(super) log_ns: i64,
    pub(super) value: T,
}

impl<T> Received<T> {
    /// Another value of the same message.
    pub(super) fn with<U>(&self, value: U) -> Received<U> {
        Received { stamp_ns: self.stamp_ns, log_ns: self.log_ns, value }
    }
}

/// Values of a topic with the times at which they were measured, and a warning where times are
/// missing.
///
/// Where no message has a stamp, all are dated by their logging. Where some have one, the others
/// are left out. The first message of a simulation is an example: it is stamped zero, and was
/// logged years after that time.
pub(super) fn dated<T>(
    topic: &str,
    received: Vec<Received<T>>,
) -> (Vec<Stamped<T>>, Option<Warning>) {
    let all = received.len();
    let undated = received.iter().filter(|one| one.stamp_ns.is_none()).count();
    let (topic, count) = (topic.to_owned(), undated as u64);
    if undated == all {
        let logged = received.into_iter().map(|one| (one.log_ns, one.value)).collect();
        return (logged, (undated > 0).then_some(Warning::LogTime { topic, count }));
    }
    let stamped = received.into_iter().filter_map(|one| Some((one.stamp_ns?, one.value)));
    let reason = "it has no stamp, as others have".to_owned();
    let warning = Warning::MessagesSkipped { topic, count, reason };
    (stamped.collect(), (undated > 0).then_some(warning))
}

/// Seconds from one time to another, without losing nanoseconds to the size of Unix time.
#[expect(clippy::cast_precision_loss, reason = "recordings last less than 2⁵³ ns, 104 days")]
pub(super) fn seconds(from_ns: i64, to_ns: i64) -> f64 {
    to_ns.saturating_sub(from_ns) as f64 / 1e9
}
