//! What the list of mechanisms expands to.

/// Declares the modules and the list of sheets with their constructors, in the list's order.
macro_rules! mechanisms {
    ($($module:ident :: $mechanism:ident),+ $(,)?) => {
        $(pub mod $module;)+

        /// The sheets of all mechanisms.
        pub const MECHANISMS: &[Sheet] = &[$(<$module::$mechanism as Described>::SHEET),+];

        /// The mechanism of `MECHANISMS[index]`.
        fn from_values(index: usize, values: &[f64], form: Form) -> Box<dyn Mechanism> {
            let constructors: &[fn(&[f64], Option<Draws>) -> Box<dyn Mechanism>] =
                &[$(|values, draws| Box::new(match draws {
                    None => $module::$mechanism::from_values(values),
                    Some(mut draws) => $module::$mechanism::drawn(values, &mut draws),
                })),+];
            constructors[index](values, form.draws())
        }
    };
}
