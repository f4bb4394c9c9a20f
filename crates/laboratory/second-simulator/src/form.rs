//! Forms: which member of its family a law is.
//!
//! Nature keeps to no formula of a catalogue. A mechanism therefore has a family of laws under one
//! name: same symmetries, same meaning of its size, another curve. A blind trial draws one for each
//! case, so that no form can be learnt.

mod curve;
mod draws;
mod steps;

pub use curve::Curve;
pub use draws::Draws;
pub use steps::Steps;

/// Which member of its family a law is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Form {
    /// The one law that the sheet states.
    #[default]
    Plain,
    /// The member of the family that follows from this number.
    Drawn(u32),
}

impl Form {
    /// The number of a drawn form.
    pub fn number(self) -> Option<u32> {
        match self {
            Self::Plain => None,
            Self::Drawn(number) => Some(number),
        }
    }

    /// What a drawn form is drawn from. It depends on the number alone: a mechanism has the same
    /// form at all sizes.
    pub(crate) fn draws(self) -> Option<Draws> {
        self.number().map(Draws::of)
    }
}
