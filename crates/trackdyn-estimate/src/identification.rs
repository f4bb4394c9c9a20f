//! All that a recording says of the kinematic parameters: the methods side by side.

use crate::contradiction::Contradiction;
use crate::doubt::Doubt;
use crate::error::Error;
use crate::genetic::{GeneticEstimate, GeneticOptions, genetic_unless_stopped};
use crate::least_squares::{
    Estimate, Loss, Unknowns, doubts, estimate_at, lacks, lacks_nuisance, least_squares,
    nuisance_doubts, whitened_rms,
};
use crate::noise::{Noise, noise_beside, of_encoders};
use crate::observations::Observations;
use crate::parameters::{Free, Parameters};
use crate::residual_noise::residual_noise;
use crate::response::Response;
use crate::run_clocks::OtherClock;
use crate::scatter::scatter;
use crate::sensor::Nuisance;
use crate::separation::Separation;
use crate::spin_test::SpinTest;
use crate::weighting::{SegmentNoise, Weighting};
use crate::{Clock, SegmentOptions, clock, contradiction, noise, spin_test};
use std::borrow::Cow;
use std::ops::ControlFlow;
use trackdyn_model::Kinematics;
use trackdyn_recording::{Recording, Warning};

/// How to identify.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Gauge of the vehicle, m.
    pub gauge: f64,
    /// Clock offset of the poses, s; none: estimated.
    pub tau: Option<f64>,
    /// Time for which the tracks must have run steadily before a segment counts, s; none: all
    /// count.
    pub settle: Option<f64>,
    /// Properties of the pose sensor to fit beside the kinematic parameters.
    pub nuisances: Vec<Nuisance>,
    /// Relative error that all yaw of the recording shares, 1: the standard deviation of the scale
    /// of a gyroscope that corrects it.
    pub yaw_scale: f64,
    /// The genetic algorithm.
    pub genetic: GeneticOptions,
    /// How the clock offset is found.
    pub clock: clock::Settings,
    /// How noise is measured.
    pub noise: noise::Settings,
    /// Which driving tells the distance of the ICRs by itself.
    pub spin: spin_test::Settings,
    /// By what poses are taken for computed from the tracks.
    pub computed: contradiction::Settings,
}

impl Options {
    /// The usual ones for a gauge, m: all segments, nothing given or fitted beside.
    pub fn new(gauge: f64) -> Self {
        Self {
            gauge,
            tau: None,
            settle: None,
            nuisances: Vec::new(),
            yaw_scale: 0.0,
            genetic: GeneticOptions::default(),
            clock: clock::Settings::default(),
            noise: noise::Settings::default(),
            spin: spin_test::Settings::default(),
            computed: contradiction::Settings::default(),
        }
    }
}

/// The parameters with one choice of what is free.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Which parameters are free.
    pub free: Free,
    /// The genetic algorithm's, by the cost (17).
    pub genetic: GeneticEstimate,
    /// The genetic result as an estimate, with the uncertainty that the cost (17) has there.
    pub genetic_estimate: Estimate,
    /// Least squares by the noise, or why not.
    pub least_squares: Result<Estimate, Error>,
    /// Why the recording does not determine them; empty where it does.
    pub doubts: Vec<Doubt>,
    /// What contradicts them; empty where all parts of the answer agree.
    pub contradictions: Vec<Contradiction>,
    /// Why properties of the sensor that were asked for are not fitted.
    pub refused: Vec<Doubt>,
}

/// What the weights of segments come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weights {
    /// The noise that the recording shows at rest or in steady driving, or that its maker states.
    Noise(SegmentNoise),
    /// The residuals of constant ICRs, which bound the noise from above, where it shows in no other
    /// way.
    Residuals(SegmentNoise),
    /// All segments count alike: constant ICRs are not found either.
    Equal,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Identification {
    /// Clock offset.
    pub clock: Clock,
    /// Noise of the recording.
    pub noise: Noise,
    /// What the weights come from.
    pub weights: Weights,
    /// How the poses follow the track speeds; none where the recording is too short to tell. Where
    /// they do not follow at once, all below is of track speeds that are weighted by it.
    pub response: Option<Response>,
    /// Segments.
    pub segments: usize,
    /// Lever that turns yaw errors into distances in the cost (17): half the gauge, m.
    pub lever: f64,
    /// The spin test, or why not.
    pub spin_test: Result<SpinTest, Error>,
    /// The distance of the ICRs from turning alone, where no fit determines more.
    pub separation: Option<Separation>,
    /// With the ICRs free, and with the ICRs and α free.
    pub fits: [Fit; 2],
}

/// Residuals, in times the noise, beyond which constant ICRs do not describe a drive: those of real
/// robots on hard ground are two to five.
const MAX_NOISE_RATIO: f64 = 8.0;

impl Identification {
    /// Size of the residuals of the best fit, in times the noise, where that is far beyond noise;
    /// none where the noise is not known.
    pub fn beyond_noise(&self) -> Option<f64> {
        let fits = self.fits.iter().filter_map(|fit| fit.least_squares.as_ref().ok());
        let least = fits.map(|fit| fit.whitened_rms).fold(f64::INFINITY, f64::min);
        let is_far = matches!(self.weights, Weights::Noise(_)) && least.is_finite();
        Some(least).filter(|least| is_far && *least > MAX_NOISE_RATIO)
    }
}

/// How far a fitted clock offset may go from its start, s: two readings at 20 Hz.
const TAU_MARGIN: f64 = 0.1;

/// Times that segments are cut anew where the clock offset runs to its margin.
const MAX_CUTS: usize = 5;

/// Runs all methods on a recording. `progress` is told each finished generation of the genetic
/// algorithm, which runs twice.
///
/// # Errors
/// Too few segments, and those of [`Clock::of`].
pub fn identify(
    recording: &Recording,
    options: &Options,
    progress: &dyn Fn(usize),
) -> Result<Identification, Error> {
    let unstopped = |generation| {
        progress(generation);
        ControlFlow::Continue(())
    };
    identify_unless_stopped(recording, options, &unstopped)
}

/// As [`identify`], until `progress` asks to stop after one of the generations.
///
/// # Errors
/// Those of [`identify`]; [`Error::Cancelled`] where `progress` asked to stop.
pub fn identify_unless_stopped(
    recording: &Recording,
    options: &Options,
    progress: &dyn Fn(usize) -> ControlFlow<()>,
) -> Result<Identification, Error> {
    let seen = Seen::of(recording, options)?;
    let Seen { observations, spin_test, response, .. } = &seen;
    let lever = options.gauge / 2.0;
    let other_clock = match seen.clock {
        Clock::Estimated(offset) => OtherClock::of(recording, offset.tau, &options.clock),
        Clock::Given(_) | Clock::Unknown { .. } => None,
    };
    let fit = |free: Free| -> Option<Fit> {
        let (gauge, genetic) = (options.gauge, &options.genetic);
        let genetic = genetic_unless_stopped(observations, gauge, lever, free, genetic, progress)?;
        let by_distance = Weighting::Distance { lever };
        let genetic_estimate =
            estimate_at(observations, &genetic.parameters, free, &by_distance, Loss::Squares);
        let (least_squares, refused) = seen.least_squares(free);
        let wide =
            least_squares.as_ref().map_or(Vec::new(), |estimate| doubts(estimate, options.gauge));
        let unlike = seen.unlike().filter(|_| !wide.is_empty());
        let doubts: Vec<Doubt> = unlike.into_iter().chain(wide).collect();
        let contradictions = least_squares.as_ref().map_or(Vec::new(), |estimate| {
            let spin = spin_test.as_ref().ok();
            let noise = seen.known_noise();
            let genetic = Some(&genetic_estimate);
            let by = &options.computed;
            let mut found =
                Contradiction::of_motions(estimate, genetic, spin, observations, noise, gauge, by);
            found.extend(Contradiction::of_response(estimate, response.as_ref()));
            found.extend(other_clock.map(Contradiction::RunClock));
            found
        });
        Some(Fit {
            free,
            genetic,
            genetic_estimate,
            least_squares,
            doubts,
            contradictions,
            refused,
        })
    };
    let fits = fit(Free::Icrs).and_then(|icrs| Some([icrs, fit(Free::IcrsAndAlphas)?]));
    let mut fits = fits.ok_or(Error::Cancelled)?;
    let [icrs, with_alphas] = &mut fits;
    if with_alphas.doubts.is_empty() {
        let found = with_alphas.contradictions.iter();
        let of_speeds: Vec<Contradiction> =
            found.filter(|found| found.is_of_track_speeds()).copied().collect();
        // They explain a distance that no friction makes.
        icrs.contradictions.retain(|one| of_speeds.is_empty() || !one.is_apart());
        icrs.contradictions.extend(of_speeds);
        let holds = with_alphas.contradictions.is_empty();
        if let (true, Ok(fit), Ok(with)) = (holds, &icrs.least_squares, &with_alphas.least_squares)
        {
            icrs.contradictions.extend(Contradiction::of_factors(fit, with));
        }
    }
    let is_open = fits.iter().all(|fit| fit.least_squares.is_err() || !fit.doubts.is_empty());
    let separation = if is_open { Separation::of_motions(observations).ok() } else { None };
    let separation = separation.map(|found| found.with_yaw_scale(options.yaw_scale));
    Ok(Identification {
        segments: observations.len(),
        response: seen.response,
        lever,
        separation,
        fits,
        clock: seen.clock,
        noise: seen.noise,
        weights: seen.weights,
        spin_test: seen.spin_test,
    })
}

/// The ICRs by least squares alone, without the other methods.
///
/// # Errors
/// Those of [`identify`], and of [`least_squares`].
pub fn icrs_alone(recording: &Recording, options: &Options) -> Result<Estimate, Error> {
    Seen::of(recording, options)?.least_squares(Free::Icrs).0
}

/// What contradicts the ICRs by least squares, without the other methods: contradictions within the
/// recording, whatever is done with it. How fast the poses follow is left to those who ask.
///
/// # Errors
/// Those of [`icrs_alone`].
pub fn contradictions(
    recording: &Recording,
    options: &Options,
) -> Result<Vec<Contradiction>, Error> {
    let seen = Seen::of(recording, options)?;
    let (estimate, _) = seen.least_squares(Free::Icrs);
    let (spin, noise) = (seen.spin_test.as_ref().ok(), seen.known_noise());
    let (observations, gauge, by) = (&seen.observations, options.gauge, &options.computed);
    Ok(Contradiction::of_motions(&estimate?, None, spin, observations, noise, gauge, by))
}

/// What a recording shows before anything is fitted to it.
struct Seen<'a> {
    recording: Cow<'a, Recording>,
    response: Option<Response>,
    options: &'a Options,
    segments: SegmentOptions,
    clock: Clock,
    observations: Observations,
    noise: Noise,
    spin_test: Result<SpinTest, Error>,
    weights: Weights,
    weighting: Weighting,
}

/// Why there are too few segments.
fn too_few(recording: &Recording, observations: &Observations, options: &Options) -> Error {
    let apart = recording.warnings().iter().find_map(|warning| match warning {
        Warning::NoCommonTime { run, offset } => Some((*run, *offset)),
        _ => None,
    });
    if let Some((run, offset)) = apart.filter(|_| options.tau.is_none()) {
        return Error::NoCommonTime { run, offset };
    }
    Error::too_few(observations.len(), observations.mean_duration(), Free::IcrsAndAlphas.count())
}

impl<'a> Seen<'a> {
    fn of(recording: &'a Recording, options: &'a Options) -> Result<Self, Error> {
        let clock = Clock::of(recording, options.tau, &options.clock)?;
        let tau = clock.tau();
        let tau_margin =
            if options.nuisances.contains(&Nuisance::TimeOffset) { TAU_MARGIN } else { 0.0 };
        let segments = SegmentOptions { tau, tau_margin, ..SegmentOptions::default() };
        let response = Response::of(recording, tau);
        let encoders = of_encoders(recording, &options.noise);
        let applied = response.as_ref().and_then(|response| response.applied(recording));
        let (recording, segments) = match applied {
            Some(weighted) => {
                let minimum_duration =
                    response.as_ref().map_or(segments.minimum_duration, Response::segment_duration);
                let segments = SegmentOptions { minimum_duration, ..segments };
                (Cow::Owned(weighted), segments)
            }
            None => (Cow::Borrowed(recording), segments),
        };
        let observations = cut(&recording, &segments, options);
        let needed = 4 * Free::IcrsAndAlphas.count();
        if observations.len() < needed {
            return Err(too_few(&recording, &observations, options));
        }
        let noise = noise_beside(&recording, tau, encoders, &options.noise);
        let spin_test = spin_test(&observations, options.gauge, &options.spin);
        // Only the weights of the encoders' noise depend on it, and roughly: its size is enough.
        let gap = spin_test.as_ref().map_or(1.5 * options.gauge, |spin| spin.gap);
        let stated = recording.stated_noise().map(SegmentNoise::stated);
        let known = SegmentNoise::measured(&noise, gap).or(stated);
        let lever = options.gauge / 2.0;
        let remaining = || residual_noise(&observations, options.gauge);
        let weights = match (known, known.is_none().then(remaining).flatten()) {
            (Some(noise), _) => Weights::Noise(noise),
            (None, Some(noise)) => Weights::Residuals(noise),
            (None, None) => Weights::Equal,
        };
        let weighting = match weights {
            Weights::Noise(noise) | Weights::Residuals(noise) => Weighting::Noise(noise),
            Weights::Equal => Weighting::Distance { lever },
        };
        let observations = match weighting {
            Weighting::Noise(_) => observations.moving_by(moves(&observations, gap)),
            Weighting::Distance { .. } => observations,
        };
        Ok(Self {
            recording,
            response,
            options,
            segments,
            clock,
            observations,
            noise,
            spin_test,
            weights,
            weighting,
        })
    }

    /// Why nothing is determined: tracks and poses that do not turn alike; none where they do.
    fn unlike(&self) -> Option<Doubt> {
        match self.clock {
            Clock::Unknown { correlation, .. } => Some(Doubt::Unlike { correlation: correlation? }),
            Clock::Given(_) | Clock::Estimated(_) => None,
        }
    }

    /// The noise that shows without a model, or is stated.
    fn known_noise(&self) -> Option<&SegmentNoise> {
        match &self.weights {
            Weights::Noise(noise) => Some(noise),
            Weights::Residuals(_) | Weights::Equal => None,
        }
    }

    /// Least squares, and why properties of the sensor that were asked for are not fitted.
    fn least_squares(&self, free: Free) -> (Result<Estimate, Error>, Vec<Doubt>) {
        let Self { recording, options, segments, observations, noise, weighting, .. } = self;
        if let Some(doubt) = lacks(observations, noise, free) {
            return (Err(Error::NotDetermined(doubt)), Vec::new());
        }
        let cut = |tau: f64| {
            let anew = cut(recording, &SegmentOptions { tau, ..*segments }, options);
            match observations.moves() {
                Some(moves) => anew.moving_by(moves),
                None => anew,
            }
        };
        let fit = |by: &Weighting| fit_with_sensor(observations, &cut, noise, free, by, options);
        let (estimate, refused) = match (fit(weighting), weighting) {
            (Fitted { estimate: Ok(first), cut, .. }, &Weighting::Noise(measured)) => {
                let observed = cut.as_ref().unwrap_or(observations);
                let by_scatter = Weighting::Noise(scatter(observed, &first, measured));
                let Fitted { estimate, cut, refused } = fit(&by_scatter);
                let observed = cut.as_ref().unwrap_or(observations);
                let beside_noise = |estimate: Estimate| {
                    let whitened_rms = whitened_rms(observed, &estimate, weighting);
                    Estimate { whitened_rms, ..estimate }
                };
                (estimate.map(beside_noise), refused)
            }
            (Fitted { estimate, refused, .. }, _) => (estimate, refused),
        };
        let scale = |estimate: Estimate| {
            let (gap, [.., left, right]) = (estimate.gap(), estimate.parameters.0);
            let alpha = f64::midpoint(left, right);
            let of_response = |response: &Response| {
                response.scale_deviation(gap.value / alpha, gap.deviation / alpha)
            };
            let open = self.response.as_ref().map_or(0.0, of_response);
            estimate.with_yaw_scale(options.yaw_scale.hypot(open))
        };
        (estimate.map(scale), refused)
    }
}

/// How the body moves by the track speeds, as far as the weights of segments depend on it: the
/// constant ICRs with all segments alike, or a separation of `gap` (m) where these are not found.
fn moves(observations: &Observations, gap: f64) -> Kinematics {
    let ideal = Kinematics::ideal(gap);
    let by_distance = Weighting::Distance { lever: gap / 2.0 };
    let (start, unknowns) = (Parameters::of(&ideal), Free::Icrs.into());
    let fit = least_squares(observations, &start, &unknowns, &by_distance, Loss::Huber);
    fit.map_or(ideal, |fit| fit.parameters.kinematics())
}

/// The segments at the clock offset of the segment options.
fn cut(recording: &Recording, segments: &SegmentOptions, options: &Options) -> Observations {
    match options.settle {
        Some(settle) => Observations::steady(recording, segments, settle),
        None => Observations::new(recording, segments),
    }
}

/// Least squares with those of the wanted properties of the sensor that the recording shows.
struct Fitted {
    estimate: Result<Estimate, Error>,
    /// The segments that it was fitted to, where the clock offset had them cut anew.
    cut: Option<Observations>,
    /// The reasons against the other properties.
    refused: Vec<Doubt>,
}

/// Least squares with the properties of the sensor that the recording shows; `cut` cuts it at
/// another clock offset.
fn fit_with_sensor(
    observations: &Observations,
    cut: &dyn Fn(f64) -> Observations,
    noise: &Noise,
    free: Free,
    weighting: &Weighting,
    options: &Options,
) -> Fitted {
    let start = Parameters::of(&Kinematics::ideal(options.gauge));
    let mut unknowns = Unknowns::from(free);
    let mut refused = Vec::new();
    for &nuisance in &options.nuisances {
        match lacks_nuisance(observations, noise, nuisance) {
            Some(doubt) => refused.push(doubt),
            None => unknowns.nuisances.push(nuisance),
        }
    }
    loop {
        let fit = |observations: &Observations| {
            least_squares(observations, &start, &unknowns, weighting, Loss::Huber)
        };
        let mut estimate = fit(observations);
        let mut moved = None;
        for _ in 0..MAX_CUTS {
            // Readings are at hand up to the margin: where the offset reaches it, segments are cut
            // anew.
            let Err(Error::ClockLeaves { tau, .. }) = estimate else { break };
            estimate = fit(moved.insert(cut(tau)));
        }
        let wide = estimate.as_ref().map_or(Vec::new(), nuisance_doubts);
        if wide.is_empty() {
            return Fitted { estimate, cut: moved, refused };
        }
        let is_wide = |nuisance: &Nuisance| {
            let of = |doubt: &Doubt| match doubt {
                Doubt::WideNuisance { nuisance: wide, .. } => wide == nuisance,
                _ => false,
            };
            wide.iter().any(of)
        };
        unknowns.nuisances.retain(|nuisance| !is_wide(nuisance));
        refused.extend(wide);
    }
}
