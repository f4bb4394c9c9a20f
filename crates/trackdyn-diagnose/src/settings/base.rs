//! What is free in every hypothesis.

use trackdyn_core::settings_group;

settings_group! {
    /// What is free in every hypothesis.
    Base {
        /// Deviation of the ICR distance from which turning is unknown.
        max_gap_deviation: f64 = 0.2, "gauge", [1e-3, 10.0],
            "Without evidence it is 0.71.",
            "Higher: straight driving is diagnosed.";
        /// Own part of a free instrument's squared signature.
        min_own_share: f64 = 0.02, "", [0.0, 1.0],
            "Less is not told apart.",
            "Higher: sensor errors look like physics.";
        /// Posterior over prior deviation up to which friction or centre of gravity is free.
        max_known_share: f64 = 0.5, "", [0.0, 1.0],
            "Evidence then beats the owner.",
            "Lower: wrong friction looks like physics.";
        /// Fall of twice the misfit that gives constant ICRs another meaning.
        min_fall_of_calibration: f64 = 1.0, "", [0.0, 1e6],
            "One standard deviation.",
            "Higher: a wrong centre of gravity stands.";
    }
}
