//! Integrals along an arc by their series. They give the same bits on every machine, unlike the
//! sines of the system, and the compiler can vectorise them.

/// Angle, rad, up to which [`arc`] is exact to 1e-10.
pub(crate) const MAX_SERIES_ANGLE: f64 = 2.0;

/// sin a/a and (1 − cos a)/a by their series, to rounding up to a = 0.8 and to 1e-10 up to a = 2.
#[inline]
pub(crate) fn arc(a: f64) -> (f64, f64) {
    let q = a * a;
    // 1/3!, 1/5!, ... and 1/2!, 1/4!, ...
    let s = 1.0
        - q * (1.0 / 6.0
            - q * (1.0 / 120.0
                - q * (1.0 / 5040.0
                    - q * (1.0 / 362_880.0
                        - q * (1.0 / 39_916_800.0
                            - q * (1.0 / 6_227_020_800.0 - q * (1.0 / 1_307_674_368_000.0)))))));
    let c = a
        * (0.5
            - q * (1.0 / 24.0
                - q * (1.0 / 720.0
                    - q * (1.0 / 40_320.0
                        - q * (1.0 / 3_628_800.0
                            - q * (1.0 / 479_001_600.0
                                - q * (1.0 / 87_178_291_200.0
                                    - q * (1.0 / 20_922_789_888_000.0))))))));
    (s, c)
}

/// What [`arc`] gives, for any angle and to 1e-10 for each 2 rad: the angle is halved, with
/// sin 2h = 2 sin h cos h and 1 − cos 2h = 2 sin² h.
pub(crate) fn any_arc(a: f64) -> (f64, f64) {
    if a.abs() <= MAX_SERIES_ANGLE {
        return arc(a);
    }
    let h = 0.5 * a;
    let (s, c) = any_arc(h);
    (s * (1.0 - c * h), s * s * h)
}

/// Real and imaginary part of ∫₀¹ u e^{iau} du by their series, to rounding up to a = 0.8.
#[inline]
pub(super) fn moment(a: f64) -> (f64, f64) {
    let q = a * a;
    // 1/(n! (n + 2)) for even and for odd n
    let real = 0.5
        - q * (1.0 / 8.0
            - q * (1.0 / 144.0
                - q * (1.0 / 5760.0
                    - q * (1.0 / 403_200.0
                        - q * (1.0 / 43_545_600.0
                            - q * (1.0 / 6_706_022_400.0 - q * (1.0 / 1_394_852_659_200.0)))))));
    let imaginary = a
        * (1.0 / 3.0
            - q * (1.0 / 30.0
                - q * (1.0 / 840.0
                    - q * (1.0 / 45_360.0
                        - q * (1.0 / 3_991_680.0
                            - q * (1.0 / 518_918_400.0
                                - q * (1.0 / 93_405_312_000.0
                                    - q * (1.0 / 22_230_464_256_000.0))))))));
    (real, imaginary)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_angle_is_within_reach() {
        for step in -80..=80 {
            let a = f64::from(step) / 4.0 + 0.1;
            let (s, c) = any_arc(a);
            let (sine, versine) = (a.sin(), 2.0 * (0.5 * a).sin().powi(2));
            assert!((s * a - sine).abs() < 1e-8 && (c * a - versine).abs() < 1e-8, "{a}: {s} {c}");
        }
    }

    #[test]
    fn series_are_the_integrals() {
        for step in 1..=16 {
            let a = f64::from(step) / 20.0;
            let (s, c) = arc(a);
            let (real, imaginary) = moment(a);
            let pairs = [
                (s, a.sin() / a),
                (c, 2.0 * (0.5 * a).sin().powi(2) / a),
                // ∫ u e^{iau} du = (e^{ia} − ∫ e^{iau} du)/(ia): a difference of near numbers,
                // hence the a
                (a * real, a.sin() - c),
                (a * imaginary, s - a.cos()),
            ];
            for (series, integral) in pairs {
                // a few roundings of numbers near 1
                assert!((series - integral).abs() < 1e-15, "{a}: {series} {integral}");
            }
            assert_eq!(moment(-a), (real, -imaginary));
        }
    }
}
