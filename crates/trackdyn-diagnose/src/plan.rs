//! Plan of the next drive: manoeuvres that separate effects which a diagnosis could not tell apart.
//!
//! Each member of a class is a hypothesis: the vehicle with that effect, at the size that explains
//! the recording. All of them drive every manoeuvre of a menu in simulation, and a sequence with
//! the largest separation per second is chosen greedily.

mod document;
pub mod menu;
mod question;
mod rivals;
mod separation;

pub use document::{PlanFile, measurements};
pub use question::{Question, measurement};

use crate::error::Error;
use crate::evidence::Evidence;
use crate::evidence::planned::PlannedRun;
use crate::settings::{self, Settings};
use crate::weighted::Weighted;
use menu::{Manoeuvre, menu};
use nalgebra::DMatrix;
use rivals::Rival;
use separation::{Pair, products, shares, squared};
use std::ops::ControlFlow;
use trackdyn_core::rounding::Digits;
use trackdyn_core::{Command, PerSide, Pose, Schedule, real};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::EffectId;
use trackdyn_model::Stationary;
use trackdyn_model::{Circumstance, VehicleFile};
use trackdyn_recording::TrackSample;

/// Digits of the numbers of plan files.
const DIGITS: Digits = Digits::Decimals(6);

/// Options of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Largest track speed, m/s, above zero.
    pub fastest: f64,
    /// Longest total time of the manoeuvres, s.
    pub duration: f64,
    /// Noise of the poses.
    pub noise: SegmentNoise,
    /// Settings: all numbers that decide.
    pub method: Settings,
}

impl Default for Options {
    /// Poses as in a laboratory, 1 mm and 1 mrad.
    fn default() -> Self {
        let method = Settings::default();
        let noise = assumed_noise(1e-3, 1e-3);
        Self { fastest: 1.0, duration: 60.0, noise, method }
    }
}

/// Noise by the standard deviations of a pose along each axis, m, and of its yaw, rad: white noise
/// of each pose, and a random walk as large after a second.
pub fn assumed_noise(xy: f64, yaw: f64) -> SegmentNoise {
    let variances = [xy.powi(2), xy.powi(2), yaw.powi(2)];
    SegmentNoise { pose: variances, walk: variances, heading: 0.0, stamp: 0.0 }
}

/// A manoeuvre of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The manoeuvre.
    pub manoeuvre: Manoeuvre,
    /// Start, s.
    pub start: f64,
    /// √ of its share of each pair's z².
    pub z: Vec<f64>,
}

/// Whether driving separates two rivals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The plan separates them.
    Plan,
    /// It takes about this long, s.
    Longer(f64),
    /// No manoeuvre of the menu does.
    Never,
}

/// Separation of two rivals.
#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    /// Index of their question.
    pub question: usize,
    /// The two effects.
    pub effects: [EffectId; 2],
    /// z over the whole plan.
    pub z: f64,
    /// z over all manoeuvres of the menu, driven one after the other.
    pub menu: f64,
    /// Whether driving separates them.
    pub answer: Answer,
}

/// A plan of what to drive next.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Manoeuvres in driving order.
    pub steps: Vec<Step>,
    /// Pairs of rivals with their separation.
    pub pairs: Vec<Separation>,
    /// Number of manoeuvres in the menu, and their total time, s.
    pub menu: (usize, f64),
    /// Least z at which two rivals count as separated.
    pub min_separation: f64,
}

impl Plan {
    /// Total time, s.
    pub fn duration(&self) -> f64 {
        self.steps.iter().map(|step| step.manoeuvre.duration()).sum()
    }

    /// Track commands; none where there is nothing to drive.
    pub fn schedule(&self) -> Option<Schedule> {
        let speeds = self.steps.iter().flat_map(|step| &step.manoeuvre.speeds);
        let last = PerSide::default();
        let interval = self.steps.first()?.manoeuvre.interval;
        let commands = speeds.chain([&last]).enumerate().map(|(k, speeds)| Command {
            t: DIGITS.round(interval * real(k)),
            speeds: speeds.map(|speed| DIGITS.round(speed)),
        });
        Schedule::new(commands.collect()).ok()
    }
}

/// Plans driving that separates the members of each class. `progress` is called after each stage,
/// and may cancel.
///
/// # Errors
/// [`Error::NoMotion`] and [`Error::NoSpin`] for a vehicle without a motion, [`Error::TooShort`]
/// for a duration shorter than every manoeuvre, [`Error::Cancelled`].
pub fn plan(
    questions: &[Question],
    file: &VehicleFile,
    options: &Options,
    progress: &dyn Fn(&'static str) -> ControlFlow<()>,
) -> Result<Plan, Error> {
    let finished = |stage| {
        if progress(stage).is_break() { Err(Error::Cancelled) } else { Ok(()) }
    };
    options.method.check()?;
    let settings = &options.method.plan;
    let menu = menu(options.fastest, gap(file, settings)?, &options.method);
    let shortest = menu.iter().map(Manoeuvre::duration).fold(f64::MAX, f64::min);
    if shortest > options.duration {
        return Err(Error::TooShort { given: options.duration, needed: shortest });
    }
    let classes = questions
        .iter()
        .map(|question| Class::new(question, file, &menu, options))
        .collect::<Result<Vec<_>, _>>()?;
    finished(STAGES[0])?;
    let chosen = chosen(&classes, &menu, options);
    finished(STAGES[1])?;
    let plan = judged(&classes, &menu, &chosen, options);
    finished(STAGES[2])?;
    Ok(plan)
}

/// Stages reported to `progress`.
pub const STAGES: [&str; 3] = ["rivals", "choice", "separation"];

/// Distance between the ICRs in a slow spin, m.
fn gap(file: &VehicleFile, settings: &settings::Plan) -> Result<f64, Error> {
    const SPIN_SPEED: f64 = 0.1;
    let model = file.model();
    let speeds = PerSide::new(-SPIN_SPEED, SPIN_SPEED);
    let solution = Stationary::new(&model, &Circumstance::default()).solve(speeds);
    let gap = 2.0 * SPIN_SPEED / solution.twist.w;
    let [least, most] = settings.gap_limits.map(|limit| file.vehicle.gauge * limit);
    let limits = least..most;
    if limits.contains(&gap) { Ok(gap) } else { Err(Error::NoSpin { rate: solution.twist.w }) }
}

/// A class of rivals, compared on the whole menu.
struct Class {
    rivals: Vec<Rival>,
    pairs: Vec<Pair>,
    /// Whether forces depend on where, or when, a manoeuvre is driven.
    knows_places: bool,
}

impl Class {
    fn new(
        question: &Question,
        file: &VehicleFile,
        menu: &[Manoeuvre],
        options: &Options,
    ) -> Result<Self, Error> {
        let fitted = Rival::fitted(question, file, &options.method);
        let all: Vec<&Manoeuvre> = menu.iter().collect();
        let driving = evidence(&[run(&all, 0.0, Pose::default())], &fitted, options);
        if let Some(reason) = fitted.mechanics(&driving).failure() {
            return Err(reason.clone().into());
        }
        let mut rivals = vec![fitted.clone()];
        rivals.extend(fitted.mimicked(question, &driving));
        let of: Vec<[usize; 2]> =
            (0..rivals.len()).flat_map(|a| (a + 1..rivals.len()).map(move |b| [a, b])).collect();
        let products = products(&of, &rivals, &driving);
        let pairs = of.into_iter().zip(&products);
        let pairs = pairs.map(|(of, products)| Pair::new(of, &rivals, &driving, products));
        let pairs = pairs.collect();
        let knows_places = rivals.iter().any(|rival| rival.mechanics(&driving).knows_places());
        Ok(Self { rivals, pairs, knows_places })
    }

    fn of(&self) -> Vec<[usize; 2]> {
        self.pairs.iter().map(|pair| pair.of).collect()
    }

    /// Products of each pair over these runs.
    fn products(&self, runs: &[PlannedRun], options: &Options) -> Vec<crate::normal::Normal> {
        products(&self.of(), &self.rivals, &evidence(runs, &self.rivals[0], options))
    }
}

/// Evidence that runs would give if the fitted member is true.
fn evidence(runs: &[PlannedRun], fitted: &Rival, options: &Options) -> Weighted {
    let moves = |evidence: &Evidence| fitted.moves(evidence);
    Weighted::new(Evidence::planned(runs, options.noise, fitted.delay(), &options.method, moves))
}

/// Manoeuvres one after the other as a run, each a block.
fn run(manoeuvres: &[&Manoeuvre], start: f64, pose: Pose) -> PlannedRun {
    let interval = manoeuvres.first().map_or(0.0, |first| first.interval);
    let mut tracks = Vec::new();
    let mut blocks = Vec::new();
    let mut push = |speeds: &PerSide<f64>| {
        let t = start + interval * real(tracks.len());
        tracks.push(TrackSample { t, v_left: speeds.left, v_right: speeds.right });
        tracks.len()
    };
    for manoeuvre in manoeuvres {
        let lengths: Vec<usize> = manoeuvre.speeds.iter().map(&mut push).collect();
        blocks.extend(lengths.first().map(|first| first - 1));
    }
    push(&PerSide::default());
    PlannedRun { tracks, pose, blocks }
}

/// Information on a pair: of each manoeuvre of the menu, and of those chosen so far.
struct Outlook {
    menu: Vec<DMatrix<f64>>,
    chosen: DMatrix<f64>,
    known: DMatrix<f64>,
    /// z² at which the rivals count as separated.
    decided: f64,
}

impl Outlook {
    /// Increase of z² by more manoeuvres of the menu.
    fn gain(&self, more: &[usize]) -> f64 {
        let with = more.iter().fold(self.chosen.clone(), |sum, &k| sum + &self.menu[k]);
        squared(&with, &self.known) - squared(&self.chosen, &self.known)
    }

    /// Weight of a gain: lower where the rivals are nearly separated.
    fn weight(&self) -> f64 {
        self.decided / (self.decided + squared(&self.chosen, &self.known))
    }
}

/// Indices of the chosen manoeuvres, in the order of their choice.
///
/// Greedy: each step adds the manoeuvre, or the pair, with the most weighted z² per second. Pairs
/// are tried because a difference between two manoeuvres may show what neither shows alone.
fn chosen(classes: &[Class], menu: &[Manoeuvre], options: &Options) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::new();
    let knows_places = classes.iter().any(|class| class.knows_places);
    let mut outlooks = outlooks(classes, menu, &chosen, options);
    if outlooks.is_empty() {
        return chosen;
    }
    let time = |of: &[usize]| of.iter().map(|&k| menu[k].duration()).sum::<f64>();
    loop {
        let left = options.duration - time(&chosen) + 1e-9;
        let weights: Vec<f64> = outlooks.iter().map(Outlook::weight).collect();
        let rate = |more: &[usize]| -> f64 {
            let gains = outlooks.iter().zip(&weights);
            gains.map(|(outlook, weight)| weight * outlook.gain(more)).sum::<f64>() / time(more)
        };
        let best = proposals(menu, left, &rate);
        let Some((rate, more)) = best else { break };
        if rate < options.method.plan.min_rate {
            break;
        }
        for k in more {
            chosen.push(k);
            if !knows_places {
                for outlook in &mut outlooks {
                    outlook.chosen += &outlook.menu[k];
                }
            }
        }
        if knows_places {
            outlooks = self::outlooks(classes, menu, &chosen, options);
        }
    }
    if !knows_places {
        exchange(&mut chosen, &outlooks, menu, options);
    }
    chosen
}

/// The manoeuvre or pair with the largest rate that fits into the time left, s.
fn proposals(
    menu: &[Manoeuvre],
    left: f64,
    rate: &(impl Fn(&[usize]) -> f64 + Sync),
) -> Option<(f64, Vec<usize>)> {
    use rayon::prelude::*;
    let fits = |more: &[usize]| more.iter().map(|&k| menu[k].duration()).sum::<f64>() <= left;
    let first = (0..menu.len()).into_par_iter().flat_map_iter(|a| {
        let pairs = (a + 1..menu.len()).map(move |b| vec![a, b]);
        std::iter::once(vec![a]).chain(pairs)
    });
    let rated = first.filter(|more| fits(more)).map(|more| (rate(&more), more));
    // Equal rates, as of mirror images: the first one.
    rated.max_by(|(a, one), (b, other)| a.total_cmp(b).then(other.cmp(one)))
}

/// Exchanges chosen manoeuvres for others as long as the least separated pairs gain.
fn exchange(chosen: &mut [usize], outlooks: &[Outlook], menu: &[Manoeuvre], options: &Options) {
    let value = |of: &[usize]| -> f64 {
        let all = outlooks.iter().map(|outlook| {
            let zero = DMatrix::zeros(outlook.chosen.nrows(), outlook.chosen.ncols());
            let sum = of.iter().fold(zero, |sum, &k| sum + &outlook.menu[k]);
            (1.0 + squared(&sum, &outlook.known) / outlook.decided).ln()
        });
        all.sum()
    };
    let time = |of: &[usize]| of.iter().map(|&k| menu[k].duration()).sum::<f64>();
    let mut best = value(chosen);
    for _ in 0..options.method.plan.exchange_rounds {
        let before = best;
        for place in 0..chosen.len() {
            for other in 0..menu.len() {
                let own = std::mem::replace(&mut chosen[place], other);
                let value = value(chosen);
                if time(chosen) <= options.duration + 1e-9 && value > best + 1e-9 {
                    best = value;
                } else {
                    chosen[place] = own;
                }
            }
        }
        if best <= before {
            break;
        }
    }
}

/// Information on each pair that the menu can separate, after the chosen manoeuvres.
fn outlooks(
    classes: &[Class],
    menu: &[Manoeuvre],
    chosen: &[usize],
    options: &Options,
) -> Vec<Outlook> {
    let driven: Vec<&Manoeuvre> = chosen.iter().map(|&k| &menu[k]).collect();
    let mut outlooks = Vec::new();
    let settings = &options.method.plan;
    let is_open = |pair: &&Pair| is_open(pair, settings);
    for class in classes.iter().filter(|class| class.pairs.iter().any(|pair| is_open(&pair))) {
        let mut runs = Vec::new();
        let (mut pose, mut time) = (Pose::default(), 0.0);
        if !driven.is_empty() {
            runs.push(run(&driven, 0.0, pose));
            let so_far = evidence(&runs, &class.rivals[0], options);
            pose = so_far.last_pose(0).unwrap_or(pose);
            time = driven.iter().map(|manoeuvre| manoeuvre.duration()).sum();
        }
        runs.extend(menu.iter().map(|manoeuvre| run(&[manoeuvre], time, pose)));
        let products = class.products(&runs, options);
        let pairs = class.pairs.iter().zip(&products);
        for (pair, products) in pairs.filter(|(pair, _)| is_open(pair)) {
            let size = products.columns() + 1;
            let blocks: Vec<DMatrix<f64>> =
                (0..products.blocks()).map(|block| products.block(block).clone()).collect();
            let (before, after) = blocks.split_at(driven.len());
            outlooks.push(Outlook {
                menu: after.to_vec(),
                chosen: before.iter().fold(DMatrix::zeros(size, size), |sum, block| sum + block),
                known: &pair.prior + settings.known_share * &pair.driven,
                decided: settings.min_separation.powi(2),
            });
        }
    }
    outlooks
}

/// Whether the whole menu separates a pair.
fn is_open(pair: &Pair, settings: &settings::Plan) -> bool {
    pair.typical >= settings.min_separation
}

/// Separations by a sequence that is driven in a row.
fn judged(classes: &[Class], menu: &[Manoeuvre], chosen: &[usize], options: &Options) -> Plan {
    let settings = &options.method.plan;
    let min_separation = settings.min_separation;
    let driven: Vec<&Manoeuvre> = chosen.iter().map(|&k| &menu[k]).collect();
    let mut start = 0.0;
    let steps = driven.iter().map(|&manoeuvre| {
        let step = Step { manoeuvre: manoeuvre.clone(), start, z: Vec::new() };
        start += manoeuvre.duration();
        step
    });
    let mut steps: Vec<Step> = steps.collect();
    let duration = start;
    let all: f64 = menu.iter().map(Manoeuvre::duration).sum();
    let mut pairs = Vec::new();
    for (question, class) in classes.iter().enumerate() {
        let row = [run(&driven, 0.0, Pose::default())];
        let products = (!driven.is_empty()).then(|| class.products(&row, options));
        for (index, pair) in class.pairs.iter().enumerate() {
            let mut z = 0.0;
            if let Some(products) = products.as_ref().map(|products| &products[index]) {
                z = squared(products.total(), &pair.prior).sqrt();
                for (step, share) in steps.iter_mut().zip(shares(products, &pair.prior)) {
                    step.z.push(share.sqrt());
                }
            }
            // z grows with the square root of time.
            let longer = |time: f64, z: f64| Answer::Longer(time * (min_separation / z).powi(2));
            let answer = if z >= min_separation {
                Answer::Plan
            } else if !is_open(pair, settings) {
                Answer::Never
            } else if z > settings.min_z_of_time {
                longer(duration, z)
            } else {
                longer(all, pair.typical)
            };
            let effects = pair.of.map(|k| class.rivals[k].effect);
            pairs.push(Separation { question, effects, z, menu: pair.typical, answer });
        }
    }
    Plan { steps, pairs, menu: (menu.len(), all), min_separation }
}

#[cfg(test)]
mod tests;
