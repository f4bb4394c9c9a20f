//! What was seen: recordings of tracked robots, and their readers.
//!
//! - [`recording`]: the one in-memory type, cleaned on the way in, of [`sample`]s.
//! - [`folder`], [`rosbag`], [`tum`], [`columns`]: one reader per format; [`read`] picks by path.
//! - [`operating_points`]: tables of steady motion, a measured map of ICRs.
//! - [`selection`]: some of its runs, or a time of them.
//! - [`doubt`]: what tracks and poses of one recording may contradict each other in.
//! - [`hold`]: track speeds between two readings.
//! - [`mod@unit`]: units of track speeds and of positions.
//! - [`table`]: CSV tables, for other readers of columns of numbers.
//!
//! Axes are those of REP-103 (x forward, y left), units SI, angles in radians.

mod attitude;
pub mod columns;
pub mod doubt;
pub mod error;
pub mod folder;
pub mod format;
pub mod hold;
pub mod operating_points;
pub mod recording;
pub mod rosbag;
pub mod sample;
pub mod selection;
mod smoothed;
mod stray_stamps;
pub mod table;
mod table_options;
pub mod tum;
pub mod unit;
mod wgs84;

pub use columns::Columns;
pub use doubt::{Axes, Doubt, DoubtKind};
pub use error::Error;
pub use format::read;
pub use operating_points::{OperatingPoint, OperatingPoints};
pub use recording::{
    BagNames, Format, PoseAxes, PoseFrame, Recording, Run, Source, StatedNoise, UncheckedRun,
    Warning,
};
pub use sample::{ImuSample, PoseSample, Series, TrackSample};
pub use selection::RunList;
pub use smoothed::smoothed;
pub use table_options::TableOptions;
pub use unit::{PoseUnit, SpeedUnit};
