//! When two sets of recordings differ.

use trackdyn_core::settings_group;

settings_group! {
    /// How two sets of recordings are compared; most rules are those of claims.
    Comparison {
        /// Deviations of chi-squared by which free numbers explain more by chance.
        max_chance: f64 = 3.0, "sd", [0.0, 100.0],
            "Chance: 0.3 %.",
            "Lower: chance looks like a difference; higher: differences hide.";
        /// Typical difference of constant ICRs, by which one is measured.
        icr_difference: f64 = 0.1, "gauge", [1e-3, 10.0],
            "Simulators and robots differ so.",
            "Lower: small differences outweigh effects.";
    }
}
