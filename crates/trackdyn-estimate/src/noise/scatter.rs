//! Noise of a table of steady operating points.

use super::Settings;
use trackdyn_core::real;
use trackdyn_core::robust::deviation_about_zero;
use trackdyn_recording::OperatingPoint;

/// Three neighbours on a line of one track speed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LineTriple {
    /// Their other track speed, ascending, m/s.
    across: [f64; 3],
    /// How far the middle one lies off the straight line through the outer two, in the channel's
    /// unit and such that it scatters as a single reading does.
    off: f64,
}

/// The triples of neighbours on all lines of one track speed, in a channel; no model enters.
fn line_triples(
    points: &[OperatingPoint],
    channel: impl Fn(&OperatingPoint) -> Option<f64>,
) -> Vec<LineTriple> {
    let mut triples = Vec::new();
    for shared in [|point: &OperatingPoint| point.v_right, |point: &OperatingPoint| point.v_left] {
        let across = |point: &OperatingPoint| point.v_left + point.v_right - shared(point);
        let mut line: Vec<(f64, f64, f64)> = points
            .iter()
            .filter_map(|point| Some((shared(point), across(point), channel(point)?)))
            .collect();
        line.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for triple in line.windows(3) {
            let [(a, x, left), (b, y, middle), (c, z, right)] = [triple[0], triple[1], triple[2]];
            if a != b || b != c || x >= y || y >= z {
                continue;
            }
            let part = (y - x) / (z - x);
            let off = middle - (1.0 - part) * left - part * right;
            let gain = (1.0 + part * part + (1.0 - part) * (1.0 - part)).sqrt();
            triples.push(LineTriple { across: [x, y, z], off: off / gain });
        }
    }
    triples
}

/// Standard deviation of a channel, in its unit, from neighbours on lines of one track speed; no
/// model enters. None without enough of them.
pub fn scatter(
    points: &[OperatingPoint],
    channel: impl Fn(&OperatingPoint) -> Option<f64>,
    settings: &Settings,
) -> Option<f64> {
    // The ICRs may jump where a track changes its direction.
    let jumps = |[x, y, z]: [f64; 3]| x * y < 0.0 || y * z < 0.0 || x.abs().min(z.abs()) < 1e-9;
    let triples = line_triples(points, channel).into_iter();
    let smooth = triples.filter(|triple| !jumps(triple.across));
    let mut off: Vec<f64> = smooth.map(|triple| triple.off).collect();
    if off.len() < settings.min_line_triples {
        return None;
    }
    let rms = (off.iter().map(|off| off * off).sum::<f64>() / real(off.len())).sqrt();
    let median = deviation_about_zero(&mut off)?;
    // Where most readings are rounded away the median says nothing.
    Some(if median > 0.0 { median } else { rms }).filter(|scatter| *scatter > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line at one speed of the right track, whose yaw rates lie in turn on both sides of a
    /// straight line, and jump where the left track turns back.
    fn line(count: i32) -> Vec<OperatingPoint> {
        let point = |k: i32| {
            let v_left = 0.1 * f64::from(k) - 0.55;
            let off = if k % 2 == 0 { 1e-3 } else { -1e-3 };
            let jump = if v_left < 0.0 { 0.5 } else { 0.0 };
            let yaw_rate = Some(0.4 - v_left + jump + off);
            OperatingPoint { v_left, v_right: 0.4, yaw_rate, ..OperatingPoint::default() }
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn scatter_is_of_smooth_lines_that_are_long_enough() {
        let found = |count| scatter(&line(count), |point| point.yaw_rate, &Settings::default());
        let long = found(18).expect("a scatter");
        // 2e-3 off, over √1.5, in place of a standard deviation: 1.48 times the median
        assert!((long / (1.4826 * 2e-3 / 1.5_f64.sqrt()) - 1.0).abs() < 0.01, "{long}");
        assert_eq!(found(6), None);
    }
}
