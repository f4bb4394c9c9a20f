//! What can go wrong with a figure.

use plotters::drawing::DrawingAreaErrorKind;
use std::convert::Infallible;

/// A figure that could not be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The axes could not be drawn.
    #[error("the axes cannot be drawn: {0}")]
    Axes(String),
    /// The picture could not be encoded.
    #[error("the picture cannot be encoded")]
    Encoding(#[from] png::EncodingError),
    /// The report could not be filled in.
    #[error("the report cannot be filled in: {0}")]
    Template(#[from] minijinja::Error),
    /// The values of figures could not be written.
    #[error("the values of the figures cannot be written: {0}")]
    Values(#[from] serde_json::Error),
}

impl From<DrawingAreaErrorKind<Infallible>> for Error {
    fn from(cause: DrawingAreaErrorKind<Infallible>) -> Self {
        Self::Axes(cause.to_string())
    }
}
