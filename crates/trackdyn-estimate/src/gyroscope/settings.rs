//! When a gyroscope serves, and how it is fitted to poses.

use trackdyn_core::settings_group;

settings_group! {
    /// When a gyroscope corrects the yaw of poses, and how it is fitted to them.
    Settings {
        /// Fewest poses beside its readings.
        min_poses: usize = 60, "", [8.0, 1e6],
            "Their noise is known to a tenth.",
            "Lower: its weight is a guess.";
        /// Smallest share of poses with readings around them.
        min_share: f64 = 0.75, "", [0.0, 1.0],
            "Ends of runs have none.",
            "Lower: corrected and other poses are mixed.";
        /// Fewest poses in a row that are smoothed.
        min_row: usize = 8, "", [3.0, 1e4],
            "A row tells its own level.",
            "Higher: short runs are refused.";
        /// Fewest readings in a row.
        min_readings: usize = 8, "", [3.0, 1e4],
            "They span a turn.",
            "Higher: rows between gaps are lost.";
        /// Change between two poses from which they jump.
        min_jump: f64 = 6.0, "sd", [1.0, 1e3],
            "Noise never changes so much.",
            "Lower: noise cuts rows; higher: loop closures look like turns.";
        /// Largest error with it, over that of the poses.
        max_error_ratio: f64 = 0.8, "", [0.0, 10.0],
            "A fifth less is worth it.",
            "Higher: a poor gyroscope corrects good poses.";
        /// Departure, in its noise, up to which poses have their yaw from it.
        max_own: f64 = 0.5, "", [0.0, 10.0],
            "Other poses have their own noise.",
            "Higher: it adds nothing.";
        /// Smallest and largest yaw of poses per yaw of the gyroscope.
        scales: [f64; 2] = [0.8, 1.25], "", [0.01, 100.0],
            "Tilts and scales err by less.",
            "Wider: wrong units and axes are taken.";
        /// Largest lag of the poses, either way.
        max_lag: f64 = 1.0, "s", [0.0, 100.0],
            "Most filters answer within a second.",
            "Lower: late poses are blurred.";
        /// Step between lags that are tried, and longest step of the fit.
        lag_step: f64 = 0.1, "s", [1e-3, 10.0],
            "Robots turn for longer.";
        /// Prior deviation of the scale.
        scale_prior: f64 = 0.05, "", [1e-6, 10.0],
            "The tilt of a mount, and its error.",
            "Lower: a wrong scale stays; higher: short drives set it.";
        /// Prior deviation of the lag about its start.
        lag_prior: f64 = 0.2, "s", [1e-6, 100.0],
            "Without turns, the start stands.",
            "Higher: noise sets the lag.";
        /// Time between mean yaws whose turns tell the scale.
        scale_interval: f64 = 2.0, "s", [0.01, 1e3],
            "Real drives show one scale from 2 s on.",
            "Lower: filtered poses make it too small.";
        /// Time for which runs share a bias.
        max_session: f64 = 600.0, "s", [0.0, 1e6],
            "A gyroscope keeps it for minutes.",
            "Higher: a drifting bias turns late runs.";
        /// Most steps of the fit.
        max_steps: usize = 20, "", [1.0, 1e4],
            "A cap: it settles sooner.";
        /// Smallest turning of poses in the fit, over the rms.
        min_turning: f64 = 0.3, "", [0.0, 10.0],
            "At rest, other noise rules.",
            "Lower: stand-still sets the noise.";
        /// Fewest differences of poses for a variance.
        min_differences: usize = 20, "", [2.0, 1e6],
            "Their median is known to a quarter.",
            "Lower: chance sets its weight.";
        /// Longest difference of poses.
        max_difference_steps: usize = 512, "", [1.0, 1e6],
            "A minute of poses at 10 Hz.",
            "Lower: slow errors look like none.";
        /// Longest difference, as a share of its row.
        max_difference_share: f64 = 1.0 / 6.0, "", [0.0, 1.0],
            "A fitted bias takes what lasts longer.",
            "Higher: walks look too small.";
        /// Fall of chi-squared from which an error wanders about zero.
        min_fall: f64 = 9.0, "", [0.0, 1e3],
            "Three standard deviations.",
            "Lower: walks are split by chance.";
        /// Times of correlation of such an error.
        correlation_times: [f64; 6] = [0.1, 0.3, 1.0, 3.0, 10.0, 30.0], "s", [1e-3, 1e4],
            "Filters forget within these.",
            "Other errors look like walks.";
        /// Largest surprise that the smoother believes.
        max_innovation: f64 = 3.4, "sd", [0.5, 1e9],
            "One of 1,500 is larger.",
            "Higher: outliers turn the poses about them.";
        /// Fewest readings at rest that tell its noise.
        min_still: usize = 100, "", [3.0, 1e6],
            "A second at 100 Hz.",
            "Lower: chance sets its noise.";
    }
}
