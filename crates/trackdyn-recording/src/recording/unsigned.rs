//! Speeds without a sign: of an encoder that counts and does not tell the direction, or that shows
//! one direction alone.
//!
//! # Law
//! The way of a track is D = p (s + c φ), with s the way forward and φ the turn of the poses, and c
//! its lever: positive on the right, negative on the left. A side whose readings never change their
//! sign shows |D|, or max(D, 0). It is doubted where the best p |s + c φ| or p max(s + c φ, 0)
//! explains its ways and no p s + q φ does, at any delay of the poses, and where s + c φ has both
//! signs. Late poses, slip and other units spoil all explanations or none. For a drive that only
//! goes forward, all are the same.

use super::Run;
use super::by_poses::{ByDelay, Row, larger, unexplained};
use crate::doubt::{Backwards, Doubt};
use trackdyn_core::{PerSide, Side};

/// Largest part of the way of a side, by its readings, that has the other sign: noise at rest.
const MAX_OTHER_SIGN: f64 = 0.005;

/// Least part of the squares that has to be unexplained without signs.
const MIN_UNSIGNED_RESIDUAL: f64 = 0.05;

/// Largest part that may be unexplained with signs, and its largest ratio to the part that is
/// unexplained without them.
const MAX_SIGNED_RESIDUAL: f64 = 0.15;
const MAX_RESIDUAL_RATIO: f64 = 0.25;

/// Least part of its way that a track has to have run the other way.
const MIN_SHARE: f64 = 0.03;

/// Levers that are tried: the least, m; the ratio of each to the one before; and their number. The
/// largest is 2.7 m.
const MIN_LEVER: f64 = 0.05;
const LEVER_RATIO: f64 = 1.19;
const LEVERS: i32 = 24;

/// What is known of a side whose speeds have no sign.
#[derive(Clone, Copy)]
struct Unsigned {
    shown: Backwards,
    share: f64,
    unexplained: [f64; 2],
}

/// Sides whose speeds never change their sign while the poses say that they have to.
pub(super) fn of(runs: &[Run], by_delay: &ByDelay) -> Option<Doubt> {
    let asked = PerSide::from_fn(|side: Side| keeps_its_sign(runs, side));
    if !(asked.left || asked.right) || !runs.iter().all(Run::has_positions) {
        return None;
    }
    let found =
        PerSide::from_fn(|side: Side| if asked[side] { unsigned(by_delay, side) } else { None });
    let (side, Unsigned { shown, share, unexplained }) = found.either(Unsigned::worse)?;
    Some(Doubt::Unsigned { shown, side, share, unexplained })
}

/// Whether nearly all of the way of a side has one sign.
fn keeps_its_sign(runs: &[Run], side: Side) -> bool {
    let speeds = || runs.iter().flat_map(Run::tracks).map(|reading| reading.speeds()[side]);
    let sum = |sense: f64| speeds().map(|speed| (sense * speed).max(0.0)).sum::<f64>();
    let [ahead, back] = [sum(1.0), sum(-1.0)];
    ahead + back > 0.0 && ahead.min(back) <= MAX_OTHER_SIGN * (ahead + back)
}

/// What is found of a side; none where its speeds may have a sign.
fn unsigned(by_delay: &ByDelay, side: Side) -> Option<Unsigned> {
    let least = |a: &(Backwards, [f64; 2]), b: &(Backwards, [f64; 2])| a.1[0].total_cmp(&b.1[0]);
    let as_read = by_delay.rows().map(|rows| unexplained(rows, |row| row.ways[side]));
    let as_read = as_read.min_by(f64::total_cmp)?;
    let levers = (0..LEVERS).map(|k| side.sign() * MIN_LEVER * LEVER_RATIO.powi(k));
    let tried = levers.flat_map(|lever| {
        by_delay.rows().flat_map(move |rows| {
            [Backwards::AsForwards, Backwards::AsZero]
                .map(|shown| (shown, left_with_signs(rows, side, lever, shown)))
        })
    });
    let (shown, [with_signs, share]) = tried.min_by(least)?;
    let is_found = as_read >= MIN_UNSIGNED_RESIDUAL
        && with_signs <= MAX_SIGNED_RESIDUAL.min(MAX_RESIDUAL_RATIO * as_read)
        && share >= MIN_SHARE;
    is_found.then_some(Unsigned { shown, share, unexplained: [as_read, with_signs] })
}

/// Part of the squares of the ways of a side that no p f(s + c φ) explains, with f the size or the
/// part that is positive, and the part of the way of s + c φ that has the rarer sign.
fn left_with_signs(rows: &[Row], side: Side, lever: f64, shown: Backwards) -> [f64; 2] {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    let (mut ahead, mut back) = (0.0_f64, 0.0_f64);
    for row in rows {
        let (way, read) = (row.forward + lever * row.turn, row.ways[side]);
        let seen = match shown {
            Backwards::AsForwards => way.abs(),
            Backwards::AsZero => way.max(0.0),
        };
        xx += seen * seen;
        xy += seen * read;
        yy += read * read;
        ahead += way.max(0.0);
        back += (-way).max(0.0);
    }
    if xx > 0.0 && yy > 0.0 {
        [1.0 - xy * xy / (xx * yy), ahead.min(back) / (ahead + back)]
    } else {
        [1.0, 0.0]
    }
}

impl Unsigned {
    /// The larger numbers of both.
    fn worse(self, other: Self) -> Self {
        let unexplained = larger(self.unexplained, other.unexplained);
        Self { share: self.share.max(other.share), unexplained, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::UncheckedRun;
    use crate::sample::{PoseSample, TrackSample};
    use trackdyn_core::Pose;

    /// Distance of the ICRs, m.
    const SEPARATION: f64 = 1.02;

    /// Commands of both sides, m/s, three seconds each.
    const COMMANDS_BOTH_WAYS: [[f64; 2]; 8] = [
        [0.5, 0.5],
        [-0.4, 0.4],
        [0.7, 0.3],
        [-0.5, -0.4],
        [0.6, -0.6],
        [0.2, 0.8],
        [0.0, 0.0],
        [-0.1, 0.5],
    ];
    const FORWARD_COMMANDS: [[f64; 2]; 8] = [
        [0.5, 0.5],
        [0.4, 0.6],
        [0.7, 0.3],
        [0.5, 0.4],
        [0.6, 0.8],
        [0.0, 0.7],
        [0.0, 0.0],
        [0.1, 0.5],
    ];

    /// A number of a small size that looks like noise.
    fn noise(k: u32, salt: f64) -> f64 {
        (12.9898 * f64::from(k) + 78.233 * salt).sin() * 43_758.545 % 1.0
    }

    /// A drive by these commands with poses that are late, and readings as `read` shows them.
    fn drive(
        commands: &[[f64; 2]],
        late: f64,
        noises: [f64; 3],
        read: impl Fn([f64; 2]) -> [f64; 2],
    ) -> Vec<Run> {
        let (step, mut at, mut speeds) = (0.02, Pose::default(), [0.0_f64; 2]);
        let [of_speeds, of_positions, of_yaw] = noises;
        let mut rows = UncheckedRun::default();
        for k in 0..7200_u32 {
            let t = step * f64::from(k);
            let to = commands[usize::try_from(k / 150).expect("small") % commands.len()];
            for (speed, to) in speeds.iter_mut().zip(to) {
                *speed += (to - *speed).clamp(-0.8 * step, 0.8 * step);
            }
            let read = read([
                speeds[0] + of_speeds * noise(k, 1.0),
                speeds[1] + of_speeds * noise(k, 2.0),
            ]);
            rows.tracks.samples.push(TrackSample { t, v_left: read[0], v_right: read[1] });
            if k % 5 == 0 {
                let [x, y, yaw] = [of_positions, of_positions, of_yaw];
                let pose = Pose::new(
                    at.x + x * noise(k, 3.0),
                    at.y + y * noise(k, 4.0),
                    at.yaw + yaw * noise(k, 5.0),
                );
                rows.poses.samples.push(PoseSample { t: t + late, pose });
            }
            let turn = step * (speeds[1] - speeds[0]) / SEPARATION;
            let way = step * f64::midpoint(speeds[0], speeds[1]);
            let (sin, cos) = (at.yaw + 0.5 * turn).sin_cos();
            at = Pose::new(at.x + way * cos, at.y + way * sin, at.yaw + turn);
        }
        vec![Run::new(rows, &mut Vec::new())]
    }

    const USUAL_NOISE: [f64; 3] = [0.01, 0.01, 0.01];

    fn found(runs: &[Run]) -> Option<(Option<Side>, f64)> {
        match of(runs, &ByDelay::new(runs)) {
            Some(Doubt::Unsigned { side, share, .. }) => Some((side, share)),
            _ => None,
        }
    }

    #[test]
    fn absolute_values_of_both_sides_or_of_one_are_found() {
        for late in [0.0, 0.3, -0.2, 3.0] {
            let both = drive(&COMMANDS_BOTH_WAYS, late, USUAL_NOISE, |v| v.map(f64::abs));
            let (side, share) = found(&both).expect("unsigned");
            assert!(side.is_none() && (0.2..0.5).contains(&share), "{late} {share}");
            let left = drive(&COMMANDS_BOTH_WAYS, late, USUAL_NOISE, |[l, r]| [l.abs(), r]);
            assert_eq!(found(&left).map(|(side, _)| side), Some(Some(Side::Left)), "{late}");
            let right = drive(&COMMANDS_BOTH_WAYS, late, USUAL_NOISE, |[l, r]| [l, -r.abs()]);
            assert_eq!(found(&right).map(|(side, _)| side), Some(Some(Side::Right)), "{late}");
        }
        let rough = drive(&COMMANDS_BOTH_WAYS, 0.1, [0.1, 0.05, 0.05], |v| v.map(f64::abs));
        assert!(found(&rough).is_some());
    }

    #[test]
    fn an_encoder_that_shows_one_direction_alone_is_found() {
        for late in [0.0, 0.3, 3.0] {
            let read = |v: [f64; 2]| v.map(|v| v.max(0.0));
            let both = drive(&COMMANDS_BOTH_WAYS, late, USUAL_NOISE, read);
            let Some(Doubt::Unsigned { shown, side, .. }) = of(&both, &ByDelay::new(&both)) else {
                panic!("{late}");
            };
            assert_eq!((shown, side), (Backwards::AsZero, None), "{late}");
        }
    }

    #[test]
    fn signed_speeds_are_fine() {
        for late in [0.0, 1.7, 9.0] {
            assert_eq!(
                found(&drive(&COMMANDS_BOTH_WAYS, late, USUAL_NOISE, |v| v)),
                None,
                "{late}"
            );
        }
    }

    #[test]
    fn a_drive_that_only_goes_forward_is_fine_however_late_or_rough() {
        for late in [0.0, 0.3, -0.7, 1.7, 5.3, 9.0] {
            for noises in [USUAL_NOISE, [0.2, 0.08, 0.08]] {
                let runs = drive(&FORWARD_COMMANDS, late, noises, |v| v.map(f64::abs));
                assert_eq!(found(&runs), None, "{late} {noises:?}");
                let coarse = |v: f64| (v.abs() / 0.2).round() * 0.2;
                let runs = drive(&FORWARD_COMMANDS, late, noises, |v| v.map(coarse));
                assert_eq!(found(&runs), None, "{late} {noises:?}");
            }
        }
    }

    /// A sensor that faces backwards, and poses in another unit.
    #[test]
    fn other_faults_are_no_missing_signs() {
        for scale in [-1.0, 0.001, 39.37] {
            let runs = drive(&FORWARD_COMMANDS, 0.2, USUAL_NOISE, |v| v.map(|v| scale * v.abs()));
            assert_eq!(found(&runs), None, "{scale}");
        }
    }
}
