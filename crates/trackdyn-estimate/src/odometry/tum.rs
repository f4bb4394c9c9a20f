//! Paths in the format of the TUM RGB-D benchmark: lines `t x y z qx qy qz qw`.

use std::fmt::Write;
use trackdyn_core::Pose;

/// The text of a path. Numbers are printed so that reading them gives the same bits.
///
/// # Sources
/// <https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats>
pub fn text(stamps: &[f64], poses: &[Pose]) -> String {
    let mut text = String::from("# t x y z qx qy qz qw\n");
    for (t, Pose { x, y, yaw }) in stamps.iter().zip(poses) {
        let (sin, cos) = (yaw / 2.0).sin_cos();
        let _ = writeln!(text, "{t} {x} {y} 0 0 0 {sin} {cos}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_is_half_in_the_quaternion() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let text = text(&[1.5], &[Pose::new(0.25, -2.0, quarter)]);
        let line = text.lines().nth(1).expect("a pose");
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().expect("a number")).collect();
        let half = (quarter / 2.0).sin();
        assert_eq!(numbers[..6], [1.5, 0.25, -2.0, 0.0, 0.0, 0.0]);
        assert!((numbers[6] - half).abs() < 1e-15 && (numbers[7] - half).abs() < 1e-15);
    }
}
