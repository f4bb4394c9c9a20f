//! Which hypotheses are refitted and kept.

use trackdyn_core::settings_group;

settings_group! {
    /// Which hypotheses are refitted and kept.
    Search {
        /// Most effects that are added.
        max_effects: usize = 3, "", [0.0, 10.0],
            "More are hardly told apart.",
            "Lower: the last go unnamed; higher: they mimic forms.";
        /// ln evidence for which an effect is kept.
        min_ln_evidence: f64 = 3.0, "", [0.0, 1e3],
            "Less than a claim needs.",
            "Higher: weak effects never come up.";
        /// z from which a variant is refined.
        min_refined_z: f64 = 3.0, "", [0.0, 100.0],
            "Chance seldom reaches it.",
            "Higher: patches between places are missed.";
        /// Best effects that are screened in pairs.
        max_paired: usize = 12, "", [2.0, 100.0],
            "66 pairs.",
            "Lower: what shows only together is missed.";
        /// Singles refitted in a round.
        max_refitted_singles: usize = 8, "", [1.0, 100.0],
            "Each takes a simulation.",
            "Lower: look-alikes win.";
        /// Pairs refitted in a round.
        max_refitted_pairs: usize = 2, "", [0.0, 100.0],
            "Each takes a simulation.",
            "Lower: look-alikes win.";
        /// Exchanges refitted for each effect.
        max_refitted_exchanges: usize = 2, "", [0.0, 100.0],
            "Each takes a simulation.",
            "Lower: look-alikes win.";
        /// Part of an effect's gain that a substitute must promise.
        min_relative_gain: f64 = 0.8, "", [0.0, 1.0],
            "Room for the screen's error.",
            "Higher: the truth is passed over.";
        /// Part of min_ln_evidence that the screen must promise.
        min_promised_share: f64 = 0.7, "", [0.0, 1.0],
            "Refits may gain.",
            "Higher: weak effects are missed.";
        /// Most rounds.
        max_rounds: usize = 5, "", [1.0, 100.0],
            "Three add an effect, two exchange.",
            "Lower: a wrong first effect stays.";
        /// ln evidence that a round must gain.
        min_round_gain: f64 = 0.5, "", [0.0, 100.0],
            "Other starts end as far apart.",
            "Lower: rounds circle.";
        /// Part of a promise below which a refit restarts.
        min_kept_share: f64 = 0.5, "", [0.0, 1.0],
            "A crest may lie between.",
            "Lower: wrong minima stand.";
        /// Share of the sizes at a restart.
        near_start: f64 = 0.3, "", [0.01, 1.0],
            "Before most crests.",
            "Higher: it starts beyond them.";
        /// Rise of twice the objective by added effects that restarts a fit at none.
        max_rise_of_nested: f64 = 0.1, "", [0.0, 100.0],
            "Rounding, and the descent's end.",
            "Higher: effects are lost in worse minima.";
        /// Relative rise of the objective up to which a hypothesis without an effect gets own
        /// beginnings.
        max_rise_by_starts: f64 = 0.3, "", [0.0, 1e6],
            "Beginnings explain no more.",
            "Lower: beginnings are claimed as effects; higher: slower.";
        /// Mass over friction, against the file's, at which Newton's law is tried.
        newton_levels: [f64; 4] = [0.3, 1.0, 3.0, 9.0], "", [1e-3, 10.0],
            "A factor of 30.",
            "A robot on ice keeps a late clock.";
        /// ICR offset that the vehicle need not take over.
        max_offset: f64 = 5e-3, "gauge", [1e-6, 1.0],
            "It is hardly noticed.",
            "Higher: sizes are off.";
        /// Most rounds in which it takes one over.
        recalibrations: usize = 2, "", [0.0, 100.0],
            "A cap: the offset ends them.";
        /// Fall of twice the misfit that gives constant ICRs another meaning.
        min_fall_of_meaning: f64 = 4.0, "", [0.0, 1e6],
            "Two standard deviations.",
            "Higher: a wrong centre of gravity stays.";
    }
}
