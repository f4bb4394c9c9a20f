//! How far intervals and detection limits reach.

use super::group::group;

group! {
    /// How far intervals and detection limits reach.
    Limits {
        /// Size of a detectable effect.
        min_detected_z: f64 = 5.0, "sd", [0.0, 100.0],
            "What claims take.",
            "Lower: verdicts miss what limits promise.";
        /// Error of any time, half an interval.
        clock_error: f64 = 1e-3, "s", [0.0, 1.0],
            "Belts give so long.",
            "Lower: clocks are claimed.";
        /// Fewest blocks or runs of a jackknife.
        min_groups: usize = 6, "", [2.0, 1e4],
            "Student's quantile.",
            "Higher: drift between runs is overlooked.";
        /// Half intervals by which ln friction surely differs.
        min_level_change: f64 = 1.5, "", [0.0, 100.0],
            "Three standard deviations.",
            "Lower: the corrected vehicle follows chance.";
        /// Excess over the squared noise floor to share out.
        min_excess: f64 = 1e-3, "", [0.0, 1.0],
            "Noise over noise.",
            "Lower: shares without sense.";
        /// Looks for an interval's end.
        max_looks: usize = 4, "", [1.0, 100.0],
            "Most take two.";
        /// Part of the width that may be off.
        end_tolerance: f64 = 0.03, "", [1e-6, 1.0],
            "Known to a tenth.";
        /// Growth from look to look.
        max_look_growth: f64 = 2.0, "", [1.0, 100.0],
            "Likelihoods flatten.";
    }
}
