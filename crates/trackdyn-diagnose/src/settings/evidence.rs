//! What counts as evidence, and what its residuals weigh.

use super::group::group;

group! {
    /// What counts as evidence, and what its residuals weigh.
    Evidence {
        /// Fewest segments of a recording.
        min_segments: usize = 60, "", [2.0, 1e6],
            "16 s of driving.",
            "Lower: noise and ICRs are hardly known.";
        /// Fewest points of a table.
        min_points: usize = 30, "", [3.0, 1e6],
            "Ten per ICR coordinate.",
            "Lower: scatter is hardly known.";
        /// Blocks of a table.
        max_table_blocks: usize = 48, "", [2.0, 1e4],
            "As of a recording.",
            "Higher: neighbours that shift alike pass for independent.";
        /// Reach of a fitted clock beyond the recording's own offset.
        clock_margin: f64 = 0.15, "s", [0.0, 10.0],
            "Clocks found without a model err less.",
            "Lower: late clocks end at the limit.";
        /// Largest coordinate of a pose.
        max_coordinate: f64 = 1000.0, "m", [1.0, 1e9],
            "Effects have no place farther out.",
            "Higher: places are sought in vain.";
        /// Shortest time between track readings; closer ones are averaged.
        min_reading_interval: f64 = 0.01, "s", [0.0, 1.0],
            "Motions in time step as long.",
            "Higher: quick changes vanish.";
        /// Distance of the ICRs of a robot that never spins.
        gap_without_spins: f64 = 1.5, "gauge", [0.5, 20.0],
            "Common on hard ground.",
            "Yaw noise starts off.";
        /// Whitened residual beyond which loss is linear.
        huber_threshold: f64 = 3.4, "sd", [0.5, 1e9],
            "1 % of normal ones are longer.",
            "Lower: power is lost; higher: outliers look like physics.";
        /// Rise of twice the misfit at which cleaned readings stand.
        max_rise_by_cleaning: f64 = 4.0, "", [0.0, 1e6],
            "Two standard deviations.",
            "Lower: jitter looks like a lag.";
        /// First and last power of √10 for smoothing ticks.
        smoothing_powers: [f64; 2] = [-4.0, 10.0], "", [-20.0, 20.0],
            "The last spans forty readings.";
        /// Smallest step of speed that is a tick.
        min_speed_step: f64 = 1e-5, "m/s", [0.0, 1.0],
            "Less is rounding.";
        /// Frequencies to sum a smoother's freedom.
        smoothing_frequencies: usize = 512, "", [8.0, 1e5],
            "Exact to 1e-3.";
        /// Duration of a steady point.
        instant: f64 = 1e-6, "s", [1e-9, 1e-3],
            "Motion is velocity times time.";
    }
}
