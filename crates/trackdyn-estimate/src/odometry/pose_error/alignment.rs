//! Laying one path over another.

use trackdyn_core::{Pose, real};

/// The motion of the plane that brings the estimated places nearest to those of the reference, in
/// the sense of least squares: `reference_from_estimate`, to be composed with the estimate's poses.
///
/// # Law
/// Umeyama 1991 without scale, in the plane: ψ = atan2(Σ p × q, Σ p · q) of the places about their
/// means, t = q̄ − R(ψ) p̄.
///
/// # Assumes
/// The plane is not turned over. In space `evo` may turn it over, which fits better where the
/// estimate looks more like the mirror image of the reference than like the reference.
pub fn align(reference: &[Pose], estimate: &[Pose]) -> Pose {
    let mean = |path: &[Pose]| {
        let count = real(path.len().max(1));
        let sum = path.iter().fold([0.0, 0.0], |[x, y], pose| [x + pose.x, y + pose.y]);
        sum.map(|sum| sum / count)
    };
    let (of_reference, of_estimate) = (mean(reference), mean(estimate));
    let (mut dot, mut cross) = (0.0, 0.0);
    for (q, p) in reference.iter().zip(estimate) {
        let q = [q.x - of_reference[0], q.y - of_reference[1]];
        let p = [p.x - of_estimate[0], p.y - of_estimate[1]];
        dot += p[0] * q[0] + p[1] * q[1];
        cross += p[0] * q[1] - p[1] * q[0];
    }
    let yaw = cross.atan2(dot);
    let turned = Pose::new(0.0, 0.0, yaw).compose(&Pose::new(of_estimate[0], of_estimate[1], 0.0));
    Pose::new(of_reference[0] - turned.x, of_reference[1] - turned.y, yaw)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_path_is_moved_back() {
        let reference: Vec<Pose> =
            (0..9).map(f64::from).map(|k| Pose::new(k, 0.3 * k * k, 0.1 * k)).collect();
        let moved = Pose::new(3.0, -7.0, 2.5);
        let estimate: Vec<Pose> = reference.iter().map(|pose| moved.compose(pose)).collect();
        let back = align(&reference, &estimate).compose(&moved);
        assert!(back.x.abs() < 1e-12 && back.y.abs() < 1e-12 && back.yaw.abs() < 1e-12);
    }
}
