//! Models, vehicles and drives that several test suites share.

pub mod cdr;
pub mod concealed;
pub mod ros2msg;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use trackdyn_core::document::Document;
use trackdyn_core::real;
use trackdyn_model::contact::Friction;
use trackdyn_model::{Effects, Model, RunningGear, Uncertainty, Vehicle, VehicleFile};
use trackdyn_recording::Recording;
use trackdyn_recording::rosbag::RosbagOptions;

/// Auriga-alpha with this centre of gravity and these effects (`id:key=value`).
///
/// # Panics
/// Where an effect is not of the catalogue.
pub fn auriga(cog: [f64; 2], effects: &[&str]) -> Model {
    let vehicle = Vehicle { cog, ..VehicleFile::auriga_alpha().vehicle };
    vehicle.check().expect("a vehicle that stands");
    Model::new(vehicle, parse_effects(effects))
}

/// The effects of these texts.
///
/// # Panics
/// Where an effect is not of the catalogue.
pub fn parse_effects(effects: &[&str]) -> Effects {
    effects.iter().map(|text| text.parse().expect("an effect of the catalogue")).collect()
}

/// A uniform number between two bounds.
pub fn uniform(random: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.random::<f64>()
}

/// A vehicle of any proportion: μ_x/μ_y from 0.2 to 5, contact from e⁻² to e² gauges long, tracks
/// or two to four axles, the centre of gravity anywhere up to `support` of the tipping limit.
pub fn random_vehicle(random: &mut ChaCha8Rng, support: f64) -> Vehicle {
    let mu_y = uniform(random, 0.1, 1.5);
    let ratio = uniform(random, 0.2_f64.ln(), 5.0_f64.ln()).exp();
    let gauge = uniform(random, -1.5, 1.5).exp();
    let length = gauge * uniform(random, -2.0, 2.0).exp();
    let width = gauge * uniform(random, 0.02, 1.0);
    let running_gear = if random.random::<f64>() < 0.7 {
        RunningGear::Track { contact_length: length, belt_width: width }
    } else {
        let axles: u32 = random.random_range(2..=4);
        let pitch = length / f64::from(axles);
        RunningGear::Wheels {
            contact_length: pitch * uniform(random, 0.1, 0.9),
            width,
            axles: (0..axles)
                .map(|k| pitch * (f64::from(k) - f64::from(axles - 1) / 2.0))
                .collect(),
        }
    };
    let mut vehicle = Vehicle {
        name: "random".to_owned(),
        mass: uniform(random, 1.0, 1000.0),
        gauge,
        cog: [0.0, 0.0],
        running_gear,
        friction: Friction { across: mu_y * ratio, along: mu_y },
        uncertainty: Uncertainty::default(),
    };
    let [rear, front] = Model::new(vehicle.clone(), Effects::none()).footprint().support();
    vehicle.cog =
        [uniform(random, -0.5, 0.5) * gauge * support, uniform(random, rear, front) * support];
    vehicle
}

/// A public recording of a real robot, which the project does not carry: `TRACKDYN_DATA` names
/// their folder, else it is `../shared/data` beside the checkout. None, and a note, where it is not
/// at hand.
///
/// # Panics
/// Where the recording cannot be read, or the folder that `TRACKDYN_DATA` names does not have it.
pub fn real_recording(name: &str) -> Option<Recording> {
    let named = std::env::var_os("TRACKDYN_DATA").map(PathBuf::from);
    let is_named = named.is_some();
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = named.unwrap_or_else(beside).join(name);
    assert!(folder.is_dir() || !is_named, "TRACKDYN_DATA: {} is not there", folder.display());
    if !folder.is_dir() {
        println!("skipped: {name} is not there (TRACKDYN_DATA names the folder of recordings)");
        return None;
    }
    Some(trackdyn_recording::read(&folder, &RosbagOptions::default()).expect(name))
}

/// A vehicle file of `configs/vehicles`.
///
/// # Panics
/// Where there is none, or it is none.
pub fn vehicle(name: &str) -> VehicleFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../configs/vehicles");
    let document = Document::read(&folder.join(name).with_extension("toml")).expect(name);
    VehicleFile::from_document(&document).expect(name)
}

/// Pieces of a whole circle: its polyline lies within R (1 − cos(π/720)), 0.01 mm for 1 m.
const CIRCLE_PIECES: usize = 720;

/// A circular path from the origin along x, to the left (or right), driven `laps` times, m.
///
/// # Panics
/// Where the radius makes no path.
pub fn circle(radius: f64, to_the_left: bool, laps: usize) -> trackdyn_drive::Path {
    let side = if to_the_left { 1.0 } else { -1.0 };
    let point = |k: usize| {
        let (sin, cos) = (real(k) / real(CIRCLE_PIECES) * TAU).sin_cos();
        [radius * sin, side * radius * (1.0 - cos)]
    };
    trackdyn_drive::Path::new((0..=laps * CIRCLE_PIECES).map(point).collect()).expect("a circle")
}
