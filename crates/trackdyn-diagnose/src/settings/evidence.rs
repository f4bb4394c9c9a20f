//! What counts as evidence, and what its residuals weigh.

use trackdyn_core::settings_group;
use trackdyn_estimate::Blocks;

settings_group! {
    /// What counts as evidence, and what its residuals weigh.
    Evidence {
        /// Fewest segments of a recording.
        min_segments: usize = 60, "", [2.0, 1e6],
            "6 s of poses at 10 Hz.",
            "Lower: noise and ICRs are hardly known.";
        /// Fewest points of a table.
        min_points: usize = 30, "", [3.0, 1e6],
            "Ten for each ICR coordinate.",
            "Lower: their scatter is hardly known.";
        /// Fewest runs that are blocks; fewer are cut into twice as many pieces.
        min_whole_runs: usize = Blocks::MIN_WHOLE_RUNS, "", [2.0, 1e4],
            "Fewer blocks give a poor variance.",
            "Lower: chance passes tests; higher: pieces pass for independent.";
        /// Most blocks of a table.
        max_table_blocks: usize = 48, "", [2.0, 1e4],
            "As for recordings.",
            "Higher: dependent neighbours pass for independent.";
        /// Farthest that a fitted clock goes beyond the recording's offset.
        clock_margin: f64 = 0.15, "s", [0.0, 10.0],
            "It was found without a model.",
            "Lower: late clocks end at the limit.";
        /// Largest coordinate of a pose.
        max_coordinate: f64 = 1000.0, "m", [1.0, 1e9],
            "No effect has a place farther out.",
            "Higher: places are sought in vain.";
        /// Quicker track readings are averaged.
        min_reading_interval: f64 = 0.01, "s", [0.0, 1.0],
            "Motions in time take no shorter steps.",
            "Higher: quick changes vanish.";
        /// Quicker poses are averaged; between slower ones a gyroscope tells yaw.
        min_pose_interval: f64 = 0.1, "s", [0.0, 10.0],
            "Noise of quicker poses is seldom white.",
            "Lower: slow, and filter errors count often; higher: quick changes vanish.";
        /// ICR distance assumed for a robot that never spins.
        gap_without_spins: f64 = 1.5, "gauge", [0.5, 20.0],
            "Usual on hard ground.",
            "Yaw noise starts wrong.";
        /// Whitened residual beyond which the loss is linear.
        huber_threshold: f64 = 3.4, "sd", [0.5, 1e9],
            "1 % of normal ones exceed it.",
            "Lower: power is lost; higher: outliers look like physics.";
        /// Longest update interval of a source that holds its speeds.
        max_held: f64 = 0.5, "s", [0.0, 10.0],
            "Slower ones are commands.",
            "Lower: staircases look like a lag; higher: commands are blurred.";
        /// Changes of a held speed per one that may come early.
        held_changes_per_early_one: usize = 10, "", [1.0, 1e6],
            "Late stamps bring a change early.",
            "Lower: any changing speed is joined.";
        /// Largest rise of twice the misfit by cleaned readings.
        max_rise_by_cleaning: f64 = 4.0, "", [0.0, 1e6],
            "Two standard deviations.",
            "Lower: jitter looks like a lag.";
        /// Prior deviation of a run's first motion, over the fastest speed.
        start_deviation: f64 = 0.5, "", [1e-3, 10.0],
            "A log may begin in a slide.",
            "Lower: earlier slides look like lags; higher: beginnings tell less.";
        /// First track speed, over the fastest, from which a run begins in motion.
        min_start_speed: f64 = 0.05, "", [0.0, 1.0],
            "Beyond encoder noise.",
            "Higher: runs cut in a slide pass for stationary.";
        /// Steps to the first motion of each run.
        start_rounds: usize = 8, "", [1.0, 100.0],
            "Steps that do not help are halved.",
            "Lower: far slides are missed.";
        /// Alternating fits of first motions and of the rest.
        start_repeats: usize = 6, "", [1.0, 100.0],
            "Each depends on the other.";
        /// Fall of twice the misfit that ends them.
        min_fall_by_starts: f64 = 4.0, "", [0.0, 100.0],
            "Two standard deviations.",
            "Lower: slower; higher: beginnings do not suit a hypothesis yet.";
        /// First and last power of √10 tried for smoothing ticks.
        smoothing_powers: [f64; 2] = [-4.0, 10.0], "", [-20.0, 20.0],
            "The last spans forty readings.";
        /// Smallest step of speed that counts as a tick.
        min_speed_step: f64 = 1e-5, "m/s", [0.0, 1.0],
            "Less is rounding.";
        /// Frequencies over which a smoother's freedom is summed.
        smoothing_frequencies: usize = 512, "", [8.0, 1e5],
            "The filter is smooth.";
        /// Duration of a steady point.
        instant: f64 = 1e-6, "s", [1e-9, 1e-3],
            "Motion is then velocity times time.";
    }
}
