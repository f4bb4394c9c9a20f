//! A vehicle as simulators of rigid bodies have it.
//!
//! - [`aspect`]: in which ways an effect can stand in a simulator.
//! - [`points`]: contact of rollers with the ground, and how a robot turns on it.
//! - [`notes`]: what a file says of the effects, and what it cannot say.
//!
//! Axes are those of REP-103: x forward, y left, z up. The origin lies on the ground, at the centre
//! of the contact area.

pub mod aspect;
pub mod notes;
pub mod points;

pub use aspect::Aspect;
pub use points::{ContactPoint, Roller};

use crate::{EquivalentDrive, Error};
use trackdyn_core::PerSide;
use trackdyn_core::frames::ros_from_paper;
use trackdyn_model::contact::Friction;
use trackdyn_model::effect::Symmetry;
use trackdyn_model::{
    ActiveEffect, Circumstance, Effects, Icrs, Model, RigidBody, Stationary, Status, VehicleFile,
};

/// Track speeds of the turn that tells the ICRs, m/s. Without effects of speed any turn does.
const TURN: PerSide<f64> = PerSide::new(-0.5, 0.5);

/// A robot for simulators of rigid bodies.
#[derive(Clone, Debug)]
pub struct Robot {
    /// Name of letters, digits and `_`, with a letter first.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of gravity, m.
    pub cog: [f64; 3],
    /// Moments of inertia about the axes through the centre of gravity, kg m².
    pub inertia: [f64; 3],
    /// Distance between the centre-lines of the sides, m.
    pub gauge: f64,
    /// Width of a belt or tyre, m.
    pub width: f64,
    /// Rear and front end of the contact of each patch, m; alike on both sides.
    pub patches: Vec<[f64; 2]>,
    /// Friction under each side, with which a body of this mass moves as the model does.
    pub friction: PerSide<Friction>,
    /// Gravity, m/s², in a world whose ground is the plane z = 0.
    pub gravity: [f64; 3],
    /// ICRs of the tracks in the paper's frame, m, by the effects that are constants.
    pub icrs: Icrs,
    /// What else a rigid body has.
    pub body: RigidBody,
    /// The model with all effects.
    pub model: Model,
}

impl Robot {
    /// The robot of a vehicle with effects.
    ///
    /// # Errors
    /// [`Error::DoesNotTurn`].
    pub fn of(file: &VehicleFile) -> Result<Self, Error> {
        let model = file.model();
        let body = model.rigid_body();
        let constants = with_effects(file, |effect| breaks_only(effect, &[Symmetry::Mirror]));
        let solution = Stationary::new(&constants, &Circumstance::default()).solve(TURN);
        // An effect may have moved the centre of gravity off the contact.
        let turns = solution.status == Status::Turning && model.vehicle().check().is_ok();
        let icrs = solution.icrs.filter(|icrs| turns && icrs.x_right > icrs.x_left);
        let icrs = icrs.ok_or_else(|| Error::DoesNotTurn { vehicle: file.vehicle.name.clone() })?;

        let vehicle = model.vehicle();
        let [x, y] = ros_from_paper(vehicle.cog);
        let patches: Vec<[f64; 2]> = model.patches().left.iter().map(|patch| patch.y).collect();
        // Ground that is the same at all places and times; a slope turns gravity instead.
        let is_everywhere =
            |effect: &ActiveEffect| !breaks_any(effect, &[Symmetry::Place, Symmetry::Time]);
        let ground = with_effects(file, is_everywhere).ground(&Circumstance::default());
        let [forward, left] = ros_from_paper(ground.gravity_along);
        let factor = body.friction_factor();
        let mut robot = Self {
            name: identifier(&vehicle.name),
            mass: vehicle.mass,
            cog: [x, y, body.cog_height],
            inertia: [0.0; 3],
            gauge: vehicle.gauge,
            width: model.patches().left[0].width(),
            patches,
            friction: ground.friction.map(|friction| Friction {
                across: friction.across * factor,
                along: friction.along * factor,
            }),
            gravity: [forward, left, -ground.gravity_normal],
            icrs,
            body,
            model,
        };
        robot.inertia = robot.box_inertia();
        Ok(robot)
    }

    /// Length, width and height of the hull, m. The height is not known: half the gauge.
    pub fn hull(&self) -> [f64; 3] {
        let [rear, front] = self.ends();
        [front - rear, self.gauge + self.width, self.gauge / 2.0]
    }

    /// Rear and front end of the contact, m.
    pub fn ends(&self) -> [f64; 2] {
        self.model.footprint().ends
    }

    /// Inertia of an even box of the hull's size, scaled to the known radius of gyration.
    fn box_inertia(&self) -> [f64; 3] {
        let [length, width, height] = self.hull().map(|side| side * side);
        let even = [width + height, length + height, length + width].map(|sum| sum / 12.0);
        // I = m r² about the vertical
        let scale = self.body.gyration.filter(|r| *r > 0.0).map_or(1.0, |r| r * r / even[2]);
        even.map(|gyration_squared| self.mass * scale * gyration_squared)
    }

    /// Steering efficiency χ of these ICRs, eq. (12).
    pub fn steering_efficiency(&self) -> f64 {
        self.gauge / (self.icrs.x_right - self.icrs.x_left)
    }

    /// The ideal differential drive that it is, seen midway between the ICRs.
    pub fn drive(&self) -> EquivalentDrive {
        let Icrs { x_left, x_right, y } = self.icrs;
        EquivalentDrive {
            gauge: self.gauge,
            separation: x_right - x_left,
            alpha: self.model.drive().gain,
            point: ros_from_paper([f64::midpoint(x_left, x_right), y]),
            is_separation_alone: false,
            is_doubtful: false,
            sectors: 0,
        }
    }

    /// The body that is left of the robot without these parts: mass, centre of gravity, inertia.
    /// Parts have a place and a mass; their own inertia is theirs.
    ///
    /// # Law
    /// Sums of mass, of first and of second moments are those of the robot (Steiner).
    pub fn chassis(&self, parts: &[([f64; 3], f64)]) -> (f64, [f64; 3], [f64; 3]) {
        let mass = self.mass - parts.iter().map(|(_, mass)| mass).sum::<f64>();
        let place: [f64; 3] = std::array::from_fn(|axis| {
            let moments: f64 = parts.iter().map(|(place, mass)| mass * place[axis]).sum();
            (self.mass * self.cog[axis] - moments) / mass
        });
        let inertia = std::array::from_fn(|axis| {
            let others = [(axis + 1) % 3, (axis + 2) % 3];
            let square = |from: [f64; 3]| -> f64 {
                others.iter().map(|&other| (from[other] - self.cog[other]).powi(2)).sum()
            };
            let of_parts: f64 = parts.iter().map(|(from, part)| part * square(*from)).sum();
            let left = self.inertia[axis] - of_parts - mass * square(place);
            // Parts of a hundredth of the mass at the rim leave most of it, unless the radius of
            // gyration is far below the size of the robot.
            left.max(self.inertia[axis] / 10.0)
        });
        (mass, place, possible(inertia))
    }
}

/// Moments of inertia of which none exceeds the sum of the others, as of any body: the others are
/// raised where one does.
fn possible(mut inertia: [f64; 3]) -> [f64; 3] {
    for axis in 0..3 {
        let others = [(axis + 1) % 3, (axis + 2) % 3];
        let missing = inertia[axis] - others.iter().map(|&other| inertia[other]).sum::<f64>();
        for other in others {
            inertia[other] += missing.max(0.0) / 2.0;
        }
    }
    inertia
}

/// The model with the effects of a vehicle that are wanted.
fn with_effects(file: &VehicleFile, is_wanted: impl Fn(&ActiveEffect) -> bool) -> Model {
    let effects: Effects = file.effects.iter().filter(|one| is_wanted(one)).cloned().collect();
    Model::new(file.vehicle.clone(), effects)
}

/// Whether an effect breaks one of these symmetries.
pub(crate) fn breaks_any(effect: &ActiveEffect, any: &[Symmetry]) -> bool {
    effect.card().breaks.iter().any(|symmetry| any.contains(symmetry))
}

/// Whether an effect breaks none but these symmetries.
pub(crate) fn breaks_only(effect: &ActiveEffect, these: &[Symmetry]) -> bool {
    effect.card().breaks.iter().all(|symmetry| these.contains(symmetry))
}

/// A name that every one of the languages takes for a word.
fn identifier(name: &str) -> String {
    let word: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if word.starts_with(|c: char| c.is_ascii_alphabetic()) { word } else { format!("robot_{word}") }
}
