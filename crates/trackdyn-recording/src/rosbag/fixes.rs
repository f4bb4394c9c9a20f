//! Poses from fixes of satellite navigation and the yaw of an IMU.
//!
//! Positions are metres east (x) and north (y) of the first fix. Yaw is that of the orientation of
//! an IMU, which counts counter-clockwise from east (REP-103); where the robot drives straight, it
//! is compared with the course.

use super::course::{COURSE_LENGTH, MIN_STRAIGHT_PIECES, aligned, straight, wrapped};
use super::date::Received;
use crate::recording::Course;
use crate::wgs84::east_north;
use std::f64::consts::PI;
use trackdyn_core::robust::deviation_about_zero;

/// Smallest distance from the first yaw at which an orientation counts as one that changes, rad:
/// above the drift of an IMU at rest.
const MIN_YAW_CHANGE: f64 = 0.2;

/// Longest time between two yaws that are interpolated, ns: a robot that turns by 3 rad/s makes
/// less than half a turn.
const MAX_YAW_INTERVAL: i64 = 1_000_000_000;

/// Largest mean angle between yaw and course, rad: 20 degrees, above that of sensors mounted by eye
/// and of robots that slide on a slope.
const MAX_COURSE_OFFSET: f64 = 0.35;

/// Smallest mean resultant length of doubled angles between yaw and course: below it, the yaw does
/// not follow the course. That of a compass does not: it counts clockwise.
const MIN_COURSE_AGREEMENT: f64 = 0.5;

/// Largest scatter of the fixes, m, by which a course of that length can be told.
const MAX_SCATTER: f64 = COURSE_LENGTH / 6.0;

/// A fix: latitude and longitude in degrees, altitude in metres.
pub(super) type Fix = Received<[f64; 3]>;

/// Poses: metres east and north, yaw in rad.
pub(super) type Poses = Vec<Received<[f64; 3]>>;

/// The yaw of an IMU, rad.
pub(super) type Yaw = Received<f64>;

/// Whether the yaw of an IMU changes.
pub(super) fn changes(yaws: &[Yaw]) -> bool {
    let first = yaws.first().map_or(0.0, |yaw| yaw.value);
    yaws.iter().any(|yaw| wrapped(yaw.value - first).abs() > MIN_YAW_CHANGE)
}

/// Places (east, north) of fixes, m, with their times, ns.
fn places(fixes: &[(i64, Fix)]) -> Vec<[f64; 2]> {
    let Some(origin) = fixes.first().map(|(_, fix)| fix.value) else { return Vec::new() };
    let level = |altitude: f64| if altitude.is_finite() { altitude } else { 0.0 };
    let place = |(_, fix): &(i64, Fix)| {
        let [latitude, longitude, altitude] = fix.value;
        let origin = [origin[0], origin[1], level(origin[2])];
        east_north(origin, [latitude, longitude, level(altitude)])
    };
    fixes.iter().map(place).collect()
}

/// Poses (east, north, yaw) at the fixes that a yaw is known at, and the number of others. Fixes
/// and yaws with their times, ns, in the order of these. `mount` is the heading of the IMU on the
/// robot, rad: the yaw is left as measured, and is compared with the course without it.
///
/// # Errors
/// A yaw that is not that of the course.
pub(super) fn poses(
    fixes: &[(i64, Fix)],
    yaws: &[(i64, f64)],
    mount: f64,
) -> Result<(Poses, u64), String> {
    let (found, left_out) = with_yaws(fixes, yaws);
    check_course(&found, mount)?;
    Ok((undated(found), left_out))
}

/// As [`poses`], with a gyroscope that has turned by these angles, with their times, ns, in place
/// of yaws: turned to the course.
///
/// # Errors
/// Fixes that tell no course, or one that the gyroscope does not follow.
pub(super) fn poses_by_gyroscope(
    fixes: &[(i64, Fix)],
    turned: &[(i64, f64)],
) -> Result<(Poses, u64, Course), String> {
    let (found, _) = with_yaws(fixes, turned);
    if let Some(scatter) = scatter(&found).filter(|scatter| *scatter > MAX_SCATTER) {
        return Err(coarse(scatter, "its yaw rates, added up,"));
    }
    let (yaws, course) = aligned(turned, &straight(&found))?;
    let (found, left_out) = with_yaws(fixes, &yaws);
    Ok((undated(found), left_out, course))
}

/// Poses with their times, ns.
type Dated = Vec<(i64, Received<[f64; 3]>)>;

/// Poses without their times.
fn undated(poses: Dated) -> Poses {
    poses.into_iter().map(|(_, pose)| pose).collect()
}

/// Poses at the fixes that a yaw is known at, and the number of others.
fn with_yaws(fixes: &[(i64, Fix)], yaws: &[(i64, f64)]) -> (Dated, u64) {
    let mut left_out = 0;
    let mut found = Vec::new();
    for ((time, fix), [x, y]) in fixes.iter().zip(places(fixes)) {
        match yaw_at(yaws, *time) {
            Some(yaw) => found.push((*time, fix.with([x, y, yaw]))),
            None => left_out += 1,
        }
    }
    (found, left_out)
}

/// The yaw between the two nearest ones, along the shorter way.
fn yaw_at(yaws: &[(i64, f64)], time: i64) -> Option<f64> {
    let after = yaws.partition_point(|(known, _)| *known < time);
    let (end, last) = *yaws.get(after)?;
    if end == time {
        return Some(last);
    }
    let (start, first) = *yaws.get(after.checked_sub(1)?)?;
    let interval = end.saturating_sub(start);
    #[expect(clippy::cast_precision_loss, reason = "at most a second")]
    let portion = |part: i64| part as f64 / interval as f64;
    (interval <= MAX_YAW_INTERVAL)
        .then(|| first + wrapped(last - first) * portion(time.saturating_sub(start)))
}

/// By how much fixes miss a smooth way, m, each by itself; none of fewer than three.
fn scatter(poses: &[(i64, Received<[f64; 3]>)]) -> Option<f64> {
    let bends = poses.windows(3).flat_map(|three| {
        [0, 1].map(|axis| {
            let [before, at, after] = [0, 1, 2].map(|k| three[k].1.value[axis]);
            before - 2.0 * at + after
        })
    });
    // Var(p0 - 2 p1 + p2) = 6 sigma^2
    Some(deviation_about_zero(&mut bends.collect::<Vec<_>>())? / 6.0_f64.sqrt())
}

/// What is said of fixes that tell no course; `what` is compared with it.
fn coarse(scatter: f64, what: &str) -> String {
    format!(
        "{what} cannot be compared with the course of the fixes, which scatter by some \
         {scatter:.1} m from one to the next: expected fixes that are known to some \
         centimetres, as a receiver with corrections (RTK) gives them; the gyroscope of an \
         IMU alone, by --pose-topic of its topic, tells x_r - x_l"
    )
}

/// Compares yaw and course where the robot drives straight, forward or backward.
fn check_course(poses: &[(i64, Received<[f64; 3]>)], mount: f64) -> Result<(), String> {
    let (mut cos, mut sin, mut count) = (0.0, 0.0, 0_u32);
    for piece in straight(poses) {
        // The doubled angle is that of driving forward and of driving backward.
        let doubled = 2.0 * (piece.off + mount);
        cos += doubled.cos();
        sin += doubled.sin();
        count += 1;
    }
    if count < MIN_STRAIGHT_PIECES {
        return Ok(());
    }
    let (agreement, offset) = (cos.hypot(sin) / f64::from(count), sin.atan2(cos) / 2.0);
    let expected = "expected yaw that counts counter-clockwise from east, as REP-103 has it";
    if agreement < MIN_COURSE_AGREEMENT
        && let Some(scatter) = scatter(poses).filter(|scatter| *scatter > MAX_SCATTER)
    {
        return Err(coarse(scatter, "its yaw"));
    }
    if agreement < MIN_COURSE_AGREEMENT {
        return Err(format!("its yaw does not follow the course of the fixes: {expected}"));
    }
    if offset.abs() > MAX_COURSE_OFFSET {
        // Which way is forward, the course does not say: tracks that contradict the poses do.
        let [off, other] = [mount - offset, mount - offset + PI].map(|of| wrapped(of).to_degrees());
        return Err(format!(
            "its yaw is off the course of the fixes by {off:.0} or {other:.0} degrees: {expected}; \
             --mount-yaw {off:.0} takes it back, --mount-yaw {other:.0} where the tracks then say \
             that the robot drives backwards"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fixes, yaws of the IMU, and the pose at each fix.
    type Driven = (Vec<(i64, Fix)>, Vec<(i64, f64)>, Vec<[f64; 3]>);

    /// A drive with turns: a fix each 0.2 s, a yaw each 0.1 s; `reported` makes the yaw of the IMU.
    fn drive(reported: impl Fn(f64) -> f64) -> Driven {
        let (mut x, mut y, mut yaw) = (0.0, 0.0, 0.3_f64);
        let (mut fixes, mut yaws, mut truth) = (Vec::new(), Vec::new(), Vec::new());
        for step in 0..2000_i64 {
            let time = step * 100_000_000;
            if step % 2 == 0 {
                // metres per degree at 45 degrees north
                let value = [45.0 + y / 111_131.75, 8.0 + x / 78_846.81, 100.0];
                fixes.push((time, Received { stamp_ns: Some(time + 1), log_ns: 0, value }));
                truth.push([x, y, yaw]);
            }
            yaws.push((time, reported(yaw)));
            yaw += if step % 100 < 80 { 0.0 } else { 0.05 };
            (x, y) = (x + 0.1 * yaw.cos(), y + 0.1 * yaw.sin());
        }
        (fixes, yaws, truth)
    }

    #[test]
    fn poses_are_those_of_the_drive() {
        let (fixes, yaws, truth) = drive(wrapped);
        let (poses, left_out) = poses(&fixes, &yaws, 0.0).expect("poses");
        assert_eq!((poses.len(), left_out), (truth.len(), 0));
        for (pose, [x, y, yaw]) in poses.iter().zip(truth) {
            // the plane bends away by less than a millimetre over these 100 m
            assert!(
                (pose.value[0] - x).hypot(pose.value[1] - y) < 0.01,
                "{:?} {x} {y}",
                pose.value
            );
            assert!(wrapped(pose.value[2] - yaw).abs() < 1e-12);
        }
    }

    #[test]
    fn a_compass_and_an_arbitrary_zero_are_refused() {
        let refused = |reported: fn(f64) -> f64| {
            let (fixes, yaws, _) = drive(reported);
            poses(&fixes, &yaws, 0.0).expect_err("refused")
        };
        assert!(refused(|yaw| PI / 2.0 - yaw).contains("does not follow"));
        let text = refused(|yaw| yaw - 1.0);
        assert!(text.contains("by -57 or 123 degrees"), "{text}");
        assert!(text.contains("--mount-yaw -57 takes it back"), "{text}");
        // which leaves the yaw as it is
        let (fixes, yaws, truth) = drive(|yaw| yaw - 1.0);
        let (found, _) = poses(&fixes, &yaws, (-57.0_f64).to_radians()).expect("poses");
        assert!(wrapped(found[0].value[2] + 1.0 - truth[0][2]).abs() < 1e-12);
        // backward all the time
        let (fixes, yaws, _) = drive(|yaw| yaw + PI);
        assert!(poses(&fixes, &yaws, 0.0).is_ok());
    }

    /// A gyroscope counts from where it was switched on, and its bias adds up: 34 degrees here.
    #[test]
    fn a_gyroscope_is_turned_to_the_course() {
        const BIAS: f64 = 0.003;
        const SCALE: f64 = 0.99;
        let (fixes, mut turned, truth) = drive(|yaw| yaw - 1.7);
        for (time, angle) in &mut turned {
            *angle = *angle / SCALE + BIAS * crate::rosbag::date::seconds(0, *time);
        }
        let (poses, left_out, course) = poses_by_gyroscope(&fixes, &turned).expect("poses");
        assert_eq!((poses.len(), left_out), (truth.len(), 0));
        // b is of the true rate, and so is 1 + e of the measured one
        assert!((course.bias - SCALE * BIAS).abs() < 1e-5, "{course:?}");
        assert!((course.scale - SCALE).abs() < 1e-4, "{course:?}");
        assert!(course.scatter < 1e-3 && course.pieces >= 40, "{course:?}");
        for (pose, [.., yaw]) in poses.iter().zip(truth) {
            assert!(wrapped(pose.value[2] - yaw).abs() < 1e-3, "{} {yaw}", pose.value[2]);
        }
    }

    #[test]
    fn a_gyroscope_upside_down_and_coarse_fixes_are_refused() {
        let (fixes, turned, _) = drive(|yaw| -yaw);
        let text = poses_by_gyroscope(&fixes, &turned).expect_err("refused");
        assert!(text.contains("at any bias") && text.contains("counter-clockwise"), "{text}");
        let (mut fixes, turned, _) = drive(|yaw| yaw);
        for (k, (_, fix)) in fixes.iter_mut().enumerate() {
            fix.value[0] += if k % 3 == 0 { 3e-5 } else { 0.0 };
        }
        let text = poses_by_gyroscope(&fixes, &turned).expect_err("refused");
        assert!(text.contains("scatter by some") && text.contains("--pose-topic"), "{text}");
    }

    #[test]
    fn a_way_without_straight_pieces_tells_no_yaw() {
        let (fixes, turned, _) = drive(|yaw| yaw);
        let text = poses_by_gyroscope(&fixes[..60], &turned).expect_err("refused");
        assert!(text.contains("straight pieces of 3 m"), "{text}");
    }

    /// Where it is the fixes that are coarse, the yaw is not blamed.
    #[test]
    fn fixes_without_corrections_do_not_tell_a_course() {
        let (mut fixes, yaws, _) = drive(wrapped);
        let mut off = 0.5_f64;
        for (_, fix) in &mut fixes {
            for degrees in &mut fix.value[..2] {
                // logistic map: without order from one fix to the next
                off = 3.99 * off * (1.0 - off);
                *degrees += (off - 0.5) * 4e-5;
            }
        }
        let text = poses(&fixes, &yaws, 0.0).expect_err("refused");
        assert!(text.contains("which scatter by some") && text.contains("(RTK)"), "{text}");
        assert!(!text.contains("does not follow"), "{text}");
    }

    #[test]
    fn fixes_without_a_yaw_nearby_are_left_out() {
        let (fixes, mut yaws, _) = drive(|yaw| yaw);
        yaws.retain(|(time, _)| !(100..150).contains(&(time / 100_000_000)));
        let (poses, left_out) = poses(&fixes, &yaws, 0.0).expect("poses");
        assert_eq!((poses.len(), left_out), (fixes.len() - 25, 25));
    }

    #[test]
    fn an_orientation_that_drifts_by_little_does_not_change() {
        let of = |values: [f64; 3]| {
            changes(&values.map(|value| Received { stamp_ns: None, log_ns: 0, value }))
        };
        assert!(!of([1.0, 1.1, 0.9]));
        assert!(!of([3.1, -3.1, 3.0]));
        assert!(of([1.0, 1.1, 0.5]));
    }
}
