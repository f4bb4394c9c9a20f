//! Least squares with the regressors D and Δt.

/// Sums of products of D, Δt and the yaw.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    dd: f64,
    dt: f64,
    tt: f64,
    dy: f64,
    ty: f64,
    yy: f64,
    count: usize,
}

/// How well D follows the yaw.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// Correlation of Δψ and D, both less their part along Δt.
    pub(super) correlation: f64,
    /// Pose intervals.
    pub(super) count: usize,
}

impl Sums {
    pub(super) fn add(&mut self, [d, t]: [f64; 2], y: f64) {
        self.dd += d * d;
        self.dt += d * t;
        self.tt += t * t;
        self.dy += d * y;
        self.ty += t * y;
        self.yy += y * y;
        self.count += 1;
    }

    pub(super) fn fit(&self) -> Fit {
        let Self { dd, dt, tt, dy, ty, yy, count } = *self;
        if tt <= 0.0 {
            return Fit { correlation: 0.0, count };
        }
        // What is left of the sums once the part along Δt is taken off both sides.
        let (dd_t, dy_t, yy_t) = (dd - dt * dt / tt, dy - dt * ty / tt, yy - ty * ty / tt);
        // Below rounding of the sums there is no turning that changes.
        if dd_t <= 1e-12 * dd || yy_t <= 1e-12 * yy {
            return Fit { correlation: 0.0, count };
        }
        Fit { correlation: dy_t / (dd_t * yy_t).sqrt(), count }
    }
}
