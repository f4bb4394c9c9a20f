//! What a blind trial does with a mechanism.

/// The part of a mechanism in a blind trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trial {
    /// An error of an instrument. It is never concealed: naming it is right wherever it is.
    Instrument(InstrumentError),
    /// A law that is concealed.
    Law(Concealment),
}

/// An error of an instrument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstrumentError {
    /// Share of the cases in which it is there and small.
    pub small_share: f64,
    /// Name of the cases without concealed physics in which it is large. Errors of one name are
    /// large together.
    pub large_in: &'static str,
    /// Whether its parameter is the delay of the stamps of poses, which sensors have by themselves.
    pub is_clock_offset: bool,
}

/// How a law is concealed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Concealment {
    /// Whether a recording can name it.
    pub identifiability: Identifiability,
    /// Strength beyond which it is not physical, or the robot stops.
    pub largest: f64,
    /// Strengths at which it is compared with another mechanism.
    pub compared_at: &'static [f64],
    /// What an owner's vehicle file states wrongly where it is there.
    pub filed: Option<Filed>,
    /// Whether trials of plain forms do without it, as those did that were made before it.
    pub needs_drawn_forms: bool,
}

/// Whether a recording can name a law of the catalogue. Laws outside the catalogue are distinct.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Identifiability {
    /// By itself, at sizes that a roboticist may meet.
    Distinct,
    /// By itself where it is large or near. Small or far away it resembles another effect.
    DistinctWhenLarge,
    /// Never by itself: other effects leave the same trace at all sizes.
    Indistinct,
}

/// A statement of a vehicle file that its owner may have wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filed {
    /// Place of the centre of gravity.
    CentreOfGravity,
    /// Friction across the tracks over that along them.
    FrictionRatio,
}

impl Trial {
    /// A law that can be concealed with strengths up to the largest one.
    pub const fn law(identifiability: Identifiability, largest: f64) -> Self {
        let (compared_at, filed): (&[f64], _) = (&[1.0], None);
        let needs_drawn_forms = false;
        Self::Law(Concealment { identifiability, largest, compared_at, filed, needs_drawn_forms })
    }

    /// With the strengths at which it is compared with another mechanism, where its trace changes
    /// its shape with the strength.
    #[must_use]
    pub const fn compared_at(self, strengths: &'static [f64]) -> Self {
        match self {
            Self::Law(law) => Self::Law(Concealment { compared_at: strengths, ..law }),
            Self::Instrument(_) => self,
        }
    }

    /// Not in trials of plain forms.
    #[must_use]
    pub const fn with_drawn_forms_only(self) -> Self {
        match self {
            Self::Law(law) => Self::Law(Concealment { needs_drawn_forms: true, ..law }),
            Self::Instrument(_) => self,
        }
    }

    /// With what an owner's vehicle file states wrongly where it is there.
    #[must_use]
    pub const fn filed(self, filed: Filed) -> Self {
        match self {
            Self::Law(law) => Self::Law(Concealment { filed: Some(filed), ..law }),
            Self::Instrument(_) => self,
        }
    }

    /// An error that is large in cases of this name, and small in a share of the others.
    pub const fn instrument(large_in: &'static str, small_share: f64) -> Self {
        Self::Instrument(InstrumentError { small_share, large_in, is_clock_offset: false })
    }

    /// The delay of the stamps of poses.
    pub const fn clock_offset(large_in: &'static str) -> Self {
        Self::Instrument(InstrumentError { small_share: 0.0, large_in, is_clock_offset: true })
    }
}
