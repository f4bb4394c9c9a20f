//! Figures as values, their pictures, and the report of a diagnosis.
//!
//! A figure is a function from results to a [`Figure`]: panels with axes, series and texts, as
//! plain data that can be cloned, compared and serialised. [`Figure::to_png`] and
//! [`Figure::to_svg`] draw it. Writing files is the caller's business.
//!
//! - [`figure`]: what figures consist of.
//! - [`text`], [`colour`], [`ticks`]: the embedded font, colours and colour maps, numbers of axes.
//! - [`icr_map()`]: the figure of an ICR map.
//! - [`inspection()`]: the figure of a recording over time.
//! - [`odometry()`]: the figure of an odometry replay.
//! - [`path_tracking()`]: the figure of drives along a path.
//! - [`diagnosis_figures()`], [`diagnosis_html()`]: the figures and the report of a diagnosis.
//! - [`comparison_figures()`], [`comparison_html()`]: those of a comparison of two sets.
//! - [`power()`], [`shares()`], [`confusion()`]: figures of what programs find of what is there.

pub mod colour;
mod comparison;
mod diagnosis;
mod draw;
mod error;
pub mod figure;
mod icr_map;
mod inspection;
mod odometry;
mod path_tracking;
mod paths;
mod scores;
mod sheet;
pub mod text;
pub mod ticks;

pub use comparison::{Compared, comparison_figures, comparison_html};
pub use diagnosis::{Subject, diagnosis_figures, diagnosis_html};
pub use error::Error;
pub use figure::Figure;
pub use icr_map::icr_map;
pub use inspection::{Inspected, inspection};
pub use odometry::odometry;
pub use path_tracking::{TrackedDrive, path_tracking};
pub use scores::{Entrant, Matrix, Power, Share, Shares, confusion, power, shares};
