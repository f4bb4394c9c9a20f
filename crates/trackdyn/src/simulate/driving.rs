//! What the tracks do.

use crate::Error;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use trackdyn_drive::schedules::{self, ScheduleKind, ScheduleOptions, ScheduledRun};

/// What the tracks do.
#[derive(Clone, Debug, PartialEq)]
pub enum Driving {
    /// Generated.
    Generated(ScheduleKind),
    /// A table t,v_left,v_right, and run where there are several.
    File(PathBuf),
    /// These runs.
    Runs(Vec<ScheduledRun>),
}

impl Default for Driving {
    /// Driven by hand, as the paths from which Martínez et al. (2005) identify.
    fn default() -> Self {
        Self::Generated(ScheduleKind::Manual)
    }
}

impl Driving {
    /// Refuses a setting of driving that is generated, where there is nothing to generate.
    pub(super) fn refuse(&self, given: Option<&'static str>) -> Result<(), Error> {
        match (self, given) {
            (Self::File(path), Some(setting)) if path.exists() => {
                Err(Error::GeneratedOnly { setting, driving: self.to_string() })
            }
            (Self::Runs(_), Some(setting)) => {
                Err(Error::GeneratedOnly { setting, driving: self.to_string() })
            }
            _ => Ok(()),
        }
    }

    /// The schedules; the options count for driving that is generated.
    pub(super) fn schedules(&self, options: &ScheduleOptions) -> Result<Vec<ScheduledRun>, Error> {
        Ok(match self {
            Self::Generated(kind) => kind.generate(options)?,
            Self::File(path) => schedules::read(path)?,
            Self::Runs(runs) => runs.clone(),
        })
    }
}

impl FromStr for Driving {
    type Err = Error;

    /// The name of driving that is generated, or a file.
    fn from_str(choice: &str) -> Result<Self, Error> {
        let file = Path::new(choice);
        match choice.parse() {
            Ok(kind) => Ok(Self::Generated(kind)),
            Err(_) if file.exists() || file.extension().is_some() => {
                Ok(Self::File(file.to_owned()))
            }
            Err(unknown) => Err(unknown.into()),
        }
    }
}

impl fmt::Display for Driving {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Generated(kind) => f.write_str(kind.name()),
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Runs(runs) => write!(f, "{} runs", runs.len()),
        }
    }
}
