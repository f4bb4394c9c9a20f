//! What an export cannot be made from.

/// An option that an export cannot be made with.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A radius that no drive has.
    #[error("wheel-radius = {value}: expected a radius of 1e-6 to 1e4 m")]
    WheelRadius {
        /// The radius, m.
        value: f64,
    },
    /// The two sides must pair up.
    #[error("right-joint: {right} names, left-joint: {left} names: expected as many right as left")]
    WheelCount {
        /// Names on the left.
        left: usize,
        /// Names on the right.
        right: usize,
    },
    /// A part that would be driven from both sides, or twice from one.
    #[error("{option} {name}: stands there twice, on one side or on both: expected each once")]
    Repeated {
        /// The option.
        option: &'static str,
        /// The name.
        name: String,
    },
    /// A name that no node of ROS has.
    #[error("{value}: expected letters, digits and _, with a letter or _ first: it names a node")]
    NodeName {
        /// The name.
        value: String,
    },
    /// A rate at which nothing is published.
    #[error("publish-rate = {value}: expected a positive number of Hz")]
    PublishRate {
        /// The rate, Hz.
        value: f64,
    },
    /// A replay with other parameters.
    #[error(
        "residuals = {residuals}: no set is of a kinematics file with the fingerprint \
         {fingerprint}: expected what `trackdyn odometry --kinematics` wrote with that file"
    )]
    NoResiduals {
        /// Path of the odometry file.
        residuals: String,
        /// Fingerprint of the kinematics file.
        fingerprint: String,
    },
    /// A vehicle whose forces do not let it turn.
    #[error(
        "vehicle {vehicle}: by its forces it does not turn in place, or tips over: expected one \
         that turns (see `trackdyn map --vehicle`)"
    )]
    DoesNotTurn {
        /// Name of the vehicle.
        vehicle: String,
    },
    /// Nothing that a viewer could show.
    #[error("no poses: expected a path of one or more")]
    NoPoses,
    /// A time that messages of ROS 2 cannot hold.
    #[error(
        "stamp {stamp} ns: expected Unix time before the year 2038, with which stamps of ROS 2 end"
    )]
    LateStamp {
        /// The stamp, ns.
        stamp: u64,
    },
    /// A place that is no part of a robot.
    #[error("contact-centre = {x},{y}: expected at most 1e4 m in size")]
    ContactCentre {
        /// Forward of the base frame, m.
        x: f64,
        /// Left of it, m.
        y: f64,
    },
    /// Two frames of a chain are one.
    #[error("{first} = {name}, {second} = {name}: expected two different frames")]
    SameFrame {
        /// Option of the one.
        first: &'static str,
        /// Option of the other.
        second: &'static str,
        /// Their name.
        name: String,
    },
    /// A name that would need quoting in one of the languages.
    #[error(
        "\"{value}\": expected a name of letters, digits, _, -, . and /, that begins with a letter \
         or _"
    )]
    Name {
        /// The name.
        value: String,
    },
}
