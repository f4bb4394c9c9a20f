//! What programs that show logs of robots open: Foxglove, Rerun, PlotJuggler.
//!
//! - [`layers`]: what is shown, as values: paths, markers, plots.
//! - [`bag`]: these as one `.mcap` file of messages of ROS 2.
//! - [`foxglove`], [`plotjuggler`]: layouts that show what is in the file.
//! - [`names`]: names of topics.

pub mod bag;
pub mod foxglove;
pub mod layers;
pub mod names;
pub mod plotjuggler;

mod message;
mod schema;
mod stream;

pub use layers::{
    Curve, JointLayer, Layers, MarkerLayer, PathLayer, Plot, Rgb, Tab, TextLayer, Trace,
};
