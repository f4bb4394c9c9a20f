//! A law of a user: its card and its function.

use super::declared::{check, lasting};
use super::{Argument, Batch, Cause, Declared, DefinitionError, Failure, Kind, Results};
use crate::effect::{Card, Stage, Symmetry};
use std::error::Error;
use std::fmt;
use std::sync::Arc;

/// What a function of a user returns: nothing, or why it cannot be evaluated.
pub type Outcome = Result<(), Box<dyn Error + Send + Sync>>;

/// What a law adds at states with these values of its parameters.
type Function = dyn Fn(&Batch, &[f64], &mut Results) -> Outcome + Send + Sync;

/// A law of a user.
pub struct CustomLaw {
    kind: Kind,
    card: Card,
    function: Box<Function>,
    /// Places of the arguments by which it is differentiated.
    sought: Vec<usize>,
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
        let sought = arguments.filter(|(_, one)| one.is_sought()).map(|(place, _)| place);
        Ok(Self { kind, card, function: Box::new(function), sought: sought.collect() })
    }

    /// Says what the function reads: it is differentiated by nothing else, which is faster.
    #[must_use]
    pub fn reading(mut self, arguments: &[Argument]) -> Self {
        let all = self.kind.arguments();
        self.sought.retain(|place| arguments.contains(&all[*place]));
        self
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

    /// Places of the arguments by which it is differentiated.
    pub(super) fn sought(&self) -> &[usize] {
        &self.sought
    }

    /// What it adds at states, with values of its parameters.
    pub(super) fn results(&self, at: &Batch, values: &[f64]) -> Result<Vec<f64>, Failure> {
        let rows = at.len();
        let mut results = vec![self.kind.nothing(); rows * self.kind.results().len()];
        (self.function)(at, values, &mut Results::new(rows, &mut results))
            .map_err(|cause| self.failure(values, Cause::Raised(Arc::from(cause))))?;
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
