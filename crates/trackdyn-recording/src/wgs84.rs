//! Places of latitude and longitude in metres, on the ellipsoid of WGS84.
//!
//! # Sources
//! NIMA TR8350.2, WGS84 (ellipsoid).

/// Semi-major axis of the ellipsoid, m.
const SEMI_MAJOR_AXIS: f64 = 6_378_137.0;

/// Flattening of the ellipsoid.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// Position on the ellipsoid's axes (ECEF), m.
fn ecef([latitude, longitude, altitude]: [f64; 3]) -> [f64; 3] {
    let (sin_lat, cos_lat) = latitude.to_radians().sin_cos();
    let (sin_lon, cos_lon) = longitude.to_radians().sin_cos();
    // e² = f (2 - f), N = a / sqrt(1 - e² sin² φ)
    let e2 = FLATTENING * (2.0 - FLATTENING);
    let n = SEMI_MAJOR_AXIS / (1.0 - e2 * sin_lat * sin_lat).sqrt();
    let to_axis = (n + altitude) * cos_lat;
    [to_axis * cos_lon, to_axis * sin_lon, (n * (1.0 - e2) + altitude) * sin_lat]
}

/// Metres east and north of an origin, in the plane that touches the ellipsoid there. Both are
/// latitude (degrees), longitude (degrees) and altitude (m).
pub(crate) fn east_north(origin: [f64; 3], fix: [f64; 3]) -> [f64; 2] {
    let (start, end) = (ecef(origin), ecef(fix));
    let [dx, dy, dz] = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
    let (sin_lat, cos_lat) = origin[0].to_radians().sin_cos();
    let (sin_lon, cos_lon) = origin[1].to_radians().sin_cos();
    // e = -sin λ dx + cos λ dy;  n = -sin φ (cos λ dx + sin λ dy) + cos φ dz
    let east = -sin_lon * dx + cos_lon * dy;
    let north = -sin_lat * (cos_lon * dx + sin_lon * dy) + cos_lat * dz;
    [east, north]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths of a degree at 45 degrees north (NGA): 111 131.75 m of latitude, 78 846.81 m of
    /// longitude, known to a centimetre.
    #[test]
    fn a_ten_thousandth_of_a_degree_has_its_length() {
        let origin = [45.0, 8.0, 0.0];
        let [east, north] = east_north(origin, [45.000_1, 8.0, 0.0]);
        assert!(east.abs() < 1e-6 && (north - 11.113_175).abs() < 1e-4, "{east} {north}");
        let [east, north] = east_north(origin, [45.0, 8.000_1, 0.0]);
        assert!((east - 7.884_681).abs() < 1e-4 && north.abs() < 1e-4, "{east} {north}");
        let [east, north] = east_north(origin, [45.0, 8.0, 30.0]);
        assert!(east.hypot(north) < 1e-6);
    }
}
