//! Which hypotheses are refitted and kept.

use super::group::group;

group! {
    /// Which hypotheses are refitted and kept.
    Search {
        /// Most effects added.
        max_effects: usize = 3, "", [0.0, 10.0],
            "More are hardly told apart.",
            "Lower: the last go unnamed; higher: they mimic forms.";
        /// ln evidence that keeps an effect.
        min_ln_evidence: f64 = 3.0, "", [0.0, 1e3],
            "Less than a claim needs.",
            "Higher: weak effects never come up.";
        /// z that lets a variant be refined.
        min_refined_z: f64 = 3.0, "", [0.0, 100.0],
            "Beyond chance.",
            "Higher: patches between are missed.";
        /// Effects screened in pairs.
        max_paired: usize = 12, "", [2.0, 100.0],
            "66 pairs.",
            "Lower: what shows only together is missed.";
        /// Singles refitted in a round.
        max_refitted_singles: usize = 3, "", [1.0, 100.0],
            "The truth ranks so high.",
            "Lower: look-alikes win.";
        /// Pairs refitted.
        max_refitted_pairs: usize = 2, "", [0.0, 100.0],
            "Likewise.",
            "Likewise.";
        /// Exchanges refitted per effect.
        max_refitted_exchanges: usize = 2, "", [0.0, 100.0],
            "Likewise.",
            "Likewise.";
        /// Part of the best gain that lets others be refitted.
        min_relative_gain: f64 = 0.8, "", [0.0, 1.0],
            "The screen errs by a fifth.",
            "Higher: the truth is passed over.";
        /// Part of min_ln_evidence that the screen must promise.
        min_promised_share: f64 = 0.7, "", [0.0, 1.0],
            "Refits may gain.",
            "Higher: weak effects are missed.";
        /// Most rounds.
        max_rounds: usize = 5, "", [1.0, 100.0],
            "Three effects, two exchanges.",
            "Lower: a wrong first effect stays.";
        /// ln evidence a round must gain.
        min_round_gain: f64 = 0.5, "", [0.0, 100.0],
            "Fits differ by less.",
            "Lower: rounds circle.";
        /// Part of a promise below which a refit restarts.
        min_kept_share: f64 = 0.5, "", [0.0, 1.0],
            "A crest lies between.",
            "Lower: wrong minima stand.";
        /// Share of the sizes at a restart.
        near_start: f64 = 0.3, "", [0.01, 1.0],
            "Before most crests.",
            "Higher: beyond the crest.";
        /// Offset of an ICR that the vehicle leaves.
        max_offset: f64 = 5e-3, "gauge", [1e-6, 1.0],
            "Hardly noticed.",
            "Higher: sizes are off.";
        /// Rounds in which it takes over.
        recalibrations: usize = 2, "", [0.0, 100.0],
            "A third changes nothing.";
        /// Fall of twice the misfit for another meaning of constant ICRs.
        min_fall_of_meaning: f64 = 4.0, "", [0.0, 1e6],
            "Two standard deviations.",
            "Higher: a wrong centre of gravity stays.";
    }
}
