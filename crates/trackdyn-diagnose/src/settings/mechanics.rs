//! How a hypothesis predicts motion.

use trackdyn_core::settings_group;

settings_group! {
    /// How a hypothesis predicts motion.
    Mechanics {
        /// Part of the speeds that may have no motion.
        max_unsolved_share: f64 = 0.2, "", [0.0, 0.5],
            "Nobody drives the table's corners.",
            "Lower: high robots lose hypotheses; higher: tipping ones are fitted.";
        /// Largest speed over the recorded one.
        speed_headroom: f64 = 1.1, "", [1.0, 10.0],
            "Room for encoder gains.",
            "Lower: faster tracks are held back.";
        /// Ratio of speeds in a logarithmic table.
        speed_range: f64 = 30.0, "", [2.0, 1e4],
            "Below, motion is in proportion.",
            "Lower: friction of slow slip is missed.";
        /// Slip below which a track sticks.
        stick_speed: f64 = 1e-4, "m/s", [1e-9, 0.1],
            "No sensor sees it.",
            "Higher: parked robots creep.";
        /// Samples that are asked whether heading or time matters.
        probes: usize = 200, "", [1.0, 1e6],
            "Headings recur.";
        /// Longest step in time.
        max_step: f64 = 0.05, "s", [1e-4, 1.0],
            "Readings rarely come later.";
        /// Shortest step in time for accuracy.
        min_step: f64 = 0.0025, "s", [1e-6, 1.0],
            "Bodies follow belts in milliseconds.";
        /// Twist error that shortens a step.
        step_tolerance: f64 = 3e-3, "m/s", [1e-9, 1.0],
            "Moves a pose by 0.01 mm in 0.1 s.";
        /// Longest step beside shear laws.
        max_sheared_step: f64 = 0.05, "s", [1e-4, 1.0],
            "Readings rarely come later.";
        /// Shortest step beside shear laws.
        min_sheared_step: f64 = 0.0125, "s", [1e-6, 1.0],
            "Errors with and without a law cancel.";
        /// Twist error that shortens such a step.
        sheared_step_tolerance: f64 = 5e-3, "m/s", [1e-9, 1.0],
            "Errors cancel.";
        /// Departure from the stationary motion, over the largest speed, that counts as none.
        max_steady_departure: f64 = 0.01, "", [0.0, 0.1],
            "Laws change slips of a percent by a percent.";
        /// Time of it after which motion with a law is stationary.
        min_steady_time: f64 = 0.2, "s", [0.0, 10.0],
            "Bodies follow belts in milliseconds.";
        /// Difference step for motions in time, in typical sizes.
        departure_difference: f64 = 0.01, "", [1e-6, 0.5],
            "Tables of stationary motion are good to a millionth.";
        /// That step of shear laws.
        sheared_difference: f64 = 0.03, "", [1e-6, 0.5],
            "Good to a percent of the law.";
        /// Change, in typical sizes, over which a motion in time serves.
        reach: f64 = 0.2, "", [1e-3, 10.0],
            "What is not linear is half a percent.";
        /// That change during a fit, of what has no slope.
        reach_without_slope: f64 = 1.0, "", [1e-3, 100.0],
            "The end of the fit is checked.";
        /// That change of the lag of belts.
        max_lag_change: f64 = 0.02, "s", [0.0, 1.0],
            "A lag mostly delays.";
        /// That change of friction ratio, and of the centre of gravity in gauges.
        max_vehicle_change: f64 = 0.003, "", [0.0, 1.0],
            "Its effect is of second order.";
        /// Typical error of a centre of gravity.
        cog_size: f64 = 0.05, "gauge", [1e-4, 1.0],
            "It scales steps alone.";
        /// Residual force over weight that counts as balance.
        balance_tolerance: f64 = 1e-5, "", [1e-12, 1e-2],
            "It moves 0.01 mm in a second.";
        /// Shares of a step to balance that are tried.
        balance_shares: [f64; 3] = [1.0, 0.3, 0.1], "", [1e-3, 1.0],
            "Shear laws may be steep.";
        /// Growth of what an unchecked step is taken to leave.
        unchecked_growth: f64 = 1.5, "", [1.0, 100.0],
            "Derivatives age.";
    }
}
