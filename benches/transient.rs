//! Time to simulate a minute of driving by hand, on one core.

use divan::{Bencher, black_box};
use trackdyn_core::{Plant, Pose};
use trackdyn_drive::{ScheduleKind, ScheduleOptions};
use trackdyn_model::Transient;
use trackdyn_model::{Effects, Model, VehicleFile};

fn main() {
    divan::main();
}

const MODELS: [&str; 4] = [
    "",
    "yaw-inertia centripetal",
    "yaw-inertia centripetal load-transfer:cog_height_m=0.05",
    "yaw-inertia centripetal shear-displacement",
];

#[divan::bench(args = MODELS, sample_count = 5)]
fn a_minute_by_hand(bencher: Bencher, effects: &str) {
    let effects: Effects = effects
        .split_whitespace()
        .map(|effect| effect.parse().expect("an effect of the catalogue"))
        .collect();
    let model = Model::new(VehicleFile::auriga_alpha().vehicle, effects);
    let minute = ScheduleOptions { duration: Some(60.0), runs: Some(1), ..Default::default() };
    let runs = ScheduleKind::Manual.generate(&minute).expect("a schedule");
    bencher.bench(|| {
        let mut robot = Transient::at_rest(&model, 0.0, Pose::default());
        black_box(robot.follow(&runs[0].schedule).expect("it drives"))
    });
}
