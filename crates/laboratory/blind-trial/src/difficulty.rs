//! What is wrong in a hard null.

use serde::{Deserialize, Deserializer, Serialize, de};
use trackdyn_second_simulator::MECHANISMS;
use trackdyn_second_simulator::sheet::Trial;

/// What is wrong in a hard null.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(into = "String")]
pub enum Difficulty {
    /// The recording states half or twice the noise that it has.
    NoiseStatement,
    /// Two to five poses in a hundred are far off.
    Outliers,
    /// Large errors of the instruments whose sheets have this name.
    Instruments(&'static str),
    /// Errors of poses go on for seconds.
    ColouredNoise,
}

impl Difficulty {
    /// All of them, in the order of tables.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::NoiseStatement, Self::Outliers];
        for sheet in MECHANISMS {
            if let Trial::Instrument(error) = sheet.trial
                && !all.contains(&Self::Instruments(error.large_in))
            {
                all.push(Self::Instruments(error.large_in));
            }
        }
        all.push(Self::ColouredNoise);
        all
    }

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoiseStatement => "noise-statement",
            Self::Outliers => "outliers",
            Self::Instruments(name) => name,
            Self::ColouredNoise => "coloured-noise",
        }
    }
}

impl From<Difficulty> for String {
    fn from(difficulty: Difficulty) -> Self {
        difficulty.name().to_owned()
    }
}

impl TryFrom<String> for Difficulty {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let all = Self::all();
        all.iter().copied().find(|one| one.name() == name).ok_or_else(|| {
            let names: Vec<&str> = all.iter().map(|one| one.name()).collect();
            format!("no difficulty \"{name}\": expected one of {}", names.join(", "))
        })
    }
}

impl<'de> Deserialize<'de> for Difficulty {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Self::try_from(String::deserialize(from)?).map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_answers_that_are_sealed_already() {
        let names: Vec<&str> = Difficulty::all().into_iter().map(Difficulty::name).collect();
        let sealed = [
            "noise-statement",
            "outliers",
            "lever-arm",
            "encoder-scale",
            "coloured-noise",
            "clock-and-yaw",
            "heading-drift",
        ];
        assert!(sealed.iter().all(|name| names.contains(name)), "{names:?}");
        for difficulty in Difficulty::all() {
            assert_eq!(Difficulty::try_from(difficulty.name().to_owned()), Ok(difficulty));
        }
        assert!(Difficulty::try_from("lever".to_owned()).is_err());
    }
}
