//! Speeds that are cut off to whole steps, towards zero, as a cast to an integer does.
//!
//! # Law
//! Of a step q, a speed that is rounded is off by nothing on average, one that is cut off by q/2
//! towards zero. With D the way by the readings of a side and N = ∫ q/2 sgn V dt,
//!
//! turn = Σ b (D + κ N) and way forward = Σ a (D + κ N): κ is 0 of rounded speeds, 1 of cut ones.
//!
//! b and a are those of [`linear`](super::linear). Where κ is surely nearer to 1, half a step is
//! added to all readings that are not zero.

use super::Run;
use super::bias::speeds;
use super::finding::{Cleaning, Finding};
use super::linear::{Linear, MIN_PIECE};
use super::motion::Piece;
use crate::hold::travelled;
use crate::sample::{Stream, TrackSample};
use trackdyn_core::{PerSide, Side, real};

/// Fewest sizes of speeds that tell a step, and how often one has to be read: a few levels that are
/// commanded are no lattice, and a reading that was mended is on none.
const MIN_SIZES: usize = 5;
const MIN_READINGS: usize = 3;

/// Least part of the readings that are multiples of the step, and by how much of it they may be
/// off: the rest was mended.
const MIN_SHARE: f64 = 0.98;
const MAX_STEP_DEVIATION: f64 = 0.02;

/// Differences of speeds that are rounding, as share of the largest speed.
const ROUNDING: f64 = 1e-6;

/// Smallest half step, as share of the root mean square of the speeds of its side.
const MIN_HALF_STEP: f64 = 0.005;

/// Standard errors by which κ, the mean of both channels, has to be nearer to one than to zero, and
/// by which each channel may be off. Slip of real robots, which the errors take for chance, reaches
/// three.
const MIN_ERRORS: f64 = 4.0;
const MAX_ERRORS: f64 = 3.0;

/// Smallest and largest κ of speeds that are cut off: halfway to rounded ones, and as far beyond.
const MIN_KAPPA: f64 = 0.5;
const MAX_KAPPA: f64 = 1.5;

/// Adds half a step to speeds that are cut off; `cleanings` takes what was found.
pub(super) fn mend(runs: &mut [Run], cleanings: &mut Vec<Cleaning>) {
    let of = |side: Side| step(&speeds(runs, side).collect::<Vec<_>>());
    let steps = PerSide::from_fn(of);
    if (steps.left.is_none() && steps.right.is_none()) || !are_cut_off(runs, steps) {
        return;
    }
    for (side, step) in Side::BOTH.into_iter().filter_map(|side| Some((side, steps[side]?))) {
        for run in runs.iter_mut() {
            let (id, mut at) = (run.id(), Vec::new());
            for reading in run.readings_mut() {
                let missing = missing(reading.speeds()[side], step);
                if missing != 0.0 {
                    *reading.speed_mut(side) += missing;
                    at.push(reading.t);
                }
            }
            let Some(&t) = at.first() else { continue };
            let (stream, finding) = (Stream::Tracks, Finding::CutOff { side, step });
            cleanings.push(Cleaning { stream, finding, count: at.len(), runs: 1, run: id, t });
        }
    }
}

/// q/2 sgn V: what a speed that is cut off to a step lacks on average, m/s.
fn missing(speed: f64, step: f64) -> f64 {
    if speed == 0.0 { 0.0 } else { 0.5 * step * speed.signum() }
}

/// The step whose multiples the speeds are; none where there is none, or it is small.
fn step(speeds: &[f64]) -> Option<f64> {
    let mut sizes: Vec<f64> = speeds.iter().map(|speed| speed.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let rounding = ROUNDING * sizes.last()?;
    let alike = sizes.chunk_by(|before, next| next - before <= rounding);
    let often = alike.filter(|alike| alike.len() >= MIN_READINGS).map(|alike| alike[0]);
    let sizes: Vec<f64> = often.filter(|size| *size > rounding).collect();
    if sizes.len() < MIN_SIZES {
        return None;
    }
    let between = sizes.windows(2).map(|pair| pair[1] - pair[0]);
    let mut step = between.chain(sizes.first().copied()).fold(f64::INFINITY, f64::min);
    // Small multiples tell the step well enough to count larger ones: q = Σ n v/Σ n².
    let (mut nv, mut nn) = (0.0, 0.0);
    for size in &sizes {
        let n = (size / step).round();
        if (size / step - n).abs() <= MAX_STEP_DEVIATION {
            nv += n * size;
            nn += n * n;
            step = nv / nn;
        }
    }
    let is_multiple =
        |speed: &&f64| (*speed / step - (*speed / step).round()).abs() <= MAX_STEP_DEVIATION;
    let count = real(speeds.len());
    let share = real(speeds.iter().filter(is_multiple).count()) / count;
    let usual = (speeds.iter().map(|speed| speed * speed).sum::<f64>() / count).sqrt();
    (share >= MIN_SHARE && 0.5 * step >= MIN_HALF_STEP * usual).then_some(step)
}

/// Whether the poses tell that speeds of these steps are cut off and not rounded.
fn are_cut_off(runs: &[Run], steps: PerSide<Option<f64>>) -> bool {
    let Some(linear) = Linear::of(runs, MIN_PIECE, &|_, _, _| false) else { return false };
    let missing = |reading: &TrackSample| {
        let of = |side: Side| missing(reading.speeds()[side], steps[side].unwrap_or(0.0));
        TrackSample { t: reading.t, v_left: of(Side::Left), v_right: of(Side::Right) }
    };
    let missing: Vec<Vec<TrackSample>> =
        runs.iter().map(|run| run.tracks().iter().map(missing).collect()).collect();
    let column = |run: usize, piece: &Piece| -> [f64; 2] {
        let of = travelled(&missing[run], piece.start, piece.end, linear.delay);
        linear.all.map(|by| by.x * of.left + by.y * of.right)
    };
    let Some(factors) = linear.factors(runs, &column) else { return false };
    let has_positions = runs.iter().all(Run::has_positions);
    let channels = if has_positions { &factors[..] } else { &factors[..1] };
    let weight = |[_, error]: &[f64; 2]| error.powi(-2);
    let weights: f64 = channels.iter().map(weight).sum();
    let cut = channels.iter().map(|one| weight(one) * one[0]).sum::<f64>() / weights;
    let may_be = |[cut, error]: &[f64; 2]| {
        let margin = MAX_ERRORS * error;
        cut + margin > MIN_KAPPA && cut - margin < MAX_KAPPA
    };
    cut - MIN_ERRORS * weights.powf(-0.5) > MIN_KAPPA
        && cut < MAX_KAPPA
        && channels.iter().all(may_be)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::UncheckedRun;
    use crate::sample::PoseSample;
    use trackdyn_core::Pose;

    /// Distance of the ICRs, m, and the step of the speeds, m/s.
    const SEPARATION: f64 = 1.02;
    const STEP: f64 = 0.03;

    /// Two minutes of changing speeds, which readings tell as `read` says.
    fn drive(read: impl Fn(f64) -> f64) -> Run {
        let speeds = |t: f64| {
            let forward = 0.35 * (0.31 * t).sin() + 0.2 * (0.83 * t + 1.0).sin();
            let turning = 0.4 * (0.57 * t + 0.4).sin() + 0.15 * (1.3 * t).sin();
            [forward - turning, forward + turning]
        };
        let (mut tracks, mut poses, mut pose) = (Vec::new(), Vec::new(), Pose::default());
        for k in 0..6000_u32 {
            let t = 0.02 * f64::from(k);
            let [left, right] = speeds(t + 0.01);
            tracks.push(TrackSample { t, v_left: read(left), v_right: read(right) });
            if k % 5 == 0 {
                // a millimetre and a milliradian, as evenly as of a tracker
                let noise = |a: f64| 1e-3 * (a * f64::from(k)).sin();
                let [x, y, yaw] = [pose.x + noise(1.7), pose.y + noise(2.3), pose.yaw + noise(2.9)];
                poses.push(PoseSample { t, pose: Pose::new(x, y, yaw) });
            }
            let (way, turn) = (0.01 * (left + right), 0.02 * (right - left) / SEPARATION);
            let (sin, cos) = (pose.yaw + 0.5 * turn).sin_cos();
            pose = Pose::new(pose.x + way * cos, pose.y + way * sin, pose.yaw + turn);
        }
        let rows = UncheckedRun {
            id: 0,
            tracks: tracks.into(),
            poses: poses.into(),
            imu: crate::sample::Series::default(),
        };
        Run::new(rows, &mut Vec::new())
    }

    fn mended(read: impl Fn(f64) -> f64) -> (Run, Vec<Cleaning>) {
        let (mut runs, mut found) = (vec![drive(read)], Vec::new());
        mend(&mut runs, &mut found);
        (runs.remove(0), found)
    }

    #[test]
    fn half_a_step_is_added_to_speeds_that_are_cut_off() {
        let (run, found) = mended(|v| STEP * (v / STEP).trunc());
        assert_eq!(found.len(), 2);
        for one in found {
            let Finding::CutOff { step, .. } = one.finding else { panic!("{one:?}") };
            assert!((step - STEP).abs() < 1e-9, "{step}");
        }
        let truth = drive(|v| v);
        let off = |of: &Run| -> f64 {
            let pairs = of.tracks().iter().zip(truth.tracks());
            pairs.map(|(a, b)| (a.v_right - b.v_right) * b.v_right.signum()).sum::<f64>() / 6000.0
        };
        assert!(off(&run).abs() < 0.05 * STEP, "{}", off(&run));
        assert!(off(&drive(|v| STEP * (v / STEP).trunc())) < -0.4 * STEP);
    }

    /// A mended reading lies between two steps, and commands of a few levels are no lattice.
    #[test]
    fn a_step_is_told_by_what_is_read_often() {
        let mut speeds: Vec<f64> = (0..100).map(|k| STEP * f64::from(k % 10)).collect();
        speeds.push(1.5 * STEP);
        let found = step(&speeds).expect("a step");
        assert!((found - STEP).abs() < 1e-9, "{found}");
        let levels: Vec<f64> = (0..100).map(|k| 0.2 * f64::from(k % 5)).collect();
        assert_eq!(step(&levels), None);
    }

    #[test]
    fn rounded_and_fine_speeds_stay() {
        for read in [|v: f64| STEP * (v / STEP).round(), |v| v] {
            let (run, found) = mended(read);
            assert_eq!(found, []);
            assert_eq!(run.tracks(), drive(read).tracks());
        }
        // half of 1 mm/s does no harm beside 0.4 m/s
        let (_, found) = mended(|v| 0.001 * (v / 0.001).trunc());
        assert_eq!(found, []);
    }
}
