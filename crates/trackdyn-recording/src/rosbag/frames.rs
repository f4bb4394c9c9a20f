//! Frames and the transforms that link them.

use std::collections::{BTreeSet, VecDeque};

/// Links between frames: pairs (parent, child), without leading slashes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Frames {
    links: BTreeSet<Link>,
}

/// A transform from parent to child.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Link {
    pub(super) parent: String,
    pub(super) child: String,
}

/// A link on the way from one frame to another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Hop {
    pub(super) link: Link,
    /// Whether the way leads from the child to the parent.
    pub(super) inverse: bool,
}

/// A frame without its leading slash: tf knows it with and without.
pub(super) fn bare(frame: &str) -> &str {
    frame.trim_start_matches('/')
}

/// Frames are the same with and without a leading slash.
pub(super) fn same_frame(a: &str, b: &str) -> bool {
    bare(a) == bare(b)
}

/// The frame that wheel odometry moves the robot in (REP-105).
const ODOMETRY: &str = "odom";

/// Usual names of the body of a robot, without a prefix (REP-105).
const BODIES: [&str; 2] = ["base_link", "base_footprint"];

/// Whether a frame is the body of a robot by its name.
pub(super) fn is_body(frame: &str) -> bool {
    bare(frame).rsplit('/').next().is_some_and(|name| BODIES.contains(&name))
}

/// Whether poses in this frame are usually the odometry of the tracks.
pub(super) fn is_of_odometry(parent: &str) -> bool {
    same_frame(parent, ODOMETRY)
}

/// Whether messages of this type are lists of transforms, of tf2 or of tf.
pub(super) fn is_transforms(kind: &str) -> bool {
    kind.ends_with("/TFMessage") || kind.ends_with("/tfMessage")
}

/// Whether messages of this type may hold the odometry of the tracks: those of an Odometry, and
/// transforms out of its frame.
pub(super) fn may_be_odometry<'a>(kind: &str, mut parents: impl Iterator<Item = &'a str>) -> bool {
    kind.ends_with("/Odometry") || (is_transforms(kind) && parents.any(is_of_odometry))
}

impl Link {
    pub(super) fn new(parent: &str, child: &str) -> Self {
        Self { parent: bare(parent).to_owned(), child: bare(child).to_owned() }
    }

    pub(super) fn is(&self, parent: &str, child: &str) -> bool {
        self.parent == bare(parent) && self.child == bare(child)
    }

    pub(super) fn name(&self) -> String {
        format!("{} -> {}", self.parent, self.child)
    }
}

impl Frames {
    pub(super) fn note(&mut self, parent: &str, child: &str) {
        if !self.links.iter().any(|link| link.is(parent, child)) {
            self.links.insert(Link::new(parent, child));
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// The shortest way from a frame to another, up and down the links; none where nothing leads
    /// there.
    pub(super) fn way(&self, from: &str, to: &str) -> Option<Vec<Hop>> {
        let mut reached: Vec<(&str, Option<(usize, Hop)>)> = vec![(bare(from), None)];
        let mut next = VecDeque::from([0]);
        while let Some(place) = next.pop_front() {
            let frame = reached[place].0;
            if frame == bare(to) {
                let mut hops = Vec::new();
                let mut at = place;
                while let Some((before, hop)) = &reached[at].1 {
                    hops.push(hop.clone());
                    at = *before;
                }
                hops.reverse();
                return Some(hops);
            }
            for link in &self.links {
                let (other, inverse) = match frame {
                    _ if link.parent == frame => (link.child.as_str(), false),
                    _ if link.child == frame => (link.parent.as_str(), true),
                    _ => continue,
                };
                if reached.iter().all(|(known, _)| *known != other) {
                    reached.push((other, Some((place, Hop { link: link.clone(), inverse }))));
                    next.push_back(reached.len() - 1);
                }
            }
        }
        None
    }

    /// The frame above all others above this one, itself where there is none.
    pub(super) fn root_of<'a>(&'a self, frame: &'a str) -> &'a str {
        let mut at = bare(frame);
        // a loop of links has no root: as many steps as links are enough for all others
        for _ in 0..self.links.len() {
            match self.links.iter().find(|link| link.child == at) {
                Some(link) => at = &link.parent,
                None => break,
            }
        }
        at
    }

    /// The frame of a robot's body by its usual name, whatever the prefix (REP-105).
    pub(super) fn body(&self) -> Option<&str> {
        BODIES.into_iter().find_map(|usual| {
            let frames = self.links.iter().flat_map(|link| [&*link.child, &*link.parent]);
            let mut frames = frames.filter(|frame| frame.rsplit('/').next() == Some(usual));
            frames.next()
        })
    }
}

impl std::fmt::Display for Frames {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (place, Link { parent, child }) in self.links.iter().enumerate() {
            let separator = if place == 0 { "" } else { ", " };
            write!(f, "{separator}{parent} -> {child}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames() -> Frames {
        let mut frames = Frames::default();
        for (parent, child) in
            [("map", "/odom"), ("odom", "base_link"), ("base_link", "laser"), ("dock", "sign")]
        {
            frames.note(parent, child);
        }
        frames
    }

    fn way(from: &str, to: &str) -> Option<Vec<(String, bool)>> {
        let hops = frames().way(from, to)?;
        Some(hops.into_iter().map(|hop| (hop.link.child, hop.inverse)).collect())
    }

    #[test]
    fn ways_lead_down_and_up() {
        let down = |names: &[&str]| {
            Some(names.iter().map(|name| ((*name).to_owned(), false)).collect::<Vec<_>>())
        };
        assert_eq!(way("map", "/base_link"), down(&["odom", "base_link"]));
        assert_eq!(way("laser", "odom").map(|hops| hops.iter().all(|hop| hop.1)), Some(true));
        assert_eq!(way("map", "map"), down(&[]));
        assert_eq!((way("map", "sign"), way("map", "nowhere")), (None, None));
    }

    #[test]
    fn roots_and_bodies_are_found() {
        let frames = frames();
        assert_eq!((frames.root_of("laser"), frames.body()), ("map", Some("base_link")));
        let mut ring = Frames::default();
        ring.note("a", "b");
        ring.note("b", "a");
        assert!(["a", "b"].contains(&ring.root_of("a")));
        assert_eq!(frames.to_string().matches(" -> ").count(), 4);
    }
}
