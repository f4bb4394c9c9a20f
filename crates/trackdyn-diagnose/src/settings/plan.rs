//! What driving tells rivals apart.

use trackdyn_core::settings_group;

settings_group! {
    /// What driving tells rivals apart.
    Plan {
        /// Distance from which rivals are told apart.
        min_separation: f64 = 3.0, "sd", [0.1, 100.0],
            "As for answers.",
            "Lower: plans promise too much.";
        /// Part of typical driving that counts as known.
        known_share: f64 = 0.05, "", [0.0, 1.0],
            "A recording went before.",
            "Higher: plans forget constants.";
        /// Smallest weighted z² of a manoeuvre per time.
        min_rate: f64 = 1e-3, "1/s", [0.0, 1e3],
            "Less would take an hour.",
            "Higher: hard pairs get no plan.";
        /// Longest residual where rivals mimic each other.
        max_mimicked_residual: f64 = 3.0, "sd", [0.1, 100.0],
            "Below Huber's threshold.",
            "Higher: differences count as outliers.";
        /// ICR distances that a slow spin may have.
        gap_limits: [f64; 2] = [0.2, 20.0], "gauge", [1e-3, 1e3],
            "Robots lie between.",
            "Vehicles that cannot turn get plans.";
        /// z of a plan from which it foretells times.
        min_z_of_time: f64 = 1.0, "sd", [1e-3, 100.0],
            "Less says nothing.",
            "Times are guessed.";
        /// Most rounds of exchanging manoeuvres.
        exchange_rounds: usize = 3, "", [0.0, 100.0],
            "A cap: the gain ends them.";
        /// Interval of readings and commands.
        interval: f64 = 0.03, "s", [1e-3, 1.0],
            "As in the paper.",
            "Higher: ramps are coarse.";
        /// Intervals in a gentle ramp.
        gentle_ramp: usize = 17, "", [1.0, 1e4],
            "Half a second.",
            "Lower: inertia shows everywhere.";
        /// Intervals in a sharp ramp.
        sharp_ramp: usize = 4, "", [1.0, 1e4],
            "Belts just follow.",
            "Higher: lags look like clocks.";
        /// Intervals of steady driving.
        steady: usize = 90, "", [1.0, 1e5],
            "Ten samples.",
            "Lower: ramps take the time.";
        /// Intervals of rest behind a manoeuvre.
        rest: usize = 18, "", [1.0, 1e4],
            "Delays show there.",
            "Lower: delays are cut off.";
        /// Intervals in a square's side.
        square_side: usize = 70, "", [1.0, 1e5],
            "1.5 m at 0.7 m/s.",
            "Lower: places look alike.";
        /// Creeping speeds.
        creeping_speeds: [f64; 3] = [0.05, 0.1, 0.2], "m/s", [1e-3, 10.0],
            "Friction settles there.",
            "Higher: creep looks viscous.";
    }
}
