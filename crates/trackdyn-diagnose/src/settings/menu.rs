//! Manoeuvres from which a plan chooses.

use trackdyn_core::settings_group;

settings_group! {
    /// Speeds of the manoeuvres from which a plan chooses, as shares of the fastest track speed,
    /// and ratios of the inner to the outer track.
    Menu {
        /// Speeds of spins.
        spin_shares: [f64; 3] = [0.25, 0.5, 1.0], "", [0.01, 1.0],
            "Doubled in steps.",
            "Narrower: laws of speed look alike.";
        /// Speeds of arcs.
        arc_shares: [f64; 3] = [0.3, 0.6, 1.0], "", [0.01, 1.0],
            "Even steps.",
            "Narrower: laws of speed look alike.";
        /// Ratios of arcs.
        arc_ratios: [f64; 3] = [0.3, 0.6, 0.85], "", [0.01, 0.99],
            "From tight to nearly straight.",
            "Narrower: laws of curvature look alike.";
        /// Speeds of counter-rotations and tight arcs.
        tight_shares: [f64; 2] = [0.5, 1.0], "", [0.01, 1.0],
            "A pair tells growth with speed.",
            "Narrower: laws of speed look alike.";
        /// Ratios of these two.
        tight_ratios: [f64; 2] = [-0.4, 0.1], "", [-0.99, 0.99],
            "Either side of a standing track.",
            "Zero: the direction of its resistance is open.";
        /// Speeds of straight runs.
        straight_shares: [f64; 2] = [0.5, 1.0], "", [0.01, 1.0],
            "A pair tells growth with speed.",
            "Narrower: laws of speed look alike.";
        /// Slow and fast speed of steps.
        speed_steps: [f64; 2] = [0.2, 0.8], "", [0.01, 1.0],
            "Wide, and never at rest.",
            "Narrower: inertia hardly shows.";
        /// Slow and fast speed of spins in steps.
        spin_steps: [f64; 2] = [0.15, 0.6], "", [0.01, 1.0],
            "Full speed tips high robots.",
            "Narrower: inertia hardly shows.";
        /// Speed of spins that turn back.
        reversal_share: f64 = 0.4, "", [0.01, 1.0],
            "Twice that is the step.",
            "Lower: inertia hardly shows.";
        /// Speed of arcs that change sides.
        arc_step_share: f64 = 0.7, "", [0.01, 1.0],
            "Below what tips high robots.",
            "Lower: inertia hardly shows.";
        /// Ratio of these arcs.
        arc_step_ratio: f64 = 0.3, "", [0.01, 0.99],
            "As in the tightest arcs.",
            "Higher: inertia hardly shows.";
        /// Ratio of creeping arcs.
        creeping_ratio: f64 = 0.4, "", [0.01, 0.99],
            "Both tracks creep.",
            "Higher: slip is lost in noise.";
        /// Speed of arcs at several headings.
        heading_share: f64 = 0.4, "", [0.01, 1.0],
            "Slopes show at any speed.",
            "Higher: more floor is needed.";
        /// Ratio of these arcs.
        heading_ratio: f64 = 0.5, "", [0.01, 0.99],
            "They turn and move on.",
            "Higher: slopes hardly turn them.";
        /// Speed along the sides of a square.
        square_share: f64 = 0.7, "", [0.01, 1.0],
            "Sides are then metres long.",
            "Lower: places look alike.";
        /// Fastest turns on the spot between these.
        corner_share: f64 = 0.4, "", [0.01, 1.0],
            "A corner is no test.",
            "Higher: corners shake the robot.";
    }
}
