//! Speeds and yaw rates over time.

use super::Driving;
use crate::{Figure, Parameters};
use trackdyn_core::PerSide;
use trackdyn_estimate::YawRates;
use trackdyn_recording::Recording as Motion;
use trackdyn_report::Inspected;

/// Speeds of the tracks, yaw rates as measured and as predicted, over time.
#[derive(Clone, Debug)]
pub struct OverTime {
    /// The runs.
    pub rates: YawRates,
    /// What the yaw rate is predicted by; none where nothing could be fitted.
    pub model: Option<String>,
    /// The radius that was assumed, m, where none is known: speeds are read with it. 1 otherwise.
    pub speed_unit: f64,
}

impl OverTime {
    pub(super) fn of(
        motion: &Motion,
        driving: &Driving,
        speed_unit: f64,
        parameters: Option<&Parameters>,
    ) -> Self {
        let gap = driving.separation.as_ref().map(|found| found.gap.value);
        let rates = |model: &dyn Fn(PerSide<f64>) -> f64| {
            YawRates::new(motion, &driving.observations, model)
        };
        let is_known = (speed_unit - 1.0).abs() < f64::EPSILON;
        let (rates, model) = match (parameters, gap) {
            (Some(parameters), _) if is_known => {
                let yaw_rate = |speed| parameters.kinematics_at(speed).twist(speed).w;
                (rates(&yaw_rate), Some(format!("by {}", parameters.name())))
            }
            (_, Ok(gap)) => {
                let fitted = "the distance of the ICRs that fits this recording best";
                let model = if is_known {
                    format!("by xᵣ − xₗ = {gap:.3} m, {fitted}")
                } else {
                    format!("by {fitted}")
                };
                // ω = (V_r − V_l)/(x_r − x_l), eq. (9)
                (rates(&|speed| (speed.right - speed.left) / gap), Some(model))
            }
            (_, Err(_)) => (rates(&|_| 0.0), None),
        };
        Self { rates, model, speed_unit }
    }

    /// The figure.
    pub fn figure(&self, name: &str, caption: &str) -> Figure {
        let (rates, model, speed_unit) = (&self.rates, self.model.as_deref(), self.speed_unit);
        trackdyn_report::inspection(&Inspected { name, rates, speed_unit, model }, caption)
    }
}
