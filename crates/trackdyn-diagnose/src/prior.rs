//! Priors of all unknowns.

use crate::evidence::{Evidence, Sample};
use crate::hypothesis::{Hypothesis, Unknown, active, neutral, typical_size};
use crate::normal::Prior;
use crate::settings;
use trackdyn_model::contact::Friction;
use trackdyn_model::effect::Role;
use trackdyn_model::{Circumstance, Model, Vehicle};

/// Prior of an unknown, centred on the neutral value of a size and the typical value of a shape.
///
/// # Panics
/// Never: an unknown of an effect has a parameter.
pub fn prior(hypothesis: &Hypothesis, unknown: Unknown, evidence: &Evidence) -> Prior {
    let (vehicle, settings) = (&hypothesis.vehicle, &evidence.settings().prior);
    match unknown {
        Unknown::Offset(_) => Prior::normal(0.0, settings.icr_offset_deviation * vehicle.gauge),
        Unknown::FrictionLevel => Prior::normal(0.0, friction_known(vehicle, settings)),
        Unknown::Cog(axis) => Prior::normal(0.0, cog_known(vehicle, axis, settings)),
        Unknown::Effect(effect, _) => {
            let parameter = unknown.parameter().expect("an effect's");
            if let Some(deviation) = measured(vehicle, unknown) {
                let deviation = deviation.max(settings.min_deviation * typical_size(parameter));
                return Prior::normal(neutral(parameter), deviation).within(parameter.range);
            }
            let prior = match parameter.role {
                Role::Size { .. } => {
                    let deviation = settings.size_deviation * typical_size(parameter);
                    Prior::normal(neutral(parameter), deviation)
                }
                Role::Place { .. } => {
                    let [middle, spread] = area(evidence, parameter.role);
                    let far = if effect.card().has_extent() {
                        settings.extent_place_deviation
                    } else {
                        settings.place_deviation
                    };
                    Prior::normal(middle, far * spread.max(settings.min_area))
                }
                Role::Time => {
                    let [middle, spread] = area(evidence, parameter.role);
                    Prior::normal(middle, settings.time_deviation * spread)
                }
                // uniform, wherever it stands
                Role::Direction => return Prior::even(hypothesis.get(unknown), 360.0),
                Role::Shape => {
                    let deviation = settings.shape_deviation * parameter.typical;
                    Prior::normal(parameter.typical, deviation)
                }
            };
            prior.within(parameter.range)
        }
    }
}

/// Prior standard deviation of ln friction, from the uncertainties in the vehicle file.
fn friction_known(vehicle: &Vehicle, settings: &settings::Prior) -> f64 {
    let friction = &vehicle.uncertainty.friction;
    match (friction.across, friction.along) {
        (Some(across), Some(along)) => {
            let both =
                (across / vehicle.friction.across).hypot(along / vehicle.friction.along) / 2.0;
            both.max(settings.min_deviation)
        }
        _ => settings.friction_deviation,
    }
}

/// Prior standard deviation of a coordinate of the centre of gravity, m.
fn cog_known(vehicle: &Vehicle, axis: usize, settings: &settings::Prior) -> f64 {
    let settings::Prior { cog_deviation, min_cog_deviation, .. } = *settings;
    let measured = vehicle.uncertainty.cog.map(|deviations| deviations[axis]);
    measured.unwrap_or(cog_deviation * vehicle.gauge).max(min_cog_deviation * vehicle.gauge)
}

/// Prior standard deviation of a size whose effect shifts the centre of gravity or the friction
/// ratio, from their measured uncertainties. None for other effects, or without such uncertainties.
pub fn measured(vehicle: &Vehicle, unknown: Unknown) -> Option<f64> {
    let Unknown::Effect(effect, place) = unknown else { return None };
    let parameters = effect.card().parameters;
    let size = typical_size(&parameters[place]);
    let values: Vec<f64> = (0..parameters.len())
        .map(|k| if k == place { parameters[k].typical } else { neutral(&parameters[k]) })
        .collect();
    let effects = std::iter::once(active(effect, &values)).collect();
    let model = Model::new(vehicle.clone(), effects);
    let moved = [0, 1].map(|axis| (model.vehicle().cog[axis] - vehicle.cog[axis]).abs());
    if moved != [0.0, 0.0] {
        let deviations = vehicle.uncertainty.cog?;
        let axis = usize::from(moved[0] <= moved[1]);
        return Some(size * deviations[axis] / moved[axis]);
    }
    let friction = model.ground(&Circumstance::default()).friction;
    let ratio = |of: &Friction| of.across / of.along;
    let change = (ratio(&friction.left) / ratio(&vehicle.friction)).ln().abs();
    let alike = friction.left == friction.right;
    if alike && change > 0.0 {
        let known = &vehicle.uncertainty.friction;
        let relative =
            (known.across? / vehicle.friction.across).hypot(known.along? / vehicle.friction.along);
        return Some(size * relative / change);
    }
    None
}

/// Middle and half range of the recorded positions along an axis of the world, m, or of the times,
/// s.
pub fn area(evidence: &Evidence, role: Role) -> [f64; 2] {
    let over = |coordinate: &dyn Fn(&Sample) -> f64| {
        let coordinates = evidence.samples().iter().map(coordinate);
        let (low, high) = coordinates
            .fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
        [f64::midpoint(low, high), (high - low) / 2.0]
    };
    match role {
        Role::Place { axis } => over(&|sample| [sample.pose.x, sample.pose.y][axis]),
        Role::Time => over(&|sample| sample.start),
        Role::Size { .. } | Role::Direction | Role::Shape => [0.0, 1.0],
    }
}

/// Priors of steps from the present values of a hypothesis.
pub fn priors(hypothesis: &Hypothesis, unknowns: &[Unknown], evidence: &Evidence) -> Vec<Prior> {
    unknowns
        .iter()
        .map(|&unknown| {
            let known = prior(hypothesis, unknown, evidence);
            Prior { mean: known.mean - hypothesis.get(unknown), ..known }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trackdyn_model::VehicleFile;

    #[test]
    fn what_is_exact_leaves_a_finite_weight() {
        let settings = &settings::Prior::default();
        let mut vehicle = VehicleFile::auriga_alpha().vehicle;
        vehicle.uncertainty.friction.across = Some(0.0);
        vehicle.uncertainty.friction.along = Some(0.0);
        vehicle.uncertainty.cog = Some([0.0; 2]);
        for deviation in [friction_known(&vehicle, settings), cog_known(&vehicle, 0, settings)] {
            assert!(deviation > 0.0 && deviation < 1e-3, "{deviation}");
        }
    }
}
