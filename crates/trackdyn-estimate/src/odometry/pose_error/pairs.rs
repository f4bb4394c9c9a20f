//! Which poses relative errors compare.

use trackdyn_core::Pose;

/// How far apart the poses of a pair are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Delta {
    /// This many poses; zero counts as one.
    Frames(usize),
    /// This much of the path, m.
    Metres(f64),
}

/// Largest deviation from the distance asked for, of that distance, where all pairs count: evo's
/// default.
const DISTANCE_TOLERANCE: f64 = 0.1;

/// Indices of pairs along a path: one after the other, or for `all` one from every pose.
///
/// Over metres, a pair that follows another ends where the distance is reached; with `all`, a pair
/// ends at the pose nearest to the distance, if that is within a tenth of it.
pub fn pairs(path: &[Pose], delta: Delta, all: bool) -> Vec<[usize; 2]> {
    match delta {
        Delta::Frames(frames) => {
            let frames = frames.max(1);
            let step = if all { 1 } else { frames };
            let last = path.len().saturating_sub(frames);
            (0..last).step_by(step).map(|from| [from, from + frames]).collect()
        }
        Delta::Metres(distance) if all => every_pair(&travelled(path), distance),
        Delta::Metres(distance) => consecutive_pairs(path, distance),
    }
}

fn step(from: &Pose, to: &Pose) -> f64 {
    (to.x - from.x).hypot(to.y - from.y)
}

/// Length of the path up to each pose, m.
fn travelled(path: &[Pose]) -> Vec<f64> {
    let mut sum = 0.0;
    let steps = path.windows(2).map(|pair| {
        sum += step(&pair[0], &pair[1]);
        sum
    });
    std::iter::once(0.0).chain(steps).collect()
}

fn every_pair(travelled: &[f64], distance: f64) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for from in 0..travelled.len().saturating_sub(1) {
        let miss = |to: usize| (travelled[to] - travelled[from] - distance).abs();
        // The distance grows along the path: the nearest pose is the first that reaches it or the
        // one before. Where several are equally near, the first counts.
        let reached = travelled.partition_point(|sum| sum - travelled[from] < distance);
        let candidates = (reached.saturating_sub(1)..=reached)
            .map(|to| to.clamp(from + 1, travelled.len() - 1))
            .map(|to| first_of(travelled, from, to));
        let nearest = candidates.min_by(|a, b| miss(*a).total_cmp(&miss(*b)));
        if let Some(to) = nearest.filter(|to| miss(*to) <= DISTANCE_TOLERANCE * distance) {
            pairs.push([from, to]);
        }
    }
    pairs
}

/// The first pose after `from` at which as much is travelled as at `to`: the robot may stand.
fn first_of(travelled: &[f64], from: usize, to: usize) -> usize {
    travelled.partition_point(|sum| *sum < travelled[to]).max(from + 1)
}

fn consecutive_pairs(path: &[Pose], distance: f64) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    let (mut from, mut sum) = (0, 0.0);
    for to in 1..path.len() {
        sum += step(&path[to - 1], &path[to]);
        if sum >= distance {
            pairs.push([from, to]);
            (from, sum) = (to, 0.0);
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(places: &[f64]) -> Vec<Pose> {
        places.iter().map(|x| Pose::new(*x, 0.0, 0.0)).collect()
    }

    #[test]
    fn frames() {
        let path = path(&[0.0; 6]);
        assert_eq!(pairs(&path, Delta::Frames(2), false), [[0, 2], [2, 4]]);
        assert_eq!(pairs(&path, Delta::Frames(4), true), [[0, 4], [1, 5]]);
        assert_eq!(pairs(&path, Delta::Frames(6), true), [[0; 2]; 0]);
    }

    #[test]
    fn metres() {
        let path = path(&[0.0, 0.6, 1.0, 1.5, 2.05, 2.05, 2.05]);
        assert_eq!(pairs(&path, Delta::Metres(1.0), false), [[0, 2], [2, 4]]);
        // From 0.6 m, the pose at 1.5 m is 0.9 m away and just near enough; standing counts once.
        assert_eq!(pairs(&path, Delta::Metres(1.0), true), [[0, 2], [1, 3], [2, 4]]);
        assert_eq!(pairs(&[], Delta::Metres(1.0), true), [[0; 2]; 0]);
    }
}
