//! Contact of one side's running gear with the ground.
//!
//! Friction is the anisotropic Coulomb law of eqs (22)-(23), `τ = −[μ] p s/|s|`, under a pressure
//! that is linear along the part of the track that bears ([`bearing`]). [`closed_form`] integrates
//! it exactly; [`quadrature`] integrates the changes by effects.

pub mod bearing;
pub mod closed_form;
pub mod patch;
pub mod pressure;
pub mod quadrature;
pub mod shear;
pub mod slip;

pub use bearing::Bearing;
pub use patch::{Extent, Patch};
pub use pressure::Pressure;
pub use quadrature::Resolution;
pub use shear::ShearStress;
pub use slip::SlipField;

use trackdyn_core::{Scalar, Wrench};

/// Friction coefficients of the ground under one side: the diagonal of `[μ]` in eq. (23).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Coefficient across the track, μ_x.
    pub across: f64,
    /// Coefficient along the track, μ_y.
    pub along: f64,
}

/// Friction wrench on the body from the patches of one side, about the frame's origin.
///
/// The pressure vanishes at an edge that moves with the load. Each patch uses the closed form where
/// it is accurate. Where the ICR is so far away that the closed form cancels, the integrand is
/// smooth and a Gauss rule has the requested digits.
pub fn friction_wrench<S: Scalar>(
    patches: impl Iterator<Item = Patch<S>> + Clone,
    friction: Friction,
    pressure: &Pressure<S>,
    slip: &SlipField<S>,
    resolution: Resolution,
) -> Wrench<S> {
    let is_near = |patch: &Patch<S>| closed_form::applies(&patch.value(), slip, resolution);
    let far = patches.clone().filter(|patch| !is_near(patch));
    let mut wrench = quadrature::far_field_wrench(far, friction, pressure, slip, resolution);
    // The closed form needs an ICR: a field without rotation has none.
    let mut near = patches.filter(is_near).peekable();
    if near.peek().is_some() {
        wrench += closed_form::friction_wrench(near, friction, pressure, slip);
    }
    wrench
}
