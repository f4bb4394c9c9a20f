//! Which cases a trial has: the strata, and what is concealed in each of their cases.

use crate::key::Root;
use crate::random::{Purpose, stream};
use rand::seq::{IndexedRandom, SliceRandom};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};
use trackdyn_core::real;

/// Effects that a recording can name, each by itself.
pub const ISOLABLE: [&str; 16] = [
    "yaw-inertia",
    "centripetal",
    "load-transfer",
    "viscous-friction",
    "stribeck-friction",
    "friction-creep",
    "motion-resistance",
    "resistance-split",
    "hitch-drag",
    "belt-slip",
    "shear-displacement",
    "directional-lugs",
    "slope",
    "tether",
    "terrain-patch",
    "friction-drift",
];

/// The class of constants: what moves the constant ICRs and nothing else. The last one is an error of an instrument as well.
pub const CONSTANTS: [&str; 8] = [
    "friction-anisotropy",
    "cog-shift",
    "friction-split",
    "friction-gradient",
    "pressure-concentration",
    "cohesion",
    "bulldozing",
    "sensor-lever-arm",
];

/// Errors of instruments, which are truths of their own wherever they are.
pub const INSTRUMENTS: [&str; 5] =
    ["sensor-lever-arm", "encoder-scale", "sensor-yaw", "time-offset", "heading-drift"];

/// Laws that no catalogue has.
pub const OUTSIDE: [&str; 10] = [
    "brushed-ground",
    "spring-cable",
    "steering-grip",
    "washboard",
    "splayed-belts",
    "twisted-frame",
    "stiff-hull",
    "side-wind",
    "warm-rubber",
    "drive-backlash",
];

/// Effects close to another one: a small size, or a far place, and the recording cannot split them.
const CLOSE: [&str; 8] = [
    "drivetrain-lag",
    "tether",
    "viscous-friction",
    "friction-creep",
    "stribeck-friction",
    "motion-resistance",
    "hitch-drag",
    "belt-slip",
];

/// What kind of case it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stratum {
    /// Nothing is concealed, and all that is known of the recording is right.
    PlainNull,
    /// Nothing is concealed, and something else is wrong.
    HardNull,
    /// One effect of the catalogue.
    Single,
    /// Two effects of the catalogue.
    Pair,
    /// One effect whose class the recording is not expected to split.
    Equivalence,
    /// One law that the catalogue does not have.
    Outside,
}

impl Stratum {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 6] = [
        Self::PlainNull,
        Self::HardNull,
        Self::Single,
        Self::Pair,
        Self::Equivalence,
        Self::Outside,
    ];

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlainNull => "plain-null",
            Self::HardNull => "hard-null",
            Self::Single => "single",
            Self::Pair => "pair",
            Self::Equivalence => "equivalence",
            Self::Outside => "outside",
        }
    }

    /// Whether nothing is concealed.
    pub fn is_null(self) -> bool {
        matches!(self, Self::PlainNull | Self::HardNull)
    }

    /// Share of the cases.
    fn share(self) -> f64 {
        match self {
            Self::PlainNull => 0.06,
            Self::HardNull => 0.18,
            Self::Single => 0.40,
            Self::Pair => 0.12,
            Self::Equivalence => 0.11,
            Self::Outside => 0.13,
        }
    }
}

/// What is wrong in a hard null.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Difficulty {
    /// The recording states half or twice the noise that it has.
    NoiseStatement,
    /// Two to five poses in a hundred are far off.
    Outliers,
    /// The pose sensor sits elsewhere.
    LeverArm,
    /// The encoders show a few percent too much or too little.
    EncoderScale,
    /// Errors of poses go on for seconds.
    ColouredNoise,
    /// Poses are late, and their sensor is turned.
    ClockAndYaw,
    /// The heading turns away.
    HeadingDrift,
}

impl Difficulty {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 7] = [
        Self::NoiseStatement,
        Self::Outliers,
        Self::LeverArm,
        Self::EncoderScale,
        Self::ColouredNoise,
        Self::ClockAndYaw,
        Self::HeadingDrift,
    ];

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoiseStatement => "noise-statement",
            Self::Outliers => "outliers",
            Self::LeverArm => "lever-arm",
            Self::EncoderScale => "encoder-scale",
            Self::ColouredNoise => "coloured-noise",
            Self::ClockAndYaw => "clock-and-yaw",
            Self::HeadingDrift => "heading-drift",
        }
    }
}

/// A case before anything of it is drawn but its kind.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedCase {
    /// Its stratum.
    pub stratum: Stratum,
    /// Ids of what is concealed.
    pub concealed: Vec<&'static str>,
    /// What is wrong, in a hard null.
    pub difficulty: Option<Difficulty>,
}

/// The cases of a trial in shuffled order; every kind comes up as often as the others of its stratum.
pub fn plan(cases: usize, root: &Root) -> Vec<PlannedCase> {
    let mut random = stream(root, 0, 0, Purpose::Plan);
    let mut planned = Vec::with_capacity(cases);
    for (stratum, count) in counts(cases) {
        planned.extend(stratum_cases(stratum, count, &mut random));
    }
    planned.shuffle(&mut random);
    planned
}

/// How many cases each stratum has: nulls are rounded up, singles take what is left.
fn counts(cases: usize) -> Vec<(Stratum, usize)> {
    let mut counts: Vec<(Stratum, usize)> = Stratum::ALL
        .into_iter()
        .map(|stratum| {
            let wanted = stratum.share() * real(cases);
            let whole = if stratum.is_null() { wanted.ceil() } else { wanted.floor() };
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
            (stratum, whole as usize)
        })
        .collect();
    let others =
        counts.iter().filter(|(s, _)| *s != Stratum::Single).map(|(_, n)| n).sum::<usize>();
    for (stratum, count) in &mut counts {
        if *stratum == Stratum::Single {
            *count = cases.saturating_sub(others);
        }
    }
    let mut left = cases;
    for (_, count) in &mut counts {
        *count = (*count).min(left);
        left -= *count;
    }
    counts
}

fn stratum_cases(stratum: Stratum, count: usize, random: &mut ChaCha8Rng) -> Vec<PlannedCase> {
    let case = |concealed, difficulty| PlannedCase { stratum, concealed, difficulty };
    match stratum {
        Stratum::PlainNull => vec![case(Vec::new(), None); count],
        Stratum::HardNull => in_turn(&Difficulty::ALL, count, random)
            .into_iter()
            .map(|difficulty| case(Vec::new(), Some(difficulty)))
            .collect(),
        Stratum::Single => single(&ISOLABLE, count, random, case),
        Stratum::Outside => single(&OUTSIDE, count, random, case),
        Stratum::Equivalence => {
            let close = count / 2;
            let concealed = CONSTANTS.into_iter().filter(|id| !INSTRUMENTS.contains(id));
            let concealed: Vec<&'static str> = concealed.collect();
            let mut cases = single(&concealed, count - close, random, case);
            cases.extend(single(&CLOSE, close, random, case));
            cases
        }
        Stratum::Pair => in_turn(&ISOLABLE, count, random)
            .into_iter()
            .map(|first| {
                let second = loop {
                    let other = *ISOLABLE.choose(random).unwrap_or(&first);
                    if other != first {
                        break other;
                    }
                };
                case(vec![first, second], None)
            })
            .collect(),
    }
}

fn single(
    ids: &[&'static str],
    count: usize,
    random: &mut ChaCha8Rng,
    case: impl Fn(Vec<&'static str>, Option<Difficulty>) -> PlannedCase,
) -> Vec<PlannedCase> {
    in_turn(ids, count, random).into_iter().map(|id| case(vec![id], None)).collect()
}

/// `count` of these, all as often but for one, in an order that is drawn.
fn in_turn<T: Copy>(of: &[T], count: usize, random: &mut ChaCha8Rng) -> Vec<T> {
    let mut drawn = Vec::with_capacity(count + of.len());
    while drawn.len() < count {
        let mut round = of.to_vec();
        round.shuffle(random);
        drawn.extend(round);
    }
    drawn.truncate(count);
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fifth_or_more_are_nulls_and_most_of_them_hard() {
        for cases in [1, 2, 7, 20, 60, 333, 1000] {
            let planned = plan(cases, &Root::of_seed(3));
            assert_eq!(planned.len(), cases);
            let of = |wanted: &dyn Fn(Stratum) -> bool| {
                planned.iter().filter(|case| wanted(case.stratum)).count()
            };
            let nulls = of(&Stratum::is_null);
            assert!(5 * nulls >= cases, "{nulls} of {cases}");
            if cases >= 20 {
                assert!(2 * of(&|s| s == Stratum::HardNull) > nulls);
                assert!(Stratum::ALL.iter().all(|stratum| of(&|s| s == *stratum) > 0));
            }
        }
    }

    #[test]
    fn every_mechanism_of_the_independent_ground_has_its_place() {
        for sheet in trackdyn_second_simulator::MECHANISMS {
            let lists: [&[&str]; 5] = [&ISOLABLE, &CONSTANTS, &INSTRUMENTS, &OUTSIDE, &CLOSE];
            assert!(lists.iter().any(|list| list.contains(&sheet.id)), "{}", sheet.id);
        }
    }

    #[test]
    fn singles_are_of_all_kinds_and_the_order_says_nothing() {
        let planned = plan(400, &Root::of_seed(5));
        for id in ISOLABLE {
            let found =
                |case: &&PlannedCase| case.stratum == Stratum::Single && case.concealed == [id];
            assert!((8..=12).contains(&planned.iter().filter(found).count()), "{id}");
        }
        let nulls = |half: &[PlannedCase]| half.iter().filter(|c| c.stratum.is_null()).count();
        // 96 nulls fall into halves as 48 ± 4.3
        assert!(nulls(&planned[..200]).abs_diff(nulls(&planned[200..])) < 30);
        assert_ne!(planned, plan(400, &Root::of_seed(6)));
        assert_eq!(planned, plan(400, &Root::of_seed(5)));
    }
}
