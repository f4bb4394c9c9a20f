//! What the pose sensor makes of the motion: its clock and its mount.

use crate::observations::Piece;
use crate::parameters::{COUNT, Parameters};
use crate::prediction::{Prediction, body_velocity, predict};
use std::fmt;
use std::str::FromStr;
use trackdyn_core::named::by_name;

/// A property of the pose sensor that is fitted beside the kinematic parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Nuisance {
    /// Clock offset τ of the poses against the encoders, s.
    TimeOffset,
    /// Yaw ψ of the sensor on the body, rad.
    SensorYaw,
    /// Place of the sensor on the body, m: never shown by poses and track speeds.
    LeverArm,
}

impl Nuisance {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::TimeOffset, Self::SensorYaw, Self::LeverArm];

    /// Name in options and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::TimeOffset => "time-offset",
            Self::SensorYaw => "sensor-yaw",
            Self::LeverArm => "lever-arm",
        }
    }

    /// Symbol in tables.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::TimeOffset => "tau",
            Self::SensorYaw => "psi",
            Self::LeverArm => "d",
        }
    }

    /// Unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::TimeOffset => "s",
            Self::SensorYaw => "rad",
            Self::LeverArm => "m",
        }
    }

    /// Standard deviation from which on the value is of no use: 50 ms, an interval of readings at
    /// 20 Hz; two degrees, 35 mm aside per metre.
    pub fn limit(self) -> f64 {
        match self {
            Self::TimeOffset => 0.05,
            Self::SensorYaw => 2.0_f64.to_radians(),
            Self::LeverArm => 0.0,
        }
    }
}

impl fmt::Display for Nuisance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Nuisance {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        by_name(&Self::ALL, Self::name, text)
    }
}

/// Clock and mount of the pose sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// τ, s: positive where poses are late ([`trackdyn_recording::hold`]).
    pub tau: f64,
    /// ψ, rad: heading of the sensor on the body, counter-clockwise positive.
    pub yaw: f64,
}

impl Sensor {
    /// The value of a nuisance; 0 for the lever arm, which no fit has.
    pub fn value(&self, nuisance: Nuisance) -> f64 {
        match nuisance {
            Nuisance::TimeOffset => self.tau,
            Nuisance::SensorYaw => self.yaw,
            Nuisance::LeverArm => 0.0,
        }
    }

    /// The sensor with a nuisance changed by a step.
    pub(crate) fn stepped(mut self, nuisance: Nuisance, step: f64) -> Self {
        match nuisance {
            Nuisance::TimeOffset => self.tau += step,
            Nuisance::SensorYaw => self.yaw += step,
            Nuisance::LeverArm => {}
        }
        self
    }
}

/// Motion over a segment as the sensor reports it: forward (m), left (m), yaw (rad); and its
/// derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Forward, left, yaw.
    pub motion: [f64; 3],
    /// Derivatives by each kinematic parameter.
    pub by_parameter: [[f64; 3]; COUNT],
    /// Derivative by τ, per s.
    pub by_tau: [f64; 3],
    /// Derivative by ψ, per rad.
    pub by_yaw: [f64; 3],
}

/// What a sensor reports of the motion of these pieces, which are cut at its τ.
///
/// # Law
/// ψ turns the translation of the motion by −ψ. A change ε of τ moves the segment over the track
/// speeds: to first order it gains ε times the twist ξ_a at its beginning and loses ε times the
/// twist ξ_b at its end, M → exp(ε ξ_a) M exp(−ε ξ_b).
pub fn report(parameters: &Parameters, sensor: &Sensor, pieces: &[Piece]) -> Report {
    Report::of(&predict(parameters, pieces), parameters, sensor, pieces)
}

impl Report {
    /// What a sensor reports of a motion that is predicted already, from the same parameters and
    /// pieces.
    pub(crate) fn of(
        prediction: &Prediction,
        parameters: &Parameters,
        sensor: &Sensor,
        pieces: &[Piece],
    ) -> Self {
        let [forward, left, yaw] = prediction.motion;
        let ends = [pieces.first(), pieces.last()];
        let [[ahead_a, aside_a, w_a], [ahead_b, aside_b, w_b]] =
            ends.map(|piece| piece.map_or([0.0; 3], |piece| body_velocity(parameters, piece)));
        let (sin, cos) = yaw.sin_cos();
        // ∂/∂τ: v_a + ω_a × t − R(θ) v_b, and ω_a − ω_b
        let by_tau = [
            ahead_a - w_a * left - (ahead_b * cos - aside_b * sin),
            aside_a + w_a * forward - (ahead_b * sin + aside_b * cos),
            w_a - w_b,
        ];
        let (sin, cos) = sensor.yaw.sin_cos();
        // R(−ψ) on forward and left
        let seen = |[x, y, yaw]: [f64; 3]| [cos * x + sin * y, cos * y - sin * x, yaw];
        let motion = seen(prediction.motion);
        Self {
            motion,
            by_parameter: prediction.sensitivity.map(seen),
            by_tau: seen(by_tau),
            // ∂R(−ψ)t/∂ψ
            by_yaw: [motion[1], -motion[0], 0.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_core::Pose;

    const PARAMETERS: Parameters = Parameters([-0.375, 0.457, 0.049, 0.97, 1.03]);

    fn pieces() -> Vec<Piece> {
        [(0.03, 0.2, 0.9), (0.04, -0.5, 0.5), (0.5, 0.7, -1.0), (0.03, 0.4, 0.4), (0.02, 0.0, -1.0)]
            .map(|(duration, v_left, v_right)| Piece { duration, v_left, v_right })
            .to_vec()
    }

    /// The motion of a sensor at `mount` on the body: S⁻¹ M S.
    fn of_mounted(mount: &Pose, [x, y, yaw]: [f64; 3]) -> Pose {
        mount.inverse().compose(&Pose::new(x, y, yaw)).compose(mount)
    }

    #[test]
    fn a_turned_sensor_reports_turned_motion() {
        let sensor = Sensor { tau: 0.0, yaw: 0.1 };
        let [x, y, yaw] = report(&PARAMETERS, &sensor, &pieces()).motion;
        let expected =
            of_mounted(&Pose::new(0.0, 0.0, 0.1), predict(&PARAMETERS, &pieces()).motion);
        assert!((x - expected.x).abs() < 1e-15 && (y - expected.y).abs() < 1e-15);
        assert!((yaw - expected.yaw).abs() < 1e-15);
    }

    #[test]
    fn a_lever_arm_is_a_shift_of_the_icrs_exactly() {
        // The sensor sits 0.3 m forward and 0.2 m to the left: the ICRs lie as much further back
        // and to the right of it.
        let [x_l, x_r, y, alpha_l, alpha_r] = PARAMETERS.0;
        let shifted = Parameters([x_l + 0.2, x_r + 0.2, y - 0.3, alpha_l, alpha_r]);
        let [x, y, yaw] = predict(&shifted, &pieces()).motion;
        let expected =
            of_mounted(&Pose::new(0.3, 0.2, 0.0), predict(&PARAMETERS, &pieces()).motion);
        assert!((x - expected.x).abs() < 1e-15 && (y - expected.y).abs() < 1e-15);
        assert_eq!(yaw, expected.yaw);
    }

    #[test]
    fn sensitivities_equal_difference_quotients() {
        const STEP: f64 = 1e-5;
        let sensor = Sensor { tau: 0.0, yaw: 0.2 };
        let exact = report(&PARAMETERS, &sensor, &pieces());
        let quotient = |at: &dyn Fn(f64) -> [f64; 3]| {
            let (ahead, behind) = (at(STEP), at(-STEP));
            [0, 1, 2].map(|channel| (ahead[channel] - behind[channel]) / (2.0 * STEP))
        };
        let by_yaw = quotient(&|step| {
            report(&PARAMETERS, &sensor.stepped(Nuisance::SensorYaw, step), &pieces()).motion
        });
        // A later clock sees more of the first speeds and less of the last.
        let by_tau = quotient(&|step| {
            let mut moved = pieces();
            moved[0].duration += step;
            moved[4].duration -= step;
            report(&PARAMETERS, &sensor, &moved).motion
        });
        let by_first = quotient(&|step| {
            let mut parameters = PARAMETERS;
            parameters.0[0] += step;
            report(&parameters, &sensor, &pieces()).motion
        });
        for (exact, quotient) in
            [(exact.by_yaw, by_yaw), (exact.by_tau, by_tau), (exact.by_parameter[0], by_first)]
        {
            for channel in 0..3 {
                // Second order of the step, on motions of a metre.
                assert!(
                    (exact[channel] - quotient[channel]).abs() < 1e-9,
                    "{exact:?} {quotient:?}"
                );
            }
        }
    }
}
