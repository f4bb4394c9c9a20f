//! One group of settings from one declaration.

use toml::Value;

/// A group whose settings are known by name.
pub trait Group {
    /// Names of all settings.
    fn names(&self) -> &'static [&'static str];

    /// Value of a setting; none where there is no such name.
    fn get(&self, name: &str) -> Option<Value>;

    /// Sets a value, or says what was expected; none where there is no such name.
    fn set(&mut self, name: &str, value: &Value) -> Option<Result<(), String>>;
}

/// Declares a group: a struct with a field for each setting.
///
/// A setting is `name: kind = default, "unit", [smallest, largest], "why", "when wrong";`, its
/// meaning the doc comment. What has no "when wrong" is numerical accuracy alone.
macro_rules! group {
    (
        $(#[doc = $about:literal])+
        $group:ident {
            $(
                $(#[doc = $meaning:literal])+
                $name:ident: $kind:ty = $default:expr, $unit:literal, [$low:literal, $high:literal],
                $why:literal $(, $if_wrong:literal)?;
            )+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Debug, PartialEq)]
        pub struct $group {
            $($(#[doc = $meaning])+ pub $name: $kind,)+
        }

        impl Default for $group {
            fn default() -> Self {
                Self { $($name: $default,)+ }
            }
        }

        impl $group {
            /// What is known of each setting, with the name of the group before its own.
            pub(super) fn entries(group: &str) -> Vec<super::Entry> {
                let default = Self::default();
                vec![$(super::Entry {
                    path: format!("{group}.{}", stringify!($name)),
                    unit: $unit,
                    range: [$low, $high],
                    default: super::Number::value(&default.$name),
                    meaning: concat!($($meaning),+).trim().to_owned(),
                    why: $why,
                    if_wrong: [$($if_wrong)?].first().copied(),
                },)+]
            }
        }

        impl super::Group for $group {
            fn names(&self) -> &'static [&'static str] {
                &[$(stringify!($name)),+]
            }

            fn get(&self, name: &str) -> Option<toml::Value> {
                match name {
                    $(stringify!($name) => Some(super::Number::value(&self.$name)),)+
                    _ => None,
                }
            }

            fn set(&mut self, name: &str, value: &toml::Value) -> Option<Result<(), String>> {
                match name {
                    $(stringify!($name) => {
                        let read = super::Number::read(value, [$low, $high]);
                        Some(read.map(|value| self.$name = value))
                    })+
                    _ => None,
                }
            }
        }
    };
}

pub(super) use group;
