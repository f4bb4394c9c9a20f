//! The trait of an effect: a card, parameters, and hooks on the pipeline.
//!
//! An effect is physics that the base model leaves out. It is written once, in one file of
//! [`effects`](crate::effects), for simulator and diagnosis alike.

mod term;

pub use term::{Nature, Pairing, Term};

use crate::contact::ShearStress;
use crate::pipeline::{Drive, Ground, RigidBody, Sensor, Site, Situation};
use crate::vehicle::Vehicle;
use trackdyn_core::{PerSide, Scalar, Wrench};

/// A mechanism that the base model leaves out.
///
/// A hook adds to or multiplies its argument and never assigns, so effects combine in any order.
/// The default of each hook does nothing. [`Card::stages`] names the hooks that act, which the
/// conformance tests check.
pub trait Effect: Copy + Sized {
    /// Description and parameters.
    const CARD: Card;

    /// Whether it is a mechanism or a form.
    const NATURE: Nature = Nature::Mechanism;

    /// Whether it is a term of Newton's second law; all of these together are the complete law.
    const IS_INERTIA: bool = false;

    /// Whether it is an error of instruments that few robots have: it is looked for where others
    /// are free from the start.
    const IS_RARE: bool = false;

    /// Terms of a form; empty for a mechanism.
    fn terms() -> Vec<Term> {
        Vec::new()
    }

    /// The effect with these parameter values, in the order and units of the card, within range.
    fn from_values(values: &[f64]) -> Self;

    /// Stage `body`: mass and geometry of the machine.
    fn body(&self, _vehicle: &mut Vehicle) {}

    /// Stage `drive`: from encoder speeds to belt speeds.
    fn drive(&self, _drive: &mut Drive) {}

    /// Stage `ground`: friction under each side and gravity at this place, heading and time.
    fn ground(&self, _ground: &mut Ground) {}

    /// Stage `load`: centre of pressure of the whole machine, (x, y) in m.
    fn load<S: Scalar>(&self, _situation: &Situation<S>, _centre_of_pressure: &mut [S; 2]) {}

    /// Stage `shear`: factors on the shear stress, and added stress, at a point of the contact.
    fn shear<S: Scalar>(&self, _site: &Site<S>, _stress: &mut ShearStress<S>) {}

    /// Stage `wrench`: forces on the body in addition to friction and weight.
    fn wrench<S: Scalar>(
        &self,
        _situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        _wrench: &mut Wrench<S>,
    ) {
    }

    /// Stage `sense`: what the pose sensor reports of the motion.
    fn sense(&self, _sensor: &mut Sensor) {}

    /// Beside the stages: what a simulator of rigid bodies is told, where the other hooks do not
    /// say it.
    fn rigid_body(&self, _body: &mut RigidBody) {}
}

/// Catalogue entry of an effect.
#[derive(Debug, PartialEq)]
pub struct Card {
    /// Name in files and on the command line, kebab-case.
    pub id: &'static str,
    /// Description in one line.
    pub title: &'static str,
    /// The law, with the letters of the parameters.
    pub law: &'static str,
    /// Assumptions, and limits of validity.
    pub assumes: &'static str,
    /// Where it shows in a map or a recording.
    pub shows: &'static str,
    /// What is not in the catalogue and acts alike; empty where nothing is known to.
    pub resembles: &'static str,
    /// Invariances of the ICR triple that it breaks.
    pub breaks: &'static [Symmetry],
    /// Pipeline stages at which it acts.
    pub stages: &'static [Stage],
    /// Parameters, in the order of [`Effect::from_values`].
    pub parameters: &'static [Parameter],
    /// Sources of the law.
    pub sources: &'static [&'static str],
}

impl Card {
    /// Whether it changes the shear stress, which then needs quadrature.
    pub fn shears(&self) -> bool {
        self.stages.contains(&Stage::Shear)
    }

    /// Whether it moves where the load presses.
    pub fn moves_load(&self) -> bool {
        self.stages.contains(&Stage::Load)
    }

    /// Whether it acts around a place in the world, over an extent that is its shape parameter.
    pub fn has_extent(&self) -> bool {
        let is_place = |one: &Parameter| matches!(one.role, Role::Place { .. });
        let is_shape = |one: &Parameter| one.role == Role::Shape;
        self.parameters.iter().any(is_place) && self.parameters.iter().any(is_shape)
    }
}

/// A parameter of an effect.
#[derive(Debug, PartialEq)]
pub struct Parameter {
    /// Name in files; ends in the unit where there is one.
    pub key: &'static str,
    /// Letter in the law.
    pub symbol: &'static str,
    /// Unit, `1` for pure numbers.
    pub unit: &'static str,
    /// Description.
    pub meaning: &'static str,
    /// Role in the law.
    pub role: Role,
    /// Smallest and largest physical value.
    pub range: [f64; 2],
    /// Typical value; the default.
    pub typical: f64,
}

impl Parameter {
    /// Unit as printed after a number; empty for pure numbers.
    pub fn unit_behind(&self) -> String {
        if self.unit == "1" { String::new() } else { format!(" {}", self.unit) }
    }
}

/// Role of a parameter in the law of its effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// Size of the effect. If all sizes are neutral there is no effect, whatever the other
    /// parameters are.
    Size {
        /// Value at which the law equals the base model, in the parameter's unit. It may lie
        /// outside the physical range: then the law approaches the base model towards that end.
        neutral: f64,
    },
    /// A coordinate of a place in the world, m.
    Place {
        /// Axis of the world: 0 for x, 1 for y.
        axis: usize,
    },
    /// A direction in the world, counter-clockwise from its x axis.
    Direction,
    /// A time since the start of the recording, s.
    Time,
    /// Another constant of the law, without influence where the sizes are neutral.
    Shape,
}

impl Role {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Size { .. } => "size",
            Self::Place { .. } => "place",
            Self::Direction => "direction",
            Self::Time => "time",
            Self::Shape => "shape",
        }
    }
}

/// An invariance of the ICRs (x_l, x_r, y), as encoders and pose sensor show them, in the base
/// model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symmetry {
    /// S: scaling all speeds by a common factor.
    SpeedScale,
    /// R: reversing all speeds.
    Reversal,
    /// P: changing between same-sign arc, counter-rotation and spin.
    Manoeuvre,
    /// M: exchanging left and right (for a centre of gravity in the middle).
    Mirror,
    /// H: turning to another heading.
    Heading,
    /// X: moving to another place.
    Place,
    /// T: driving at another time.
    Time,
    /// D: changing the speeds instead of holding them.
    Transient,
    /// 0: equal track speeds drive straight ahead, as fast as the encoders show.
    Straight,
}

impl Symmetry {
    /// All invariances, in the order in which tables list them.
    pub const ALL: [Self; 9] = [
        Self::SpeedScale,
        Self::Reversal,
        Self::Manoeuvre,
        Self::Mirror,
        Self::Heading,
        Self::Place,
        Self::Time,
        Self::Transient,
        Self::Straight,
    ];

    /// The letter that tables use.
    pub fn letter(self) -> char {
        match self {
            Self::SpeedScale => 'S',
            Self::Reversal => 'R',
            Self::Manoeuvre => 'P',
            Self::Mirror => 'M',
            Self::Heading => 'H',
            Self::Place => 'X',
            Self::Time => 'T',
            Self::Transient => 'D',
            Self::Straight => '0',
        }
    }
}

/// A stage of the pipeline from belt speeds to the balance of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Mass and geometry of the machine.
    Body,
    /// Belt speeds at given encoder speeds.
    Drive,
    /// Ground at a place, heading and time.
    Ground,
    /// Distribution of the weight over the patches.
    Load,
    /// Friction mobilised at a point of the contact.
    Shear,
    /// Other forces on the body.
    Wrench,
    /// Motion as reported by the pose sensor.
    Sense,
}

impl Stage {
    /// All stages, in the order of evaluation.
    pub const ALL: [Self; 7] =
        [Self::Body, Self::Drive, Self::Ground, Self::Load, Self::Shear, Self::Wrench, Self::Sense];

    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Body => "body",
            Self::Drive => "drive",
            Self::Ground => "ground",
            Self::Load => "load",
            Self::Shear => "shear",
            Self::Wrench => "wrench",
            Self::Sense => "sense",
        }
    }
}
