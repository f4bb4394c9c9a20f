//! The result of a replay as a file, schema `trackdyn.odometry/1`.

use super::{Advice, Odometry};
use crate::Provenance;
use crate::document::{ClockTable, GyroscopeTable, Rounded, to_toml};
use serde::Serialize;
use trackdyn_estimate::odometry::comparison::{Component, SpanErrors};
use trackdyn_estimate::odometry::{Comparison, Estimate, ParameterSet, Span};
use trackdyn_model::Kinematics;

#[derive(Serialize)]
struct File<'a> {
    schema: &'static str,
    runs: Vec<i64>,
    #[serde(skip_serializing_if = "<[i64]>::is_empty")]
    runs_left_out: &'a [i64],
    duration_s: Rounded,
    distance_m: Rounded,
    confidence: String,
    /// Why the forces on the vehicle are not replayed.
    #[serde(skip_serializing_if = "Option::is_none")]
    physics_stopped: Option<&'a str>,
    source: Source<'a>,
    clock: ClockTable<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gyroscope: Option<GyroscopeTable>,
    advice: AdviceTable,
    set: Vec<SetTable>,
    span: Vec<SpanTable<'a>>,
}

#[derive(Serialize)]
struct Source<'a> {
    command: &'a str,
    version: &'a str,
    recording: &'a str,
    robot: &'a str,
    fingerprint: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    time_s: Option<[f64; 2]>,
    vehicle: &'a str,
    vehicle_fingerprint: &'a str,
    gauge_m: f64,
}

/// Which parameters to take.
#[derive(Serialize)]
struct AdviceTable {
    /// A file, or `ideal`.
    #[serde(skip_serializing_if = "Option::is_none")]
    take: Option<String>,
    /// Why that is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    undecided: Option<String>,
    /// Errors as a share of those of the other sets.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    compared: Vec<ComparedTable>,
}

#[derive(Serialize)]
struct ComparedTable {
    with: String,
    position: EstimateTable,
    yaw: EstimateTable,
}

#[derive(Serialize)]
struct SetTable {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fingerprint: Option<String>,
    held_out: bool,
    /// None of forces.
    #[serde(flatten)]
    constants: Option<ConstantsTable>,
    end_position_rms_m: Rounded,
    end_yaw_rms_rad: Rounded,
}

#[derive(Serialize)]
struct ConstantsTable {
    x_icr_left_m: f64,
    x_icr_right_m: f64,
    y_icr_m: f64,
    alpha_left: f64,
    alpha_right: f64,
}

#[derive(Serialize)]
struct SpanTable<'a> {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    length_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length_s: Option<f64>,
    count: usize,
    blocks: usize,
    mean_distance_m: Rounded,
    mean_duration_s: Rounded,
    set: Vec<ErrorTable<'a>>,
}

#[derive(Serialize)]
struct ErrorTable<'a> {
    name: &'a str,
    along_m: ComponentTable,
    across_m: ComponentTable,
    yaw_rad: ComponentTable,
    position_m: ComponentTable,
}

#[derive(Serialize)]
struct ComponentTable {
    mean: EstimateTable,
    rms: EstimateTable,
    #[serde(skip_serializing_if = "Option::is_none")]
    per_metre: Option<EstimateTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rms_over_ideal: Option<EstimateTable>,
}

#[derive(Serialize)]
struct EstimateTable {
    value: Rounded,
    #[serde(skip_serializing_if = "Option::is_none")]
    low95: Option<Rounded>,
    #[serde(skip_serializing_if = "Option::is_none")]
    high95: Option<Rounded>,
}

/// The text of `odometry.toml`.
pub(super) fn text(odometry: &Odometry, provenance: &Provenance) -> String {
    let Odometry { comparison: result, clock, recording, gauge, .. } = odometry;
    to_toml(&File {
        schema: "trackdyn.odometry/1",
        runs: result.paths.iter().map(|path| path.run).collect(),
        runs_left_out: &result.left_out,
        duration_s: Rounded(result.duration()),
        distance_m: Rounded(result.distance()),
        confidence: format!("95 %, jackknife: {}", result.blocks.description()),
        source: Source {
            command: &provenance.command,
            version: &provenance.version,
            recording: recording.name(),
            robot: recording.motion().map_or("unknown", |motion| motion.robot()),
            fingerprint: recording.fingerprint(),
            time_s: odometry.time,
            vehicle: gauge.vehicle(),
            vehicle_fingerprint: gauge.fingerprint(),
            gauge_m: gauge.metres(),
        },
        physics_stopped: odometry.physics_stopped(),
        clock: ClockTable::of(clock),
        gyroscope: recording.gyroscope().map(GyroscopeTable::of),
        advice: of_advice(&odometry.advice()),
        set: result
            .sets
            .iter()
            .enumerate()
            .map(|(index, set)| of_set(odometry, index, set))
            .collect(),
        span: result.spans.iter().map(|errors| of_span(result, errors)).collect(),
    })
}

fn of_advice(advice: &Advice) -> AdviceTable {
    let compared = advice.compared().iter().map(|one| ComparedTable {
        with: one.with.clone(),
        position: of_estimate(one.place),
        yaw: of_estimate(one.yaw),
    });
    AdviceTable {
        take: advice.choice().map(str::to_owned),
        undecided: match advice {
            Advice::Undecided { reason } => Some(reason.clone()),
            _ => None,
        },
        compared: compared.collect(),
    }
}

fn of_set(odometry: &Odometry, index: usize, set: &ParameterSet) -> SetTable {
    // A set without its alphas is of the file that has them.
    let replayed = odometry.replayed.iter().find(|one| {
        let without = one.set.without_alpha();
        one.set.name() == set.name() || without.is_some_and(|of| of.name() == set.name())
    });
    let [place, yaw] = odometry.error_at_end(index);
    SetTable {
        name: set.name().to_owned(),
        file: replayed.map(|one| one.parameters.name().to_owned()),
        fingerprint: replayed.map(|one| one.parameters.fingerprint()),
        held_out: match (replayed, set.vehicle()) {
            (Some(one), _) => odometry.is_held_out(one.parameters.source()),
            (None, Some(vehicle)) => {
                vehicle.source.as_ref().is_none_or(|source| odometry.is_held_out(source))
            }
            (None, None) => true,
        },
        constants: set.kinematics().map(|Kinematics { icrs, alpha }| ConstantsTable {
            x_icr_left_m: icrs.x_left,
            x_icr_right_m: icrs.x_right,
            y_icr_m: icrs.y,
            alpha_left: alpha.left,
            alpha_right: alpha.right,
        }),
        end_position_rms_m: Rounded(place),
        end_yaw_rms_rad: Rounded(yaw),
    }
}

fn of_span<'a>(result: &'a Comparison, errors: &SpanErrors) -> SpanTable<'a> {
    let (kind, length_m, length_s) = match errors.span {
        Span::Segment => ("segment", None, None),
        Span::Distance(length) => ("distance", Some(length), None),
        Span::Duration(length) => ("duration", None, Some(length)),
    };
    let of_set =
        |(set, errors): (&'a ParameterSet, &trackdyn_estimate::odometry::comparison::SetErrors)| {
            ErrorTable {
                name: set.name(),
                along_m: of_component(&errors.along),
                across_m: of_component(&errors.across),
                yaw_rad: of_component(&errors.yaw),
                position_m: of_component(&errors.position),
            }
        };
    SpanTable {
        kind,
        length_m,
        length_s,
        count: errors.count,
        blocks: errors.blocks,
        mean_distance_m: Rounded(errors.mean_distance),
        mean_duration_s: Rounded(errors.mean_duration),
        set: result.sets.iter().zip(&errors.sets).map(of_set).collect(),
    }
}

fn of_component(component: &Component) -> ComponentTable {
    ComponentTable {
        mean: of_estimate(component.mean),
        rms: of_estimate(component.rms),
        per_metre: component.per_metre.map(of_estimate),
        rms_over_ideal: component.over_first.map(of_estimate),
    }
}

fn of_estimate(estimate: Estimate) -> EstimateTable {
    let [low95, high95] =
        estimate.interval().map_or([None; 2], |ends| ends.map(|end| Some(Rounded(end))));
    EstimateTable { value: Rounded(estimate.value), low95, high95 }
}
