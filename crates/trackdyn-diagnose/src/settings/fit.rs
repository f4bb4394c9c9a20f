//! How the numbers of a hypothesis are fitted.

use super::group::group;

group! {
    /// How the numbers of a hypothesis are fitted.
    Fit {
        /// Gauss-Newton steps.
        max_steps: usize = 6, "", [1.0, 1e3],
            "Most take three.";
        /// Motions in time found anew.
        max_restarts: usize = 3, "", [1.0, 100.0],
            "Slopes then hold.";
        /// Shares of a step.
        step_shares: [f64; 4] = [1.0, 0.4, 0.15, 0.05], "", [1e-4, 1.0],
            "Laws are steep near none.";
        /// Fall of twice the objective that ends a descent.
        min_fall: f64 = 0.2, "", [0.0, 100.0],
            "A fifth of chance.";
        /// Promised fall too small to try.
        min_promised_fall: f64 = 0.01, "", [0.0, 10.0],
            "Far below chance.";
        /// Error of a promised fall that keeps the Jacobian.
        max_promise_error: f64 = 0.1, "", [0.0, 1.0],
            "Steps stay good.";
        /// Fall for which a Jacobian is kept.
        max_fall_of_jacobian: f64 = 10.0, "", [0.0, 1e6],
            "Covariances change by percents.";
        /// Difference step of a size, of its distance from none.
        size_difference: f64 = 0.2, "", [1e-3, 1.0],
            "It may scale a law.";
        /// Limits of that, in typical sizes.
        size_difference_limits: [f64; 2] = [2.5e-3, 0.05], "", [1e-6, 1.0],
            "Between rounding and curvature.";
        /// Step of an ICR.
        icr_difference: f64 = 1e-3, "gauge", [1e-6, 0.1],
            "Likewise.";
        /// Of ln friction.
        friction_difference: f64 = 0.05, "", [1e-6, 0.5],
            "Likewise.";
        /// Of a centre of gravity.
        cog_difference: f64 = 5e-3, "gauge", [1e-6, 0.1],
            "Likewise.";
        /// Of a place.
        place_difference: f64 = 0.1, "m", [1e-6, 10.0],
            "Likewise.";
        /// Of a direction.
        direction_difference: f64 = 2.0, "deg", [1e-3, 45.0],
            "Likewise.";
        /// Of a shape, as part of it.
        shape_difference: f64 = 0.05, "", [1e-6, 0.5],
            "Likewise.";
        /// Part of a range that is its end.
        limit_tolerance: f64 = 1e-6, "", [0.0, 0.1],
            "Rounding.";
    }
}
