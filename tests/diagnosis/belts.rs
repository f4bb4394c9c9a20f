//! Belts that lag take all that the body does along.

use nalgebra::Vector3;
use trackdyn_diagnose::Evidence;
use trackdyn_diagnose::hypothesis::Hypothesis;
use trackdyn_diagnose::mechanics::{Instruments, Mechanics};
use trackdyn_field::ScheduleKind;
use trackdyn_field::sensors::Preset;
use trackdyn_physics::ActiveEffect;
use trackdyn_tests::concealed::{Drive, INERTIA, owned, runs, sensors};

/// What inertia adds is late with belts that lag, without a motion in time of its own for every lag: a hypothesis on the way
/// of a fit predicts what one that is found anew does. A clock of lag and delay together would else explain more.
#[test]
fn what_inertia_adds_is_late_with_the_belts() {
    let file = owned(&[]);
    let schedule = runs(ScheduleKind::Manual, 2, 7);
    let drive = Drive::new(&file.vehicle, &[], &schedule, 7).expect("it drives");
    let recording = drive.recording(&sensors(Preset::Laboratory), 7);
    let evidence = Evidence::of_recording(&recording, file.vehicle.gauge).expect("enough");
    let at_once = Hypothesis::filed(&file);
    let inert = Mechanics::new(&at_once, &evidence);
    for lag in [0.05, 0.15] {
        let belts = ActiveEffect::new("drivetrain-lag", &[("time_constant_s", lag)]).expect("one");
        let lagging = at_once.with_effect(belts);
        let predicted = |mechanics: &Mechanics, hypothesis: &Hypothesis| {
            mechanics.predict(&Instruments::of(hypothesis), &evidence)
        };
        let anew = predicted(&Mechanics::new(&lagging, &evidence), &lagging);
        let on_the_way = inert.on_the_way(&lagging, &[], &evidence);
        let on_the_way = predicted(&on_the_way, &lagging);
        let still = without_inertia(&lagging);
        let still = predicted(&Mechanics::new(&still, &evidence), &still);
        let [off, added] = [&on_the_way, &still].map(|other| rms(&anew, other));
        println!("lag {lag} s: off by {off} of the {added} that inertia adds");
        assert!(off < 0.25 * added, "lag {lag} s: {off} of {added}");
    }
}

fn without_inertia(hypothesis: &Hypothesis) -> Hypothesis {
    let effects = hypothesis.effects.iter().filter(|one| !INERTIA.contains(&one.card().id));
    Hypothesis { effects: effects.cloned().collect(), ..hypothesis.clone() }
}

/// Root mean square of the differences of the yaw, rad.
fn rms(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a[2] - b[2]).powi(2)).sum();
    (squares / trackdyn_core::real(a.len())).sqrt()
}
