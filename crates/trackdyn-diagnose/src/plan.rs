//! The next manoeuvre: driving that tells apart what a diagnosis could not.
//!
//! Each member of a class is a hypothesis of its own: the vehicle with that effect at the size at
//! which it explains the recording. Every manoeuvre of a menu is driven by all of them in
//! simulation, and the sequence with the largest separation per second is put together step by
//! step.

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
use menu::{INTERVAL, Manoeuvre, menu};
use nalgebra::DMatrix;
use rivals::Rival;
use separation::{Pair, products, shares, squared};
use std::ops::ControlFlow;
use trackdyn_core::rounding::Digits;
use trackdyn_core::{Command, PerSide, Pose, Schedule, real};
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::EffectId;
use trackdyn_model::Stationary;
use trackdyn_model::{Circumstance, Model, VehicleFile};
use trackdyn_recording::TrackSample;

/// How to plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Largest track speed, m/s, above zero.
    pub fastest: f64,
    /// Longest time of all manoeuvres together, s.
    pub duration: f64,
    /// Standard deviation of a pose along each axis, m.
    pub noise_xy: f64,
    /// Standard deviation of a pose's yaw, rad.
    pub noise_yaw: f64,
    /// All numbers that decide.
    pub method: Settings,
}

impl Default for Options {
    /// A laboratory's poses.
    fn default() -> Self {
        let method = Settings::default();
        Self { fastest: 1.0, duration: 60.0, noise_xy: 1e-3, noise_yaw: 1e-3, method }
    }
}

impl Options {
    /// The noise: white noise of each pose, and as much again per √s by which poses and encoders
    /// wander.
    fn noise(&self) -> SegmentNoise {
        let variances = [self.noise_xy.powi(2), self.noise_xy.powi(2), self.noise_yaw.powi(2)];
        SegmentNoise { pose: variances, walk: variances, heading: 0.0 }
    }
}

/// A manoeuvre of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What is driven.
    pub manoeuvre: Manoeuvre,
    /// When it begins, s.
    pub start: f64,
    /// √ of its part of each pair's z².
    pub z: Vec<f64>,
}

/// Whether driving tells two rivals apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The plan does.
    Plan,
    /// It takes about this time, s.
    Longer(f64),
    /// No manoeuvre of the menu does.
    Never,
}

/// Two rivals.
#[derive(Clone, Debug, PartialEq)]
pub struct Separation {
    /// Index of the question that it belongs to.
    pub question: usize,
    /// Both, by their places in the catalogue.
    pub effects: [EffectId; 2],
    /// z over the whole plan.
    pub z: f64,
    /// z over all manoeuvres of the menu, one after the other.
    pub menu: f64,
    /// Whether driving tells them apart.
    pub answer: Answer,
}

/// What to drive next.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The manoeuvres, in the order in which they are driven.
    pub steps: Vec<Step>,
    /// What they separate.
    pub pairs: Vec<Separation>,
    /// Number of manoeuvres to choose from, and how long all of them take, s.
    pub menu: (usize, f64),
    /// z from which on two rivals count as told apart.
    pub min_separation: f64,
}

impl Plan {
    /// How long it takes, s.
    pub fn duration(&self) -> f64 {
        self.steps.iter().map(|step| step.manoeuvre.duration()).sum()
    }

    /// The commands; none where there is nothing to drive.
    pub fn schedule(&self) -> Option<Schedule> {
        let speeds = self.steps.iter().flat_map(|step| &step.manoeuvre.speeds);
        let last = PerSide::default();
        let commands = speeds.chain([&last]).enumerate().map(|(k, speeds)| Command {
            t: rounded(INTERVAL * real(k)),
            speeds: speeds.map(rounded),
        });
        Schedule::new(commands.collect()).ok()
    }
}

/// The number with the digits that files of plans keep.
fn rounded(value: f64) -> f64 {
    Digits::Decimals(6).round(value)
}

/// Plans what separates the members of these classes. `progress` is told of each finished stage,
/// and may ask to stop.
///
/// # Errors
/// [`Error::NoMotion`] for a vehicle that cannot move so, [`Error::TooShort`] for a time in which
/// no manoeuvre of the menu can be driven, [`Error::Cancelled`].
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
    let menu = menu(options.fastest, gap(file, settings)?, settings);
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

/// Stages that progress is reported of.
pub const STAGES: [&str; 3] = ["rivals", "choice", "separation"];

/// Distance between the ICRs of a slow spin, m.
fn gap(file: &VehicleFile, settings: &settings::Plan) -> Result<f64, Error> {
    const SLOW: f64 = 0.1;
    let model = Model::new(file.vehicle.clone(), file.effects.clone());
    let speeds = PerSide::new(-SLOW, SLOW);
    let solution = Stationary::new(&model, &Circumstance::default()).solve(speeds);
    let gap = 2.0 * SLOW / solution.twist.w;
    let [least, most] = settings.gap_limits.map(|limit| file.vehicle.gauge * limit);
    let limits = least..most;
    if limits.contains(&gap) {
        Ok(gap)
    } else {
        Err(Error::NoMotion(format!("in a slow spin it turns at {} rad/s", solution.twist.w)))
    }
}

/// A class of rivals on typical driving.
struct Class {
    rivals: Vec<Rival>,
    pairs: Vec<Pair>,
    /// Whether it matters where, or when, a manoeuvre is driven.
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
            let reason = reason.to_owned();
            return Err(Error::NoMotion(reason));
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

    /// The products of each pair over these runs.
    fn products(&self, runs: &[PlannedRun], options: &Options) -> Vec<crate::normal::Normal> {
        products(&self.of(), &self.rivals, &evidence(runs, &self.rivals[0], options))
    }
}

/// What runs would show if the fitted member is the one.
fn evidence(runs: &[PlannedRun], fitted: &Rival, options: &Options) -> Weighted {
    let moves = |evidence: &Evidence| fitted.moves(evidence);
    Weighted::new(Evidence::planned(runs, options.noise(), fitted.delay(), &options.method, moves))
}

/// Manoeuvres in a row as a run, each a block of its own.
fn run(manoeuvres: &[&Manoeuvre], start: f64, pose: Pose) -> PlannedRun {
    let mut tracks = Vec::new();
    let mut blocks = Vec::new();
    let mut push = |speeds: &PerSide<f64>| {
        let t = start + INTERVAL * real(tracks.len());
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

/// What a pair would show in each manoeuvre of the menu, and has shown in those that are chosen
/// already.
struct Outlook {
    menu: Vec<DMatrix<f64>>,
    chosen: DMatrix<f64>,
    known: DMatrix<f64>,
    /// z² from which on the rivals are told apart.
    decided: f64,
}

impl Outlook {
    /// z² beyond what is chosen, of more manoeuvres of the menu.
    fn gain(&self, more: &[usize]) -> f64 {
        let with = more.iter().fold(self.chosen.clone(), |sum, &k| sum + &self.menu[k]);
        squared(&with, &self.known) - squared(&self.chosen, &self.known)
    }

    /// What a gain counts: less where the rivals are told apart already.
    fn weight(&self) -> f64 {
        self.decided / (self.decided + squared(&self.chosen, &self.known))
    }
}

/// The manoeuvres of the menu that separate best, in the order of their choice.
///
/// Step by step the one, or the two together, with the most weighted z² per second; two, for what
/// shows in a difference between manoeuvres shows in none of them alone.
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

/// The manoeuvre or the two with the best rate within a time, s.
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
    // Equal rates, as those of mirror images: the one that stands first.
    rated.max_by(|(a, one), (b, other)| a.total_cmp(b).then(other.cmp(one)))
}

/// Exchanges chosen manoeuvres for others while that separates more of what is separated least.
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

/// The outlook of each pair that the menu separates, after what is chosen.
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

/// Whether some driving separates a pair.
fn is_open(pair: &Pair, settings: &settings::Plan) -> bool {
    pair.typical >= settings.min_separation
}

/// What a sequence separates, driven in a row.
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
            // z grows with the root of the time.
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
