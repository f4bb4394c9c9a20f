//! Which signal of the joints tells the speeds: a velocity or a position.

use super::joint::Joint;
use crate::recording::Warning;
use crate::rosbag::options::JointSignal;

/// A signal of the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Signal {
    /// Position, rad.
    Position,
    /// Velocity, rad/s.
    Velocity,
}

impl Signal {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
        }
    }

    fn other(self) -> Self {
        match self {
            Self::Position => Self::Velocity,
            Self::Velocity => Self::Position,
        }
    }
}

/// What a joint has of a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// No number in most messages.
    Absent,
    /// A number that never changes, for a velocity 0.
    Still,
    /// It moves.
    Moves,
}

/// The signal to take: velocities where all joints that move have them, else positions.
///
/// # Errors
/// Why neither can be taken.
pub(super) fn choose(
    joints: &[Joint],
    wanted: JointSignal,
    warnings: &mut Vec<Warning>,
) -> Result<Signal, String> {
    let first = if wanted == JointSignal::Position { Signal::Position } else { Signal::Velocity };
    let Some(problem) = problem(joints, first) else { return Ok(first) };
    let other = first.other();
    let is_other = self::problem(joints, other).is_none();
    match wanted {
        JointSignal::Any if is_other => {
            let has_any = joints.iter().any(|joint| state(joint, first) != State::Absent);
            if has_any {
                let (what, name) = ("joint signal", other.name());
                warnings.push(Warning::Chosen { what, taken: format!("the {name}: {problem}") });
            }
            Ok(other)
        }
        _ if is_other => Err(format!(
            "the joints have no such signal: {problem}; take the {0} by --joint-signal {0}",
            other.name()
        )),
        _ => {
            let other = self::problem(joints, other).unwrap_or_default();
            Err(format!("the joints have no such signal: {problem}, and {other}"))
        }
    }
}

/// Why a signal cannot be taken; none where it can.
fn problem(joints: &[Joint], signal: Signal) -> Option<String> {
    let name = signal.name();
    let of = |joint: &Joint| (state(joint, signal), state(joint, signal.other()));
    let which = |problem: &dyn Fn(State, State) -> bool| {
        let mut which = joints.iter().filter(|joint| {
            let (this, other) = of(joint);
            problem(this, other)
        });
        which.next().map(|joint| joint.name.as_str())
    };
    if let Some(joint) = which(&|this, _| this == State::Absent) {
        return Some(format!("the {name} of {joint} is missing in most messages"));
    }
    let joint = which(&|this, other| this == State::Still && other == State::Moves)?;
    let other = signal.other().name();
    let still = match signal {
        Signal::Position => "never changes",
        Signal::Velocity => "is always 0",
    };
    Some(format!("the {name} of {joint} {still} while its {other} moves"))
}

/// Whether most messages have neither signal of a joint.
pub(super) fn is_silent(joint: &Joint) -> bool {
    [Signal::Position, Signal::Velocity].iter().all(|signal| state(joint, *signal) == State::Absent)
}

fn state(joint: &Joint, signal: Signal) -> State {
    let values =
        || joint.signals.iter().map(|one| one.value[usize::from(signal == Signal::Velocity)]);
    let mut finite = values().filter(|value| value.is_finite());
    if 2 * finite.clone().count() <= values().count() {
        return State::Absent;
    }
    let first = match signal {
        Signal::Position => finite.next(),
        Signal::Velocity => Some(0.0),
    };
    if finite.any(|value| Some(value) != first) { State::Moves } else { State::Still }
}
