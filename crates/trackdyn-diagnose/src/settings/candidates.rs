//! Which variants of each effect are tried.

use trackdyn_core::settings_group;

settings_group! {
    /// Which variants of each effect are tried.
    Candidates {
        /// Steps to signatures, in typical sizes; the first possible one counts.
        size_steps: [f64; 3] = [1.0, 0.2, -0.2], "", [-10.0, 10.0],
            "A typical step may tip a robot.",
            "The screen promises wrong sizes.";
        /// Relative change of the base's motion below which signatures serve again.
        max_base_change: f64 = 0.05, "", [0.0, 1.0],
            "They change by as little.",
            "Higher: the screen is of another robot.";
        /// Typical sizes at which shear laws are taken.
        shear_sizes: [f64; 3] = [1.0, 0.2, 0.05], "", [1e-3, 10.0],
            "A size may be the scale of a law.",
            "Stiff soil is missed.";
        /// Angle between directions.
        direction_step: f64 = 15.0, "deg", [1.0, 120.0],
            "Half-way a cosine keeps 99 %.",
            "Higher: refinement starts too far off.";
        /// Ratio of neighbouring shapes.
        shape_ratio: f64 = 2.5, "", [1.01, 100.0],
            "Three span a factor of six.",
            "Higher: shapes fall between.";
        /// Places without an extent, in half widths from the middle.
        places: [f64; 5] = [-3.0, -1.0, 0.0, 1.0, 3.0], "", [-100.0, 100.0],
            "Anchors lie beside areas too.",
            "Other anchors look like slopes.";
        /// Times of a change, in half the driven time, from its middle.
        times: [f64; 6] = [-1.1, -0.66, -0.22, 0.22, 0.66, 1.1], "", [-10.0, 10.0],
            "Even steps; the outer ones lie before and after.",
            "Short changes are missed.";
        /// Most places of an extent.
        max_places: usize = 40, "", [1.0, 1e5],
            "Others are seldom passed.",
            "Lower: patches are missed.";
        /// Most refining rounds of a variant; of a time, per step length.
        refining_rounds: usize = 6, "", [0.0, 100.0],
            "Steps and three halvings.",
            "Lower: places stay coarse.";
        /// Smallest step of refinement, in half distances.
        min_refining_step: f64 = 0.2, "", [1e-3, 1.0],
            "The fit does the rest.";
        /// ln evidence that a step must gain.
        min_refining_gain: f64 = 0.1, "", [0.0, 100.0],
            "Far below chance.";
    }
}
