//! Triples of poses and the noise they show.

use super::stamps::{Triple, stamps};
use super::{Component, Method, PoseNoise, Settings};
use crate::gaps::Gaps;
use nalgebra::Vector3;
use trackdyn_core::robust::{MEDIAN_OF_CHI_SQUARE, median};
use trackdyn_core::{PerSide, Side, real};
use trackdyn_recording::hold::travelled;
use trackdyn_recording::{PoseSample, Recording, Run};

/// Steps between the poses of a triple.
const STEPS: [usize; 4] = [1, 2, 4, 8];

/// Triples of one number of steps.
#[derive(Default)]
struct Group {
    triples: Vec<Triple>,
}

impl Group {
    fn add(&mut self, [a, b, c]: [&PoseSample; 3], is_clean: bool) {
        let (t_1, t_2) = (b.t - a.t, c.t - b.t);
        let first = Vector3::from(a.pose.relative(&b.pose).log(t_1).to_array());
        let second = Vector3::from(b.pose.relative(&c.pose).log(t_2).to_array());
        let lever = t_1 * t_2 / (t_1 + t_2);
        let lambda = t_1 / (t_1 + t_2);
        self.triples.push(Triple {
            off: (second - first) * lever,
            twist: first * lambda + second * (1.0 - lambda),
            white: 1.0 + lambda * lambda + (1.0 - lambda) * (1.0 - lambda),
            walk: lever,
            is_clean,
        });
    }

    fn count(&self) -> usize {
        self.triples.len()
    }

    /// Sum of a number of each triple.
    fn sum(&self, of: fn(&Triple) -> f64) -> f64 {
        self.triples.iter().map(of).sum()
    }
}

/// Pose noise while the encoders of both sides show zero; `tau` is the clock offset of the poses,
/// s.
pub(super) fn standing(recording: &Recording, tau: f64, settings: &Settings) -> Option<PoseNoise> {
    let mut groups: [Group; 4] = Default::default();
    for run in recording.runs() {
        for [from, until] in still(run, settings.settling_time) {
            let poses = run.poses();
            let first = poses.partition_point(|sample| sample.t - tau < from);
            let after = poses.partition_point(|sample| sample.t - tau <= until);
            gather(poses.get(first..after).unwrap_or_default(), &mut groups, settings, |_| true);
        }
    }
    figures(groups, Method::StandStill, settings)
}

/// Pose noise while the speeds of both sides stay the same within their noise.
pub(super) fn moving(
    recording: &Recording,
    tau: f64,
    deviation: PerSide<Option<f64>>,
    settings: &Settings,
) -> Option<PoseNoise> {
    let mut groups: [Group; 4] = Default::default();
    for run in recording.runs() {
        let gaps = Gaps::of(run.tracks());
        let is_known = |a: &PoseSample, c: &PoseSample| !gaps.meet(a.t - tau, c.t - tau);
        let allowed = deviation.map(|one| one.unwrap_or(0.0) * settings.max_speed_change);
        gather(run.poses(), &mut groups, settings, |triple| {
            is_known(triple[0], triple[2]) && is_steady(run, triple, tau, allowed)
        });
    }
    figures(groups, Method::SteadyIncrements, settings)
}

/// Times of a run during which the robot stands, from a settling time on, s.
fn still(run: &Run, settling_time: f64) -> Vec<[f64; 2]> {
    let tracks = run.tracks();
    let stretches = tracks.chunk_by(|a, b| {
        let stands = |v_left: f64, v_right: f64| v_left == 0.0 && v_right == 0.0;
        stands(a.v_left, a.v_right) == stands(b.v_left, b.v_right)
    });
    stretches
        .filter(|stretch| stretch[0].v_left == 0.0 && stretch[0].v_right == 0.0)
        .map(|stretch| [stretch[0].t + settling_time, stretch[stretch.len() - 1].t])
        .collect()
}

/// Whether the tracks move, and move alike in both halves but for an `allowed` error of a reading,
/// m/s.
fn is_steady(run: &Run, [a, b, c]: [&PoseSample; 3], tau: f64, allowed: PerSide<f64>) -> bool {
    let tracks = run.tracks();
    let (Some(first), Some(last)) = (tracks.first(), tracks.last()) else { return false };
    if a.t - tau < first.t || c.t - tau > last.t {
        return false;
    }
    let mean = |from: &PoseSample, to: &PoseSample| {
        travelled(tracks, from.t, to.t, tau).map(|distance| distance / (to.t - from.t))
    };
    let (before, after) = (mean(a, b), mean(b, c));
    let readings = |from: &PoseSample, to: &PoseSample| {
        let index = |t: f64| tracks.partition_point(|sample| sample.t <= t - tau);
        real((index(to.t) - index(from.t)).max(1))
    };
    let spread = (1.0 / readings(a, b) + 1.0 / readings(b, c)).sqrt();
    let moves = Side::BOTH.iter().any(|&side| before[side] != 0.0);
    moves
        && Side::BOTH.iter().all(|&side| {
            // Without noise, rounding of the means is what is left.
            (after[side] - before[side]).abs() <= (allowed[side] * spread).max(1e-9)
        })
}

fn gather(
    poses: &[PoseSample],
    groups: &mut [Group; 4],
    settings: &Settings,
    accept: impl Fn([&PoseSample; 3]) -> bool,
) {
    let at = |index: Option<usize>| index.and_then(|index| poses.get(index));
    for (group, steps) in groups.iter_mut().zip(STEPS) {
        for (index, triple) in poses.windows(2 * steps + 1).enumerate() {
            let triple = [&triple[0], &triple[steps], &triple[2 * steps]];
            let turn = |from: usize| triple[from + 1].pose.yaw - triple[from].pose.yaw;
            let is_small = [0, 1].into_iter().all(|from| turn(from).abs() <= settings.max_turn);
            let is_short = triple[2].t - triple[0].t <= settings.max_duration;
            if is_small && is_short && accept(triple) {
                let around = (at(index.checked_sub(1)), at(Some(index + 2 * steps + 1)));
                let is_amid = match around {
                    (Some(before), Some(after)) => accept([before, triple[1], after]),
                    _ => false,
                };
                // Triples overlap: about one in `steps` is independent of the others.
                group.add(triple, is_amid && index.is_multiple_of(steps));
            }
        }
    }
}

fn figures(groups: [Group; 4], method: Method, settings: &Settings) -> Option<PoseNoise> {
    let count = groups[0].count();
    if count < settings.min_triples {
        return None;
    }
    let component = |coordinate: usize| {
        let mut rows = Vec::new();
        for (group, steps) in groups.iter().zip(STEPS) {
            if group.count() < settings.min_triples {
                continue;
            }
            let count = real(group.count());
            let white = group.sum(|triple| triple.white) / count;
            let walk = group.sum(|triple| triple.walk) / count;
            let independent = count / real(steps);
            let squares = group.triples.iter().map(|triple| triple.off[coordinate].powi(2));
            let variance = median(&mut squares.collect::<Vec<_>>())? / MEDIAN_OF_CHI_SQUARE;
            rows.push(([white, walk], variance, independent));
        }
        Some(split(&rows))
    };
    let plain = [component(0)?, component(1)?, component(2)?];
    let triples: Vec<Triple> = groups.into_iter().flat_map(|group| group.triples).collect();
    let ([forward, lateral, yaw], stamp) =
        stamps(&triples, plain, settings).unwrap_or((plain, 0.0));
    let of_pose = plain.map(|component| component.white);
    Some(PoseNoise { forward, lateral, yaw, stamp, of_pose, triples: count, method })
}

/// R ≥ 0 and q ≥ 0 from variances = R white + q walk. A variance is known to a part of itself, so
/// its weight is its inverse square times the count of independent triples.
fn split(rows: &[([f64; 2], f64, f64)]) -> Component {
    let [mut aa, mut ab, mut bb, mut ay, mut by] = [0.0; 5];
    for &([a, b], y, count) in rows {
        if y <= 0.0 {
            return Component { white: 0.0, walk: 0.0 };
        }
        let weight = count / (y * y);
        aa += weight * a * a;
        ab += weight * a * b;
        bb += weight * b * b;
        ay += weight * a * y;
        by += weight * b * y;
    }
    let determinant = aa * bb - ab * ab;
    let both = [(ay * bb - by * ab) / determinant, (by * aa - ay * ab) / determinant];
    let [r, q] = match both {
        [r, q] if determinant > 1e-12 * aa * bb && r >= 0.0 && q >= 0.0 => [r, q],
        [r, _] if determinant > 1e-12 * aa * bb && r < 0.0 => [0.0, (by / bb).max(0.0)],
        _ => [(ay / aa).max(0.0), 0.0],
    };
    Component { white: r.sqrt(), walk: q.sqrt() }
}
