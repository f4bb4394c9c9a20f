//! Yaw rates at the end of a gyroscope's range, where nothing else tells the yaw.
//!
//! # Law
//! A robot turns by ω = k (V_r − V_l), where k changes by some percent with the speed. At the end
//! of a range, ω stays at a limit L while V_r − V_l goes on. So k is taken from slow turning, and
//! pieces are looked at in which k (V_r − V_l) lies well beyond L, the largest |ω|. A gyroscope
//! that follows has hardly any. Where there are many, they stand at L although V_r − V_l differs,
//! or readings repeat L to the last digit.

use super::Run;
use super::motion::{Following, Piece, pieces};
use crate::doubt::Doubt;
use trackdyn_core::real;
use trackdyn_core::robust::quantile;

/// Share of the pieces that turn no faster than the limit: single readings may.
const LIMIT_QUANTILE: f64 = 0.98;

/// Part of the limit up to which turning is slow, and part of it from which on it tells k.
const SLOW_TURNING: [f64; 2] = [0.1, 0.6];

/// Turning by the tracks, in limits, from which on it lies beyond.
const MIN_BEYOND: f64 = 1.2;

/// Fewest such pieces, and their least share in all.
const MIN_PIECES: usize = 12;
const MIN_SHARE: f64 = 0.03;

/// Least part of the limit at which a piece beyond stands, and the least share of these that do.
const MIN_AT_LIMIT: f64 = 0.85;
const MIN_STANDING_SHARE: f64 = 0.8;

/// Least ratio of the upper to the lower decile of V_r − V_l in these.
const MIN_DECILE_RATIO: f64 = 1.15;

/// Part of the largest reading by which others are equal to it, and their least share.
const ROUNDING: f64 = 1e-5;
const MIN_EQUAL_SHARE: f64 = 0.01;

/// A gyroscope at the end of its range, in runs that have yaw alone, which follows the tracks.
pub(super) fn of(runs: &[Run], following: &Following) -> Option<Doubt> {
    let rates = |run: &Run, piece: &Piece| {
        let (ways, time) = (following.ways(run, piece), piece.end - piece.start);
        [piece.turn / time, (ways.right - ways.left) / time]
    };
    // ω and V_r − V_l of each piece, as sizes
    let all: Vec<[f64; 2]> = runs
        .iter()
        .flat_map(|run| pieces(run).into_iter().map(move |piece| (run, piece)))
        .filter(|(run, piece)| piece.is_covered(run.tracks(), following.delay))
        .map(|(run, piece)| rates(run, &piece).map(f64::abs))
        .collect();
    let column = |rows: &[[f64; 2]], k: usize| rows.iter().map(|row| row[k]).collect::<Vec<_>>();
    let limit = quantile(&mut column(&all, 0), LIMIT_QUANTILE)?;
    let [least, most] = SLOW_TURNING.map(|part| part * limit);
    let slow = all.iter().filter(|[rate, by]| (least..most).contains(rate) && *by > 0.0);
    let per_metre = quantile(&mut slow.map(|[rate, by]| rate / by).collect::<Vec<_>>(), 0.5)?;
    let is_beyond = |row: &&[f64; 2]| per_metre * row[1] > MIN_BEYOND * limit;
    let beyond: Vec<[f64; 2]> = all.iter().filter(is_beyond).copied().collect();
    let share = real(beyond.len()) / real(all.len());
    if beyond.len() < MIN_PIECES || share < MIN_SHARE {
        return None;
    }
    let standing = beyond.iter().filter(|[rate, _]| *rate > MIN_AT_LIMIT * limit).count();
    let [low, high] = [0.1, 0.9].map(|share| quantile(&mut column(&beyond, 1), share));
    let differs = high? > MIN_DECILE_RATIO * low?;
    let stands = real(standing) > MIN_STANDING_SHARE * real(beyond.len());
    let fastest = per_metre * high?;
    ((stands && differs) || repeats_its_largest(runs)).then_some(Doubt::SaturatedGyroscope {
        limit,
        fastest,
        share,
    })
}

/// Whether many readings of the gyroscope are equal to the largest one of their sense.
fn repeats_its_largest(runs: &[Run]) -> bool {
    let readings = || runs.iter().flat_map(Run::imu).map(|reading| reading.gyro_z);
    let count = readings().count();
    let is_met_often = |sense: f64| {
        let largest = readings().map(|rate| sense * rate).fold(0.0, f64::max);
        let met = readings().filter(|rate| sense * rate > (1.0 - ROUNDING) * largest).count();
        largest > 0.0 && real(met) > MIN_EQUAL_SHARE * real(count)
    };
    is_met_often(1.0) || is_met_often(-1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{UncheckedRun, turn_by_gyroscope};
    use crate::sample::{ImuSample, TrackSample};

    /// Two minutes of turning to and fro at speeds that differ, whose yaw rates a gyroscope shows
    /// as `shown` says.
    fn driven(shown: impl Fn(f64, u32) -> f64) -> Vec<Run> {
        let mut rows = UncheckedRun::default();
        for k in 0..12_000_u32 {
            let t = 0.01 * f64::from(k);
            let size = 0.2 + 0.6 * (0.11 * t).sin().powi(2);
            let speed = size * (0.6 * t).sin();
            rows.tracks.samples.push(TrackSample { t, v_left: -speed, v_right: speed });
            // faster turns slip more
            let rate = 2.0 * speed / (0.9 + 0.1 * speed.abs());
            let none = f64::NAN;
            let gyro_z = shown(rate, k);
            rows.imu.samples.push(ImuSample { t, gyro_z, acc_x: none, acc_y: none });
        }
        turn_by_gyroscope(&mut rows);
        vec![Run::new(rows, &mut Vec::new())]
    }

    /// A number of a small size that looks like noise.
    fn noise(k: u32) -> f64 {
        (12.9898 * f64::from(k)).sin() * 43_758.545 % 1.0
    }

    #[test]
    fn the_end_of_a_range_is_found_and_turning_that_follows_is_not() {
        let of = |runs: &[Run]| of(runs, &Following::of(runs, &|_, _, _| false)?);
        assert_eq!(of(&driven(|rate, _| rate)), None);
        assert_eq!(of(&driven(|rate, k| rate + 0.05 * noise(k))), None);
        for limit in [0.4, 0.8] {
            for plateau in [0.0, 0.02] {
                let runs = driven(|rate, k| rate.clamp(-limit, limit) + plateau * noise(k));
                let Some(Doubt::SaturatedGyroscope { limit: found, fastest, share }) = of(&runs)
                else {
                    panic!("{limit} {plateau}");
                };
                assert!((found / limit - 1.0).abs() < 0.1, "{found} {limit}");
                assert!(fastest > 1.2 * limit && share > 0.03, "{fastest} {share}");
            }
        }
    }
}
