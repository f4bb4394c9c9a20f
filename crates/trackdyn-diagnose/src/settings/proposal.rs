//! When a form is proposed for what no effect explains.

use trackdyn_core::settings_group;

settings_group! {
    /// When a form is proposed for what no effect explains.
    Proposal {
        /// Most terms of a law.
        max_terms: usize = 3, "", [1.0, 20.0],
            "More describe noise.",
            "Higher: laws do not carry over.";
        /// Family-wise p from which a symmetry is clearly kept.
        min_p_kept: f64 = 0.1, "", [0.0, 1.0],
            "Ten times a broken one's.",
            "Lower: terms break whole symmetries.";
        /// Part of the left-over departure that a law may leave.
        max_remainder: f64 = 0.5, "", [0.0, 1.0],
            "It explains most of it.",
            "Higher: empty laws are proposed.";
    }
}
