//! Expansion of the list of effects.

/// Declares the modules of the catalogue, the list of cards and the dispatch of the hooks.
///
/// The expansion is the only place that knows effects by name.
macro_rules! catalogue {
    ($($module:ident :: $effect:ident),+ $(,)?) => {
        $(pub mod $module;)+

        /// The cards of all effects, in the catalogue's order.
        pub const CATALOGUE: &[Card] = &[$(<$module::$effect as Effect>::CARD),+];

        /// Kind of each effect of the catalogue.
        const NATURES: &[Nature] = &[$(<$module::$effect as Effect>::NATURE),+];

        /// Whether each effect of the catalogue is a term of Newton's second law.
        const INERTIA_FLAGS: &[bool] = &[$(<$module::$effect as Effect>::IS_INERTIA),+];

        /// Whether each effect of the catalogue is an error of instruments that few robots have.
        const RARITY_FLAGS: &[bool] = &[$(<$module::$effect as Effect>::IS_RARE),+];

        /// The terms of each effect of the catalogue.
        const TERMS: &[fn() -> Vec<Term>] = &[$(<$module::$effect as Effect>::terms),+];

        /// One effect with its parameters: of the catalogue, or a law of a user.
        #[derive(Clone, Debug, PartialEq)]
        #[expect(clippy::large_enum_variant, reason = "a model has a few, and laws are copied")]
        enum Law {
            $($effect($module::$effect),)+
            Custom(ActiveLaw),
        }

        impl Law {
            /// An effect with the values of its parameters, in the order of its card.
            fn from_values(effect: EffectId, values: &[f64]) -> Self {
                if let Some(law) = effect.custom() {
                    return Self::Custom(ActiveLaw::new(law, values));
                }
                let constructors: &[fn(&[f64]) -> Self] =
                    &[$(|values| Self::$effect(Effect::from_values(values))),+];
                constructors[effect.index()](values)
            }

            fn body(&self, vehicle: &mut Vehicle) {
                match self {
                    $(Self::$effect(effect) => effect.body(vehicle),)+
                    Self::Custom(_) => {}
                }
            }

            fn drive(&self, drive: &mut Drive) {
                match self {
                    $(Self::$effect(effect) => effect.drive(drive),)+
                    Self::Custom(_) => {}
                }
            }

            fn sense(&self, sensor: &mut Sensor) {
                match self {
                    $(Self::$effect(effect) => effect.sense(sensor),)+
                    Self::Custom(_) => {}
                }
            }

            fn rigid_body(&self, body: &mut RigidBody) {
                match self {
                    $(Self::$effect(effect) => effect.rigid_body(body),)+
                    Self::Custom(_) => {}
                }
            }

            fn ground(&self, ground: &mut Ground) {
                match self {
                    $(Self::$effect(effect) => effect.ground(ground),)+
                    Self::Custom(_) => {}
                }
            }

            #[inline]
            fn load<S: Scalar>(&self, situation: &Situation<S>, centre_of_pressure: &mut [S; 2]) {
                match self {
                    $(Self::$effect(effect) => effect.load(situation, centre_of_pressure),)+
                    Self::Custom(_) => {}
                }
            }

            #[inline]
            fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
                match self {
                    $(Self::$effect(effect) => effect.shear(site, stress),)+
                    Self::Custom(law) => law.shear(site, stress),
                }
            }

            #[inline]
            fn wrench<S: Scalar>(
                &self,
                situation: &Situation<S>,
                normal_load: &PerSide<S>,
                wrench: &mut Wrench<S>,
            ) {
                match self {
                    $(Self::$effect(effect) => effect.wrench(situation, normal_load, wrench),)+
                    Self::Custom(law) => law.wrench(situation, normal_load, wrench),
                }
            }
        }
    };
}
