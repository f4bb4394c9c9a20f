//! When the outermost transform of a chain is measured.
//!
//! # Law
//! A localisation publishes map → odom, so that map → odom → base_link is where it found the robot.
//! It finds it now and then, and sends the transform again and again in between: what moves then is
//! odometry, whatever the frame of the poses. So a pose is measured where the value of map → odom
//! changes.
//!
//! A value often holds for the time to come, and is stamped ahead. It was found no later than it
//! was logged: where its stamp is later than the transform of odometry that is logged next, it
//! belongs to the one before.

use crate::rosbag::clock::By;
use crate::rosbag::date::{Received, Stamped};
use nalgebra::Isometry3;

/// Least corrections that poses are taken from: a map that is set by hand is set less often.
pub(super) const MIN_CORRECTIONS: usize = 10;

/// Largest difference of a transform that is sent again, m and rad: rounding.
const MAX_ROUNDING: f64 = 1e-9;

/// Whether two transforms are one value.
fn are_same(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    (a.translation.vector - b.translation.vector).norm() <= MAX_ROUNDING
        && a.rotation.angle_to(&b.rotation) <= MAX_ROUNDING
}

/// Each value of a transform that differs from the one before, in the order of logging. When the
/// first was measured is not known.
pub(super) fn changes(
    received: &[Received<Isometry3<f64>>],
) -> impl Iterator<Item = &Received<Isometry3<f64>>> {
    let pairs = received.windows(2).filter(|pair| !are_same(&pair[0].value, &pair[1].value));
    pairs.map(|pair| &pair[1])
}

/// When the values of the outer transform were measured, in the order of time; of those of one
/// time, the last. The inner transform is that of odometry.
pub(super) fn corrections(
    outer: &[Received<Isometry3<f64>>],
    inner: &[Received<Isometry3<f64>>],
    by: By,
) -> Vec<Stamped<Isometry3<f64>>> {
    let [of_outer, of_inner] = [stamps(outer, by), stamps(inner, by)];
    let mut odometry = inner.iter().peekable();
    let mut newest: Option<i64> = None;
    let mut measured: Vec<Stamped<Isometry3<f64>>> = Vec::new();
    for one in changes(outer) {
        while let Some(other) = odometry.next_if(|other| other.log_ns <= one.log_ns) {
            newest = newest.max(of_inner(other));
        }
        let Some(stamp) = of_outer(one) else { continue };
        let next = odometry.peek().and_then(|next| of_inner(next));
        let is_ahead = next.or(newest).is_some_and(|known| stamp > known);
        measured.push((newest.filter(|_| is_ahead).unwrap_or(stamp), one.value));
    }
    // a stable order: the last of one time is the last that was logged
    measured.sort_by_key(|(stamp, _)| *stamp);
    measured.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        if is_same {
            *kept = *next;
        }
        is_same
    });
    measured
}

/// What dates transforms: logging where none has a stamp.
fn stamps<T>(received: &[Received<T>], by: By) -> impl Fn(&Received<T>) -> Option<i64> + use<T> {
    let is_logged = by == By::Log || received.iter().all(|one| one.stamp_ns.is_none());
    move |one| if is_logged { Some(one.log_ns) } else { one.stamp_ns }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// Transforms at these times, which are logged a millisecond later, with these x.
    fn link(times: &[i64], ahead: i64, x: impl Fn(i64) -> f64) -> Vec<Received<Isometry3<f64>>> {
        let transform = |&t: &i64| Received {
            stamp_ns: Some(t + ahead),
            log_ns: t + 1,
            value: Isometry3::new(Vector3::new(x(t), 0.0, 0.0), Vector3::new(0.0, 0.0, 1.0)),
        };
        times.iter().map(transform).collect()
    }

    fn every(interval: i64) -> Vec<i64> {
        (0..200).map(|k| interval * k).take_while(|t| *t < 4000).collect()
    }

    /// Where a map stands that is corrected once in a second.
    fn each_second(t: i64) -> f64 {
        [0.0, 0.1, 0.3, 0.2][usize::try_from(t / 1000).expect("few")]
    }

    fn times(measured: &[Stamped<Isometry3<f64>>]) -> Vec<(i64, f64)> {
        measured.iter().map(|(stamp, value)| (*stamp, value.translation.x)).collect()
    }

    #[test]
    fn a_value_that_is_sent_again_counts_once() {
        let rounding = |t: i64| each_second(t) + if t % 100 == 0 { 1e-13 } else { 0.0 };
        let outer = link(&every(50), 0, rounding);
        assert_eq!(changes(&outer).count(), 3);
        let inner = link(&every(20), 0, |_| 0.0);
        let found = times(&corrections(&outer, &inner, By::Header));
        let expected = [(1000, 0.1), (2000, 0.3), (3000, 0.2)];
        assert!(found.iter().zip(expected).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-12));
        assert_eq!(found.len(), 3);
    }

    #[test]
    fn a_value_that_is_stamped_ahead_belongs_to_the_odometry_before() {
        let outer = link(&every(50), 500, each_second);
        let inner = link(&every(20), 0, |_| 0.0);
        let found = times(&corrections(&outer, &inner, By::Header));
        assert_eq!(found, [(1000, 0.1), (2000, 0.3), (3000, 0.2)]);
        // without odometry, stamps are all that there is
        assert_eq!(times(&corrections(&outer, &[], By::Header))[0], (1500, 0.1));
        let logged = times(&corrections(&outer, &inner, By::Log));
        assert_eq!(logged, [(1001, 0.1), (2001, 0.3), (3001, 0.2)]);
    }

    #[test]
    fn of_two_values_for_one_time_the_last_counts() {
        let x = |t: i64| f64::from(i32::try_from(t).expect("small"));
        let outer = link(&[0, 100, 101, 102], 500, x);
        let inner = link(&[0, 90, 200], 0, |_| 0.0);
        let found = times(&corrections(&outer, &inner, By::Header));
        assert_eq!(found, [(90, 102.0)]);
    }

    #[test]
    fn transforms_without_stamps_are_dated_by_their_logging() {
        let mut outer = link(&every(50), 0, each_second);
        let mut inner = link(&every(20), 0, |_| 0.0);
        for one in outer.iter_mut().chain(&mut inner) {
            one.stamp_ns = None;
        }
        assert_eq!(times(&corrections(&outer, &inner, By::Header))[0], (1001, 0.1));
    }
}
