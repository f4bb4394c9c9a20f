//! Which of the parameters that were replayed to take.

use super::{Odometry, Replayed};
use trackdyn_estimate::odometry::{Estimate, ParameterSet};

/// Errors of the set that is taken, as a share of those of another on the same pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Name of the other set.
    pub with: String,
    /// Ratio of the root mean squares of the errors of place, 1.
    pub place: Estimate,
    /// Ratio of the root mean squares of the errors of yaw, 1.
    pub yaw: Estimate,
}

/// Which parameters to take.
///
/// A set with more parameters is taken where it is surely better than those with fewer: where the
/// 95 % interval of the ratio of the errors of place lies below one; or that of the errors of yaw,
/// while it is not sure that those of place are larger. Errors are over the span of
/// [the drift](trackdyn_estimate::odometry::Comparison::drift).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Advice {
    /// The parameters of this file, as given.
    File {
        /// The file.
        file: String,
        /// How it compares with the others.
        compared: Vec<Compared>,
    },
    /// The gauge alone: no file is surely better than the ideal drive.
    Ideal {
        /// How the ideal drive compares with the others.
        compared: Vec<Compared>,
    },
    /// This replay does not tell.
    Undecided {
        /// Why, and what to do.
        reason: String,
    },
}

/// A set that may be taken: its place among the sets, and its file; none of the ideal drive.
struct Candidate<'a> {
    set: usize,
    replayed: Option<&'a Replayed>,
}

/// The advice of a replay.
pub(super) fn of(odometry: &Odometry) -> Advice {
    let undecided = |reason: String| Advice::Undecided { reason };
    if odometry.replayed.is_empty() {
        let reason = "the ideal drive was replayed alone: give parameter files by --kinematics";
        return undecided(reason.to_owned());
    }
    let fitted: Vec<&str> = odometry
        .replayed
        .iter()
        .filter(|one| !odometry.is_held_out(one))
        .map(|one| one.set.name())
        .collect();
    if !fitted.is_empty() {
        return undecided(format!(
            "{}: fitted to this driving, which makes errors look smaller: replay other driving, by \
             --runs or --time",
            fitted.join(", ")
        ));
    }
    let sound = odometry.replayed.iter().filter(|one| !one.parameters.is_doubtful());
    let mut sound: Vec<&Replayed> = sound.collect();
    if sound.is_empty() {
        return undecided("all parameters are doubtful".to_owned());
    }
    // fewer parameters first; the order of the files else
    sound.sort_by_key(|one| one.set.without_alpha().is_some());
    match chosen(odometry, &sound) {
        Some((best, compared)) => match best.replayed {
            Some(one) => Advice::File { file: one.parameters.name().to_owned(), compared },
            None => Advice::Ideal { compared },
        },
        None => undecided("too little driving for intervals: replay more of it".to_owned()),
    }
}

/// The set to take, and how it compares with the others; none where no intervals are known.
fn chosen<'a>(
    odometry: &Odometry,
    sound: &[&'a Replayed],
) -> Option<(Candidate<'a>, Vec<Compared>)> {
    let sets = &odometry.comparison.sets;
    let place_of = |one: &Replayed| sets.iter().position(|set| set.name() == one.set.name());
    let span = odometry.comparison.drift()?;
    let mut best = Candidate { set: 0, replayed: None };
    for one in sound {
        let set = place_of(one)?;
        if is_surely_better(span.ratio(set, best.set)?)? {
            best = Candidate { set, replayed: Some(one) };
        }
    }
    let others = std::iter::once(Some(0)).chain(sound.iter().map(|one| place_of(one)));
    let others = others.flatten().filter(|other| *other != best.set);
    let compared = others.map(|other| {
        let [place, yaw] = span.ratio(best.set, other)?;
        Some(Compared { with: sets[other].name().to_owned(), place, yaw })
    });
    let compared = compared.collect::<Option<Vec<_>>>()?;
    Some((best, compared))
}

/// Whether errors are surely smaller, by the ratios of place and yaw; none where no intervals are
/// known.
fn is_surely_better([place, yaw]: [Estimate; 2]) -> Option<bool> {
    let ([place_low, place_high], [_, yaw_high]) = (place.interval()?, yaw.interval()?);
    Some(place_high < 1.0 || (place_low <= 1.0 && yaw_high < 1.0))
}

impl Advice {
    /// What to take, in words: a file, or the ideal drive; none where it is not decided.
    pub fn choice(&self) -> Option<&str> {
        match self {
            Self::File { file, .. } => Some(file),
            Self::Ideal { .. } => Some(ParameterSet::IDEAL),
            Self::Undecided { .. } => None,
        }
    }

    /// How the choice compares with the others.
    pub fn compared(&self) -> &[Compared] {
        match self {
            Self::File { compared, .. } | Self::Ideal { compared } => compared,
            Self::Undecided { .. } => &[],
        }
    }
}
