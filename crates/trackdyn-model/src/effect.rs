//! What an effect is: a card, parameters, and hooks on the pipeline.
//!
//! An effect is physics that the base model leaves out. It is written once, in one file of
//! [`effects`](crate::effects), and serves the simulator and the diagnosis alike.

mod term;

pub use term::{Nature, Pairing, Term};

use crate::contact::ShearStress;
use crate::pipeline::{Drive, Ground, Sensor, Site, Situation};
use crate::vehicle::Vehicle;
use trackdyn_core::{PerSide, Scalar, Wrench};

/// A mechanism that the base model leaves out.
///
/// A hook adds to or multiplies what it is given and never assigns, so effects combine in any
/// order. A hook that an effect does not override does nothing. [`Card::stages`] names the hooks
/// that act; the conformance tests hold the two together.
pub trait Effect: Copy + Sized {
    /// Description and parameters.
    const CARD: Card;

    /// Whether it is a mechanism or a form.
    const NATURE: Nature = Nature::Mechanism;

    /// Whether it is a part of Newton's second law: all of them together are the law in full.
    const IS_INERTIA: bool = false;

    /// The terms of a form; none of a mechanism.
    fn terms() -> Vec<Term> {
        Vec::new()
    }

    /// The effect with its parameters in the order and the units of the card, each within its
    /// range.
    fn from_values(values: &[f64]) -> Self;

    /// Stage `body`: what the machine is.
    fn body(&self, _vehicle: &mut Vehicle) {}

    /// Stage `drive`: from the speeds that the encoders show to those of the belts.
    fn drive(&self, _drive: &mut Drive) {}

    /// Stage `ground`: friction under each side and gravity at this place, heading and time.
    fn ground(&self, _ground: &mut Ground) {}

    /// Stage `load`: centre of pressure of the whole machine, (x, y) in m.
    fn load<S: Scalar>(&self, _situation: &Situation<S>, _centre_of_pressure: &mut [S; 2]) {}

    /// Stage `shear`: factors on the shear stress, and stress beside it, at a point of the contact.
    fn shear<S: Scalar>(&self, _site: &Site<S>, _stress: &mut ShearStress<S>) {}

    /// Stage `wrench`: forces on the body beside friction and weight.
    fn wrench<S: Scalar>(
        &self,
        _situation: &Situation<S>,
        _normal_load: &PerSide<S>,
        _wrench: &mut Wrench<S>,
    ) {
    }

    /// Stage `sense`: what the pose sensor reports of the motion.
    fn sense(&self, _sensor: &mut Sensor) {}
}

/// What a reader of the catalogue sees of an effect.
#[derive(Debug, PartialEq)]
pub struct Card {
    /// Name in files and on the command line, kebab-case.
    pub id: &'static str,
    /// One line: what it is.
    pub title: &'static str,
    /// The law, in the letters of the parameters.
    pub law: &'static str,
    /// What is assumed, and where the law ends.
    pub assumes: &'static str,
    /// Where in a map or a recording it shows.
    pub shows: &'static str,
    /// Invariances of the ICR triple that it breaks.
    pub breaks: &'static [Symmetry],
    /// Pipeline stages at which it acts.
    pub stages: &'static [Stage],
    /// Parameters, in the order of [`Effect::from_values`].
    pub parameters: &'static [Parameter],
    /// Where the law comes from.
    pub sources: &'static [&'static str],
}

impl Card {
    /// Whether it changes the shear stress, which then needs a quadrature.
    pub fn shears(&self) -> bool {
        self.stages.contains(&Stage::Shear)
    }

    /// Whether it acts around a place of the world, over an extent that is its shape, and not on
    /// the robot wherever it is.
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
    /// What it is.
    pub meaning: &'static str,
    /// What it does in the law.
    pub role: Role,
    /// Smallest and largest value that is physical.
    pub range: [f64; 2],
    /// A size that a roboticist may meet; the default where none is given.
    pub typical: f64,
}

impl Parameter {
    /// Its unit as it stands behind a number; nothing for pure numbers.
    pub fn unit_behind(&self) -> String {
        if self.unit == "1" { String::new() } else { format!(" {}", self.unit) }
    }
}

/// What a parameter does in the law of its effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// How large the effect is. Where all its sizes are neutral there is no effect, whatever its
    /// other parameters are.
    Size {
        /// Value at which the law is that of the base model, in the parameter's unit. It may lie
        /// below the physical range: then the law approaches the base model towards that end of the
        /// range.
        neutral: f64,
    },
    /// A coordinate of a place in the world, m.
    Place {
        /// Axis of the world: 0 for x, 1 for y.
        axis: usize,
    },
    /// A direction in the world, counter-clockwise from its x axis.
    Direction,
    /// A constant of the law that says nothing where the sizes are neutral.
    Shape,
}

impl Role {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Size { .. } => "size",
            Self::Place { .. } => "place",
            Self::Direction => "direction",
            Self::Shape => "shape",
        }
    }
}

/// An invariance that the ICR triple (x_l, x_r, y), as encoders and pose sensor show it, has in the
/// base model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symmetry {
    /// S: all speeds scaled by one factor.
    SpeedScale,
    /// R: all speeds reversed.
    Reversal,
    /// P: same-sign arc, counter-rotation, spin.
    Manoeuvre,
    /// M: left and right exchanged (on a machine with its centre of gravity in the middle).
    Mirror,
    /// H: turned to another heading.
    Heading,
    /// X: moved to another place.
    Place,
    /// T: done at another time.
    Time,
    /// D: speeds that change against steady ones.
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
    /// What the machine is.
    Body,
    /// How fast the belts run when the encoders show a speed.
    Drive,
    /// What the ground is at this place, heading and time.
    Ground,
    /// How the weight spreads over the patches.
    Load,
    /// How much friction a point of the contact mobilises.
    Shear,
    /// What else acts on the body.
    Wrench,
    /// What the pose sensor reports.
    Sense,
}

impl Stage {
    /// The stages in the order in which the model walks them.
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
