//! Exit status of the program.

use std::error::Error;
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

impl Exit {
    /// How a run ended that an error ended.
    pub fn of(error: &(dyn Error + 'static)) -> Self {
        let of_library = error.downcast_ref::<trackdyn::Error>();
        let is_no_result = of_library.is_some_and(trackdyn::Error::is_no_result);
        if is_no_result { Self::NoResult } else { Self::BadInput }
    }
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
