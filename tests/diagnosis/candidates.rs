//! Candidates of a diagnosis: their order says nothing, and terms without meaning are not claimed.

mod order;
mod placebo;
