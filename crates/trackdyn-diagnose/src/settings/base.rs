//! What is free in every hypothesis.

use super::group::group;

group! {
    /// What is free in every hypothesis.
    Base {
        /// Deviation of the ICRs' distance from which turning is unknown.
        max_gap_deviation: f64 = 0.2, "gauge", [1e-3, 10.0],
            "Without evidence 0.71.",
            "Higher: straight driving is diagnosed.";
        /// Own part of an instrument's squared signature for it to be free.
        min_own_share: f64 = 0.02, "", [0.0, 1.0],
            "Less is not told apart.",
            "Higher: sensor errors look like physics.";
        /// Part of its prior deviation to which friction or centre of gravity must be known to
        /// be free.
        max_known_share: f64 = 0.5, "", [0.0, 1.0],
            "Evidence beats the owner.",
            "Lower: wrong friction looks like physics.";
        /// Fall of twice the misfit for another meaning of constant ICRs.
        min_fall_of_calibration: f64 = 1.0, "", [0.0, 1e6],
            "One standard deviation.",
            "Higher: a wrong centre of gravity stands.";
        /// Track speeds of the spin that defines constant ICRs.
        spin_speed: f64 = 0.1, "m/s", [1e-3, 10.0],
            "Any will do.";
        /// Rounds to a vehicle of given ICRs.
        calibration_rounds: usize = 20, "", [1.0, 1e3],
            "Most take five.";
        /// Error of an ICR that ends them.
        calibration_tolerance: f64 = 1e-9, "m", [1e-12, 1e-3],
            "Far below sensors.";
        /// Their difference step.
        calibration_difference: f64 = 1e-5, "", [1e-9, 1e-2],
            "Between rounding and curvature.";
        /// Largest steps: ln friction ratio; centre of gravity in gauges.
        calibration_steps: [f64; 2] = [0.5, 0.1], "", [1e-3, 10.0],
            "Longer ones overshoot.";
    }
}
