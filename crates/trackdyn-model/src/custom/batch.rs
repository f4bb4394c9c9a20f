//! States in columns of one length, and what a law adds at them.

use super::{Argument, Kind};

/// What a law sees: a column for each argument, with a row for each state.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    kind: Kind,
    rows: usize,
    /// All columns, one behind the other.
    columns: &'a [f64],
}

impl<'a> Batch<'a> {
    pub(super) fn new(kind: Kind, rows: usize, columns: &'a [f64]) -> Self {
        Self { kind, rows, columns }
    }

    /// Number of states.
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// All columns, one behind the other, in the order of [`Kind::arguments`].
    pub fn columns(&self) -> &'a [f64] {
        self.columns
    }

    /// The column of an argument; empty where a law of this kind does not see it.
    pub fn column(&self, argument: Argument) -> &'a [f64] {
        let place = self.kind.arguments().iter().position(|one| *one == argument);
        place.map_or(&[], |place| &self.columns[place * self.rows..][..self.rows])
    }
}

/// What a law adds: a column for each of [`Kind::results`], with a row for each state. They begin
/// with what does nothing: no force, or factors of one.
#[derive(Debug)]
pub struct Results<'a> {
    rows: usize,
    columns: &'a mut [f64],
    /// Arguments that the function read, a bit for each place; none where it does not tell.
    pub(super) read: Option<u32>,
}

impl<'a> Results<'a> {
    pub(super) fn new(rows: usize, columns: &'a mut [f64]) -> Self {
        Self { rows, columns, read: None }
    }

    /// Says which arguments the function read for this call: a bit for each place in
    /// [`Kind::arguments`]. A function that never says so is taken to read all of them.
    pub fn read(&mut self, places: u32) {
        self.read = Some(self.read.unwrap_or(0) | places);
    }

    /// All columns, one behind the other.
    pub fn columns(&mut self) -> &mut [f64] {
        self.columns
    }

    /// The column of this place in [`Kind::results`]; empty where there is none.
    pub fn column(&mut self, place: usize) -> &mut [f64] {
        self.columns.chunks_exact_mut(self.rows).nth(place).unwrap_or_default()
    }
}
