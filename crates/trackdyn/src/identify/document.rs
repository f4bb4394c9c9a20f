//! The result of an identification as a file, schema `trackdyn.identification/1`.

use super::{FILES, MotionFit};
use crate::Provenance;
use crate::document::{ClockTable, GyroscopeTable, Rounded, to_toml};
use serde::Serialize;
use trackdyn_estimate::Interval;
use trackdyn_estimate::identification::{Fit, Weights};
use trackdyn_estimate::noise::Component;
use trackdyn_estimate::{
    Contradiction, Doubt, Error, Estimate, Free, Identification, Parameters, SpinTest,
};
use trackdyn_model::kinematics::Source;

#[derive(Serialize)]
struct File<'a> {
    schema: &'static str,
    frame: &'static str,
    segments: usize,
    source: SourceTable<'a>,
    clock: ClockTable<'a>,
    noise: NoiseTable,
    #[serde(skip_serializing_if = "Option::is_none")]
    response: Option<ResponseTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gyroscope: Option<GyroscopeTable>,
    method: Vec<MethodTable>,
}

#[derive(Serialize)]
struct SourceTable<'a> {
    #[serde(flatten)]
    source: &'a Source,
    robot: &'a str,
    vehicle_fingerprint: &'a str,
    gauge_m: f64,
}

/// How the poses follow the track speeds, where they do not follow at once.
#[derive(Serialize)]
struct ResponseTable {
    icr_separation_m: Rounded,
    low95_m: Rounded,
    high95_m: Rounded,
    icr_separation_at_once_m: Rounded,
}

/// Noise of the recording; keys are absent where it does not show it.
#[derive(Serialize)]
struct NoiseTable {
    weights: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_forward_m: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_lateral_m: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_yaw_rad: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_stamp_s: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    encoder_left_m_s: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    encoder_right_m_s: Option<Rounded>,
}

/// One method with one choice of what is free.
#[derive(Serialize)]
struct MethodTable {
    method: &'static str,
    free: &'static str,
    /// Whether the recording determines what is free.
    determined: bool,
    /// Kinematics file with these numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cost: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cost_unit: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    whitened_rms: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    blocks: Option<usize>,
    /// Why it is not determined.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    doubts: Vec<String>,
    /// What contradicts it: it is written where that is forced.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    contradictions: Vec<String>,
    /// What was asked for beside the ICRs and is not fitted: why.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    not_fitted: Vec<String>,
    estimate: Vec<EstimateTable>,
}

#[derive(Serialize)]
struct EstimateTable {
    name: &'static str,
    unit: &'static str,
    value: Rounded,
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_error: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    low95: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    high95: Option<Rounded>,
}

impl MotionFit {
    /// The text of `identification.toml` (schema `trackdyn.identification/1`).
    pub fn to_toml(&self, provenance: &Provenance) -> String {
        text(self, &self.sourced.source(provenance))
    }
}

/// The text of `identification.toml`; `source` is that of the kinematics files.
fn text(identified: &MotionFit, source: &Source) -> String {
    let (found, gauge) = (&identified.found, identified.gauge());
    let mut method = vec![of_spin_test(&found.spin_test, gauge)];
    for (fit, file) in found.fits.iter().zip(FILES) {
        method.push(of_genetic(fit, gauge));
        method.push(of_least_squares(fit, gauge, found.weights, file, identified.sourced.force));
    }
    to_toml(&File {
        schema: "trackdyn.identification/1",
        frame: "paper",
        segments: found.segments,
        source: SourceTable {
            source,
            robot: identified.robot(),
            vehicle_fingerprint: identified.vehicle_fingerprint(),
            gauge_m: gauge,
        },
        clock: ClockTable::of(&found.clock),
        noise: of_noise(found),
        response: found.response.as_ref().filter(|of| !of.is_at_once()).map(|response| {
            ResponseTable {
                icr_separation_m: Rounded(response.gap.value),
                low95_m: Rounded(response.gap.low),
                high95_m: Rounded(response.gap.high),
                icr_separation_at_once_m: Rounded(response.gap_at_once),
            }
        }),
        gyroscope: identified.gyroscope.as_ref().map(|of| {
            let without = of.gap_without_it.map(|gap| gap.deviation);
            GyroscopeTable::of(&of.found).with_error_without_it(without)
        }),
        method,
    })
}

fn of_noise(found: &Identification) -> NoiseTable {
    let poses = found.noise.moving.as_ref().or(found.noise.standing.as_ref());
    let white = |component: &Component| Rounded(component.white);
    let encoders = found.noise.encoders.map(|noise| noise.map(|noise| Rounded(noise.deviation)));
    NoiseTable {
        weights: match found.weights {
            Weights::Noise(_) => "noise",
            Weights::Residuals(_) => "residuals",
            Weights::Equal => "equal",
        },
        pose_forward_m: poses.map(|poses| white(&poses.forward)),
        pose_lateral_m: poses.map(|poses| white(&poses.lateral)),
        pose_yaw_rad: poses.map(|poses| white(&poses.yaw)),
        pose_stamp_s: poses.map(|poses| poses.stamp).filter(|stamp| *stamp > 0.0).map(Rounded),
        encoder_left_m_s: encoders.left,
        encoder_right_m_s: encoders.right,
    }
}

impl MethodTable {
    fn new(method: &'static str, free: &'static str) -> Self {
        Self {
            method,
            free,
            determined: true,
            file: None,
            cost: None,
            cost_unit: None,
            whitened_rms: None,
            blocks: None,
            doubts: Vec::new(),
            contradictions: Vec::new(),
            not_fitted: Vec::new(),
            estimate: Vec::new(),
        }
    }

    fn refused(self, doubts: Vec<String>) -> Self {
        Self { determined: doubts.is_empty(), doubts, ..self }
    }
}

fn of_spin_test(spin_test: &Result<SpinTest, Error>, gauge: f64) -> MethodTable {
    let table = MethodTable::new("spin-test", "distance");
    match spin_test {
        Ok(spin) => MethodTable { estimate: of_spin(spin, gauge), ..table },
        Err(reason) => table.refused(vec![reason.to_string()]),
    }
}

fn of_spin(spin: &SpinTest, gauge: f64) -> Vec<EstimateTable> {
    let row = |name, unit, value, interval: Option<Interval>| match interval {
        Some(interval) => of_interval(name, unit, &interval),
        None => EstimateTable {
            name,
            unit,
            value: Rounded(value),
            standard_error: None,
            low95: None,
            high95: None,
        },
    };
    vec![
        row("x_r - x_l", "m", spin.gap, spin.interval),
        row("chi", "1", spin.steering_efficiency, spin.interval.map(|gap| gap.dividing(gauge))),
    ]
}

fn name_of(free: Free) -> &'static str {
    match free {
        Free::Icrs => "icrs",
        Free::IcrsAndAlphas => "icrs-and-alphas",
    }
}

fn of_genetic(fit: &Fit, gauge: f64) -> MethodTable {
    let doubts = if let Err(Error::NotDetermined(doubt)) = &fit.least_squares {
        vec![doubt.to_string()]
    } else {
        Vec::new()
    };
    MethodTable {
        cost: Some(fit.genetic.cost),
        cost_unit: Some("m^2"),
        blocks: Some(fit.genetic_estimate.filled_blocks),
        estimate: of_estimate(&fit.genetic_estimate, gauge),
        ..MethodTable::new("genetic", name_of(fit.free)).refused(doubts)
    }
}

fn of_least_squares(
    fit: &Fit,
    gauge: f64,
    weights: Weights,
    file: &'static str,
    force: bool,
) -> MethodTable {
    let is_written = fit.doubts.is_empty() && (force || fit.contradictions.is_empty());
    let table = MethodTable {
        not_fitted: fit.refused.iter().map(Doubt::to_string).collect(),
        ..MethodTable::new("least-squares", name_of(fit.free))
    };
    match &fit.least_squares {
        Ok(estimate) => MethodTable {
            file: is_written.then_some(file),
            contradictions: fit.contradictions.iter().map(Contradiction::to_string).collect(),
            cost: Some(estimate.cost),
            cost_unit: Some(if weights == Weights::Equal { "m^2" } else { "1" }),
            whitened_rms: matches!(weights, Weights::Noise(_))
                .then_some(Rounded(estimate.whitened_rms)),
            blocks: Some(estimate.filled_blocks),
            estimate: of_estimate(estimate, gauge),
            ..table.refused(fit.doubts.iter().map(Doubt::to_string).collect())
        },
        Err(reason) => table.refused(vec![reason.to_string()]),
    }
}

fn of_estimate(estimate: &Estimate, gauge: f64) -> Vec<EstimateTable> {
    let unknowns = &estimate.unknowns;
    let parameters = (0..unknowns.free.count()).filter_map(|k| {
        let (name, unit) = (Parameters::NAMES[k], Parameters::UNITS[k]);
        Some(of_interval(name, unit, &estimate.interval(k)?))
    });
    let sensor = unknowns.nuisances.iter().filter_map(|&nuisance| {
        Some(of_interval(nuisance.symbol(), nuisance.unit(), &estimate.nuisance(nuisance)?))
    });
    let derived = [
        of_interval("x_r - x_l", "m", &estimate.gap()),
        of_interval("chi", "1", &estimate.steering_efficiency(gauge)),
        of_interval("e", "1", &estimate.eccentricity()),
    ];
    parameters.chain(sensor).chain(derived).collect()
}

fn of_interval(name: &'static str, unit: &'static str, interval: &Interval) -> EstimateTable {
    let Interval { value, deviation, low, high } = *interval;
    let finite = |value: f64| value.is_finite().then_some(Rounded(value));
    EstimateTable {
        name,
        unit,
        value: Rounded(value),
        standard_error: finite(deviation),
        low95: finite(low),
        high95: finite(high),
    }
}
