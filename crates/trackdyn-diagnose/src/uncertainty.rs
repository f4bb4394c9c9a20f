//! Confidence intervals of fitted parameters.

mod spread;

pub(crate) use spread::Spread;

use crate::evidence::Evidence;
use crate::fit::Fit;
use crate::hypothesis::Unknown;
use crate::normal::{Normal, effective};
use crate::search::{Found, Search};
use nalgebra::DVector;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use trackdyn_model::EffectId;

/// A fitted parameter with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The parameter.
    pub unknown: Unknown,
    /// Estimate, in its unit.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Fitted friction level: ln of the factor of both friction coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Estimate.
    pub value: f64,
    /// Half width of its 95 % interval.
    pub half: f64,
    /// Whether it clearly differs from the vehicle file.
    pub is_sure: bool,
}

/// 95 % confidence intervals of the unknowns of a hypothesis.
///
/// The largest of three variances counts: that by the noise, and two jackknife variances (B − 1)/B
/// Σ (θ₋ᵦ − θ)², with blocks or whole runs left out, which need no noise model. A jackknife counts
/// only where several groups determine the unknown. Where one group does, leaving it out shows the
/// lack of data and not a scatter. An interval ends where the profile likelihood (all other
/// unknowns refitted) has fallen as far as a parabola with that variance would at Student's
/// quantile.
///
/// # Sources
/// The block jackknife: Bell, McCaffrey, Survey Methodology 28(2), 2002 (CR3). Profile likelihood:
/// Venzon, Moolgavkar, Applied Statistics 37(1), 1988; with another variance than the noise's:
/// McCullagh, Nelder, Generalized Linear Models, 2nd ed. 1989, chapter 9.
pub struct Uncertainty<'a> {
    search: &'a Search,
    fit: &'a Fit,
    spread: Spread,
    /// Half widths for a parabolic likelihood.
    halves: Vec<f64>,
}

/// Candidates for independent groups, as ranges of blocks: single blocks, and runs.
fn groupings(evidence: &Evidence, counts: impl Fn(usize) -> bool) -> [Vec<Range<usize>>; 2] {
    let blocks = (0..evidence.blocks()).filter(|&block| counts(block));
    let blocks: Vec<Range<usize>> = blocks.map(|block| block..block + 1).collect();
    let mut runs: BTreeMap<usize, Range<usize>> = BTreeMap::new();
    for sample in evidence.samples().iter().filter(|sample| counts(sample.block)) {
        let run = runs.entry(sample.run).or_insert(sample.block..sample.block + 1);
        *run = run.start.min(sample.block)..run.end.max(sample.block + 1);
    }
    // Each point of a table is a run, several to a block: a block is left out once, as a whole.
    let mut runs: Vec<Range<usize>> = runs.into_values().collect();
    runs.dedup();
    [blocks, runs]
}

/// Effective number of groups that determine an unknown, all others being free. `covariance` is its
/// column of the covariance, of these columns of the normal equations.
///
/// # Law
/// That of I_g = wᵀ J_g w, the information of a group, w the covariance of the unknown with all.
fn shown_by(
    normal: &Normal,
    groups: &[Range<usize>],
    columns: &[usize],
    covariance: &DVector<f64>,
) -> f64 {
    // I_g = wᵀ J_g w
    let of_group = |group: &Range<usize>| -> f64 {
        group.clone().map(|block| normal.change_at(block, columns, covariance)).sum()
    };
    effective(groups.iter().map(of_group))
}

impl<'a> Uncertainty<'a> {
    /// Uncertainty of the best hypothesis.
    pub fn of(search: &'a Search, best: &'a Found) -> Self {
        let fit = &best.fit;
        let spread = Spread::of(search, best);
        let variances = fit.solution.covariance.diagonal();
        let half = |place: usize| {
            if fit.free.contains(&place) {
                spread.half_of(place)
            } else {
                spread.half_unseen(variances[place])
            }
        };
        let halves = (0..fit.unknowns.len()).map(half).collect();
        Self { search, fit, spread, halves }
    }

    /// How well the recording determines any number that depends on the unknowns.
    pub(crate) fn spread(&self) -> &Spread {
        &self.spread
    }

    /// 95 % intervals of the parameters of these effects.
    pub fn intervals(&self, effects: &[EffectId]) -> Vec<Interval> {
        let is_asked = |unknown: &Unknown| effects.iter().any(|&effect| unknown.is_of(effect));
        let places = (0..self.halves.len()).filter(|&place| is_asked(&self.fit.unknowns[place]));
        let places: Vec<usize> = places.collect();
        places.par_iter().filter_map(|&place| self.interval(place)).collect()
    }

    fn interval(&self, place: usize) -> Option<Interval> {
        let unknown = self.fit.unknowns[place];
        let parameter = unknown.parameter()?;
        let clock = self.search.settings().limits.clock_error;
        let model = if parameter.unit == "s" { clock } else { 0.0 };
        let value = self.fit.hypothesis.get(unknown);
        let [low, high] = parameter.range;
        let half = self.halves[place];
        let (below, above) = rayon::join(|| self.end(place, -half), || self.end(place, half));
        Some(Interval {
            unknown,
            value,
            low: (value - below.hypot(model)).max(low),
            high: (value + above.hypot(model)).min(high),
        })
    }

    /// Distance from the estimate to an end of the interval, within the parameter's range.
    /// `parabola` is the signed distance for a parabolic likelihood.
    ///
    /// The search is nearly linear: √(rise of twice the objective) is proportional to the distance
    /// for a parabola, and nearly so otherwise.
    fn end(&self, place: usize, parabola: f64) -> f64 {
        let Self { search: Search { evidence, .. }, fit, .. } = self;
        if !fit.free.contains(&place) {
            return parabola.abs();
        }
        let unknown = fit.unknowns[place];
        let value = fit.hypothesis.get(unknown);
        let [low, high] = fit.hypothesis.range(unknown);
        let variance = fit.solution.covariance[(place, place)];
        let asked = parabola.abs() / variance.sqrt();
        let room = if parabola < 0.0 { value - low } else { high - value };
        // Bracket: distance and √rise of a point that is too near, and of one that is too far.
        let (mut near, mut far) = ([0.0, 0.0], None);
        let mut distance = parabola.abs();
        let settings = &evidence.settings().limits;
        for _ in 0..settings.max_looks {
            let looked = distance.min(room);
            let there = value + looked.copysign(parabola);
            let risen = fit.profile(place, there, evidence) - fit.objective;
            let root = risen.max(0.0).sqrt();
            if (root / asked - 1.0).abs() < settings.end_tolerance
                || (looked == room && root < asked)
            {
                return looked;
            }
            if root < asked {
                near = [looked, root];
            } else {
                far = Some([looked, root]);
            }
            distance = match far {
                Some(far) if far[1].is_finite() => {
                    near[0] + (far[0] - near[0]) * (asked - near[1]) / (far[1] - near[1])
                }
                Some(far) => f64::midpoint(near[0], far[0]),
                None => looked * (asked / root).min(settings.max_look_growth),
            };
        }
        distance.min(room)
    }

    /// Friction level with its interval; none where friction is not free.
    pub fn friction_level(&self) -> Option<Level> {
        let unknowns = &self.fit.unknowns;
        let place = unknowns.iter().position(|one| *one == Unknown::FrictionLevel)?;
        let (value, half) = (self.fit.hypothesis.friction_level, self.halves[place]);
        let least = self.search.settings().limits.min_level_change;
        Some(Level { value, half, is_sure: value.abs() > least * half })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;
    use trackdyn_recording::OperatingPoint;

    #[test]
    fn points_of_a_table_are_left_out_by_blocks() {
        let point = |k: i32| {
            let (v_left, v_right) = (0.1 * f64::from(k / 12), 0.1 * f64::from(k % 12));
            let off = 0.001 * f64::from((7 * k).rem_euclid(11));
            OperatingPoint {
                v_left,
                v_right,
                v_forward: Some(f64::midpoint(v_left, v_right) + off),
                v_lateral: None,
                yaw_rate: Some(v_right - v_left - off),
            }
        };
        let table: Vec<OperatingPoint> = (0..144).map(point).collect();
        let evidence = Evidence::of_points(&table, &Settings::default()).expect("evidence");
        let [blocks, runs] = groupings(&evidence, |_| true);
        assert_eq!(blocks.len(), evidence.blocks());
        assert_eq!(runs, blocks);
    }
}
