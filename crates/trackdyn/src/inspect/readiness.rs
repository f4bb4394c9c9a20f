//! What a recording is good for: each use is tried.

use super::{Driving, Finding, InspectSettings};
use crate::identify::{FILES, Identification, IdentifySettings, identify};
use crate::{Error, Gauge, Recording};
use std::f64::consts::PI;
use trackdyn_diagnose::Settings;
use trackdyn_diagnose::evidence::Evidence;
use trackdyn_estimate::odometry::{Comparison, ParameterSet};
use trackdyn_estimate::{Clock, Contradiction};
use trackdyn_recording::Recording as Motion;

/// Distance of the ICRs per gauge that is assumed where the gauge is not known: hard ground.
const USUAL_GAP: f64 = 1.5;

/// Gauge that is assumed where nothing is known, m.
const USUAL_GAUGE: f64 = 0.5;

/// What a recording is used for, by the command that does it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Use {
    /// Identification of the kinematics.
    Identify,
    /// Dead reckoning with parameters.
    Odometry,
    /// Diagnosis of the physics that a model lacks.
    Diagnose,
}

impl Use {
    /// Name of the command.
    pub fn command(self) -> &'static str {
        match self {
            Self::Identify => "identify",
            Self::Odometry => "odometry",
            Self::Diagnose => "diagnose",
        }
    }
}

/// How far a recording suffices.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It does.
    Ready,
    /// It gives less than all: what, and why.
    Partly(String),
    /// It does not: why.
    No(String),
}

/// A use, and how far a recording suffices for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Readiness {
    /// The use.
    pub what: Use,
    /// How far it suffices.
    pub verdict: Verdict,
    /// Names of the files of all parameters that an identification would write; none of other uses.
    pub files: Vec<&'static str>,
}

impl Readiness {
    fn new(what: Use, verdict: Verdict) -> Self {
        Self { what, verdict, files: Vec::new() }
    }

    /// Whether the use gives anything.
    pub fn is_ready(&self) -> bool {
        !matches!(self.verdict, Verdict::No(_))
    }
}

/// A recording that is good for nothing, for one reason.
pub(super) fn none(reason: &str) -> Vec<Readiness> {
    let no = |what| Readiness::new(what, Verdict::No(reason.to_owned()));
    [Use::Identify, Use::Odometry, Use::Diagnose].map(no).to_vec()
}

/// What a table of steady operating points is good for.
pub(super) fn of_points(
    recording: &Recording,
    settings: &InspectSettings,
    findings: &mut Vec<Finding>,
) -> Vec<Readiness> {
    let points = recording.points().map_or(&[][..], |table| table.points());
    let gap = trackdyn_estimate::Separation::of_points(points).map(|found| found.gap.value);
    let identified = to_identify(recording, settings, gap.ok(), findings);
    let no_motion = "a table has no path to reckon".to_owned();
    let evidence = Evidence::of_points(points, &Settings::default()).map(drop);
    vec![
        identified,
        Readiness::new(Use::Odometry, Verdict::No(no_motion)),
        Readiness::new(Use::Diagnose, of_result(evidence)),
    ]
}

/// What a recording of motion is good for.
pub(super) fn of_motion(
    recording: &Recording,
    driving: &Driving,
    settings: &InspectSettings,
    findings: &mut Vec<Finding>,
) -> Vec<Readiness> {
    let gap = driving.separation.as_ref().ok().map(|found| found.gap.value);
    let identified = to_identify(recording, settings, gap, findings);
    let is_identified = identified.is_ready();
    let unusable = findings.iter().find_map(|of| match of {
        Finding::Fit(Contradiction::WheelOdometry { .. }) => {
            Some("these poses are wheel odometry: expected those of something else")
        }
        Finding::Turning(_) => Some("the tracks do not turn as the poses do"),
        // What no parameters explain is none of one drive.
        Finding::Fit(Contradiction::Way { .. }) if !is_identified => {
            Some("the poses move where the tracks do not drive")
        }
        Finding::Fit(Contradiction::Turning { .. } | Contradiction::Follows { .. })
            if !is_identified =>
        {
            Some("the poses do not turn as the tracks do")
        }
        _ => None,
    });
    let usable = match unusable {
        Some(reason) => Err(reason),
        None => {
            recording.expect_positions().map_err(|_| "poses have a yaw alone: expected positions")
        }
    };
    let [odometry, diagnose] = usable.map_or_else(
        |reason| {
            let no = || Verdict::No(reason.to_owned());
            [no(), no()]
        },
        |motion| {
            let gauge = gauge(settings, gap);
            let tau = driving.clock.as_ref().map_or(0.0, Clock::tau);
            [to_replay(motion, gauge, tau), to_diagnose(motion, gauge, driving)]
        },
    );
    vec![
        identified,
        Readiness::new(Use::Odometry, odometry),
        Readiness::new(Use::Diagnose, diagnose),
    ]
}

/// Tries to replay it with the ideal drive.
fn to_replay(motion: &Motion, gauge: f64, tau: f64) -> Verdict {
    of_result(Comparison::new(motion, vec![ParameterSet::ideal(gauge)], tau).map(drop))
}

/// Takes the evidence of a diagnosis out of it.
fn to_diagnose(motion: &Motion, gauge: f64, driving: &Driving) -> Verdict {
    let method = Settings::default();
    let needed = method.evidence.min_segments;
    let turned = driving.turned.left.abs() + driving.turned.right.abs();
    let is_turning = match &driving.separation {
        Ok(found) => found.gap.deviation < method.base.max_gap_deviation * gauge,
        Err(_) => turned >= PI,
    };
    match Evidence::of_recording(motion, gauge, &method) {
        Ok(evidence) if evidence.samples().len() < needed => {
            let found = evidence.samples().len();
            Verdict::No(format!("{found} segments: expected at least {needed}"))
        }
        Ok(_) if !is_turning => Verdict::No(trackdyn_diagnose::Error::NoTurning.to_string()),
        other => of_result(other.map(drop)),
    }
}

fn of_result<E: std::fmt::Display>(result: Result<(), E>) -> Verdict {
    result.map_or_else(|reason| Verdict::No(reason.to_string()), |()| Verdict::Ready)
}

/// The gauge given, else one that makes nothing look wrong, m.
fn gauge(settings: &InspectSettings, gap: Option<f64>) -> f64 {
    let given = settings.gauge.as_ref().map(Gauge::metres);
    given.unwrap_or_else(|| usual_gauge(gap))
}

/// A gauge that makes nothing look wrong by the distance of the ICRs, m, where that is known.
pub(super) fn usual_gauge(gap: Option<f64>) -> f64 {
    gap.map_or(USUAL_GAUGE, |gap| gap / USUAL_GAP)
}

/// Tries to identify the robot.
fn to_identify(
    recording: &Recording,
    settings: &InspectSettings,
    gap: Option<f64>,
    findings: &mut Vec<Finding>,
) -> Readiness {
    let no = |reason: String| Readiness::new(Use::Identify, Verdict::No(reason));
    let gauge = Gauge::new(gauge(settings, gap));
    let gauge = settings.gauge.clone().map_or(gauge, Ok);
    let tried = gauge.and_then(|gauge| {
        let settings = IdentifySettings { tau: settings.tau, ..IdentifySettings::default() };
        identify(recording, &gauge, &settings)
    });
    let identified = match tried {
        Ok(identified) => identified,
        Err(Error::Identify { cause, .. }) => return no(cause.to_string()),
        Err(error) => return no(error.to_string()),
    };
    for contradiction in identified.contradictions().into_iter().flatten() {
        let is_of_gauge = matches!(contradiction, Contradiction::Efficiency { .. });
        let is_known =
            |of: &Finding| matches!(of, Finding::Fit(other) if other.is_like(&contradiction));
        if !findings.iter().any(is_known) && (settings.gauge.is_some() || !is_of_gauge) {
            findings.push(Finding::Fit(contradiction));
        }
    }
    if let Identification::Points(fit) = &identified
        && !fit.lagging.is_empty()
    {
        findings.push(Finding::Lagging(fit.lagging.len()));
    }
    let files = FILES.into_iter().zip(identified.reasons());
    let files = files.filter(|(_, reason)| reason.is_none()).map(|(file, _)| file).collect();
    Readiness { files, ..Readiness::new(Use::Identify, of_identified(&identified)) }
}

fn of_identified(identified: &Identification) -> Verdict {
    match identified.reasons() {
        [None, None] => Verdict::Ready,
        [None, Some(reason)] => {
            Verdict::Partly(format!("the ICRs without factors on the track speeds: {reason}"))
        }
        [Some(reason), None] => {
            Verdict::Partly(format!("the ICRs with factors on the track speeds alone: {reason}"))
        }
        [Some(reason), Some(_)] if identified.is_determined() => {
            Verdict::Partly(format!("the distance of the ICRs alone: {reason}"))
        }
        [Some(reason), Some(_)] => Verdict::No(reason),
    }
}
