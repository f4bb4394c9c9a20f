//! What else of the catalogue could have left a signature: effects at typical sizes, with a few choices
//! of the places and speeds that their size does not say.

use crate::dose::{Dose, Scene};
use crate::plan::ISOLABLE;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::FRAC_PI_2;
use trackdyn_core::Pose;

/// Distance of an anchor that is out of sight, m.
const FAR: f64 = 500.0;
/// Distance of an anchor nearby, m.
const NEAR: f64 = 5.0;
/// Strengths of friction that creeps: its law is anything but linear in them.
const CREEPS: [f64; 4] = [0.3, 1.0, 3.0, 10.0];
/// Places of a patch that are tried.
const PATCHES: usize = 2;
/// Radius of a patch, m.
const PATCH: f64 = 1.5;

/// Effects that stand for one hypothesis; what is spanned by their signatures cannot be told from it.
pub(crate) struct Alternative {
    /// Id of the mechanism.
    pub(crate) id: &'static str,
    /// Doses with their strengths.
    pub(crate) members: Vec<(Dose, f64)>,
}

/// All alternatives but those of these ids.
pub(crate) fn alternatives(
    excluded: &[&str],
    scene: Scene,
    random: &mut ChaCha8Rng,
) -> Vec<Alternative> {
    let ids = ISOLABLE.into_iter().chain(["drivetrain-lag"]);
    let mut all = Vec::new();
    for id in ids.filter(|id| !excluded.contains(id)) {
        for members in choices(id, scene, random) {
            all.push(Alternative { id, members });
        }
    }
    all
}

fn choices(id: &'static str, scene: Scene, random: &mut ChaCha8Rng) -> Vec<Vec<(Dose, f64)>> {
    let usual = Dose::draw(id, scene, random);
    let with = |key, values: &[f64]| {
        values.iter().map(|value| vec![(usual.clone().with(key, *value), 1.0)]).collect()
    };
    let weight = scene.machine.weight();
    let anchored = |distance: f64, quarter: f64| {
        let (sin, cos) = (quarter * FRAC_PI_2).sin_cos();
        Dose::tether(weight, [distance * cos, distance * sin])
    };
    match id {
        "stribeck-friction" => with("speed_m_per_s", &[0.03, 0.06, 0.12, 0.25, 0.5]),
        "friction-creep" => CREEPS.map(|strength| vec![(usual.clone(), strength)]).to_vec(),
        "hitch-drag" => {
            let length = scene.machine.length();
            with("distance_m", &[0.5 * length, 1.5 * length])
        }
        // both directions of the world span all of them
        "slope" => vec![of_all_sizes([Dose::slope(0.0), Dose::slope(90.0)])],
        "tether" => {
            let near = [0.5, 1.5, 2.5, 3.5].map(|quarter| vec![(anchored(NEAR, quarter), 1.0)]);
            let far = of_all_sizes([0.0, 1.0].map(|quarter| anchored(FAR, quarter)));
            near.into_iter().chain([far]).collect()
        }
        "terrain-patch" => (0..PATCHES)
            .map(|_| {
                let count = scene.visited.len().max(1);
                let place = scene.visited.get(random.random_range(0..count)).copied();
                vec![(Dose::patch(place.unwrap_or_default(), PATCH, 1.3), 1.0)]
            })
            .collect(),
        _ => vec![vec![(usual, 1.0)]],
    }
}

/// Two strengths of each: what goes with the size, and with its square.
fn of_all_sizes(doses: [Dose; 2]) -> Vec<(Dose, f64)> {
    doses.into_iter().flat_map(|dose| [(dose.clone(), 0.5), (dose, 1.5)]).collect()
}

/// The places of poses, m.
pub(crate) fn places<'a>(poses: impl Iterator<Item = &'a Pose>) -> Vec<[f64; 2]> {
    poses.map(|pose| [pose.x, pose.y]).collect()
}
