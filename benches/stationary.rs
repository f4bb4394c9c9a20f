//! Time of one stationary solve from a cold start.

use divan::{Bencher, black_box};
use trackdyn_core::PerSide;
use trackdyn_model::Stationary;
use trackdyn_model::{Circumstance, Effects, Model, VehicleFile};

fn main() {
    divan::main();
}

const MODELS: [&str; 5] = [
    "",
    "centripetal load-transfer:cog_height_m=0.05",
    "motion-resistance",
    "viscous-friction",
    "shear-displacement",
];

#[divan::bench(args = MODELS)]
fn solve(bencher: Bencher, effects: &str) {
    let effects: Effects = effects
        .split_whitespace()
        .map(|effect| effect.parse().expect("an effect of the catalogue"))
        .collect();
    let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
    let solver = Stationary::new(&model, &Circumstance::default());
    bencher.bench(|| solver.solve(black_box(PerSide::new(0.35, 0.85))));
}
