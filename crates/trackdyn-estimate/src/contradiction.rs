//! What contradicts a fit: other parts of the same answer, and what no track does.

mod text;

use crate::Interval;
use crate::least_squares::Estimate;
use crate::observations::Observations;
use crate::parameters::Parameters;
use crate::response::Response;
use crate::run_clocks::OtherClock;
use crate::spin_test::SpinTest;
use crate::unexplained::LeftOver;
use crate::weighting::SegmentNoise;
use trackdyn_core::robust::quantile;
use trackdyn_core::{PerSide, Side, settings_group};

/// Standard errors by which two methods may differ.
const MAX_ERRORS: f64 = 5.0;

/// Part of the distance of the ICRs by which turning over seconds may differ from a fit: intervals
/// of the fit reach what is less.
const MAX_OF_RESPONSE: f64 = 0.1;

/// Part of the distance of the ICRs by which the spin test may differ from a fit: it takes the
/// robot for symmetric and its track speeds for steady.
const MAX_OF_SPIN: f64 = 0.15;

/// Part of the distance of the ICRs by which the genetic algorithm may differ from a fit: its
/// squares follow outliers.
const MAX_OF_GENETIC: f64 = 0.25;

/// χ that no track reaches: friction under a contact longer than a point moves the ICRs out of the
/// tracks' centre-lines. Axles a fifth of the gauge apart, μ_x = μ_y, give 0.96.
const MAX_EFFICIENCY: f64 = 0.97;

/// χ below which it is the units that are wrong. A track of length l at L/2 from the middle slides
/// aside by y and along by d, the distance of its ICR from it. Where that is far, μ_x d L/2 =
/// μ_y l²/12, so χ = L/(L + 2d) = 1/(1 + μ_y l²/(3 μ_x L²)): of tracks twice as long as the gauge,
/// beyond which no robot turns by its tracks, with twice the friction aside, 0.27.
const MIN_EFFICIENCY: f64 = 0.25;

/// Range of α where encoders and wheel radii are as their file states and the tracks grip.
const ALPHAS: [f64; 2] = [0.8, 1.25];

/// Largest logarithm of the ratio of both α at which a unit may be wrong: a unit is that of both
/// sides.
const MAX_LN_UNLIKE: f64 = 0.1;

/// Largest ratio of the upper to the lower quartile of ways of tracks per way of poses where a unit
/// may be wrong: slip, as on ice, varies by more.
const MAX_SPREAD_OF_UNITS: f64 = 1.3;

/// Least errors of track speeds that count as more than those of tyres and pitches: the deviation
/// of a factor from 1, and the ratio of the residuals without factors to those with them. By slip
/// of real robots that ratio is 1.2 at most.
const MIN_FACTOR: f64 = 0.03;
const MIN_RATIO_BY_FACTORS: f64 = 2.0;

/// Part of the turning that a fit leaves where it describes the drive.
const MAX_TURNING_LEFT: f64 = 0.5;

/// Part of the way that a fit leaves where it describes the drive: twice what the slip of real
/// robots on gravel leaves.
const MAX_WAY_LEFT: f64 = 0.3;

/// Smallest turn of the sensor that shows, rad: in turns, ICRs that are shifted turn the way, too.
const MIN_MOUNT: f64 = 0.17;

settings_group! {
    /// When poses count as computed from the tracks: they show no slip.
    Settings {
        /// Largest part that is left of the turning and of the ICR distance.
        max_left: f64 = 2e-3, "", [0.0, 0.1],
            "Time between readings, and rounding.",
            "Lower: such poses are diagnosed; higher: exact ones are refused.";
        /// Largest distance of the ICRs from the centre-lines.
        max_off_centre_lines: f64 = 0.02, "gauge", [0.0, 0.1],
            "Any real contact moves them further out.",
            "Lower: such poses are diagnosed; higher: short contacts are refused.";
    }
}

/// Something that contradicts a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Contradiction {
    /// Another method finds other ICRs.
    Method {
        /// Its name.
        method: &'static str,
        /// x_r − x_l by it, m, for track speeds as the fit takes them.
        found: f64,
        /// x_r − x_l by the fit, m.
        fit: f64,
    },
    /// ICRs closer to each other than the tracks.
    Efficiency {
        /// χ.
        chi: f64,
    },
    /// ICRs further from each other than friction puts them.
    Apart {
        /// χ.
        chi: f64,
    },
    /// A track that moves much less or more than its encoder says.
    Alpha {
        /// The side.
        side: Side,
        /// Its factor.
        alpha: f64,
        /// Track speeds per speed of the poses, where both tracks and all of the drive say one, as
        /// a wrong unit does and slip does not.
        ratio: Option<f64>,
    },
    /// Factors on the track speeds explain what the fit leaves: no slip does so.
    Factors {
        /// α.
        alphas: PerSide<f64>,
        /// Size of the residuals without them over that with them.
        ratio: f64,
    },
    /// A run whose poses are late by another time than those of all.
    RunClock(OtherClock),
    /// The fit explains hardly any turning.
    Turning {
        /// Part of the turning that it leaves, of the segments that should turn most.
        left: f64,
    },
    /// The poses move where the tracks do not drive.
    Way {
        /// Part of the way that the fit leaves, of the segments that should lead furthest.
        left: f64,
        /// Heading of the sensor on the robot that would explain it, rad.
        mount: Option<f64>,
        /// Part of a run where it happens, where elsewhere hardly any is left: s from its first
        /// reading.
        during: Option<[f64; 2]>,
    },
    /// Poses that follow the track speeds over time, and not as through a filter.
    Follows {
        /// Part of the turning that a filter leaves.
        left: f64,
    },
    /// Turning over seconds tells another distance of the ICRs than the fit.
    Response {
        /// x_r − x_l by turning over seconds, m.
        gap: f64,
        /// x_r − x_l by the fit, m.
        fit: f64,
    },
    /// Poses that are computed from the tracks.
    WheelOdometry {
        /// Part of the turning that the fit leaves.
        left: f64,
    },
}

impl Contradiction {
    /// What contradicts a fit of motions on a vehicle with this gauge, m; the genetic algorithm
    /// counts where it ran.
    pub fn of_motions(
        fit: &Estimate,
        genetic: Option<&Estimate>,
        spin_test: Option<&SpinTest>,
        observations: &Observations,
        noise: Option<&SegmentNoise>,
        gauge: f64,
        settings: &Settings,
    ) -> Vec<Self> {
        let left = LeftOver::of(&fit.parameters, observations, noise);
        if is_computed(&fit.parameters, &left, gauge, settings) {
            return vec![Self::WheelOdometry { left: left.turning }];
        }
        let mut found = Self::of_parameters(&fit.parameters, &fit.steering_efficiency(gauge));
        let [.., alpha_l, alpha_r] = fit.parameters.0;
        let are_alike = alpha_l > 0.0
            && alpha_r > 0.0
            && (alpha_l / alpha_r).ln().abs() < MAX_LN_UNLIKE
            && spread_of_ways(observations) < MAX_SPREAD_OF_UNITS;
        for contradiction in &mut found {
            if let Self::Alpha { ratio, .. } = contradiction {
                *ratio = are_alike.then(|| 2.0 / (alpha_l + alpha_r));
            }
        }
        let gap = fit.gap();
        let by_method = |method, of: Interval, largest: f64| {
            let error = of.deviation.hypot(gap.deviation);
            let off = (of.value - gap.value).abs();
            let is_far = off > MAX_ERRORS * error && off > largest * gap.value;
            is_far.then_some(Self::Method { method, found: of.value, fit: gap.value })
        };
        found.extend(match spin_test.and_then(|spin| spin.interval) {
            // ∫ α_r V_r − α_l V_l dt: of a spin, both sides count alike
            Some(spin) => {
                let [.., left, right] = fit.parameters.0;
                let alpha = f64::midpoint(left, right);
                let of = Interval {
                    value: alpha * spin.value,
                    deviation: alpha * spin.deviation,
                    ..spin
                };
                by_method("the spin test", of, MAX_OF_SPIN)
            }
            None => genetic.and_then(|genetic| {
                by_method("the genetic algorithm", genetic.gap(), MAX_OF_GENETIC)
            }),
        });
        if left.turning > MAX_TURNING_LEFT {
            found.push(Self::Turning { left: left.turning });
        }
        if left.way > MAX_WAY_LEFT {
            let [mount, beside] = LeftOver::mount(observations);
            let shows = mount.abs() > MIN_MOUNT && beside < MAX_WAY_LEFT;
            let during = LeftOver::where_most(&fit.parameters, observations, MAX_WAY_LEFT);
            // Factors of a fit that takes the sensor's axes for the robot's mean nothing.
            if shows {
                found.retain(|one| !one.is_of_track_speeds());
            }
            found.push(Self::Way { left: left.way, mount: shows.then_some(mount), during });
        }
        found
    }

    /// Whether track speeds that are off by a constant factor contradict a fit that takes them as
    /// they are, beside the one `with` factors.
    pub fn of_factors(fit: &Estimate, with: &Estimate) -> Option<Self> {
        let ratio = fit.whitened_rms / with.whitened_rms;
        let [.., l, r] = with.parameters.0;
        let is_off = [3, 4].into_iter().any(|place| {
            let interval = with.interval(place);
            let is_beyond = |of: Interval| of.low > 1.0 + MIN_FACTOR || of.high < 1.0 - MIN_FACTOR;
            interval.is_some_and(is_beyond)
        });
        let alphas = PerSide::new(l, r);
        (is_off && ratio > MIN_RATIO_BY_FACTORS).then_some(Self::Factors { alphas, ratio })
    }

    /// What contradicts any distance of the ICRs for poses that follow in this way.
    pub fn of_following(response: &Response) -> Option<Self> {
        Some(Self::Follows { left: response.left? })
    }

    /// Whether a fit contradicts the turning over seconds, by which its track speeds are weighted.
    pub fn of_response(fit: &Estimate, response: Option<&Response>) -> Option<Self> {
        let response = response?;
        if let Some(found) = Self::of_following(response) {
            return Some(found);
        }
        let over = response.gap;
        let [.., left, right] = fit.parameters.0;
        // Turning alone takes α for 1.
        let gap = fit.gap().value / f64::midpoint(left, right);
        let off = (over.value - gap).abs();
        let is_far = off > MAX_ERRORS * over.deviation && off > MAX_OF_RESPONSE * gap;
        is_far.then_some(Self::Response { gap: over.value, fit: gap })
    }

    /// What contradicts a distance of the ICRs with this χ.
    pub fn of_efficiency(efficiency: &Interval) -> Option<Self> {
        let chi = efficiency.value;
        if efficiency.low > MAX_EFFICIENCY {
            Some(Self::Efficiency { chi })
        } else {
            (efficiency.high < MIN_EFFICIENCY).then_some(Self::Apart { chi })
        }
    }

    /// Whether it and one of another fit of the same recording are one finding.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Alpha { side, .. }, Self::Alpha { side: other, .. }) => side == other,
            (Self::Method { method, .. }, Self::Method { method: other, .. }) => method == other,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }

    /// Whether it shows that track speeds are not what they seem, whatever else is fitted.
    pub fn is_of_track_speeds(&self) -> bool {
        matches!(self, Self::Alpha { .. })
    }

    /// Whether it is [`Contradiction::Apart`].
    pub(crate) fn is_apart(&self) -> bool {
        matches!(self, Self::Apart { .. })
    }

    /// What contradicts parameters whatever they were fitted to.
    pub fn of_parameters(parameters: &Parameters, efficiency: &Interval) -> Vec<Self> {
        let [.., left, right] = parameters.0;
        let alphas = PerSide { left, right };
        let ratio = None;
        let far = Side::BOTH.into_iter().filter_map(|side| {
            let (alpha, [low, high]) = (alphas[side], ALPHAS);
            (!(low..=high).contains(&alpha)).then_some(Self::Alpha { side, alpha, ratio })
        });
        Self::of_efficiency(efficiency).into_iter().chain(far).collect()
    }
}

/// Ratio of the upper to the lower quartile of the way of the tracks per way of the poses, over the
/// half of the segments in which the tracks run furthest.
fn spread_of_ways(observations: &Observations) -> f64 {
    let mut ways: Vec<[f64; 2]> = observations
        .segments()
        .iter()
        .map(|segment| {
            let travelled = observations.travelled(segment);
            let [x, y, _] = segment.motion;
            [f64::midpoint(travelled.left, travelled.right).abs(), x.hypot(y)]
        })
        .collect();
    ways.sort_by(|a, b| b[0].total_cmp(&a[0]));
    ways.truncate(ways.len().div_ceil(2));
    let mut ratios: Vec<f64> = ways.iter().map(|[tracks, poses]| tracks / poses).collect();
    let [lower, upper] = [0.25, 0.75].map(|share| quantile(&mut ratios, share));
    lower.zip(upper).map_or(f64::INFINITY, |(lower, upper)| upper / lower)
}

/// Whether poses are those of a differential drive: ICRs on the tracks' centre-lines; or nothing
/// left, and ICRs on one line through the middle, as far from it on either side; or never a move to
/// the side.
fn is_computed(parameters: &Parameters, left: &LeftOver, gauge: f64, settings: &Settings) -> bool {
    let &Settings { max_left, max_off_centre_lines } = settings;
    let [x_l, x_r, y, ..] = parameters.0;
    let gap = x_r - x_l;
    let is_ideal = [x_l + gauge / 2.0, x_r - gauge / 2.0, y]
        .into_iter()
        .all(|off| off.abs() < max_off_centre_lines * gauge);
    let is_level = y.abs() < max_left * gap;
    let is_even = (x_l + x_r).abs() < max_left * gap;
    is_ideal
        || is_level && is_even && left.turning < max_left
        || is_level && left.sideways < max_left
}
