//! Waves of the ground.
//!
//! # Law
//! Any dependence on place is a sum of waves. To first order a field φ of the ground's friction
//! moves half the distance of the ICRs with its value, and their middle and y with its gradient
//! across and along the body:
//!
//! δh ∝ φ,  δa ∝ ∂φ/∂left,  δy ∝ ∂φ/∂forward,  φ = A cos k·p + B sin k·p
//!
//! so that each wave number k has six columns. Wave numbers are as dense as the driven area
//! resolves, longest waves first.

use super::{Along, Part, Resolved};
use crate::evidence::{Evidence, Sample};
use crate::fit::Fit;
use crate::locate::IcrColumns;
use crate::locate::departures::middle_half_y;
use crate::weighted::Weighted;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{PI, TAU};
use trackdyn_core::real;

/// Waves of the ground; none where samples share no world.
pub fn resolved<'a>(evidence: &'a Weighted, _fit: &Fit, icrs: &IcrColumns) -> Option<Resolved<'a>> {
    if !evidence.has_world() {
        return None;
    }
    let departures = middle_half_y(icrs);
    let numbers = numbers(evidence);
    let wave = |number: &Vector2<f64>| {
        (TAU / number.norm(), Along::Ground { direction: (number.y / number.x).atan() })
    };
    let waves = numbers.iter().map(wave).collect();
    let columns = move |wave: usize| columns(evidence, &departures, numbers[wave]).into();
    let whole = Part { samples: 0..evidence.samples().len(), blocks: 0..evidence.blocks() };
    Some(Resolved { evidence, waves, columns: Box::new(columns), parts: vec![whole] })
}

/// Wave vectors k, rad/m, one of each pair ±k, longest waves first.
fn numbers(evidence: &Evidence) -> Vec<Vector2<f64>> {
    let settings = &evidence.settings().location;
    // without the outermost poses, which may be stray
    let extent = |of: &dyn Fn(&Sample) -> f64| {
        let mut values: Vec<f64> = evidence.samples().iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of them"
        )]
        let aside = (settings.outer_share * real(values.len())) as usize;
        let [low, high] = [values[aside], values[values.len() - 1 - aside]];
        (high - low).max(2.0 * settings.min_wavelength)
    };
    let step = Vector2::new(extent(&|s| s.pose.x), extent(&|s| s.pose.y))
        .map(|extent| TAU / (settings.waves_per_length * extent));
    // half an ellipse holds π/2 K²/(Δk_x Δk_y) wave vectors
    let largest = (2.0 * real(settings.max_waves) * step.x * step.y / PI).sqrt();
    let largest = largest.min(TAU / settings.min_wavelength);
    let multiples =
        |step: f64| (0..).map(move |k: u32| step * f64::from(k)).take_while(move |k| *k <= largest);
    // k and −k are equivalent
    let other = |[x, y]: [f64; 2]| (x > 0.0 && y > 0.0).then_some([x, -y]);
    let mut numbers: Vec<Vector2<f64>> = multiples(step.x)
        .flat_map(|x| multiples(step.y).map(move |y| [x, y]))
        .flat_map(|number| std::iter::once(number).chain(other(number)))
        .map(Vector2::from)
        .filter(|number| number.norm() > 0.0 && number.norm() <= largest)
        .collect();
    numbers.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    numbers
}

/// The six columns of a wave, not whitened.
fn columns(
    evidence: &Evidence,
    [middle, half, y]: &[Vec<Vector3<f64>>; 3],
    number: Vector2<f64>,
) -> [Vec<Vector3<f64>>; 6] {
    let mut columns = std::array::from_fn(|_| Vec::with_capacity(half.len()));
    let across_crests = number.normalize();
    for (k, sample) in evidence.samples().iter().enumerate() {
        let pose = &sample.pose;
        let (phase_sin, phase_cos) = (number.x * pose.x + number.y * pose.y).sin_cos();
        let (sin, cos) = pose.yaw.sin_cos();
        let left = across_crests.y * cos - across_crests.x * sin;
        let forward = across_crests.x * cos + across_crests.y * sin;
        let by = [half[k], middle[k] * left, y[k] * forward];
        for (place, departure) in by.into_iter().enumerate() {
            columns[2 * place].push(departure * phase_cos);
            columns[2 * place + 1].push(departure * phase_sin);
        }
    }
    columns
}
