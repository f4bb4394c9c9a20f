//! Conformance tests for every effect of the catalogue.

use crate::contact::pressure::Footprint;
use crate::contact::quadrature::SlipSite;
use crate::contact::{Pressure, ShearStress};
use crate::effect::{Card, Parameter, Role, Stage};
use crate::effects::{ActiveEffect, CATALOGUE};
use crate::model::Model;
use crate::pipeline::{Circumstance, Drive, Ground, Motion, Sensor, Site, Situation};
use crate::{Effects, VehicleFile};
use std::collections::BTreeSet;
use trackdyn_core::{Dual, PerSide, Scalar, Side, Twist, Wrench};

/// Every effect with typical parameters.
fn all() -> impl Iterator<Item = ActiveEffect> {
    CATALOGUE.iter().map(|card| {
        let typical: Vec<_> = card.parameters.iter().map(|p| (p.key, p.typical)).collect();
        ActiveEffect::new(card.id, &typical).expect("typical sizes are in range")
    })
}

/// A fast left turn.
fn turn<S: Scalar>(z: [S; 3]) -> Motion<S> {
    Motion::anchored(PerSide::new(0.3, 0.9), Side::Left, [z[0], z[1]], z[2])
}

const ICR: [f64; 3] = [-0.37, 0.05, 1.2];

/// A fast left turn with acceleration.
fn changing_turn() -> Motion {
    let acceleration = Twist { v_x: 0.1, v_y: 0.3, w: -0.2 };
    Motion { acceleration, ..turn(ICR) }
}

/// A place, heading and time at which every effect acts.
const ACTING_CIRCUMSTANCE: Circumstance =
    Circumstance { position: [3.0, 0.5], heading: 0.4, time: 60.0 };

#[test]
fn every_file_is_registered() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/effects");
    let own = ["active", "dispatch", "error", "id", "nature"];
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder of the catalogue")
        .map(|entry| entry.expect("readable").path())
        .map(|path| path.file_stem().expect("a file name").to_string_lossy().into_owned())
        .filter(|stem| !own.contains(&stem.as_str()))
        .collect();
    let ids: BTreeSet<String> = CATALOGUE.iter().map(|card| card.id.replace('-', "_")).collect();
    assert_eq!(files, ids, "one file per effect, one line per file in effects.rs");
    assert_eq!(ids.len(), CATALOGUE.len(), "ids are unique");
}

#[test]
fn cards_are_complete() {
    for card in CATALOGUE {
        for text in [card.title, card.law, card.assumes, card.shows] {
            assert!(text.len() > 10 && !text.ends_with(' '), "{}: {text:?}", card.id);
        }
        assert!(!card.sources.is_empty() && !card.stages.is_empty(), "{}", card.id);
        assert!(card.breaks.is_sorted(), "{}: symmetries in the order of the tables", card.id);
        for parameter in card.parameters {
            let [low, high] = parameter.range;
            assert!(low < high && (low..=high).contains(&parameter.typical), "{}", card.id);
            assert!(parameter.typical.is_finite() && !parameter.meaning.is_empty());
            let suffix = parameter.unit.replace('/', "_per_").to_lowercase();
            assert!(parameter.unit == "1" || parameter.key.ends_with(&suffix), "{}", parameter.key);
        }
    }
}

#[test]
fn hooks_act_at_the_stages_of_the_card_and_nowhere_else() {
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    let footprint = Footprint::of(&vehicle.patches(Side::Left));
    let motion = changing_turn();
    for effect in all() {
        let mut body = vehicle.clone();
        effect.body(&mut body);
        let mut drive = Drive::direct();
        effect.drive(&mut drive);
        let mut sensor = Sensor::default();
        effect.sense(&mut sensor);

        let level = Ground::level(&vehicle, &footprint, ACTING_CIRCUMSTANCE);
        let mut ground = level;
        effect.ground(&mut ground);

        let situation =
            Situation { vehicle: &vehicle, ground: &level, footprint: &footprint, motion: &motion };
        let mut centre_of_pressure = vehicle.cog;
        effect.load(&situation, &mut centre_of_pressure);

        let patch = &vehicle.patches(Side::Left)[0];
        let position = [patch.centre()[0], 0.1];
        let unit_slip = motion.slip.left.direction_at(position);
        let unit_slip_length = unit_slip[0].hypot(unit_slip[1]);
        let slip = SlipSite { position, unit_slip, unit_slip_length };
        let pressure = Pressure { at_origin: 1e4, gradient: 2e3 };
        let side = Side::Left;
        let site = Site { situation: &situation, side, patch, pressure: &pressure, slip: &slip };
        let mut stress = ShearStress::base();
        effect.shear(&site, &mut stress);

        let mut wrench = Wrench::zero();
        effect.wrench(&situation, &PerSide::new(1000.0, 1200.0), &mut wrench);

        for (stage, acts) in [
            (Stage::Body, body != vehicle),
            (Stage::Drive, drive != Drive::direct()),
            (Stage::Ground, ground != level),
            (Stage::Load, centre_of_pressure != vehicle.cog),
            (Stage::Shear, stress != ShearStress::base()),
            (Stage::Wrench, wrench != Wrench::zero()),
            (Stage::Sense, sensor != Sensor::default()),
        ] {
            let listed = effect.card().stages.contains(&stage);
            assert_eq!(acts, listed, "{} at stage {}", effect.card().id, stage.name());
        }
    }
}

/// Behind a lag, a stopping belt becomes so slow that the reciprocal of its speed overflows.
#[test]
fn forces_and_their_derivatives_are_finite_however_slow_the_belts_are() {
    const SLOW_SPEEDS: [f64; 7] = [1e-3, 1e-100, 1e-300, 1e-311, 5e-324, 0.0, -1e-311];
    for effect in all() {
        let vehicle = VehicleFile::auriga_alpha().vehicle;
        let model = Model::new(vehicle, Effects::from_iter([effect.clone()]));
        let ground = model.ground(&ACTING_CIRCUMSTANCE);
        let pairs =
            SLOW_SPEEDS.iter().flat_map(|&slow| [0.9, 3.0 * slow].map(|right| (slow, right)));
        for (left, right) in pairs {
            let [x, y, turn]: [Dual<3>; 3] = Dual::variables(ICR);
            let motion = Motion::anchored(PerSide::new(left, right), Side::Left, [x, y], turn);
            for sum in total(&model, &ground, &motion) {
                let finite = sum.value.is_finite() && sum.gradient.iter().all(|g| g.is_finite());
                assert!(finite, "{effect} at {left:e} and {right:e} m/s: {sum:?}");
            }
        }
    }
}

#[test]
fn derivatives_of_the_balance_equal_difference_quotients() {
    const STEP: f64 = 1e-6;
    for effect in all() {
        let vehicle = VehicleFile::auriga_alpha().vehicle;
        let weight = vehicle.weight();
        let model = Model::new(vehicle, Effects::from_iter([effect.clone()]));
        let ground = model.ground(&ACTING_CIRCUMSTANCE);
        let exact = total(&model, &ground, &turn(Dual::variables(ICR)));
        for variable in 0..3 {
            let at = |step: f64| {
                let mut z = ICR;
                z[variable] += step;
                total(&model, &ground, &turn(z))
            };
            let (ahead, behind) = (at(STEP), at(-STEP));
            for k in 0..3 {
                let quotient = (ahead[k] - behind[k]) / (2.0 * STEP);
                let error = (exact[k].gradient[variable] - quotient).abs();
                assert!(error < 1e-7 * weight, "{effect}: d{k}/d{variable} off by {error}");
            }
        }
    }
}

fn total<S: Scalar>(model: &Model, ground: &Ground, motion: &Motion<S>) -> [S; 3] {
    let balance = model.balance(ground, motion);
    let mut sum = balance.load;
    sum += balance.friction.left;
    sum += balance.friction.right;
    [sum.force_x, sum.force_y, sum.moment]
}

/// Everything that a model predicts of a turn: the wrench on the body over its weight, the drive
/// and the sensor, SI.
fn behaviour(effects: Effects) -> Vec<f64> {
    let vehicle = VehicleFile::auriga_alpha().vehicle;
    let weight = vehicle.mass * trackdyn_core::STANDARD_GRAVITY;
    let model = Model::new(vehicle, effects);
    let wrench = total(&model, &model.ground(&ACTING_CIRCUMSTANCE), &changing_turn());
    let [force_x, force_y, moment] = wrench.map(|component| component / weight);
    let drive = model.drive();
    let backward = drive.driven(PerSide::new(-1.0, -1.0), ACTING_CIRCUMSTANCE.time);
    let &Sensor { lever: [x, y], yaw, yaw_rate_bias, delay } = model.sensor();
    [
        [force_x, force_y, moment],
        [drive.gain.left, drive.gain.right, drive.slip_per_traction],
        [backward.left, backward.right, drive.time_constant.left],
        [drive.time_constant.right, x, y],
        [yaw, yaw_rate_bias, delay],
    ]
    .concat()
}

/// Largest change of the prediction by an effect with these values.
fn departure(card: &Card, value: impl Fn(&Parameter) -> f64) -> f64 {
    let settings: Vec<_> = card.parameters.iter().map(|p| (p.key, value(p))).collect();
    let effect = ActiveEffect::new(card.id, &settings).expect("values in range");
    let with = behaviour(Effects::from_iter([effect]));
    let changes = with.iter().zip(behaviour(Effects::none()));
    changes.map(|(with, without)| (with - without).abs()).fold(0.0, f64::max)
}

/// Neutral value of a size, clamped to its range; none for other parameters.
fn neutral(parameter: &Parameter) -> Option<f64> {
    let [low, high] = parameter.range;
    match parameter.role {
        Role::Size { neutral } => Some(neutral.clamp(low, high)),
        Role::Place { .. } | Role::Direction | Role::Time | Role::Shape => None,
    }
}

#[test]
fn an_effect_is_there_where_one_of_its_sizes_is_not_neutral_and_nowhere_else() {
    /// Largest change at neutral sizes, relative to typical ones. It is zero unless the neutral
    /// value is a limit outside the range, which starts at a two-hundredth of the typical size or
    /// less.
    const MAX_LEFT_SHARE: f64 = 0.01;
    for card in CATALOGUE {
        let least = MAX_LEFT_SHARE * departure(card, |parameter| parameter.typical);
        let others: [fn(&Parameter) -> f64; 3] = [|p| p.typical, |p| p.range[0], |p| p.range[1]];
        for other in others {
            let left = departure(card, |parameter| neutral(parameter).unwrap_or(other(parameter)));
            assert!(left <= least, "{}: neutral sizes leave {left}", card.id);
        }
        let sizes: Vec<_> = card.parameters.iter().filter(|p| neutral(p).is_some()).collect();
        // Of several sizes each causes a share.
        let least = least / trackdyn_core::real(sizes.len());
        for size in sizes {
            let alone = departure(card, |parameter| match neutral(parameter) {
                Some(neutral) if parameter.key != size.key => neutral,
                _ => parameter.typical,
            });
            assert!(alone > least, "{}: {} does {alone} alone", card.id, size.key);
        }
    }
}

#[test]
fn text_form_is_read_back() {
    for effect in all() {
        assert_eq!(effect.to_string().parse(), Ok(effect));
    }
}

#[test]
fn mistakes_name_what_would_have_been_right() {
    let message = |text: &str| text.parse::<ActiveEffect>().expect_err("a mistake").to_string();
    assert!(message("centripedal").contains("such as \"centripetal\""));
    assert!(message("load-transfer:cog_hight_m=0.3").contains("such as \"cog_height_m\""));
    assert!(message("load-transfer:cog_height_m=-1").contains("between 0 and 5 m"));
    assert!(message("load-transfer:cog_height_m=nan").contains("between 0 and 5 m"));
    assert!(message("load-transfer:cog_height_m").contains("the form"));
    assert!(message("slope:angle_deg=1,angle_deg=2").contains("each parameter once"));
}
