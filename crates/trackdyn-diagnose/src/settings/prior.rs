//! What is known of each number before the evidence.

use trackdyn_core::settings_group;

settings_group! {
    /// What is known of each number before the evidence.
    Prior {
        /// Deviation of a size, in typical sizes.
        size_deviation: f64 = 3.0, "", [0.1, 1e3],
            "Larger ones are seldom.",
            "Lower: large sizes shrink; higher: weak effects cost too much.";
        /// Deviation of a place, in half widths of the area.
        place_deviation: f64 = 3.0, "", [0.1, 1e3],
            "Farther ones are hardly felt.",
            "Lower: far anchors are missed.";
        /// That of a place with an extent.
        extent_place_deviation: f64 = 1.0, "", [0.1, 1e3],
            "It acts where the robot was.",
            "Lower: patches at the edge are missed.";
        /// Deviation of a time, in half the recording.
        time_deviation: f64 = 1.0, "", [0.1, 1e3],
            "It lies within the recording.",
            "Lower: late and early changes are missed.";
        /// Smallest half width of an area.
        min_area: f64 = 1.0, "m", [1e-3, 1e3],
            "Robots may spin on the spot.",
            "Lower: places are known too well.";
        /// Deviation of a shape, in typical values.
        shape_deviation: f64 = 1.0, "", [0.01, 1e3],
            "Its order is known.",
            "Lower: other shapes are missed.";
        /// Deviations of a law's form, as parts of its effect.
        form_deviations: [f64; 3] = [0.1, 0.2, 0.4], "", [1e-3, 10.0],
            "Other laws of friction differ by 10 to 40 %.",
            "Lower: second laws mend the first; higher: they hide.";
        /// Largest effect of another form that is ignored.
        min_form_effect: f64 = 0.5, "sd", [0.0, 100.0],
            "It shows nothing.",
            "Higher: forms of weak laws pass for physics.";
        /// Deviation of a constant ICR.
        icr_offset_deviation: f64 = 0.5, "gauge", [1e-3, 100.0],
            "ICRs lie near the tracks.",
            "Lower: wrong constants look like physics.";
        /// Deviation of unmeasured ln friction.
        friction_deviation: f64 = 0.3, "", [1e-4, 10.0],
            "Guesses err by a third.",
            "Lower: wrong friction looks like physics.";
        /// Largest change of ln friction.
        max_friction_change: f64 = 1.4, "", [0.01, 5.0],
            "A factor of four.",
            "Higher: forces may balance nowhere.";
        /// Deviation of an unmeasured centre of gravity.
        cog_deviation: f64 = 0.1, "gauge", [1e-4, 10.0],
            "Guesses err by centimetres.",
            "Lower: a wrong centre looks like physics.";
        /// Smallest deviation of ln friction, and of sizes in typical ones.
        min_deviation: f64 = 1e-4, "", [1e-9, 1.0],
            "Weights stay finite.";
        /// Smallest deviation of a centre of gravity.
        min_cog_deviation: f64 = 1e-5, "gauge", [1e-9, 1.0],
            "Weights stay finite.";
    }
}
