//! Failure of a law of a user.

use std::error::Error;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;

/// A law of a user that failed: which one, with which parameters, and why.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Id of the law.
    pub law: String,
    /// Its parameters.
    pub parameters: Vec<(String, f64)>,
    /// Why.
    pub cause: Cause,
}

/// Why a law failed.
#[derive(Clone, Debug)]
pub enum Cause {
    /// The function says that it cannot be evaluated.
    Raised(Arc<dyn Error + Send + Sync>),
    /// A result that is no finite number.
    NotFinite {
        /// Which of [`results`](super::Kind::results).
        result: &'static str,
        /// The value.
        value: f64,
        /// What the law saw.
        seen: Vec<(&'static str, f64)>,
    },
}

impl Failure {
    /// Leaves all work up to [`guarded`].
    pub(super) fn unwind(self) -> ! {
        // no panic: nothing is printed
        resume_unwind(Box::new(self))
    }
}

/// Does work that may evaluate laws of a user.
///
/// # Errors
/// The failure of the first law that failed.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, Box<Failure>> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| match panic.downcast::<Failure>() {
        Ok(failure) => failure,
        Err(other) => resume_unwind(other),
    })
}

/// Names with their values.
fn list<'a>(all: impl Iterator<Item = (&'a str, f64)>) -> String {
    all.map(|(name, value)| format!("{name} = {value}")).collect::<Vec<_>>().join(", ")
}

impl Error for Failure {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match &self.cause {
            Cause::Raised(cause) => Some(&**cause),
            Cause::NotFinite { .. } => None,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parameters = list(self.parameters.iter().map(|(key, value)| (&**key, *value)));
        write!(f, "law \"{}\" ({parameters}): ", self.law)?;
        match &self.cause {
            Cause::Raised(cause) => write!(f, "{cause}"),
            Cause::NotFinite { result, value, seen } => {
                let seen = list(seen.iter().copied());
                let expected = "expected a finite number at every motion, at standstill too";
                write!(f, "{result} {value} at {seen}: {expected}")
            }
        }
    }
}
