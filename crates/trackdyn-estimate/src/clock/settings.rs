//! How the clock offset is found.

use trackdyn_core::settings_group;

settings_group! {
    /// How the clock offset of the poses is found.
    Settings {
        /// Smallest offset of the first search.
        earliest: f64 = -0.5, "s", [-1e4, 0.0],
            "Poses are seldom early.",
            "Higher: a later search finds early peaks.";
        /// Largest offset of the first search.
        latest: f64 = 1.0, "s", [0.0, 1e4],
            "Most filters answer within a second.",
            "Lower: a later search finds late peaks.";
        /// Largest offset searched where these two enclose no clear peak.
        farthest: f64 = 60.0, "s", [0.0, 1e6],
            "Clocks without a server drift by a minute.",
            "Lower: these are refused; higher: repeated driving looks like an offset.";
        /// Largest offset of a clear peak where all of these are unclear.
        last: f64 = 600.0, "s", [0.0, 1e6],
            "Clocks set by hand.",
            "Lower: such clocks are refused.";
        /// Quicker poses are averaged.
        min_pose_interval: f64 = 0.05, "s", [0.0, 10.0],
            "A robot hardly turns between them.",
            "Lower: noise hides the turning.";
        /// Step of a search.
        step: f64 = 0.02, "s", [1e-3, 1.0],
            "Peaks are wider.";
        /// Step beyond the first search.
        far_step: f64 = 0.1, "s", [1e-3, 10.0],
            "Robots turn for longer.",
            "Higher: peaks lie between.";
        /// Fewest pose intervals.
        min_intervals: usize = 20, "", [4.0, 1e6],
            "Fewer agree by chance.",
            "Lower: chance sets the clock.";
        /// Smallest correlation of tracks and poses.
        min_correlation: f64 = 0.5, "", [0.0, 1.0],
            "Other pairs of signals reach it seldom.",
            "Lower: unlike columns get an offset; higher: noisy poses get none.";
        /// Correlation of a peak that ends the search.
        min_clear_correlation: f64 = 0.95, "", [0.0, 1.0],
            "Repeated driving seldom reaches it.",
            "Lower: a peak of chance is taken; higher: far ones are.";
        /// Share of pose intervals that such a peak uses.
        min_clear_share: f64 = 0.5, "", [0.0, 1.0],
            "Some poses may agree by chance.",
            "Lower: a short overlap sets the clock.";
        /// Variance that a far peak may leave, over that of the first.
        max_left_by_far_peak: f64 = 0.5, "", [0.0, 1.0],
            "Peaks of repeated driving are hardly higher.",
            "Higher: they are taken.";
        /// Most pose intervals of a wide search.
        max_intervals: usize = 2000, "", [20.0, 1e7],
            "A peak shows in a part of them.";
        /// Farthest step uphill from an end of the first search.
        uphill_reach: f64 = 1.0, "s", [0.02, 1e3],
            "As far as the first search.",
            "Lower: it stops at a side peak.";
        /// Smallest share of pose intervals at a far offset.
        min_share: f64 = 0.3, "", [0.0, 1.0],
            "A late clock cuts off an end.",
            "Lower: a short overlap sets the clock.";
        /// Largest standard error of a known offset.
        max_error: f64 = 0.5, "s", [1e-6, 1e4],
            "As far as offsets usually are.",
            "Higher: the offset is a guess.";
        /// Duration over which residuals may be correlated.
        block_duration: f64 = 5.0, "s", [0.1, 1e4],
            "Robots turn for seconds.",
            "Lower: the standard error is too small.";
        /// Longest interval of changes of the track speeds that keeps instruments apart.
        max_update_interval: f64 = 0.5, "s", [0.0, 1e3],
            "Slower changes are commands, without noise.",
            "Higher: few pose intervals are left.";
    }
}
