//! How the numbers of a hypothesis are fitted.

use trackdyn_core::settings_group;

settings_group! {
    /// How the numbers of a hypothesis are fitted.
    Fit {
        /// Most Gauss-Newton steps.
        max_steps: usize = 6, "", [1.0, 1e3],
            "A cap: the fall ends them.";
        /// Most motions in time found anew in a fit.
        max_restarts: usize = 3, "", [1.0, 100.0],
            "A cap: slopes hold sooner.";
        /// Shares of a step that are tried.
        step_shares: [f64; 4] = [1.0, 0.4, 0.15, 0.05], "", [1e-4, 1.0],
            "Laws are steep near none.";
        /// Fall of twice the objective that ends a descent.
        min_fall: f64 = 0.2, "", [0.0, 100.0],
            "Far below chance.";
        /// Promised fall that is too small to try.
        min_promised_fall: f64 = 0.01, "", [0.0, 10.0],
            "Far below chance.";
        /// Relative error of a promised fall that keeps the Jacobian.
        max_promise_error: f64 = 0.1, "", [0.0, 1.0],
            "Its steps stay good.";
        /// Largest fall of twice the objective that keeps the Jacobian at the end.
        max_fall_of_jacobian: f64 = 10.0, "", [0.0, 1e6],
            "It then describes the minimum.";
        /// Difference step of a size, as part of its distance from none.
        size_difference: f64 = 0.2, "", [1e-3, 1.0],
            "A size may be the scale of a law.";
        /// Limits of that step, in typical sizes.
        size_difference_limits: [f64; 2] = [2.5e-3, 0.05], "", [1e-6, 1.0],
            "Between rounding and curvature.";
        /// Difference step of an ICR.
        icr_difference: f64 = 1e-3, "gauge", [1e-6, 0.1],
            "Between rounding and curvature.";
        /// Difference step of ln friction.
        friction_difference: f64 = 0.05, "", [1e-6, 0.5],
            "Between rounding and curvature.";
        /// Difference step of a centre of gravity.
        cog_difference: f64 = 5e-3, "gauge", [1e-6, 0.1],
            "Between rounding and curvature.";
        /// Difference step of a place.
        place_difference: f64 = 0.1, "m", [1e-6, 10.0],
            "Between rounding and curvature.";
        /// Difference step of a time.
        time_difference: f64 = 0.5, "s", [1e-3, 10.0],
            "A quarter of what a change takes.";
        /// Difference step of a direction.
        direction_difference: f64 = 2.0, "deg", [1e-3, 45.0],
            "Between rounding and curvature.";
        /// Difference step of a shape, as part of it.
        shape_difference: f64 = 0.05, "", [1e-6, 0.5],
            "Between rounding and curvature.";
    }
}
