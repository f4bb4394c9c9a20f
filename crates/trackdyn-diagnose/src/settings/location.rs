//! Which symmetries the evidence breaks.

use super::group::group;

group! {
    /// Which symmetries the evidence breaks.
    Location {
        /// Largest family-wise p of a broken symmetry.
        max_p: f64 = 0.01, "", [0.0, 1.0],
            "One false alarm in 100 recordings.",
            "Higher: chance is located.";
        /// That of what a corrected model leaves.
        max_p_left_over: f64 = 0.001, "", [0.0, 1.0],
            "Simulators are not the ground.",
            "Higher: good answers are flagged; lower: unknown physics is not.";
        /// Part of the departure that laws may leave in a symmetry.
        max_form_left: f64 = 0.2, "", [0.0, 1.0],
            "Twice a form's error.",
            "Higher: unknown physics goes unflagged.";
        /// Part of the squared noise that may be left in one.
        max_noise_left: f64 = 0.01, "", [0.0, 1.0],
            "Long recordings show any simulator's error.",
            "Lower: the simulator is flagged.";
        /// Draws of signs.
        draws: usize = 2000, "", [99.0, 1e7],
            "p reaches 0.0005.",
            "Lower: nothing is ever left over.";
        /// Slower over faster track, straight driving from here.
        min_straight_ratio: f64 = 0.9, "", [0.0, 1.0],
            "ICRs hardly show.",
            "Lower: arcs count as straight.";
        /// That of spins, up to here.
        max_spin_ratio: f64 = -0.7, "", [-1.0, 0.0],
            "Tracks never match exactly.",
            "Higher: counter-rotation counts as spins.";
        /// Part of the largest speed at which a track runs.
        min_running_speed: f64 = 0.02, "", [0.0, 1.0],
            "Standing encoders flicker less.",
            "Lower: flicker counts as turning round.";
        /// Times in which the past is forgotten.
        memories: [f64; 2] = [3.0, 12.0], "s", [1e-3, 1e6],
            "Sloshing; soil and belts.",
            "Other memories show less.";
        /// Shortest wave of the ground.
        min_wavelength: f64 = 0.5, "m", [0.01, 1e3],
            "Contacts average over less.",
            "Higher: washboard is missed.";
        /// Most waves.
        max_waves: usize = 1500, "", [1.0, 1e6],
            "Chance grows with their number.",
            "Lower: short waves of large areas are missed.";
        /// Wave numbers per length of the area.
        waves_per_length: f64 = 1.3, "", [0.1, 10.0],
            "Half-way three quarters are kept.",
            "Lower: waves fall between.";
        /// Poses outside of the area, at each end.
        outer_share: f64 = 0.01, "", [0.0, 0.4],
            "1 % may be stray.",
            "Lower: stray poses coarsen waves.";
        /// Known beforehand where other blocks judge one.
        score_ridge: f64 = 0.1, "", [1e-6, 10.0],
            "Holds unknown sizes at none.",
            "Lower: one block's news looks certain.";
        /// Fewest samples for a manoeuvre to be the worst.
        min_samples_named: usize = 20, "", [1.0, 1e6],
            "Known to a fifth.",
            "Lower: outliers name it.";
        /// Fewest samples of a cell in pictures.
        min_samples_shown: usize = 12, "", [3.0, 1e6],
            "Four per coordinate.";
        /// Smallest eigenvalue of contrasts over the largest.
        min_eigenvalue: f64 = 1e-6, "", [0.0, 1.0],
            "Less is rounding.";
    }
}
