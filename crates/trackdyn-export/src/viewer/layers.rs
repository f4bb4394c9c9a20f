//! What a viewer shows of a drive, as values.

use crate::Error;
use std::collections::BTreeMap;
use trackdyn_core::{PerSide, Pose};

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// What a viewer shows of a drive. Stamps are Unix time in nanoseconds, lengths m, angles rad, axes
/// those of REP-103.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Where it comes from: keys and texts.
    pub notes: BTreeMap<String, String>,
    /// Frame that paths are expressed in.
    pub fixed_frame: String,
    /// Paths, each with a frame that moves along it.
    pub paths: Vec<PathLayer>,
    /// Points that move with a frame.
    pub markers: Vec<MarkerLayer>,
    /// Speeds of joints.
    pub joints: Vec<JointLayer>,
    /// Words that hold until the next.
    pub texts: Vec<TextLayer>,
    /// Curves over time.
    pub tabs: Vec<Tab>,
}

/// A path, run after run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathLayer {
    /// Name in legends.
    pub name: String,
    /// Beginning of its topics.
    pub topic: String,
    /// Frame that moves along it.
    pub frame: String,
    /// Its colour.
    pub colour: Rgb,
    /// Stamps of the poses, in order.
    pub stamps: Vec<u64>,
    /// Poses in the fixed frame.
    pub poses: Vec<Pose>,
    /// Index of the first pose of each run.
    pub starts: Vec<usize>,
}

/// Points that move with a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarkerLayer {
    /// Its topic.
    pub topic: String,
    /// The frame.
    pub frame: String,
    /// Their colour.
    pub colour: Rgb,
    /// Their diameter, m.
    pub diameter: f64,
    /// Name of each point.
    pub points: Vec<String>,
    /// Stamps, in order.
    pub stamps: Vec<u64>,
    /// The points (x, y) at each stamp; none where a point is not shown then.
    pub places: Vec<Vec<Option<[f64; 2]>>>,
}

/// Speeds of the two tracks as those of joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointLayer {
    /// Its topic.
    pub topic: String,
    /// Names of the joints.
    pub names: PerSide<String>,
    /// Stamps, in order.
    pub stamps: Vec<u64>,
    /// Speeds, m/s.
    pub speeds: Vec<PerSide<f64>>,
}

/// Words that hold until the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextLayer {
    /// Its topic.
    pub topic: String,
    /// Stamps, in order.
    pub stamps: Vec<u64>,
    /// The words.
    pub texts: Vec<String>,
}

/// Plots below each other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tab {
    /// Its title.
    pub title: String,
    /// Its plots.
    pub plots: Vec<Plot>,
}

/// Curves of one quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// The quantity with its unit.
    pub title: String,
    /// Its curves.
    pub curves: Vec<Curve>,
}

/// A number over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Name in legends.
    pub name: String,
    /// Its topic.
    pub topic: String,
    /// Its colour.
    pub colour: Rgb,
    /// Its values.
    pub trace: Trace,
}

/// Values over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Stamps, in order.
    pub stamps: Vec<u64>,
    /// Values.
    pub values: Vec<f64>,
}

impl Trace {
    /// Appends a value.
    pub fn push(&mut self, stamp: u64, value: f64) {
        self.stamps.push(stamp);
        self.values.push(value);
    }
}

/// First time that a stamp of ROS 2 cannot hold: 2³¹ s, in nanoseconds.
const STAMPS_END: u64 = 2_147_483_648_000_000_000;

impl Layers {
    /// All curves.
    pub fn curves(&self) -> impl Iterator<Item = &Curve> {
        self.tabs.iter().flat_map(|tab| &tab.plots).flat_map(|plot| &plot.curves)
    }

    /// Middle of the paths, m, and the length of the square around them, m, at least 1 m.
    pub(super) fn extent(&self) -> ([f64; 2], f64) {
        let range = |of: fn(&Pose) -> f64| {
            let values = self.paths.iter().flat_map(|path| &path.poses).map(of);
            let ends = values.fold(None, |ends: Option<[f64; 2]>, value| {
                let [low, high] = ends.unwrap_or([value; 2]);
                Some([low.min(value), high.max(value)])
            });
            ends.unwrap_or_default()
        };
        let ranges = [range(|pose| pose.x), range(|pose| pose.y)];
        let lengths = ranges.map(|[low, high]| high - low);
        (ranges.map(|[low, high]| f64::midpoint(low, high)), lengths[0].max(lengths[1]).max(1.0))
    }

    /// Refuses what no viewer can show.
    ///
    /// # Errors
    /// [`Error::NoPoses`] without any path, [`Error::LateStamp`] for stamps that ROS cannot hold.
    pub(super) fn check(&self) -> Result<(), Error> {
        if self.paths.iter().all(|path| path.poses.is_empty()) {
            return Err(Error::NoPoses);
        }
        let all = (self.paths.iter().map(|path| &path.stamps))
            .chain(self.markers.iter().map(|markers| &markers.stamps))
            .chain(self.joints.iter().map(|joints| &joints.stamps));
        let last = all.filter_map(|stamps| stamps.last().copied()).max().unwrap_or_default();
        if last >= STAMPS_END {
            return Err(Error::LateStamp { stamp: last });
        }
        Ok(())
    }
}
