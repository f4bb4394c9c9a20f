//! Numbers that decide an answer: each is declared once, with all that is to be known of it.
//!
//! [`settings_group!`](crate::settings_group) declares a group beside the code that it serves: a
//! struct with a field for each number. Each has a unit, a range, a default, and in words what it
//! is, why it has that value and what happens when it is wrong. [`Group`] finds them by name.

mod number;

pub use number::Number;
pub use toml::Value;

/// What is known of one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Group and name, as in `verdict.min_ln_bayes_factor`.
    pub path: String,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Smallest and largest value.
    pub range: [f64; 2],
    /// Value that it has unless it is set.
    pub default: Value,
    /// What it is.
    pub meaning: String,
    /// Why it has that value.
    pub why: &'static str,
    /// What happens when it is wrong; none of what is numerical accuracy alone.
    pub if_wrong: Option<&'static str>,
}

/// A group whose settings are known by name.
pub trait Group {
    /// What is known of each setting, with the name of the group before its own.
    fn entries(group: &str) -> Vec<Entry>
    where
        Self: Sized;

    /// Names of all settings.
    fn names(&self) -> &'static [&'static str];

    /// Value of a setting; none where there is no such name.
    fn get(&self, name: &str) -> Option<Value>;

    /// Sets a value, or says what was expected; none where there is no such name.
    fn set(&mut self, name: &str, value: &Value) -> Option<Result<(), String>>;
}

/// Declares a group of settings: a struct with a field for each, its default, and its
/// [`Group`](crate::settings::Group).
///
/// A setting is `name: kind = default, "unit", [smallest, largest], "why", "when wrong";`, its
/// meaning the doc comment. What has no "when wrong" is numerical accuracy alone.
#[macro_export]
macro_rules! settings_group {
    (@unit "") => { "" };
    (@unit $unit:literal) => { concat!(" ", $unit) };
    (
        $(#[doc = $about:literal])+
        $group:ident {
            $(
                $(#[doc = $meaning:literal])+
                $name:ident: $kind:ty = $default:expr, $unit:tt, [$low:literal, $high:literal],
                $why:literal $(, $if_wrong:literal)?;
            )+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Debug, PartialEq)]
        pub struct $group {
            $(
                $(#[doc = $meaning])+
                #[doc = ""]
                #[doc = concat!(
                    "Default: ", stringify!($default), $crate::settings_group!(@unit $unit), ". ",
                    $why $(, " ", $if_wrong)?
                )]
                pub $name: $kind,
            )+
        }

        impl Default for $group {
            fn default() -> Self {
                Self { $($name: $default,)+ }
            }
        }

        impl $crate::settings::Group for $group {
            fn entries(group: &str) -> Vec<$crate::settings::Entry> {
                let default = Self::default();
                vec![$($crate::settings::Entry {
                    path: format!("{group}.{}", stringify!($name)),
                    unit: $unit,
                    range: [$low, $high],
                    default: $crate::settings::Number::value(&default.$name),
                    meaning: concat!($($meaning),+).trim().to_owned(),
                    why: $why,
                    if_wrong: [$($if_wrong)?].first().copied(),
                },)+]
            }

            fn names(&self) -> &'static [&'static str] {
                &[$(stringify!($name)),+]
            }

            fn get(&self, name: &str) -> Option<$crate::settings::Value> {
                match name {
                    $(stringify!($name) => {
                        Some($crate::settings::Number::value(&self.$name))
                    })+
                    _ => None,
                }
            }

            fn set(
                &mut self,
                name: &str,
                value: &$crate::settings::Value,
            ) -> Option<Result<(), String>> {
                match name {
                    $(stringify!($name) => {
                        let read = $crate::settings::Number::read(value, [$low, $high]);
                        Some(read.map(|value| self.$name = value))
                    })+
                    _ => None,
                }
            }
        }
    };
}
