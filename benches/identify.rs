//! Time to identify ICRs and alphas from a recording as long as the paper's.

mod paper_case;

use divan::{Bencher, black_box};
use paper_case::PaperCase;
use trackdyn_estimate::genetic::Cost;

fn main() {
    divan::main();
}

#[divan::bench]
fn least_squares_noise_huber(bencher: Bencher) {
    let case = PaperCase::new();
    bencher.bench(|| black_box(&case).noise_huber());
}

#[divan::bench]
fn least_squares_distance_squares(bencher: Bencher) {
    let case = PaperCase::new();
    bencher.bench(|| black_box(&case).distance_squares());
}

#[divan::bench(sample_count = 10)]
fn genetic(bencher: Bencher) {
    let case = PaperCase::new();
    bencher.bench(|| black_box(&case).genetic(1));
}

/// What the genetic algorithm asks for, once, on one core.
#[divan::bench]
fn cost(bencher: Bencher) {
    let case = PaperCase::new();
    let cost = Cost::new(&case.observations, paper_case::LEVER);
    let parameters = case.distance_squares().parameters;
    bencher.bench(|| cost.at(black_box(&parameters)));
}
