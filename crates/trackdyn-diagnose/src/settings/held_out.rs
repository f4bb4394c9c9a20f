//! Which runs the result is judged on.

use trackdyn_core::settings_group;

settings_group! {
    /// Which runs, or points of a table, the result is judged on, unless the caller says which.
    HeldOut {
        /// Fewest runs of which some are held out.
        min_runs: usize = 8, "", [2.0, 1e6],
            "Of fewer, none can be spared.",
            "Lower: too little is left to fit.";
        /// Every so many runs, the last is held out.
        every: usize = 4, "", [2.0, 1e6],
            "Three quarters are fitted.",
            "Lower: less is fitted; higher: chance judges.";
    }
}

impl HeldOut {
    /// Indices of those held out, of so many runs or points.
    pub fn of(&self, count: usize) -> Vec<usize> {
        if count < self.min_runs {
            return Vec::new();
        }
        (self.every - 1..count).step_by(self.every).collect()
    }
}
