//! What looks at the messages of a bag.

use super::topic::Topic;

/// Who looks at the messages of a bag.
pub(super) trait Visitor {
    /// The definition of a type, with those of the types that it needs; before its topics turn up.
    fn defines(&mut self, _kind: &str, _text: &str) {}

    /// A topic turns up; whether its messages are wanted.
    fn wants(&mut self, topic: &Topic) -> bool;

    /// A message of a wanted topic. `log_ns` is when it was logged, Unix time in nanoseconds.
    fn message(&mut self, topic: &Topic, log_ns: i64, payload: &[u8]);
}
