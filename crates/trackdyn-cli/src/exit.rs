//! Exit status of the program.

use std::process::ExitCode;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: done, and where something was checked, it holds.
    Done,
    /// 1: the input is not usable, or a check does not hold.
    BadInput,
    /// 2: the input is sound, but the computation gave no result.
    NoResult,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::BadInput => 1,
            Exit::NoResult => 2,
        })
    }
}
