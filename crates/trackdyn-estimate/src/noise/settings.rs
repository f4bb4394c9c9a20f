//! How noise is measured without a model.

use crate::variances::MIN_GAIN;
use trackdyn_core::settings_group;

settings_group! {
    /// How noise is measured on what driving cannot explain, before any model.
    Settings {
        /// Fewest triples behind a figure.
        min_triples: usize = 30, "", [3.0, 1e6],
            "Their median is known to a fifth.",
            "Lower: chance sets the noise.";
        /// Longest triple of poses.
        max_duration: f64 = 2.5, "s", [0.01, 1e3],
            "Robots drive evenly for as long.",
            "Higher: driving looks like noise.";
        /// Largest turn between two poses of a triple.
        max_turn: f64 = 1.0, "rad", [0.01, 3.0],
            "Noise is propagated for small turns.",
            "Higher: turns look like noise.";
        /// Time from the tracks' stop until poses stand still.
        settling_time: f64 = 0.5, "s", [0.0, 1e3],
            "Delays of poses are shorter.",
            "Lower: stopping looks like noise.";
        /// Largest speed difference of a triple's halves.
        max_speed_change: f64 = 2.0, "sd", [0.1, 100.0],
            "One even triple of 20 differs by more.",
            "Higher: driving looks like noise.";
        /// Student's degrees of freedom in the test for stamp errors.
        tails: f64 = 5.0, "", [1.0, 1e6],
            "Outliers then count little.",
            "Higher: outliers look like late stamps.";
        /// Gain of ln likelihood from which stamps have errors.
        min_stamp_gain: f64 = MIN_GAIN, "", [0.0, 1e6],
            "Chance: 1e-4.",
            "Lower: white noise looks like late stamps.";
        /// Most triples tested for stamp errors.
        max_stamp_triples: usize = 4000, "", [30.0, 1e7],
            "They tell the noise to a percent.";
        /// Longest time that a measured track speed stays unchanged.
        max_hold_time: f64 = 0.5, "s", [0.0, 1e3],
            "What stays longer is a command.",
            "Higher: commands look like noise.";
        /// Most readings for which it does.
        max_hold_readings: f64 = 10.0, "", [1.0, 1e6],
            "What stays longer is a command.",
            "Higher: commands look like noise.";
        /// Fewest triples of neighbours in a table of steady points.
        min_line_triples: usize = 10, "", [3.0, 1e6],
            "Tables are small.",
            "Lower: chance sets their scatter.";
    }
}
