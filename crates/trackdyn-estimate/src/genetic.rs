//! The genetic algorithm of sec. 4.2: bit strings, cost (17).

mod chebyshev;
mod cost;
mod form;

pub use cost::Cost;

use crate::observations::Observations;
use crate::parameters::{COUNT, Free, Parameters};
use form::Form;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::HashMap;
use std::ops::ControlFlow;

/// Bits per parameter: 4096 steps of its range.
const BITS_PER_PARAMETER: u32 = 12;

/// How the population evolves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneticOptions {
    /// Individuals.
    pub population: usize,
    /// Generations.
    pub generations: usize,
    /// Probability that two parents cross over.
    pub crossover: f64,
    /// Probability that a bit flips.
    pub mutation: f64,
    /// Best individuals that live on unchanged.
    pub elite: usize,
    /// Seed of all random numbers.
    pub seed: u64,
}

impl Default for GeneticOptions {
    fn default() -> Self {
        Self {
            population: 100,
            generations: 200,
            crossover: 0.8,
            mutation: 0.01,
            elite: 2,
            seed: 1,
        }
    }
}

/// The best individual and its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneticEstimate {
    /// The parameters; fixed ones are those of the ideal drive.
    pub parameters: Parameters,
    /// The cost (17), m².
    pub cost: f64,
}

/// Ranges that the bit strings span: ICRs up to three gauges out, α within 20 %.
fn ranges(gauge: f64) -> [[f64; 2]; COUNT] {
    let icr = 3.0 * gauge;
    let alpha = [0.8, 1.2];
    [[-icr, -gauge / 4.0], [gauge / 4.0, icr], [-gauge, gauge], alpha, alpha]
}

/// Evolves the parameters. `progress` is told each finished generation.
///
/// The result depends on the seed and not on the number of threads: only costs are computed in
/// parallel.
///
/// # Panics
/// Without a population.
pub fn genetic(
    observations: &Observations,
    gauge: f64,
    lever: f64,
    free: Free,
    options: &GeneticOptions,
    progress: &dyn Fn(usize),
) -> GeneticEstimate {
    let unstopped = |generation| {
        progress(generation);
        ControlFlow::Continue(())
    };
    genetic_unless_stopped(observations, gauge, lever, free, options, &unstopped)
        .expect("progress never asks to stop")
}

/// As [`genetic`], until `progress` asks to stop after one of the generations: then there is no
/// estimate.
///
/// # Panics
/// Without a population.
pub fn genetic_unless_stopped(
    observations: &Observations,
    gauge: f64,
    lever: f64,
    free: Free,
    options: &GeneticOptions,
    progress: &dyn Fn(usize) -> ControlFlow<()>,
) -> Option<GeneticEstimate> {
    let ranges = ranges(gauge);
    let count = free.count();
    let bits = BITS_PER_PARAMETER * narrow(count);
    let decode = |chromosome: u64| decode(chromosome, count, &ranges);
    let cost = Cost::new(observations, lever);
    // A place of the form takes as long as a cost.
    let most = options.population * options.generations / 4;
    let form = Form::new(observations, lever, free, &ranges, most);
    // A population that converges meets the same strings again and again.
    let mut known: HashMap<u64, f64> = HashMap::new();
    let mut evaluate = |chromosomes: Vec<u64>| -> Vec<(f64, u64)> {
        let mut new: Vec<u64> =
            chromosomes.iter().copied().filter(|c| !known.contains_key(c)).collect();
        new.sort_unstable();
        new.dedup();
        match &form {
            Some(form) => known.extend(new.into_iter().map(|c| (c, form.at(&decode(c))))),
            None => known.par_extend(new.into_par_iter().map(|c| (c, cost.at(&decode(c))))),
        }
        let mut ranked: Vec<(f64, u64)> =
            chromosomes.into_iter().map(|chromosome| (known[&chromosome], chromosome)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ranked
    };
    let mut random = ChaCha8Rng::seed_from_u64(options.seed);
    let mask = u64::MAX >> (64 - bits);
    let first = (0..options.population).map(|_| random.random::<u64>() & mask).collect();
    let mut ranked = evaluate(first);
    for generation in 1..=options.generations {
        let parent = |random: &mut ChaCha8Rng| {
            // Tournament of two; the ranking makes the smaller index the fitter one.
            let draw = |random: &mut ChaCha8Rng| random.random_range(0..ranked.len());
            ranked[draw(random).min(draw(random))].1
        };
        let mut children = Vec::with_capacity(options.population);
        while children.len() + options.elite < options.population {
            let (mother, father) = (parent(&mut random), parent(&mut random));
            let mut child = mother;
            if random.random::<f64>() < options.crossover {
                let tail = mask >> random.random_range(1..bits);
                child = (mother & !tail) | (father & tail);
            }
            for bit in 0..bits {
                if random.random::<f64>() < options.mutation {
                    child ^= 1 << bit;
                }
            }
            children.push(child);
        }
        let elite: Vec<(f64, u64)> = ranked.iter().take(options.elite).copied().collect();
        ranked = evaluate(children);
        ranked.extend(elite);
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if progress(generation).is_break() {
            return None;
        }
    }
    let parameters = decode(ranked[0].1);
    Some(GeneticEstimate { parameters, cost: cost.at(&parameters) })
}

#[expect(clippy::cast_possible_truncation, reason = "at most five parameters")]
fn narrow(count: usize) -> u32 {
    count as u32
}

/// The parameters of a bit string: each field of bits is a Gray code over its range.
fn decode(chromosome: u64, count: usize, ranges: &[[f64; 2]; COUNT]) -> Parameters {
    let mut parameters = [0.0, 0.0, 0.0, 1.0, 1.0];
    for (k, (parameter, [low, high])) in parameters.iter_mut().zip(ranges).enumerate().take(count) {
        let largest = (1_u64 << BITS_PER_PARAMETER) - 1;
        let gray = (chromosome >> (BITS_PER_PARAMETER * narrow(k))) & largest;
        let mut binary = gray;
        for shift in [1, 2, 4, 8] {
            binary ^= binary >> shift;
        }
        #[expect(clippy::cast_precision_loss, reason = "twelve bits")]
        let fraction = binary as f64 / largest as f64;
        *parameter = low + (high - low) * fraction;
    }
    Parameters(parameters)
}
