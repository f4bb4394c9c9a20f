//! Sensors that come with the program.

use super::Sensors;
use trackdyn_core::document::Document;

/// Sensors that come with the program, as files in `configs/sensors`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Preset {
    /// No errors at all.
    Perfect,
    /// A robot in a laboratory: [`Sensors::default`].
    Laboratory,
    /// A robot outdoors: coarse encoders, late and noisy poses with outliers and gaps.
    Field,
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Perfect, Self::Laboratory, Self::Field];

    /// Its name on command lines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Perfect => "perfect",
            Self::Laboratory => "laboratory",
            Self::Field => "field",
        }
    }

    /// The preset of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// The sensors.
    ///
    /// # Panics
    /// Never: the files are part of the program, and a test reads them.
    pub fn sensors(self) -> Sensors {
        let text = match self {
            Self::Perfect => include_str!("perfect.toml"),
            Self::Laboratory => include_str!("laboratory.toml"),
            Self::Field => include_str!("field.toml"),
        };
        let name = format!("{}.toml (embedded)", self.name());
        match Sensors::from_document(&Document::new(name, text)) {
            Ok(sensors) => sensors,
            Err(error) => panic!("{error}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_valid_and_read_back() {
        for preset in Preset::ALL {
            let sensors = preset.sensors();
            assert_eq!(sensors.name, preset.name());
            assert_eq!(Preset::named(preset.name()), Some(preset));
            let back = Sensors::from_document(&Document::new("s.toml", sensors.to_toml()));
            assert_eq!(back.expect("valid"), sensors);
        }
        assert_eq!(Preset::Laboratory.sensors(), Sensors::default());
        assert_eq!(Preset::Perfect.sensors().clock_offset(), 0.0);
    }
}
