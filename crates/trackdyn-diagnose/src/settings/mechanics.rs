//! How a hypothesis predicts motion.

use super::group::group;

group! {
    /// How a hypothesis predicts motion.
    Mechanics {
        /// Part of the speeds that may have no motion.
        max_unsolved_share: f64 = 0.2, "", [0.0, 1.0],
            "Corners are seldom driven.",
            "Lower: high robots lose hypotheses; higher: tipping ones are fitted.";
        /// Largest speed over the recorded one.
        speed_headroom: f64 = 1.1, "", [1.0, 10.0],
            "Encoder gains reach 10 %.",
            "Lower: faster tracks are held back.";
        /// Ratio of speeds in a logarithmic table.
        speed_range: f64 = 30.0, "", [2.0, 1e4],
            "Below, motion is in proportion.",
            "Lower: friction of slow slip is missed.";
        /// Slip below which a track sticks.
        stick_speed: f64 = 1e-4, "m/s", [1e-9, 0.1],
            "No sensor sees it.",
            "Higher: parked robots creep.";
        /// Samples asked whether headings or times matter.
        probes: usize = 200, "", [1.0, 1e6],
            "All headings occur.";
        /// Longest step in time.
        max_step: f64 = 0.01, "s", [1e-4, 1.0],
            "Dry friction acts in milliseconds.";
        /// Twist error that halves it.
        step_tolerance: f64 = 1e-3, "m/s", [1e-9, 1.0],
            "As 2 ms steps.";
        /// Longest step beside shear laws.
        max_sheared_step: f64 = 0.05, "s", [1e-4, 1.0],
            "Errors cancel.";
        /// Twist error that halves it.
        sheared_step_tolerance: f64 = 5e-3, "m/s", [1e-9, 1.0],
            "Likewise.";
        /// Change in typical sizes over which a motion in time serves.
        reach: f64 = 0.2, "", [1e-3, 10.0],
            "The rest is half a percent.";
        /// That during a fit, without slopes.
        reach_without_slope: f64 = 1.0, "", [1e-3, 100.0],
            "The end is checked.";
        /// That of belt lag.
        max_lag_change: f64 = 0.02, "s", [0.0, 1.0],
            "It only delays.";
        /// That of friction ratio and centre of gravity (gauges).
        max_vehicle_change: f64 = 0.003, "", [0.0, 1.0],
            "A second-order change.";
        /// Typical error of a centre of gravity.
        cog_size: f64 = 0.05, "gauge", [1e-4, 1.0],
            "Scales steps.";
        /// Residual force over weight that is balance.
        balance_tolerance: f64 = 1e-5, "", [1e-12, 1e-2],
            "0.01 mm in a second.";
        /// Shares of a step to balance.
        balance_shares: [f64; 3] = [1.0, 0.3, 0.1], "", [1e-3, 1.0],
            "Shear laws are steep.";
        /// Growth of what an unchecked step leaves.
        unchecked_growth: f64 = 1.5, "", [1.0, 100.0],
            "Derivatives age.";
    }
}
