//! Figures.
//!
//! A figure is a function from results to the bytes of a PNG; writing them to disk is the caller's
//! business. A report is a page that carries its figures. Pictures are drawn at twice the size at which they are usually read.
//!
//! - [`canvas`]: the pixels, and what is drawn straight into them.
//! - [`text`]: text in the embedded font.
//! - [`brush`]: the canvas as a backend of `plotters`.
//! - [`panel`]: axes around a rectangle of the canvas.
//! - [`colour`]: colours and colour maps.
//! - [`diagnosis_figures()`], [`diagnosis_html()`]: the figures and the report of a diagnosis.
//! - [`icr_map()`]: the figure of an ICR map.
//! - [`odometry()`]: the figure of an odometry replay.
//! - [`path_tracking()`]: the figure of drives along a path.
//! - [`power()`], [`shares()`], [`confusion()`]: figures of what programs find of what is there.

pub mod brush;
pub mod canvas;
pub mod colour;
mod colour_bar;
mod diagnosis;
mod error;
mod icr_map;
mod legend;
mod look;
mod odometry;
pub mod panel;
mod path_tracking;
mod scores;
mod sheet;
pub mod text;

pub use diagnosis::{Figure, Subject, diagnosis_figures, diagnosis_html};
pub use error::Error;
pub use icr_map::icr_map;
pub use odometry::odometry;
pub use path_tracking::{TrackedDrive, path_tracking};
pub use scores::{Entrant, Matrix, Power, Share, Shares, confusion, power, shares};
