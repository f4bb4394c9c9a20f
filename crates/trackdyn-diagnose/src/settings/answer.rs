//! Which effects are one answer together.

use trackdyn_core::settings_group;

settings_group! {
    /// Which effects are one answer together.
    Answer {
        /// ln likelihood within which two hypotheses are one answer.
        max_ln_likelihood_gap: f64 = 3.0, "", [0.0, 1e3],
            "Odds of 20.",
            "Lower: one of two alike is named; higher: too many.";
        /// Distance below which two effects are one answer, or what filed laws leave.
        min_separation: f64 = 3.0, "sd", [0.0, 100.0],
            "Chance: 0.3 %.",
            "Lower: one of two alike is named; higher: too many.";
        /// Rivals refitted, and as many of constant ICRs.
        max_rivals: usize = 3, "", [0.0, 100.0],
            "Each takes a simulation.",
            "Lower: members are missing.";
        /// Part of the gain that a rival must reach in the screen.
        min_rival_gain: f64 = 0.85, "", [0.0, 1.0],
            "Room for the screen's error.",
            "Higher: rivals go unasked.";
        /// That part for encoders and sensors.
        min_instrument_gain: f64 = 0.5, "", [0.0, 1.0],
            "Their signatures are taken far off.",
            "Higher: clocks go unasked.";
        /// Most effects named for winning in turn.
        max_unstable: usize = 3, "", [1.0, 100.0],
            "More is no answer.",
            "Lower: true classes are refused.";
        /// Resampled recordings.
        resamples: usize = 200, "", [10.0, 1e6],
            "A share of 0.9 is known to 0.02.",
            "Lower: the seed decides.";
        /// Own part of a squared signature up to which an effect is constant.
        max_constant_share: f64 = 0.03, "", [0.0, 1.0],
            "Only long recordings show less.",
            "Lower: one law is named for all.";
        /// Own part up to which it mostly is.
        max_mostly_constant_share: f64 = 0.1, "", [0.0, 1.0],
            "Three times that.",
            "Higher: constants explain too much.";
        /// ln likelihood that a member may lack for each unknown fewer.
        constants_allowance: f64 = 2.0, "", [0.0, 100.0],
            "Chance gives one half.",
            "Lower: members are missing.";
    }
}
