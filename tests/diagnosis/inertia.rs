//! What a body owes to its mass comes late with the belts, and differs with the law of friction.

use nalgebra::Vector3;
use trackdyn_core::{PerSide, Plant, Pose, Trajectory};
use trackdyn_diagnose::candidate::{Beside, Variant};
use trackdyn_diagnose::diagnosis::Kind;
use trackdyn_diagnose::hypothesis::{Hypothesis, Unknown, neutral};
use trackdyn_diagnose::mechanics::{Instruments, Mechanics};
use trackdyn_diagnose::{Diagnosis, Evidence, Settings, Weighted};
use trackdyn_drive::ScheduleKind;
use trackdyn_drive::sensors::Preset;
use trackdyn_estimate::weighting::SegmentNoise;
use trackdyn_model::Transient;
use trackdyn_model::contact::Friction;
use trackdyn_model::vehicle::FrictionUncertainty;
use trackdyn_model::{ActiveEffect, Model, RunningGear};
use trackdyn_tests::concealed::{Drive, INERTIA, diagnosed, named, owned, runs, sensors};

/// What inertia adds is late with belts that lag, without a motion in time of its own for every
/// lag: a hypothesis on the way of a fit predicts what one that is found anew does. A clock of lag
/// and delay together would else explain more.
#[test]
fn what_inertia_adds_is_late_with_the_belts() {
    let (at_once, evidence) = by_hand();
    let inert = Mechanics::new(&at_once, &evidence);
    for lag in [0.05, 0.15] {
        let belts = ActiveEffect::new("drivetrain-lag", &[("time_constant_s", lag)]).expect("one");
        let lagging = at_once.with_effect(belts);
        let anew = predicted(&lagging, &evidence);
        let on_the_way = inert.on_the_way(&lagging, &[], &evidence);
        let on_the_way = on_the_way.predict(&Instruments::of(&lagging), &evidence);
        let still = predicted(&without_inertia(&lagging), &evidence);
        let [off, added] = [on_the_way, still].map(|other| rms(&minus(&anew, &other)));
        println!("lag {lag} s: off by {off} of the {added} that inertia adds");
        assert!(off < 0.25 * added, "lag {lag} s: {off} of {added}");
    }
}

/// A belt jumps with each reading, and on dry friction a body follows in some milliseconds. Steps
/// by readings pass over that: a robot with little friction under small wheels seemed to have
/// Stribeck's friction, of seven standard deviations.
#[test]
fn what_inertia_adds_is_what_small_steps_make_it() {
    let mut file = owned(&[]);
    file.vehicle.running_gear =
        RunningGear::Wheels { contact_length: 0.088, width: 0.094, axles: vec![0.29, -0.29] };
    file.vehicle.friction = Friction { across: 0.57, along: 0.4 };
    file.vehicle.gauge = 0.55;
    file.vehicle.cog = [-0.017, 0.003];
    let (_, evidence) = by_hand();
    let hypothesis = Hypothesis::filed(&file, &Settings::default().prior);
    // of a laboratory
    let [pose, walk] = [4e-3_f64, 1.5e-3].map(|deviation| deviation.powi(2));
    let yaw = [0.17_f64, 0.07].map(|degrees| degrees.to_radians().powi(2));
    let noise = SegmentNoise {
        pose: [pose, pose, yaw[0]],
        walk: [walk, walk, 0.0],
        heading: yaw[1],
        stamp: 0.0,
    };
    let evidence = Weighted::new(evidence).with_noise(noise);
    let exact = in_time(&hypothesis, &evidence, (0.002, 1e-5));
    let off = evidence.white(minus(&predicted(&hypothesis, &evidence), &exact));
    let off = off.iter().map(Vector3::norm_squared).sum::<f64>().sqrt();
    println!("off by {off} standard deviations in {} samples", evidence.samples().len());
    assert!(off < 1.2, "{off} standard deviations");
}

/// The departure by inertia is found without these laws, and what they change in it from there:
/// that is what a motion in time with them gives, which takes many times as long.
#[test]
fn laws_of_the_slip_speed_change_the_answer_to_acceleration() {
    let (plain, evidence) = by_hand();
    let still = |hypothesis: &Hypothesis| predicted(&without_inertia(hypothesis), &evidence);
    for law in SLIP_LAWS.into_iter().chain(STRONG_EFFECTS) {
        let law: ActiveEffect = law.parse().expect("an effect");
        let [with, without] = [plain.with_effect(law.clone()), plain.clone()].map(|hypothesis| {
            let still = still(&hypothesis);
            let exact = in_time(&hypothesis, &evidence, (0.03, 5e-3));
            [exact, predicted(&hypothesis, &evidence)].map(|moving| minus(&moving, &still))
        });
        let [exact, found] = [0, 1].map(|k| minus(&with[k], &without[k]));
        let (changed, off) = (rms(&exact), rms(&minus(&found, &exact)));
        println!("{law} changes {changed:.2e} rad a segment, off by {off:.2e}");
        assert!(off < 0.2 * changed, "{law}: {off} of {changed}");
    }
}

/// What a number of the robot changes in its answer to acceleration is found with what inertia
/// adds, on the way of a fit too: with a law of the slip speed it is not found once more. A fit
/// took every step of the friction ratio nearly twice as far as its derivatives foretold, and came
/// to rest nowhere.
#[test]
fn a_law_of_the_slip_speed_takes_no_part_in_what_other_numbers_change() {
    let (plain, evidence) = by_hand();
    let rubber: ActiveEffect = "friction-anisotropy:ratio=0.95".parse().expect("an effect");
    let ratio = Unknown::Effect(rubber.effect(), 0);
    let plain = plain.with_effect(rubber);
    for law in SLIP_LAWS {
        let here = plain.with_effect(law.parse().expect("an effect"));
        for (number, step) in [(ratio, 0.05), (Unknown::Cog(0), 0.02), (Unknown::Cog(1), 0.02)] {
            let mechanics = Mechanics::beside(None, &here, &evidence);
            let there = here.with(number, here.get(number) + step);
            let on_the_way = mechanics.on_the_way(&there, &[number], &evidence);
            let on_the_way = on_the_way.predict(&Instruments::of(&there), &evidence);
            let by_inertia = |hypothesis: &Hypothesis, moving: &[Vector3<f64>]| {
                minus(moving, &predicted(&without_inertia(hypothesis), &evidence))
            };
            let before = by_inertia(&here, &predicted(&here, &evidence));
            let [anew, on_the_way] = [predicted(&there, &evidence), on_the_way]
                .map(|moving| minus(&by_inertia(&there, &moving), &before));
            let (changed, off) = (rms(&anew), rms(&minus(&on_the_way, &anew)));
            println!("{law}, {number:?}: {changed:.2e} rad a segment, off by {off:.2e}");
            assert!(off < 0.4 * changed, "{law}, {number:?}: {off} of {changed}");
        }
    }
}

/// The search sees by signatures, and a law of the slip speed shows in the answer to acceleration
/// as well as in steady turns.
#[test]
fn signatures_of_laws_of_the_slip_speed_know_the_answer_to_acceleration() {
    let (plain, evidence) = by_hand();
    let evidence = Weighted::new(evidence);
    let beside = Beside::new(&plain, &evidence);
    for law in SLIP_LAWS.into_iter().chain(STRONG_EFFECTS) {
        let law: ActiveEffect = law.parse().expect("an effect");
        let variant = Variant { effect: law.effect(), values: law.values().to_vec() };
        let signatures = beside.signatures(std::slice::from_ref(&variant));
        let [(_, signatures)] = &signatures[..] else { panic!("{law}: {}", signatures.len()) };
        let size = variant.values[0] - neutral(&law.card().parameters[0]);
        let white = |changed: &[Vector3<f64>]| {
            evidence.white(changed.iter().map(|change| change / size).collect())
        };
        let [whole, steady] = [plain.clone(), without_inertia(&plain)].map(|plain: Hypothesis| {
            let with = predicted(&plain.with_effect(law.clone()), &evidence);
            white(&minus(&with, &predicted(&plain, &evidence)))
        });
        let off = rms(&minus(&signatures[0].column, &whole));
        let in_time = rms(&minus(&whole, &steady));
        assert!(off < 0.02 * in_time, "{law}: {off} of {in_time}");
    }
}

/// Laws of the shear stress that depend on the slip.
const SLIP_LAWS: [&str; 4] = [
    "stribeck-friction:excess=0.35,speed_m_per_s=0.08",
    "stribeck-friction:excess=0.35,speed_m_per_s=0.2",
    "viscous-friction:growth_s_per_m=0.15",
    "shear-displacement:modulus_m=0.01",
];

/// Effects that change the answer to acceleration so much that other numbers of the robot change
/// another one.
const STRONG_EFFECTS: [&str; 2] =
    ["viscous-friction:growth_s_per_m=1.0", "friction-creep:speed_m_per_s=0.05"];

/// Friction that grows with the slip brakes a robot that starts to turn as more friction does.
/// Where its owner measured friction, that is not its level: the noise stays what it is, and the
/// law is named.
#[test]
fn friction_that_grows_with_the_slip_is_named_where_its_level_is_known() {
    const CONCEALED_EFFECT: &str = "viscous-friction:growth_s_per_m=0.3";
    let mut file = owned(&[CONCEALED_EFFECT]);
    file.vehicle.uncertainty.friction =
        FrictionUncertainty { across: Some(0.03), along: Some(0.03) };
    let schedule = runs(ScheduleKind::Manual, 4, 11);
    let drive = Drive::new(&file.vehicle, &[CONCEALED_EFFECT], &schedule, 11).expect("it drives");
    let sensors = sensors(Preset::Laboratory);
    let found = diagnosed(&drive.recording(&sensors, 11), &file).expect("enough");
    let walk = walk(&found);
    println!("walk of the yaw {walk} of {}: {:?}", sensors.pose.walk.yaw, named(&found));
    assert!(walk < 1.5 * sensors.pose.walk.yaw, "{walk}");
    let physics: Vec<_> =
        named(&found).into_iter().filter(|(kind, _)| *kind == Kind::Physics).collect();
    assert!(
        matches!(&physics[..], [(_, members)] if members.contains("viscous-friction")),
        "{physics:?}"
    );
}

/// A centre of gravity that is filed wrong and a sensor beside it move the constant ICRs alike, but
/// mass pulls where it is with every start and stop. Taken for the sensor's, 1 cm would be noise of
/// a heading that walks, or friction that depends on the slip.
#[test]
fn mass_tells_where_it_is_beside_a_mount() {
    const CONCEALED_EFFECT: &str = "sensor-lever-arm:x_m=0.2,y_m=0.2";
    let truth = owned(&[CONCEALED_EFFECT]);
    let mut file = truth.clone();
    file.vehicle.cog[0] -= 0.01;
    let schedule = runs(ScheduleKind::Manual, 4, 11);
    let drive = Drive::new(&truth.vehicle, &[CONCEALED_EFFECT], &schedule, 11).expect("it drives");
    let sensors = sensors(Preset::Laboratory);
    let found = diagnosed(&drive.recording(&sensors, 11), &file).expect("enough");
    let cog = found.models.base.fit.hypothesis.vehicle.cog;
    println!("centre of gravity {cog:?} of {:?}: {:?}", truth.vehicle.cog, named(&found));
    assert!((cog[0] - truth.vehicle.cog[0]).abs() < 0.003, "{cog:?}");
    let walk = walk(&found);
    assert!(walk < 1.5 * sensors.pose.walk.yaw, "{walk}");
    assert!(named(&found).iter().all(|(kind, _)| *kind != Kind::Physics), "{:?}", named(&found));
}

/// Walk of the yaw that a diagnosis finds, rad/√s.
fn walk(of: &Diagnosis) -> f64 {
    let noise = of.evidence.seen.noise().expect("of a recording");
    (noise.walk[2] + noise.heading).sqrt()
}

/// A robot with mass, and two runs by hand.
fn by_hand() -> (Hypothesis, Evidence) {
    let file = owned(&[]);
    let schedule = runs(ScheduleKind::Manual, 2, 7);
    let drive = Drive::new(&file.vehicle, &[], &schedule, 7).expect("it drives");
    let recording = drive.recording(&sensors(Preset::Laboratory), 7);
    let evidence = Evidence::of_recording(&recording, file.vehicle.gauge, &Settings::default())
        .expect("enough");
    (Hypothesis::filed(&file, &Settings::default().prior), evidence)
}

fn without_inertia(hypothesis: &Hypothesis) -> Hypothesis {
    let effects = hypothesis.effects.iter().filter(|one| !INERTIA.contains(&one.card().id));
    Hypothesis { effects: effects.cloned().collect(), ..hypothesis.clone() }
}

fn predicted(hypothesis: &Hypothesis, evidence: &Evidence) -> Vec<Vector3<f64>> {
    Mechanics::new(hypothesis, evidence).predict(&Instruments::of(hypothesis), evidence)
}

/// The motion in time of all that the hypothesis holds, over each sample, in steps of this length,
/// s, and tolerance, m/s.
fn in_time(
    hypothesis: &Hypothesis,
    evidence: &Evidence,
    (step, tolerance): (f64, f64),
) -> Vec<Vector3<f64>> {
    let model = Model::new(hypothesis.vehicle.clone(), hypothesis.effects.clone());
    let paths: Vec<Trajectory> = evidence
        .tracks()
        .iter()
        .map(|run| {
            let mut path = Trajectory::default();
            let mut robot = Transient::at_rest(&model, run[0].t, Pose::default())
                .with_step(step)
                .with_tolerance(tolerance, step / 20.0);
            path.push(robot.moment());
            for pair in run.windows(2) {
                let speeds = PerSide::new(pair[0].v_left, pair[0].v_right);
                robot.drive(speeds, pair[1].t, &mut path).expect("it moves");
            }
            path
        })
        .collect();
    let samples = evidence.samples().iter();
    samples
        .map(|sample| {
            let path = &paths[sample.run];
            let moved =
                path.pose_at(sample.start).relative(&path.pose_at(sample.start + sample.duration));
            Vector3::new(moved.x, moved.y, moved.yaw)
        })
        .collect()
}

fn minus(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Root mean square of the yaw, rad.
fn rms(of: &[Vector3<f64>]) -> f64 {
    let squares: f64 = of.iter().map(|value| value[2].powi(2)).sum();
    (squares / trackdyn_core::real(of.len())).sqrt()
}
