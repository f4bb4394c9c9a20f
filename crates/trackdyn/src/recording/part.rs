//! Parts of a recording.

use trackdyn_recording::RunList;

/// Which part of a recording counts. Default: all of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// These runs only.
    pub runs: Option<RunList>,
    /// This time of each run only, s from its first reading.
    pub time: Option<[f64; 2]>,
}

impl Part {
    /// Names of the settings that leave something out.
    pub(crate) fn given(&self) -> Vec<&'static str> {
        let given = [("runs", self.runs.is_some()), ("time", self.time.is_some())];
        given.into_iter().filter_map(|(name, given)| given.then_some(name)).collect()
    }
}
