//! Which symmetries the evidence breaks.

use trackdyn_core::settings_group;

settings_group! {
    /// Which symmetries the evidence breaks.
    Location {
        /// Largest family-wise p of a broken symmetry.
        max_p: f64 = 0.01, "", [0.0, 1.0],
            "One false alarm in 100 recordings.",
            "Higher: chance is located.";
        /// Largest p of what a corrected model leaves.
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
        /// Slower over faster track from which driving is straight.
        min_straight_ratio: f64 = 0.9, "", [0.0, 1.0],
            "ICRs hardly show.",
            "Lower: arcs count as straight.";
        /// That ratio up to which it is a spin.
        max_spin_ratio: f64 = -0.7, "", [-1.0, 0.0],
            "Tracks never match exactly.",
            "Higher: counter-rotation counts as spins.";
        /// Part of the largest speed from which a track runs.
        min_running_speed: f64 = 0.02, "", [0.0, 1.0],
            "Above the flicker of standing encoders.",
            "Lower: flicker counts as turning.";
        /// Times in which the past is forgotten.
        memories: [f64; 2] = [3.0, 12.0], "s", [1e-3, 1e6],
            "Sloshing tanks; warm or worked ground.",
            "Other memories show less.";
        /// Shortest wave of the ground.
        min_wavelength: f64 = 0.5, "m", [0.01, 1e3],
            "Contacts average over less.",
            "Higher: washboard is missed.";
        /// Most waves that are tried.
        max_waves: usize = 1500, "", [1.0, 1e6],
            "Chance grows with their number.",
            "Lower: short waves of large areas are missed.";
        /// Wave numbers per length of the area.
        waves_per_length: f64 = 1.3, "", [0.1, 10.0],
            "Half-way a wave keeps three quarters.",
            "Lower: waves fall between.";
        /// Shortest wave of the belts.
        min_belt_wavelength: f64 = 0.3, "m", [0.01, 1e3],
            "A sprocket of 10 cm turns once.",
            "Higher: a sprocket out of true is missed.";
        /// Way of a belt over which its waves are followed.
        max_belt_way: f64 = 50.0, "m", [1.0, 1e6],
            "Many turns of a sprocket.",
            "Longer: chance grows; shorter: weak ones are missed.";
        /// Fewest waves of a belt within that way.
        min_belt_waves: usize = 3, "", [1.0, 1e3],
            "Fewer look like a trend.",
            "Lower: drift looks like a wave.";
        /// Part of the poses beyond each end of the area.
        outer_share: f64 = 0.01, "", [0.0, 0.4],
            "One in 100 may be stray.",
            "Lower: stray poses make waves coarse.";
        /// Weight of no effect where other blocks judge one.
        score_ridge: f64 = 0.1, "", [1e-6, 10.0],
            "They may know nothing.",
            "Lower: what one block saw looks certain.";
        /// Fewest samples of a manoeuvre named the worst.
        min_samples_named: usize = 20, "", [1.0, 1e6],
            "Their mean is known to a fifth.",
            "Lower: outliers name it.";
        /// Fewest samples of a cell of ICRs in pictures.
        min_samples_shown: usize = 12, "", [3.0, 1e6],
            "Four for each coordinate.";
        /// Prior deviation of the ICRs of such a cell.
        shown_deviation: f64 = 10.0, "m", [1e-3, 1e6],
            "Nothing is known of them.";
    }
}
