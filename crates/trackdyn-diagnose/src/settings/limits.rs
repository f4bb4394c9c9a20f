//! How far intervals and detection limits reach.

use trackdyn_core::settings_group;

settings_group! {
    /// How far intervals and detection limits reach.
    Limits {
        /// z of a detectable effect.
        min_detected_z: f64 = 5.0, "sd", [0.0, 100.0],
            "Claims take 4.5 at least.",
            "Lower: verdicts miss what limits promise.";
        /// Error of any time in the model, half an interval.
        clock_error: f64 = 1e-3, "s", [0.0, 1.0],
            "Belts and ground give so long.",
            "Lower: clocks are claimed.";
        /// Fewest blocks or runs of a jackknife.
        min_groups: usize = 6, "", [2.0, 1e4],
            "Student's quantile of fewer is wide.",
            "Higher: drift between runs is overlooked.";
        /// Half intervals by which ln friction surely differs.
        min_level_change: f64 = 1.5, "", [0.0, 100.0],
            "Three standard deviations.",
            "Lower: the corrected vehicle follows chance.";
        /// Most looks for the end of an interval.
        max_looks: usize = 4, "", [1.0, 100.0],
            "A cap: the tolerance ends them.";
        /// Part of its width to which an end is found.
        end_tolerance: f64 = 0.03, "", [1e-6, 1.0],
            "Widths are known no better.";
        /// Growth from look to look.
        max_look_growth: f64 = 2.0, "", [1.0, 100.0],
            "Likelihoods flatten.";
    }
}
