//! Which of the parameters that were replayed to take.

use super::{Odometry, Replayed};
use trackdyn_estimate::odometry::{Estimate, ParameterSet};
use trackdyn_model::VehicleFile;

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
/// A set with more parameters is taken only if it is surely better than those with fewer. Either
/// the 95 % interval of the ratio of position errors lies below one. Or that of the yaw errors
/// does, and the position errors are not surely larger. Errors are over the span of
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
    /// The forces on the vehicle.
    Physics {
        /// Name of the vehicle.
        vehicle: String,
        /// How they compare with the others.
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

/// A set that may be taken.
#[derive(Clone, Copy)]
struct Candidate<'a> {
    /// Its place among the sets.
    set: usize,
    kind: Kind<'a>,
}

#[derive(Clone, Copy)]
enum Kind<'a> {
    Ideal,
    File(&'a Replayed),
    Physics(&'a VehicleFile),
}

/// The advice of a replay.
pub(super) fn of(odometry: &Odometry) -> Advice {
    let undecided = |reason: String| Advice::Undecided { reason };
    if odometry.replayed.is_empty() && odometry.physics().is_none() {
        let reason = "the ideal drive was replayed alone: give parameter files by --kinematics, or \
                      a vehicle";
        return undecided(reason.to_owned());
    }
    let is_fitted = |one: &&Replayed| !odometry.is_held_out(one.parameters.source());
    let files = odometry.replayed.iter().filter(is_fitted).map(Replayed::name);
    let physics = odometry.is_physics_fitted_to_it().then_some(ParameterSet::PHYSICS_NAME);
    let fitted: Vec<&str> = files.chain(physics).collect();
    if !fitted.is_empty() {
        return undecided(format!(
            "{}: fitted to this driving, which makes errors look smaller: replay other driving, by \
             --runs or --time",
            fitted.join(", ")
        ));
    }
    let candidates = candidates(odometry);
    if candidates.is_empty() {
        return undecided("all parameters are doubtful".to_owned());
    }
    match chosen(odometry, &candidates) {
        Some((best, compared)) => match best.kind {
            Kind::File(one) => Advice::File { file: one.parameters.name().to_owned(), compared },
            Kind::Physics(file) => Advice::Physics { vehicle: file.vehicle.name.clone(), compared },
            Kind::Ideal => Advice::Ideal { compared },
        },
        None => undecided("too little driving for intervals: replay more of it".to_owned()),
    }
}

/// Sound sets beside the ideal drive: those with fewer parameters first, files in their order, the
/// forces last.
fn candidates(odometry: &Odometry) -> Vec<Candidate<'_>> {
    let sets = &odometry.comparison.sets;
    let sound = odometry.replayed.iter().filter(|one| !one.parameters.is_doubtful());
    let mut sound: Vec<&Replayed> = sound.collect();
    sound.sort_by_key(|one| one.set.without_alpha().is_some());
    let of_file = |one| {
        let set = sets.iter().position(|set| set.name() == Replayed::name(one))?;
        Some(Candidate { set, kind: Kind::File(one) })
    };
    let physics = odometry.physics().map(Kind::Physics);
    let physics = physics.map(|kind| Candidate { set: sets.len() - 1, kind });
    sound.into_iter().filter_map(of_file).chain(physics).collect()
}

/// The set to take, and how it compares with the others; none where no intervals are known.
fn chosen<'a>(
    odometry: &Odometry,
    candidates: &[Candidate<'a>],
) -> Option<(Candidate<'a>, Vec<Compared>)> {
    let span = odometry.comparison.drift()?;
    let ideal = Candidate { set: 0, kind: Kind::Ideal };
    let mut best = ideal;
    for one in candidates {
        if is_surely_better(span.ratio(one.set, best.set)?)? {
            best = *one;
        }
    }
    let others = std::iter::once(&ideal).chain(candidates).filter(|other| other.set != best.set);
    let compared = others.map(|other| {
        let [place, yaw] = span.ratio(best.set, other.set)?;
        let with = odometry.comparison.sets[other.set].name().to_owned();
        Some(Compared { with, place, yaw })
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
    /// What to take, in words: a file, `ideal` or `physics`; none where it is not decided.
    pub fn choice(&self) -> Option<&str> {
        match self {
            Self::File { file, .. } => Some(file),
            Self::Physics { .. } => Some(ParameterSet::PHYSICS_NAME),
            Self::Ideal { .. } => Some(ParameterSet::IDEAL_NAME),
            Self::Undecided { .. } => None,
        }
    }

    /// How the choice compares with the others.
    pub fn compared(&self) -> &[Compared] {
        match self {
            Self::File { compared, .. }
            | Self::Physics { compared, .. }
            | Self::Ideal { compared } => compared,
            Self::Undecided { .. } => &[],
        }
    }
}
