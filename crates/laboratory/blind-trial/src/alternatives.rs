//! What else of the catalogue could have left a signature: effects at typical sizes, with a few
//! choices of the places, directions and shapes that their size does not say.

use crate::dose::{Dose, Scene, concealment, polar};
use crate::forms::Forms;
use crate::plan::{close, isolable};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::FRAC_PI_2;
use trackdyn_core::Pose;
use trackdyn_second_simulator::Sheet;
use trackdyn_second_simulator::sheet::{Anchor, Role};

/// Distance of an anchor from where its pull has the same direction everywhere, m.
const DISTANT_ANCHOR: f64 = 500.0;
/// Distance of an anchor that the robot drives around, m.
const NEAR_ANCHOR: f64 = 5.0;
/// Places on the path that are tried.
const PLACES_ON_PATH: usize = 2;

/// Effects that stand for one hypothesis; what is spanned by their signatures cannot be told from
/// it.
pub(crate) struct Alternative {
    /// The mechanism.
    pub(crate) sheet: &'static Sheet,
    /// Doses with their strengths.
    pub(crate) members: Vec<(Dose, f64)>,
}

/// All alternatives but those of these ids. Where forms are drawn, each is tried in the plain one
/// and in another one.
pub(crate) fn alternatives(
    excluded: &[&str],
    forms: Forms,
    scene: Scene,
    random: &mut ChaCha8Rng,
) -> Vec<Alternative> {
    let confusable = close().filter(|sheet| !isolable().any(|other| other.id == sheet.id));
    let sheets = isolable().chain(confusable).filter(|sheet| !excluded.contains(&sheet.id));
    let all = sheets.flat_map(|sheet| {
        let mut choices = choices(sheet, scene, random);
        if !forms.is_plain() && sheet.family.is_some() {
            let others = choices.clone().into_iter().map(|members| {
                let form = forms.draw(sheet, random);
                let of_form = |(dose, strength): (Dose, f64)| (dose.of_form(form), strength);
                members.into_iter().map(of_form).collect()
            });
            choices.extend(others.collect::<Vec<_>>());
        }
        choices.into_iter().map(move |members| Alternative { sheet, members })
    });
    all.collect()
}

fn choices(sheet: &'static Sheet, scene: Scene, random: &mut ChaCha8Rng) -> Vec<Vec<(Dose, f64)>> {
    let shapes = shapes(Dose::draw(sheet, scene, random), scene);
    let strengths = concealment(sheet).map_or(&[1.0][..], |law| law.compared_at);
    shapes.into_iter().flat_map(|dose| placed(&dose, strengths, scene, random)).collect()
}

/// A dose at all values of its shapes that are compared.
fn shapes(usual: Dose, scene: Scene) -> Vec<Dose> {
    let mut doses = vec![usual];
    for parameter in doses[0].sheet().parameters {
        if let Role::Shape { compared_at: values @ [_, ..], .. } = parameter.draw.role {
            let with =
                |dose: &Dose, value: f64| dose.clone().with(parameter.key, scene.machine, value);
            doses = doses
                .iter()
                .flat_map(|dose| values.iter().map(move |value| with(dose, *value)))
                .collect();
        }
    }
    doses
}

/// A dose in the directions and at the places that are compared.
fn placed(
    dose: &Dose,
    strengths: &[f64],
    scene: Scene,
    random: &mut ChaCha8Rng,
) -> Vec<Vec<(Dose, f64)>> {
    let roles = || dose.sheet().parameters.iter().map(|parameter| parameter.draw.role);
    if roles().any(|role| role == Role::Direction) {
        // two directions of the world span all of them
        return vec![of_all_sizes([0.0, 90.0].map(|degrees| dose.clone().towards(degrees)))];
    }
    let anchor = roles().find_map(|role| match role {
        Role::Place { anchor, .. } => Some(anchor),
        _ => None,
    });
    let anchored =
        |distance: f64, quarter: f64| dose.clone().at_place(polar(distance, quarter * FRAC_PI_2));
    match anchor {
        None => strengths.iter().map(|strength| vec![(dose.clone(), *strength)]).collect(),
        Some(Anchor::Around(_)) => {
            let quarters = [0.5, 1.5, 2.5, 3.5];
            let near = quarters.map(|quarter| vec![(anchored(NEAR_ANCHOR, quarter), 1.0)]);
            let far = of_all_sizes([0.0, 1.0].map(|quarter| anchored(DISTANT_ANCHOR, quarter)));
            near.into_iter().chain([far]).collect()
        }
        Some(Anchor::OnPath) => (0..PLACES_ON_PATH)
            .map(|_| vec![(dose.clone().at_place(scene.visited(random)), 1.0)])
            .collect(),
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
