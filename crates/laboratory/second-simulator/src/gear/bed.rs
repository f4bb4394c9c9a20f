//! Load of the shoes under a rigid track frame on springs.

use super::Shoe;

/// Largest part of the load, and of the load a metre away, that rounding may lose.
const MAX_LOAD_ERROR: f64 = 1e-9;

/// Replaces each shoe's spring stiffness, which stands in its load, by the load it carries.
///
/// # Law
/// The frame sinks by d and pitches by θ; a spring carries `k A (d + θ y)` where that presses and
/// nothing where it would pull. d and θ are those at which the springs carry N with its moment N
/// y_p. Springs that lift are taken out and the frame settles anew, until none changes.
///
/// # Assumes
/// Both sides bear their part of the weight at the same y_p: the hull lies on two cross-beams and
/// does not resist torsion. Under equal springs this is the linear pressure of the paper's Fig. 5.
///
/// # Errors
/// No springs carry the load there: the machine pitches over.
pub(super) fn settle(shoes: &mut [Shoe], load: f64, y_pressure: f64) -> Result<(), String> {
    let mut frame = [1.0, 0.0];
    let mut bearing = shoes.len() + 1;
    loop {
        let (mut k0, mut k1, mut k2, mut count) = (0.0, 0.0, 0.0, 0);
        for shoe in shoes.iter() {
            let y = shoe.position[1];
            if frame[0] + frame[1] * y > 0.0 {
                k0 += shoe.load;
                k1 += shoe.load * y;
                k2 += shoe.load * y * y;
                count += 1;
            }
        }
        let determinant = k0 * k2 - k1 * k1;
        if count >= bearing || determinant <= 0.0 {
            break;
        }
        bearing = count;
        frame = [
            load * (k2 - k1 * y_pressure) / determinant,
            load * (k0 * y_pressure - k1) / determinant,
        ];
    }
    let mut carried = [0.0, 0.0];
    for shoe in shoes {
        shoe.load *= (frame[0] + frame[1] * shoe.position[1]).max(0.0);
        carried[0] += shoe.load;
        carried[1] += shoe.load * shoe.position[1];
    }
    let off = (carried[0] - load).abs() + (carried[1] - load * y_pressure).abs();
    if off <= MAX_LOAD_ERROR * load {
        return Ok(());
    }
    let end = if y_pressure > 0.0 { "front" } else { "rear" };
    Err(format!("the load shifts beyond the {end} end and the robot pitches over"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> Vec<Shoe> {
        let shoe = |k: i32| Shoe {
            position: [0.0, 0.01 * f64::from(k)],
            area: 1.0,
            load: 1.0,
            ..Shoe::default()
        };
        (-30..=30).map(shoe).collect()
    }

    fn carried(shoes: &[Shoe]) -> [f64; 2] {
        let load = shoes.iter().map(|s| s.load).sum::<f64>();
        [load, shoes.iter().map(|s| s.load * s.position[1]).sum::<f64>() / load]
    }

    #[test]
    fn load_and_centre_of_pressure_are_those_asked_for() {
        // 0.09 m is inside the middle third, 0.15 m lifts the rear
        for y in [0.0, 0.04, -0.09, 0.15] {
            let mut shoes = row();
            settle(&mut shoes, 1000.0, y).expect("it bears");
            let [load, centre] = carried(&shoes);
            assert!((load - 1000.0).abs() < 1e-9 && (centre - y).abs() < 1e-9, "{y} {centre}");
            assert!(shoes.iter().all(|shoe| shoe.load >= 0.0));
        }
    }

    #[test]
    fn a_load_beyond_the_end_is_not_borne() {
        for (y, end) in [(0.301, "front"), (0.5, "front"), (-0.4, "rear")] {
            let error = settle(&mut row(), 1000.0, y).expect_err("no springs there");
            assert!(error.contains(end), "{error}");
        }
        settle(&mut row(), 1000.0, 0.28).expect("few springs bear");
    }

    #[test]
    fn equal_springs_press_linearly() {
        let mut shoes = row();
        settle(&mut shoes, 1000.0, 0.05).expect("it bears");
        for three in shoes.windows(3) {
            assert!((three[0].load - 2.0 * three[1].load + three[2].load).abs() < 1e-9);
        }
    }
}
