//! The result of an identification as text.

use crate::wrapped::wrapped;
use std::fmt::Write;
use trackdyn::crates::core::lines::counted;
use trackdyn::crates::estimate::identification::{Fit, Weights};
use trackdyn::crates::estimate::noise::PoseNoise;
use trackdyn::crates::estimate::weighting::SegmentNoise;
use trackdyn::crates::estimate::{
    Clock, Contradiction, Estimate, Free, Identification, Interval, Nuisance, Parameters, Response,
};
use trackdyn::crates::model::kinematics::SeparationFile;
use trackdyn::crates::recording::Run;
use trackdyn::crates::recording::recording::known_offset;
use trackdyn::identify::{GyroscopeUse, MotionFit, TurningFit};
use trackdyn::{Gauge, Recording};

/// One screen: the recording, its clock and noise, the methods side by side.
pub fn text(recording: &Recording, gauge: &Gauge, fit: &MotionFit) -> String {
    let found = &fit.found;
    let mut text = String::new();
    let runs = recording.runs();
    let seconds: f64 = runs.iter().map(Run::duration).sum();
    let _ = writeln!(
        text,
        "{}: {}, {seconds:.0} s, {} segments; {}, gauge {} m\n",
        recording.name(),
        counted(runs.len(), "run"),
        found.segments,
        gauge.vehicle(),
        gauge.metres()
    );
    let fits = found.fits.iter().filter_map(|fit| fit.least_squares.as_ref().ok());
    let mut fitted = fits.flat_map(|estimate| &estimate.unknowns.nuisances);
    clock(&mut text, &found.clock, fitted.any(|one| *one == Nuisance::TimeOffset));
    noise(&mut text, found);
    response(&mut text, found.response.as_ref());
    if let Some(of) = &fit.gyroscope {
        gyroscope(&mut text, of, found);
    }
    match &found.spin_test {
        Ok(spin) => {
            let deviation = spin.interval.map_or_else(String::new, |interval| {
                format!(", standard error {:.4} m", interval.deviation)
            });
            let _ = writeln!(
                text,
                "  spin test  x_r - x_l = {:.4} m{deviation}; chi = {:.4} ({} segments, {:.0} rad)",
                spin.gap, spin.steering_efficiency, spin.segments, spin.yaw
            );
        }
        Err(reason) => {
            text += &wrapped("  spin test  ", &reason.to_string());
        }
    }
    for fit in &found.fits {
        self::fit(&mut text, fit, gauge.metres(), matches!(found.weights, Weights::Noise(_)));
    }
    text
}

/// What is known where the recording determines the distance of the ICRs alone.
pub fn separation(found: &SeparationFile) -> String {
    let (gap, chi) = (found.icr_separation_m.get_ref(), found.steering_efficiency.get_ref());
    let SeparationFile { low95_m, high95_m, .. } = found;
    format!(
        "\n  from turning alone, track speeds as measured: x_l, x_r and y are open\n    \
         x_r-x_l {gap:>10.4}{:>24} m\n    chi     {chi:>10.4}\n    \
         wheel_separation_multiplier {:.4}\n",
        format!("{low95_m:.4} to {high95_m:.4}"),
        1.0 / chi
    )
}

/// What contradicts a fit.
pub fn contradicted(text: &mut String, contradictions: &[Contradiction]) {
    if contradictions.is_empty() {
        return;
    }
    text.push_str("    contradicted, and not written unless forced (--force):\n");
    for contradiction in contradictions {
        *text += &wrapped("    - ", &contradiction.to_string());
    }
}

/// One screen where poses have a yaw alone.
pub fn turning(recording: &Recording, gauge: &Gauge, fit: &TurningFit) -> String {
    let found = &fit.found;
    let mut text = format!(
        "{}: {}, {} segments; {}, gauge {} m\n\n",
        recording.name(),
        counted(recording.runs().len(), "run"),
        found.segments,
        gauge.vehicle(),
        gauge.metres()
    );
    clock(&mut text, &found.clock, false);
    response(&mut text, found.response.as_ref());
    text += "  poses      their yaw alone is known: it tells the distance of the ICRs, and not \
             where they are\n";
    for contradiction in fit.contradictions() {
        text += &wrapped("  contradicted, and not written: ", &contradiction.to_string());
    }
    text
}

fn clock(text: &mut String, clock: &Clock, is_fitted: bool) {
    let start = if is_fitted { ", where tau starts" } else { "" };
    let known = known_offset(clock.tau()).map_or_else(String::new, |name| format!("; {name}"));
    let line = match clock {
        Clock::Given(tau) => format!("poses {tau:.3} s late, as given{start}"),
        Clock::Estimated(offset) => format!(
            "poses {:.3} s late (standard error {:.3} s){known}",
            offset.tau, offset.standard_error
        ),
        Clock::Unknown { reason, .. } => format!("taken as equal: {reason}"),
    };
    *text += &wrapped("  clock      ", &line);
}

/// How the poses follow the track speeds, where they do not follow at once.
fn response(text: &mut String, response: Option<&Response>) {
    let Some(response) = response.filter(|response| !response.is_at_once()) else { return };
    let (at_once, gap) = (response.gap_at_once, response.gap.value);
    let cause = if at_once > gap {
        "poses that are filtered, commands in place of speeds, or a robot that takes time to turn"
    } else {
        "track speeds that are filtered, or slip while they change"
    };
    *text += &wrapped(
        "  response   ",
        &format!(
            "the poses do not follow the track speeds at once ({cause}): x_r - x_l would be \
             {at_once:.3} m by a delay alone, and is {gap:.3} m over seconds. Track speeds are \
             weighted by the response that the log shows; intervals count what it leaves open"
        ),
    );
}

/// What a gyroscope tells, and how much better the distance of the ICRs is known by it.
fn gyroscope(text: &mut String, of: &GyroscopeUse, found: &Identification) {
    let gyroscope = match &of.found {
        Ok(gyroscope) => gyroscope,
        Err(reason) => {
            *text += &wrapped("  gyroscope  ", &format!("left out: {reason}"));
            return;
        }
    };
    *text += &wrapped("  gyroscope  ", &gyroscope.to_string());
    let [icrs, _] = &found.fits;
    if let (Ok(with), Some(without)) = (&icrs.least_squares, &of.gap_without_it) {
        let [with, without] = [with.gap().deviation, without.deviation];
        let _ = writeln!(
            text,
            "             standard error of x_r - x_l {with:.4} m, {without:.4} m without it"
        );
    }
}

fn noise(text: &mut String, found: &Identification) {
    let poses = found.noise.moving.as_ref().or(found.noise.standing.as_ref());
    let line = match poses {
        Some(poses) => format!(
            "poses {} mm forward, {} mm aside, {} mrad{}{} ({}, {})",
            or_below(1e3 * poses.forward.white, 1),
            or_below(1e3 * poses.lateral.white, 1),
            or_below(1e3 * poses.yaw.white, 2),
            wandering(poses),
            match poses.stamp {
                0.0 => String::new(),
                seconds => format!(", their stamps {:.0} ms", 1e3 * seconds),
            },
            poses.triples,
            poses.method
        ),
        None => match found.weights {
            Weights::Noise(_) => "as the recording states it".to_owned(),
            Weights::Residuals(SegmentNoise { pose, .. }) => {
                let [forward, lateral, yaw] = pose.map(|variance| 1e3 * variance.sqrt());
                format!(
                    "poses at most {} mm forward, {} mm aside, {} mrad (what constant ICRs leave: \
                     nothing rests or drives steadily)",
                    or_below(forward, 1),
                    or_below(lateral, 1),
                    or_below(yaw, 2)
                )
            }
            Weights::Equal => "not measurable: all segments count alike".to_owned(),
        },
    };
    *text += &wrapped("  noise      ", &line);
}

/// A number with so many decimals, or that it is below the smallest of these.
fn or_below(value: f64, decimals: usize) -> String {
    let least = 10_f64.powi(-i32::try_from(decimals).unwrap_or(1));
    if value < least / 2.0 {
        format!("below {least:.decimals$}")
    } else {
        format!("{value:.decimals$}")
    }
}

/// By how much poses wander whose noise shows from one to the next alone in part: as fixes do that
/// a receiver smooths.
fn wandering(poses: &PoseNoise) -> String {
    let [forward, lateral] = [&poses.forward, &poses.lateral].map(|of| [1e3 * of.white, of.walk]);
    let wanders = forward[1].max(lateral[1]) >= 5e-5;
    if !wanders || forward[0].min(lateral[0]) >= 0.05 {
        return String::new();
    }
    format!(
        ", and wander by {} mm and {} mm in a second",
        or_below(1e3 * forward[1], 1),
        or_below(1e3 * lateral[1], 1)
    )
}

fn fit(text: &mut String, fit: &Fit, gauge: f64, by_noise: bool) {
    let title = match fit.free {
        Free::Icrs => "ICRs, track speeds as measured",
        Free::IcrsAndAlphas => "ICRs and factors on the track speeds",
    };
    let _ = writeln!(text, "\n  {title}");
    let estimate = match &fit.least_squares {
        Ok(estimate) => estimate,
        Err(reason) => {
            *text += &wrapped("    ", &reason.to_string());
            return;
        }
    };
    if !fit.doubts.is_empty() {
        text.push_str("    not determined by this recording:\n");
        for doubt in &fit.doubts {
            *text += &wrapped("    - ", &doubt.to_string());
        }
        return;
    }
    contradicted(text, &fit.contradictions);
    parameters(text, fit, estimate, gauge);
    for doubt in &fit.refused {
        *text += &wrapped("    not fitted: ", &doubt.to_string());
    }
    let cut = if estimate.blocks.are_pieces() { "pieces of runs" } else { "runs" };
    let count = estimate.filled_blocks;
    let _ = if by_noise {
        let rms = estimate.whitened_rms;
        writeln!(
            text,
            "    residuals {rms:.2} times the noise; intervals from the noise and from {count} \
            {cut}"
        )
    } else {
        writeln!(text, "    intervals from the residuals and from {count} {cut}")
    };
}

fn parameters(text: &mut String, fit: &Fit, estimate: &Estimate, gauge: f64) {
    let _ =
        writeln!(text, "    {:8}{:>10}{:>24}{:>10}", "", "estimate", "95 % interval", "genetic");
    for k in 0..fit.free.count() {
        let Some(interval) = estimate.interval(k) else { continue };
        let unit = if Parameters::UNITS[k] == "m" { " m" } else { "" };
        row(text, Parameters::NAMES[k], &interval, Some(fit.genetic.parameters.0[k]), unit);
    }
    for &nuisance in &estimate.unknowns.nuisances {
        let Some(interval) = estimate.nuisance(nuisance) else { continue };
        row(text, nuisance.symbol(), &interval, None, &format!(" {}", nuisance.unit()));
    }
    let genetic = &fit.genetic_estimate;
    row(text, "x_r-x_l", &estimate.gap(), Some(genetic.gap().value), " m");
    let chi = |of: &Estimate| of.steering_efficiency(gauge);
    row(text, "chi", &chi(estimate), Some(chi(genetic).value), "");
    row(text, "e", &estimate.eccentricity(), Some(genetic.eccentricity().value), "");
}

fn row(text: &mut String, name: &str, interval: &Interval, genetic: Option<f64>, unit: &str) {
    let range = format!("{:.4} to {:.4}", interval.low, interval.high);
    let genetic = genetic.map_or_else(String::new, |value| format!("{value:.4}"));
    let _ = writeln!(text, "    {name:8}{:>10.4}{range:>24}{genetic:>10}{unit}", interval.value);
}
