//! What a claim must reach.

use trackdyn_core::settings_group;

settings_group! {
    /// What a claim must reach: each of these rules can refuse it.
    Verdict {
        /// Largest family-wise probability that chance scores as high.
        max_p: f64 = 0.01, "", [0.0, 1.0],
            "One false claim in 100 complete models.",
            "Higher: chance is claimed.";
        /// Smallest ln Bayes factor against the best other answer.
        min_ln_bayes_factor: f64 = 5.0, "", [0.0, 1e4],
            "Odds of 150.",
            "Lower: neighbours are claimed; higher: weak effects are refused.";
        /// Smallest gain on blocks left out, in standard errors.
        min_held_out_gain: f64 = 2.0, "", [0.0, 100.0],
            "Placebos in coloured noise pass weaker rules.",
            "Lower: slow drift is claimed.";
        /// Fewest blocks of time that show it, where p refuses it.
        min_blocks: f64 = 3.0, "", [0.0, 1e3],
            "Two may meet one event.",
            "Lower: what was met once passes for chance.";
        /// Smallest share of resampled recordings that name the same.
        min_stability: f64 = 0.9, "", [0.0, 1.0],
            "Other drives would too.",
            "Lower: one of several is claimed.";
        /// Part to which a law's form, or a filed size, is known.
        max_form_error: f64 = 0.1, "", [0.0, 1.0],
            "Laws are known no better.",
            "Lower: remainders of large effects are claimed; higher: second effects are refused.";
        /// Part by which a filed size must change.
        min_filed_change: f64 = 0.5, "", [0.0, 10.0],
            "Shear laws shift other sizes.",
            "Lower: filed laws are claimed anew.";
        /// Smallest difference of constant ICRs from the file's.
        min_icr_difference: f64 = 0.01, "gauge", [0.0, 1.0],
            "Shoes and tyres vary so.",
            "Lower: every robot has a wrong constant.";
    }
}
