//! How far dead reckoning leads astray.

use trackdyn_core::settings_group;

settings_group! {
    /// How drift of dead reckoning is measured.
    Drift {
        /// Lengths of the pieces; the first with enough pieces counts.
        distances: [f64; 7] = [100.0, 50.0, 20.0, 10.0, 5.0, 2.0, 1.0], "m", [1e-3, 1e6],
            "Errors of heading show over a distance.",
            "Shorter: errors of heading hide.";
        /// Angles of the pieces, likewise.
        angles: [f64; 3] = [1.0, 0.5, 0.25], "turns", [1e-3, 1e3],
            "From a whole turn on, sides look alike.",
            "Smaller: noise of the poses shows.";
        /// Fewest pieces.
        min_pieces: usize = 10, "", [2.0, 1e6],
            "Of fewer, one weighs more than a tenth.",
            "Lower: single errors set the drift.";
        /// Step between delays of the poses that a replay tries.
        delay_step: f64 = 0.01, "s", [1e-4, 1.0],
            "Readings at 100 Hz.";
    }
}
