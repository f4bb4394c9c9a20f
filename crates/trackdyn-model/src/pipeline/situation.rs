//! Arguments of the hooks of an effect.

use crate::contact::pressure::Footprint;
use crate::contact::quadrature::SlipSite;
use crate::contact::{Friction, Patch, Pressure, SlipField};
use crate::pipeline::{Ground, Motion};
use crate::vehicle::Vehicle;
use trackdyn_core::{Scalar, Side};

/// Vehicle, ground and motion.
#[derive(Clone, Copy)]
pub struct Situation<'a, S> {
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The ground, after all effects of stage `ground`.
    pub ground: &'a Ground,
    /// Extent of one side's contact.
    pub footprint: &'a Footprint,
    /// The motion of hull and belts.
    pub motion: &'a Motion<S>,
}

impl<S: Scalar> Situation<'_, S> {
    /// Centripetal acceleration of the centre of gravity, ω × v, (x, y) in m/s²: the only one in
    /// stationary motion.
    #[inline]
    pub fn steady_acceleration(&self) -> [S; 2] {
        self.motion.twist.steady_acceleration_at(self.vehicle.cog)
    }

    /// Acceleration of the centre of gravity from changes of the twist, (x, y) in m/s².
    #[inline]
    pub fn transient_acceleration(&self) -> [S; 2] {
        self.motion.acceleration.velocity_at(self.vehicle.cog)
    }
}

/// A point of the contact under one side.
pub struct Site<'a, S> {
    /// Vehicle, ground and motion.
    pub situation: &'a Situation<'a, S>,
    /// The side.
    pub side: Side,
    /// The patch that holds the point, as far as it bears.
    pub patch: &'a Patch<S>,
    /// Normal pressure under the side.
    pub pressure: &'a Pressure<S>,
    /// Position and slip direction of the point.
    pub slip: &'a SlipSite<S>,
}

impl<S: Scalar> Site<'_, S> {
    /// Normal pressure at the point, Pa.
    #[inline]
    pub fn normal_pressure(&self) -> S {
        self.pressure.at(self.slip.position[1])
    }

    /// Friction coefficients under the side.
    #[inline]
    pub fn friction(&self) -> Friction {
        self.situation.ground.friction[self.side]
    }

    /// Unit vector of the slip, s/|s|.
    #[inline]
    pub fn slip_direction(&self) -> [S; 2] {
        self.slip.unit_slip.map(|s| s / self.slip.unit_slip_length)
    }

    /// Belt speed relative to the hull, m/s.
    #[inline]
    pub fn belt_speed(&self) -> S {
        self.situation.motion.belt_speed[self.side]
    }

    /// Slip field of the belt.
    #[inline]
    pub fn slip_field(&self) -> &SlipField<S> {
        &self.situation.motion.slip[self.side]
    }

    /// Slip velocity |s|, m/s.
    #[inline]
    pub fn slip_speed(&self) -> S {
        self.slip.unit_slip_length * self.slip_field().speed
    }
}
