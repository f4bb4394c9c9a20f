//! What was seen: recordings of tracked robots, and what they say before any kinematic model.
//!
//! - [`recording`]: the one in-memory type, cleaned on the way in.
//! - [`folder`], [`rosbag`], [`tum`]: one reader per format; [`read`] picks by path.
//! - [`operating_points`]: tables of steady motion, a measured map of ICRs.
//! - [`selection`]: some of its runs, or a time of them.
//! - [`segment`], [`hold`]: pieces between two poses and the track speeds within them.
//! - [`clock`]: how late the poses are against the encoders.
//! - [`blocks`]: parts that count as independent.
//! - [`interval`]: 95 % from leaving out one of them each.
//! - [`noise`]: how noisy poses and encoders are, from the recording itself.
//! - [`regular`]: the times at which samples were due, of stamps that jitter.
//! - [`robust`]: statistics by medians.
//! - [`synthetic`]: recordings with known truth.
//! - [`table`]: CSV tables, for other readers of columns of numbers.
//!
//! Axes are those of REP-103 (x forward, y left), units SI, angles in radians.

pub mod blocks;
pub mod clock;
pub mod error;
pub mod folder;
pub mod format;
mod gaps;
pub mod hold;
pub mod interval;
pub mod noise;
pub mod operating_points;
pub mod recording;
pub mod regular;
pub mod robust;
pub mod rosbag;
pub mod segment;
pub mod selection;
pub mod synthetic;
pub mod table;
mod thinned;
pub mod tum;

pub use blocks::{Blocks, Extent};
pub use clock::Clock;
pub use error::Error;
pub use format::{Format, read};
pub use interval::Interval;
pub use operating_points::{OperatingPoint, OperatingPoints};
pub use recording::{
    ImuSample, PoseSample, Recording, Run, Series, Source, StatedNoise, TrackSample, UncheckedRun,
    Warning,
};
pub use segment::{Segment, SegmentOptions, segments};
pub use selection::RunList;
