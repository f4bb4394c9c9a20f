//! What a simulator of rigid bodies has to be told of a robot beside the vehicle.

/// Properties of a robot that a simulator of rigid bodies has, and a balance of forces on the
/// ground has as terms of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RigidBody {
    /// Height of the centre of gravity above the ground, m; zero moves no load.
    pub cog_height: f64,
    /// Ratio k of the force to mass times acceleration, in a steady turn; none without that force.
    pub steady_inertia: Option<f64>,
    /// Ratio k of the force to mass times acceleration, in changes of speed; none without it.
    pub transient_inertia: Option<f64>,
    /// Radius of gyration about the vertical through the centre of gravity, m; none if unknown.
    pub gyration: Option<f64>,
    /// Relative excess γ of friction at the front end of the contact, 1.
    pub friction_gradient: f64,
    /// Excess κ of the pressure at the ends of a patch over its mean, 1.
    pub pressure_concentration: f64,
    /// Slip speed v_c by which friction at small slip is μ p s/v_c, m/s; zero for dry friction.
    pub creep_speed: f64,
}

impl RigidBody {
    /// Factor on both friction coefficients with which a body of mass m moves as the model does.
    ///
    /// # Law
    /// k m a = Σ μ p is m a = Σ (μ/k) p.
    pub fn friction_factor(&self) -> f64 {
        let strength = self.steady_inertia.or(self.transient_inertia);
        strength.filter(|k| *k > 0.0).map_or(1.0, f64::recip)
    }
}

#[cfg(test)]
mod tests {
    use super::RigidBody;

    #[test]
    fn a_force_of_twice_the_mass_is_half_the_friction() {
        let factor = |steady, transient| {
            let body = RigidBody {
                steady_inertia: steady,
                transient_inertia: transient,
                ..RigidBody::default()
            };
            body.friction_factor()
        };
        assert_eq!(factor(Some(2.0), Some(1.0)), 0.5);
        assert_eq!(factor(None, Some(4.0)), 0.25);
        assert_eq!((factor(None, None), factor(Some(0.0), None)), (1.0, 1.0));
    }
}
