//! Another cone of friction, and another direction of friction on it.

use crate::contact::{Friction, ShearStress};
use crate::effect::{Card, Effect, Parameter, Role, Stage};
use crate::pipeline::Site;
use trackdyn_core::Scalar;

/// Friction that dissipates as much as its cone lets it, on cones from a diamond to a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionCone {
    normality: f64,
    pyramid: f64,
}

/// Part of the slip, for a full box, below which a component of friction is not full, 1.
///
/// A box is vertical there: a robot that drives straight has no definite force across. The error of
/// an ICR is below a hundredth of the distance from it to the middle of a track.
const EDGE: f64 = 0.01;

/// Square of a slip component that is nothing beside 1, so that its logarithm is finite.
const NEGLIGIBLE_SQUARE: f64 = 1e-30;

impl Effect for FrictionCone {
    const CARD: Card = Card {
        id: "friction-cone",
        title: "Friction on another cone, as simulators have it",
        law: "τ = −[μ] p ∂|u|_m/∂u, u = [μ/√(μ_x μ_y)]^a s/|s|, |u|_m = (|u_x|^m + |u_y|^m)^(1/m), \
              m = 2/(1 + b)",
        assumes: "The cone's section is |τ_x/μ_x|^n + |τ_y/μ_y|^n = p^n with 1/n + 1/m = 1, in \
                  the axes of the hull. With a = 1 the stress dissipates most, as in simulators \
                  that minimise: MuJoCo's elliptic cone b = 0, its pyramid towards b = −1 (a \
                  diamond), the box of ODE, Bullet and DART b = 1. With a = 0 it points as in eq. \
                  (22).",
        shows: "ICRs move as by another ratio of friction, by an amount that depends on how far \
                slip is from both axes. It belongs to the class of constants.",
        resembles: "",
        breaks: &[],
        stages: &[Stage::Shear],
        parameters: &[
            Parameter {
                key: "normality",
                symbol: "a",
                unit: "1",
                meaning: "part of the turn from the slip's direction to that of most dissipation",
                role: Role::Size { neutral: 0.0 },
                range: [0.0, 1.0],
                typical: 0.5,
            },
            Parameter {
                key: "pyramid",
                symbol: "b",
                unit: "1",
                meaning: "section of the cone: a diamond towards −1, an ellipse, a box at 1",
                role: Role::Size { neutral: 0.0 },
                range: [-0.9, 1.0],
                typical: 0.5,
            },
        ],
        sources: &[
            "Goyal, Ruina, Papadopoulos, Wear 143, 1991 (greatest dissipation)",
            "Michałowski, Mróz, Archives of Mechanics 30, 1978 (anisotropic cones)",
            "MuJoCo, documentation: computation, friction cones",
            "Smith, Open Dynamics Engine, manual: friction approximation",
        ],
    };

    fn from_values(values: &[f64]) -> Self {
        Self { normality: values[0], pyramid: values[1] }
    }

    fn shear<S: Scalar>(&self, site: &Site<S>, stress: &mut ShearStress<S>) {
        let slip = site.slip_direction();
        let friction = site.friction();
        let [across, along] = self.direction(slip, friction);
        let pressure = site.normal_pressure();
        // τ_added = −[μ] p (∂|u|_m/∂u − s/|s|)
        stress.added[0] += (across - slip[0]) * pressure * -friction.across;
        stress.added[1] += (along - slip[1]) * pressure * -friction.along;
    }
}

impl FrictionCone {
    /// −τ/([μ] p) at a slip direction: ∂|u|_m/∂u.
    fn direction<S: Scalar>(&self, slip: [S; 2], friction: Friction) -> [S; 2] {
        // u = [μ/√(μ_x μ_y)]^a s/|s|
        let ratio = (friction.across / friction.along).powf(0.5 * self.normality);
        let u = [slip[0] * ratio, slip[1] * (1.0 / ratio)];
        // m = 2/(1 + b)
        let m = 2.0 / (1.0 + self.pyramid);
        // |u|² with the edge of a box rounded
        let rounding = (EDGE * self.pyramid).powi(2) + NEGLIGIBLE_SQUARE;
        let squares = u.map(|u| u * u + rounding);
        let powers = squares.map(|square| power(square, 0.5 * m));
        // ∂|u|_m/∂u = u |u|^(m − 2) |u|_m^(1 − m)
        let norm = power(powers[0] + powers[1], (1.0 - m) / m);
        [0, 1].map(|k| u[k] * powers[k] / squares[k] * norm)
    }
}

/// x^n for positive x.
fn power<S: Scalar>(x: S, n: f64) -> S {
    let value = x.value().powf(n);
    x.map(value, n * value / x.value())
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRICTION: Friction = Friction { across: 0.9, along: 0.6 };

    fn at(normality: f64, pyramid: f64, angle: f64) -> [f64; 2] {
        let slip = [angle.cos(), angle.sin()];
        FrictionCone { normality, pyramid }.direction(slip, FRICTION)
    }

    #[test]
    fn stress_stays_on_its_cone() {
        for k in 0..36 {
            let angle = 0.05 + f64::from(k) * 0.17;
            for pyramid in [-0.9_f64, -0.5, 0.0, 0.3, 0.9] {
                // 1/n + 1/m = 1 with 1/m = (1 + b)/2
                let n = 2.0 / (1.0 - pyramid);
                for normality in [0.0, 0.4, 1.0] {
                    let on = at(normality, pyramid, angle).map(|g| g.abs().powf(n));
                    // Components along which u is small are rounded: g_k by u_k/√(u_k² + ε²).
                    let least = angle.cos().abs().min(angle.sin().abs());
                    let ratio = FRICTION.across / FRICTION.along;
                    let rounded = n / 2.0 * ratio * (EDGE * pyramid / least).powi(2);
                    let rounded = rounded + 1e-6;
                    assert!((on[0] + on[1] - 1.0).abs() < rounded, "{pyramid} {angle}: {on:?}");
                }
            }
        }
    }

    /// No other stress on the cone takes more power from the slip.
    #[test]
    fn stress_of_full_normality_dissipates_most() {
        let power = |g: [f64; 2], angle: f64| {
            FRICTION.across * g[0] * angle.cos() + FRICTION.along * g[1] * angle.sin()
        };
        for pyramid in [-0.9, -0.3, 0.0, 0.6, 1.0] {
            for k in 0..18 {
                let slip = 0.03 + f64::from(k) * 0.35;
                let most = power(at(1.0, pyramid, slip), slip);
                // Every stress of the cone is that of some slip.
                let other = |k: u32| at(1.0, pyramid, f64::from(k).to_radians());
                let other = (0..360).map(|k| power(other(k), slip)).fold(0.0, f64::max);
                assert!(most > other - 2e-3, "{pyramid} {slip}: {most} and {other}");
            }
        }
    }

    #[test]
    fn limits_are_a_box_an_ellipse_and_a_diamond() {
        let [across, along] = at(1.0, 1.0, 0.3);
        assert!((across - 1.0).abs() < 1e-3 && (along - 1.0).abs() < 2e-3, "{across} {along}");
        let [across, along] = at(0.0, 0.0, 0.3);
        assert!((across - 0.3_f64.cos()).abs() < 1e-12 && (along - 0.3_f64.sin()).abs() < 1e-12);
        // μ_x s_x > μ_y s_y: all force across
        let [across, along] = at(1.0, -0.9, 0.3);
        assert!(across > 0.99 && along < 1e-3, "{across} {along}");
    }
}
