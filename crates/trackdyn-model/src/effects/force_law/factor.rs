//! Factor of a coefficient of the force law, and the symmetries that it breaks.

use crate::effect::{Pairing, Parameter, Symmetry, Term};
use crate::pipeline::Situation;
use trackdyn_core::{STANDARD_GRAVITY, Scalar};

/// A component of the wrench times a function of the situation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factor {
    pub component: Component,
    pub sign: Sign,
    pub argument: Argument,
}

/// A component of the wrench.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Component {
    /// F_x, to the right.
    Side,
    /// F_y, forward.
    Forward,
    /// M, counter-clockwise.
    Turn,
    /// A force along an axis of the world.
    World([u8; 2]),
    /// A force towards the origin of the world that grows with the distance.
    Spring,
}

/// A sign of the belt speeds, as a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sign {
    /// One.
    Any,
    /// Sign of V_l + V_r.
    Along,
    /// Sign of V_r − V_l.
    Turning,
    /// Product of both.
    Both,
}

/// A dimensionless function of motion, heading, place or time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Argument {
    /// One.
    One,
    /// v/√(g ℓ).
    Speed,
    /// v |v|/(g ℓ).
    SpeedSigned,
    /// v²/(g ℓ).
    SpeedSquared,
    /// ω √(ℓ/g).
    Rate,
    /// ω |ω| ℓ/g.
    RateSigned,
    /// ω² ℓ/g.
    RateSquared,
    /// v ω/g.
    Acceleration,
    /// cos nψ.
    Cos(u8),
    /// sin nψ.
    Sin(u8),
    /// Place along the world's x axis over ℓ.
    X,
    /// Place along the world's y axis over ℓ.
    Y,
    /// t/T.
    Time,
}

/// Scales that make quantities dimensionless.
pub(super) struct Scales {
    /// ℓ, m.
    pub length: f64,
    /// T, s.
    pub time: f64,
}

/// Motion, heading, place and time in dimensionless numbers.
pub(super) struct Arguments<S> {
    speed: S,
    rate: S,
    along: f64,
    turning: f64,
    heading: f64,
    place: [f64; 2],
    time: f64,
}

impl<S: Scalar> Arguments<S> {
    pub(super) fn of(situation: &Situation<S>, scales: &Scales) -> Self {
        let motion = situation.motion;
        let circumstance = &situation.ground.circumstance;
        let belts = motion.belt_speed.map(S::value);
        Self {
            // v/√(g ℓ)
            speed: motion.twist.v_y * (STANDARD_GRAVITY * scales.length).sqrt().recip(),
            // ω √(ℓ/g)
            rate: motion.twist.w * (scales.length / STANDARD_GRAVITY).sqrt(),
            along: sign(belts.left + belts.right),
            turning: sign(belts.right - belts.left),
            heading: circumstance.heading,
            place: circumstance.position.map(|x| x / scales.length),
            time: circumstance.time / scales.time,
        }
    }
}

fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

impl Factor {
    /// Value of the function.
    pub(super) fn value<S: Scalar>(&self, of: &Arguments<S>) -> S {
        let &Arguments { speed, rate, heading, .. } = of;
        let argument = match self.argument {
            Argument::One => S::from(1.0),
            Argument::Speed => speed,
            Argument::SpeedSigned => speed * speed.abs(),
            Argument::SpeedSquared => speed * speed,
            Argument::Rate => rate,
            Argument::RateSigned => rate * rate.abs(),
            Argument::RateSquared => rate * rate,
            // v ω/g = v/√(g ℓ) · ω √(ℓ/g)
            Argument::Acceleration => speed * rate,
            Argument::Cos(n) => S::from((f64::from(n) * heading).cos()),
            Argument::Sin(n) => S::from((f64::from(n) * heading).sin()),
            Argument::X => S::from(of.place[0]),
            Argument::Y => S::from(of.place[1]),
            Argument::Time => S::from(of.time),
        };
        argument
            * match self.sign {
                Sign::Any => 1.0,
                Sign::Along => of.along,
                Sign::Turning => of.turning,
                Sign::Both => of.along * of.turning,
            }
    }

    /// Whether the factor is odd under reversal, and under mirroring.
    ///
    /// Speeds and ω are odd under reversal; ω and the sense of turning are odd under mirroring.
    fn is_odd(&self) -> [bool; 2] {
        let sign = match self.sign {
            Sign::Any => [false, false],
            Sign::Along => [true, false],
            Sign::Turning => [true, true],
            Sign::Both => [false, true],
        };
        let argument = match self.argument {
            Argument::Speed | Argument::SpeedSigned => [true, false],
            Argument::Rate | Argument::RateSigned => [true, true],
            Argument::Acceleration => [false, true],
            _ => [false, false],
        };
        [sign[0] != argument[0], sign[1] != argument[1]]
    }

    /// Invariances of the ICRs that it breaks, ascending.
    ///
    /// Friction changes sign with the speeds and does not depend on their magnitude: reversal is
    /// kept if the force is odd, the speed scale if it is of degree zero. Mirroring changes the
    /// sign of lateral force and moment, not of forward force.
    fn breaks(&self) -> Vec<Symmetry> {
        let [reversed, mirrored] = self.is_odd();
        let in_world = matches!(self.component, Component::World(_) | Component::Spring);
        let is_speed = matches!(
            self.argument,
            Argument::Speed
                | Argument::SpeedSigned
                | Argument::SpeedSquared
                | Argument::Rate
                | Argument::RateSigned
                | Argument::RateSquared
                | Argument::Acceleration
        );
        let heads = matches!(self.argument, Argument::Cos(_) | Argument::Sin(_));
        let places = matches!(self.argument, Argument::X | Argument::Y);
        let broken = |symmetry: &Symmetry| match symmetry {
            Symmetry::SpeedScale => is_speed,
            Symmetry::Reversal => !reversed,
            Symmetry::Manoeuvre => is_speed || matches!(self.sign, Sign::Along | Sign::Both),
            Symmetry::Mirror => in_world || mirrored == (self.component == Component::Forward),
            Symmetry::Heading => heads || in_world,
            Symmetry::Place => places || self.component == Component::Spring,
            Symmetry::Time => self.argument == Argument::Time,
            Symmetry::Transient | Symmetry::Straight => false,
        };
        Symmetry::ALL.into_iter().filter(broken).collect()
    }

    /// The factor as text; sine and cosine are left to the pairing.
    fn words(&self) -> String {
        let sign = match self.sign {
            Sign::Any => "",
            Sign::Along => "sign(V_l + V_r)",
            Sign::Turning => "sign(V_r − V_l)",
            Sign::Both => "sign(V_l + V_r) sign(V_r − V_l)",
        };
        let argument = match self.argument {
            Argument::Speed => "v/√(g ℓ)",
            Argument::SpeedSigned => "v |v|/(g ℓ)",
            Argument::SpeedSquared => "v²/(g ℓ)",
            Argument::Rate => "ω √(ℓ/g)",
            Argument::RateSigned => "ω |ω| ℓ/g",
            Argument::RateSquared => "ω² ℓ/g",
            Argument::Acceleration => "v ω/g",
            Argument::Time => "t/T",
            _ => "",
        };
        [sign, argument].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
    }
}

/// Terms of all coefficients. Cosine and sine of a heading, and the axes of the world, form pairs.
pub(super) fn terms(factors: &[Factor], parameters: &'static [Parameter]) -> Vec<Term> {
    let mut terms = Vec::new();
    for (k, factor) in factors.iter().enumerate() {
        let (coefficients, pairing) = match (factor.component, factor.argument) {
            (_, Argument::Sin(_) | Argument::Y) | (Component::World([0, 1]), _) => continue,
            (_, Argument::Cos(n)) => (vec![k, k + 1], Pairing::Heading(n)),
            (_, Argument::X) | (Component::World(_), _) => (vec![k, k + 1], Pairing::World),
            (Component::Spring, _) => (vec![k, k - 2, k - 1], Pairing::Spring),
            _ => (vec![k], Pairing::Alone),
        };
        let component = match factor.component {
            Component::Side => "sideways force",
            Component::Forward => "forward force",
            Component::Turn => "moment",
            Component::World(_) => "force",
            Component::Spring => "pull",
        };
        let unit = match factor.component {
            Component::Turn => "of the weight times half the contact length",
            _ => "of the weight",
        };
        terms.push(Term {
            key: parameters[k].key,
            coefficients,
            breaks: factor.breaks(),
            component,
            unit,
            factor: factor.words(),
            pairing,
        });
    }
    terms
}
