//! A law of a user: its card and its function.

use super::declared::{check, lasting};
use super::{Argument, Batch, Cause, Declared, DefinitionError, Failure, Kind, Results};
use crate::effect::{Card, Stage, Symmetry};
use std::error::Error;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// What a function of a user returns: nothing, or why it cannot be evaluated.
pub type Outcome = Result<(), Box<dyn Error + Send + Sync>>;

/// What a law adds at states with these values of its parameters.
type Function = dyn Fn(&Batch, &[f64], &mut Results) -> Outcome + Send + Sync;

/// The bit of the arguments that were read which says that the function tells of them.
const TELLS: u32 = 1 << 31;

/// A law of a user.
pub struct CustomLaw {
    kind: Kind,
    card: Card,
    function: Box<Function>,
    /// Arguments by which it is differentiated, a bit for each place.
    sought: u32,
    /// Those of them that its function has read so far, where it tells.
    read: AtomicU32,
    is_shared: bool,
}

impl fmt::Debug for CustomLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CustomLaw").field("card", &self.card).finish_non_exhaustive()
    }
}

impl CustomLaw {
    /// A force on the body: see [`Kind::Force`].
    ///
    /// # Errors
    /// [`DefinitionError`] for a name or a parameter that cannot be.
    pub fn force(
        id: &str,
        title: &str,
        parameters: &[Declared],
        function: impl Fn(&Batch, &[f64], &mut Results) -> Outcome + Send + Sync + 'static,
    ) -> Result<Self, DefinitionError> {
        Self::new(Kind::Force, id, title, parameters, function)
    }

    /// Factors on the friction: see [`Kind::Friction`].
    ///
    /// # Errors
    /// [`DefinitionError`] for a name or a parameter that cannot be.
    pub fn friction(
        id: &str,
        title: &str,
        parameters: &[Declared],
        function: impl Fn(&Batch, &[f64], &mut Results) -> Outcome + Send + Sync + 'static,
    ) -> Result<Self, DefinitionError> {
        Self::new(Kind::Friction, id, title, parameters, function)
    }

    /// A law that is called with a batch of states and the values of its parameters, in their
    /// order. Several threads call it at once.
    ///
    /// # Errors
    /// [`DefinitionError`] for a name or a parameter that cannot be.
    pub fn new(
        kind: Kind,
        id: &str,
        title: &str,
        parameters: &[Declared],
        function: impl Fn(&Batch, &[f64], &mut Results) -> Outcome + Send + Sync + 'static,
    ) -> Result<Self, DefinitionError> {
        check(id, parameters)?;
        let law = match kind {
            Kind::Force => "F, M of a function beside the catalogue, at the centre of gravity",
            Kind::Friction => "τ = −f [μ] p s/|s|, f of a function beside the catalogue",
        };
        let stage: &[Stage] = match kind {
            Kind::Force => &[Stage::Wrench],
            Kind::Friction => &[Stage::Shear],
        };
        let parameters: Vec<_> = parameters.iter().map(Declared::parameter).collect();
        let card = Card {
            id: lasting(id),
            title: lasting(if title.is_empty() { id } else { title }),
            law,
            assumes: "What the function assumes that defines it.",
            shows: "Where the function says.",
            resembles: "",
            breaks: &[],
            stages: stage,
            parameters: Box::leak(parameters.into_boxed_slice()),
            sources: &[],
        };
        let arguments = kind.arguments().iter().enumerate();
        let sought = arguments.filter(|(_, one)| one.is_sought()).map(|(place, _)| 1 << place);
        let (sought, read) = (sought.sum(), AtomicU32::new(0));
        Ok(Self { kind, card, function: Box::new(function), sought, read, is_shared: false })
    }

    /// Says what the function reads: it is differentiated by nothing else, which is faster.
    #[must_use]
    pub fn reading(mut self, arguments: &[Argument]) -> Self {
        let all = self.kind.arguments().iter().enumerate();
        let read = all.filter(|(_, one)| arguments.contains(one)).map(|(place, _)| 1 << place);
        self.sought &= read.sum::<u32>();
        self
    }

    /// Says that a call takes long, whatever the number of states: works that go on
    /// [`together`](super::together) share calls.
    #[must_use]
    pub fn shared(mut self) -> Self {
        self.is_shared = true;
        self
    }

    /// Whether works share its calls.
    pub fn is_shared(&self) -> bool {
        self.is_shared
    }

    /// The law with these symmetries on its card as broken.
    pub(super) fn breaking(mut self, broken: Vec<Symmetry>) -> Self {
        self.card.breaks = Box::leak(broken.into_boxed_slice());
        self
    }

    /// What it adds.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Its card.
    pub fn card(&self) -> &Card {
        &self.card
    }

    /// Places of the arguments by which it is differentiated. Where the function tells what it
    /// reads, these are the ones that it has read so far: see [`CustomLaw::is_read_beyond`].
    pub(super) fn sought(&self) -> Vec<usize> {
        let sought = self.sought & (self.read.load(Ordering::Relaxed) | !self.tells());
        (0..self.kind.arguments().len()).filter(|place| sought >> place & 1 == 1).collect()
    }

    /// Whether the function has read an argument by which it was not differentiated.
    pub(super) fn is_read_beyond(&self, sought: &[usize]) -> bool {
        self.sought() != sought
    }

    /// All bits where the function has told what it reads, else none.
    fn tells(&self) -> u32 {
        if self.read.load(Ordering::Relaxed) & TELLS == 0 { 0 } else { u32::MAX }
    }

    /// What it adds at states, with values of its parameters.
    pub(super) fn results(&self, at: &Batch, values: &[f64]) -> Result<Vec<f64>, Failure> {
        let rows = at.len();
        let mut results = vec![self.kind.nothing(); rows * self.kind.results().len()];
        let mut adds = Results::new(rows, &mut results);
        (self.function)(at, values, &mut adds)
            .map_err(|cause| self.failure(values, Cause::Raised(Arc::from(cause))))?;
        if let Some(read) = adds.read {
            let (before, read) = (self.read.load(Ordering::Relaxed), read | TELLS);
            if before | read != before {
                self.read.fetch_or(read, Ordering::Relaxed);
            }
        }
        Ok(results)
    }

    pub(super) fn failure(&self, values: &[f64], cause: Cause) -> Failure {
        let keys = self.card.parameters.iter().map(|parameter| parameter.key.to_owned());
        let parameters = keys.zip(values.iter().copied()).collect();
        Failure { law: self.card.id.to_owned(), parameters, cause }
    }

    /// The failure of a result that is no finite number in one of the first `count` rows, if any.
    pub(super) fn not_finite(
        &self,
        at: &Batch,
        values: &[f64],
        results: &[f64],
        count: usize,
    ) -> Option<Failure> {
        let rows = at.len();
        let mut columns = self.kind.results().iter().zip(results.chunks_exact(rows));
        columns.find_map(|(&result, column)| {
            let row = column[..count].iter().position(|value| !value.is_finite())?;
            let columns = self.kind.arguments().iter().zip(at.columns().chunks_exact(rows));
            let seen = columns.map(|(one, column)| (one.name(), column[row])).collect();
            let cause = Cause::NotFinite { result, value: column[row], seen };
            Some(self.failure(values, cause))
        })
    }
}
