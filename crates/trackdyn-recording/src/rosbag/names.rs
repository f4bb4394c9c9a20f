//! What the name of a joint says: its side, and whether it turns a wheel or a track.

use super::words::{LEFT, RIGHT, WHEEL, words};
use trackdyn_core::Side;

/// What a joint moves, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// A flipper, an arm, a camera or another part that carries no robot forward.
    Other,
    /// The name does not say.
    Unknown,
    /// A wheel, a track or its sprocket.
    Wheel,
}

/// Parts that may be named beside a wheel or a motor and make it one of their own.
const OTHER_PARTS: [&str; 58] = [
    "flipper",
    "flippers",
    "arm",
    "arms",
    "gripper",
    "grippers",
    "finger",
    "fingers",
    "hand",
    "wrist",
    "elbow",
    "shoulder",
    "manipulator",
    "sensor",
    "sensors",
    "mast",
    "pan",
    "tilt",
    "camera",
    "cam",
    "head",
    "neck",
    "lidar",
    "laser",
    "radar",
    "antenna",
    "steer",
    "steering",
    "steered",
    "caster",
    "castor",
    "casters",
    "castors",
    "swivel",
    "turret",
    "boom",
    "bucket",
    "blade",
    "stick",
    "brush",
    "fan",
    "propeller",
    "thruster",
    "door",
    "lid",
    "hatch",
    "light",
    "lamp",
    "display",
    "lift",
    "fork",
    "winch",
    "hook",
    "tool",
    "plow",
    "gimbal",
    "ptu",
    "valve",
];

/// Parts that wheels hang on: they do not turn with them, but a wheel may be named after its part.
const CARRIER: [&str; 18] = [
    "suspension",
    "susp",
    "shock",
    "spring",
    "damper",
    "rocker",
    "bogie",
    "bogey",
    "leg",
    "hip",
    "knee",
    "ankle",
    "foot",
    "swing",
    "knuckle",
    "upright",
    "fender",
    "bumper",
];

/// The side that a joint is on by its name; none where the name gives none, or both.
pub(super) fn side(name: &str) -> Option<Side> {
    let words = words(name);
    let only = |is: &dyn Fn(&str, Side) -> bool| {
        let [left, right] =
            [Side::Left, Side::Right].map(|side| words.iter().any(|word| is(word, side)));
        (left != right).then_some(if left { Side::Left } else { Side::Right })
    };
    let full = |word: &str, side: Side| word == side.name();
    let of_axle = |word: &str, side: Side| match side {
        Side::Left => LEFT.contains(&word),
        Side::Right => RIGHT.contains(&word),
    };
    let letter = |word: &str, side: Side| match side {
        Side::Left => word == "l" || word == "lhs",
        Side::Right => word == "r" || word == "rhs",
    };
    if let Some(side) = only(&full) {
        return Some(side);
    }
    if words.iter().any(|word| word == "left" || word == "right") {
        return None;
    }
    only(&of_axle).or_else(|| only(&letter)).or_else(|| {
        // r_l: rear left
        let letters: Vec<&str> =
            words.iter().map(String::as_str).filter(|word| word.len() == 1).collect();
        (letters == ["r", "l"]).then_some(Side::Left)
    })
}

/// What a joint moves by its name.
pub(super) fn part(name: &str) -> Part {
    let words = words(name);
    let has = |list: &[&str]| words.iter().any(|word| list.contains(&word.as_str()));
    if has(&OTHER_PARTS) {
        Part::Other
    } else if has(&WHEEL) {
        Part::Wheel
    } else if has(&CARRIER) {
        Part::Other
    } else {
        Part::Unknown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_are_told_by_whole_words() {
        for name in [
            "left_wheel",
            "wheel_left",
            "base/left",
            "frontLeftWheel",
            "FLWheel",
            "fl_wheel",
            "wheel_l",
            "LF",
            "rear-left-1",
            "left1",
            "LEFT",
            "lwheel",
            "frontleft_joint",
            "wheelrl",
            "r_l_wheel",
        ] {
            assert_eq!(side(name), Some(Side::Left), "{name}");
        }
        for name in ["right_wheel", "rr", "wheelFR", "BR_motor", "m2.right", "rightwheel", "r1"] {
            assert_eq!(side(name), Some(Side::Right), "{name}");
        }
        for name in [
            "camera_upright_joint",
            "bright",
            "leftover",
            "cleft",
            "lidar",
            "roller",
            "flipper",
            "left_right",
            "rear_wheel",
            "",
            "träck",
            "l_r",
        ] {
            assert_eq!(side(name), None, "{name}");
        }
    }

    #[test]
    fn parts_are_told_by_whole_words() {
        for (name, expected) in [
            ("left_track_joint", Part::Wheel),
            ("frontLeftWheel", Part::Wheel),
            ("leftwheel", Part::Wheel),
            ("rocker_left_wheel", Part::Wheel),
            ("rocker_left", Part::Other),
            ("left_flipper_track", Part::Other),
            ("front_left_steering_motor", Part::Other),
            ("left_caster_wheel", Part::Other),
            ("front_left", Part::Unknown),
            ("left_armor", Part::Unknown),
        ] {
            assert_eq!(part(name), expected, "{name}");
        }
    }
}
