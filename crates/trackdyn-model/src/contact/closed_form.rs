//! Exact friction wrench of a rectangle under linear pressure, with its exact derivatives.
//!
//! Let (u, v) be the position relative to the ICR (X, Y) and r = √(u² + v²). The slip direction is
//! ±(−v, u)/r, so force and moment are area integrals of
//!
//! ```text
//! g ∈ { v/r, u/r, (μ_y u² + μ_x v²)/r },   each times the weights 1 and y
//! ```
//!
//! Each g is homogeneous of some degree d, g(λu, λv) = λᵈ g(u, v). Then div(g·(u, v)) = (d + 2) g
//! (Euler), and the divergence theorem turns the area integral into line integrals over the edges:
//!
//! ```text
//! ∬ g du dv = 1/(d+2) · ( [u ∫ g dv]_{u₁}^{u₂} + [v ∫ g du]_{v₁}^{v₂} )
//! ```
//!
//! The integrals along an edge are elementary (`EdgeMoments`). The same ones are the derivatives: a
//! shift of the ICR moves the edges, ∂/∂X ∬ g = −[∫ g dv]. All is bounded and continuous wherever
//! the ICR lies, inside, on an edge or on a corner.

use crate::contact::{Friction, Patch, Pressure, Resolution, SlipField};
use trackdyn_core::{Scalar, Wrench};

/// Distance to the ICR, in half diagonals of the patch, up to which the closed form is used.
///
/// The sum over the edges loses digits with the distance, while the Gauss rule of the far field
/// gains them as the integrand turns smooth: at this distance both are exact to rounding.
const MAX_DISTANCE: f64 = 6.0;

/// Distance to the ICR, in half diagonals of the patch, up to which the closed form is used where
/// half the digits suffice: it has these farther out, at a half to a quarter of the cost of
/// quadrature.
const MAX_COARSE_DISTANCE: f64 = 50.0;

/// Whether the closed form is accurate for this patch and slip.
#[inline]
pub fn applies<S: Scalar>(patch: &Patch, slip: &SlipField<S>, resolution: Resolution) -> bool {
    let reach = if resolution == Resolution::Fine { MAX_DISTANCE } else { MAX_COARSE_DISTANCE };
    slip.icr_distance_squared(patch) < reach * reach
}

/// Friction wrench about the frame's origin of patches that share friction, pressure and slip.
///
/// Meaningful where [`applies`] holds for each patch. Edges have no derivative here: the pressure
/// vanishes where they move.
pub fn friction_wrench<S: Scalar>(
    patches: impl Iterator<Item = Patch<S>>,
    friction: Friction,
    pressure: &Pressure<S>,
    slip: &SlipField<S>,
) -> Wrench<S> {
    let icr = slip.icr();
    let position = icr.map(Scalar::value);
    let mut sum = Integrals::default();
    for patch in patches {
        sum.add(&patch.value(), friction, position);
    }
    sum.wrench(friction, slip.rotation.value().signum(), icr, pressure)
}

/// Integrals of 1/r, t/r, t²/r, t³/r along an edge t₁..t₂ at the distance c from the ICR.
struct EdgeMoments {
    m0: f64,
    m1: f64,
    m2: f64,
    m3: f64,
}

impl EdgeMoments {
    /// `r` are the distances of the edge's two ends from the ICR.
    #[inline]
    fn new(c: f64, t: [f64; 2], r: [f64; 2]) -> Self {
        let c_squared = c * c;
        let m0 = log_moment(c_squared, t, r);
        // ∫ t/r dt = r
        let m1 = r[1] - r[0];
        Self {
            m0,
            m1,
            // ∫ t²/r dt = ½ (t r − c² ∫ 1/r dt)
            m2: 0.5 * (t[1] * r[1] - t[0] * r[0] - c_squared * m0),
            // ∫ t³/r dt = ⅓ r³ − c² r
            m3: m1 * ((r[1] * r[1] + r[1] * r[0] + r[0] * r[0]) / 3.0 - c_squared),
        }
    }
}

/// ∫ dt/r = asinh(t₂/|c|) − asinh(t₁/|c|), in the form that does not cancel.
///
/// For c = 0 the integral may diverge, but it is only used times c: zero.
#[inline]
fn log_moment(c_squared: f64, t: [f64; 2], r: [f64; 2]) -> f64 {
    if c_squared < f64::MIN_POSITIVE {
        return 0.0;
    }
    let ratio = if t[0] >= 0.0 {
        (t[1] + r[1]) / (t[0] + r[0])
    } else if t[1] <= 0.0 {
        (r[0] - t[0]) / (r[1] - t[1])
    } else {
        // r + t = c²/(r − t)
        (t[1] + r[1]) * (r[0] - t[0]) / c_squared
    };
    ratio.ln()
}

/// One of the three integrals with its derivatives by the ICR, under the pressures 1 and y.
#[derive(Clone, Copy, Default)]
struct Integral {
    /// ∬ g and ∬ y g.
    value: [f64; 2],
    /// Derivatives by X.
    by_x: [f64; 2],
    /// Derivatives by Y.
    by_y: [f64; 2],
}

impl Integral {
    /// Adds the integral of g of degree `degree` over the rectangle.
    ///
    /// `along_v` holds ∫ g dv and ∫ v g dv at the edges u₁ and u₂; `along_u` holds ∫ g du at the
    /// edges v₁ and v₂.
    #[inline]
    fn add(
        &mut self,
        degree: f64,
        (u, v): ([f64; 2], [f64; 2]),
        icr_y: f64,
        along_v: [[f64; 2]; 2],
        along_u: [f64; 2],
    ) {
        // Euler: (d + 2) ∬ g = [u ∫ g dv] + [v ∫ g du]; v g has degree d + 1.
        let plain = (u[1] * along_v[1][0] - u[0] * along_v[0][0] + v[1] * along_u[1]
            - v[0] * along_u[0])
            / (degree + 2.0);
        let by_v = (u[1] * along_v[1][1] - u[0] * along_v[0][1] + v[1] * v[1] * along_u[1]
            - v[0] * v[0] * along_u[0])
            / (degree + 3.0);
        // y = Y + v
        self.value[0] += plain;
        self.value[1] += by_v + icr_y * plain;
        // ∂/∂X ∬ w(y) g = −[∫ w g dv]
        let edge = along_v[1][0] - along_v[0][0];
        self.by_x[0] -= edge;
        self.by_x[1] -= along_v[1][1] - along_v[0][1] + icr_y * edge;
        // ∂/∂Y ∬ w(y) g = −[w ∫ g du] + ∬ w′ g
        self.by_y[0] -= along_u[1] - along_u[0];
        self.by_y[1] += plain - (v[1] + icr_y) * along_u[1] + (v[0] + icr_y) * along_u[0];
    }
}

/// The three integrals, summed over the patches of one side.
#[derive(Clone, Copy, Default)]
struct Integrals {
    /// ∬ v/r: drives the force along x.
    v: Integral,
    /// ∬ u/r: drives the force along y.
    u: Integral,
    /// ∬ (μ_y u² + μ_x v²)/r: the moment about the ICR.
    moment: Integral,
}

impl Integrals {
    #[inline]
    fn add(&mut self, patch: &Patch, friction: Friction, [icr_x, icr_y]: [f64; 2]) {
        let (mu_x, mu_y) = (friction.across, friction.along);
        let u = [patch.x[0] - icr_x, patch.x[1] - icr_x];
        let v = [patch.y[0] - icr_y, patch.y[1] - icr_y];
        let r = u.map(|u| v.map(|v| (u * u + v * v).sqrt()));
        // Along the edges u = u₁, u₂ (variable v) and v = v₁, v₂ (variable u).
        let side = [0, 1].map(|i| EdgeMoments::new(u[i], v, r[i]));
        let end = [0, 1].map(|k| EdgeMoments::new(v[k], u, [r[0][k], r[1][k]]));
        self.v.add(
            0.0,
            (u, v),
            icr_y,
            [0, 1].map(|i| [side[i].m1, side[i].m2]),
            [0, 1].map(|k| v[k] * end[k].m0),
        );
        self.u.add(
            0.0,
            (u, v),
            icr_y,
            [0, 1].map(|i| [u[i] * side[i].m0, u[i] * side[i].m1]),
            [0, 1].map(|k| end[k].m1),
        );
        self.moment.add(
            1.0,
            (u, v),
            icr_y,
            [0, 1].map(|i| {
                [
                    mu_y * u[i] * u[i] * side[i].m0 + mu_x * side[i].m2,
                    mu_y * u[i] * u[i] * side[i].m1 + mu_x * side[i].m3,
                ]
            }),
            [0, 1].map(|k| mu_y * end[k].m2 + mu_x * v[k] * v[k] * end[k].m0),
        );
    }

    /// The wrench about the frame's origin.
    #[inline]
    fn wrench<S: Scalar>(
        &self,
        friction: Friction,
        sense: f64,
        icr: [S; 2],
        pressure: &Pressure<S>,
    ) -> Wrench<S> {
        let lift = |integral: &Integral, factor: f64| -> S {
            let Pressure { at_origin, gradient } = pressure;
            let (p0, p1) = (at_origin.value(), gradient.value());
            let under = |by: [f64; 2]| factor * (p0 * by[0] + p1 * by[1]);
            S::chain(
                under(integral.value),
                [
                    under(integral.by_x),
                    under(integral.by_y),
                    factor * integral.value[0],
                    factor * integral.value[1],
                ],
                [icr[0], icr[1], *at_origin, *gradient],
            )
        };
        // τ = −[μ] p s/|s| with s/|s| = sense · (−v, u)/r, eq. (22)
        let force_x = lift(&self.v, sense * friction.across);
        let force_y = lift(&self.u, -sense * friction.along);
        let moment_about_icr = lift(&self.moment, -sense);
        Wrench {
            force_x,
            force_y,
            // eq. (15), carried from the ICR to the origin
            moment: moment_about_icr + icr[0] * force_y - icr[1] * force_x,
        }
    }
}
