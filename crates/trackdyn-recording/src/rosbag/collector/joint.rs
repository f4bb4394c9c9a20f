//! A joint that may turn a track.

use crate::rosbag::date::Received;
use crate::rosbag::names::Part;
use trackdyn_core::Side;

/// A joint that counts for a side.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) topic: String,
    pub(super) side: Side,
    /// -1 where it counts backwards.
    pub(super) sign: f64,
    /// What it moves, by its name.
    pub(super) part: Part,
    /// Position and velocity of each of its messages, in the order of the bag; NaN for none.
    pub(super) signals: Vec<Received<[f64; 2]>>,
}

/// Names of joints; with their topics where they share them.
pub(super) fn listed<'a>(joints: impl Iterator<Item = &'a Joint>) -> String {
    let joints: Vec<&Joint> = joints.collect();
    let name = |joint: &&Joint| {
        let shared = joints.iter().filter(|other| other.name == joint.name).count() > 1;
        if shared { format!("{} of {}", joint.name, joint.topic) } else { joint.name.clone() }
    };
    joints.iter().map(name).collect::<Vec<_>>().join(", ")
}
