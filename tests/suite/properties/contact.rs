//! The closed form of the contact against an independent quadrature, and what any friction must
//! obey.

use crate::properties::tanh_sinh::integrate;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use trackdyn_core::{Dual, Scalar, Wrench};
use trackdyn_model::contact::{
    Friction, Patch, Pressure, Resolution, ShearStress, SlipField, closed_form, friction_wrench,
    quadrature,
};
use trackdyn_tests::uniform;

/// A patch with friction, pressure and the slip of a turn about an ICR.
#[derive(Clone, Copy, Debug)]
struct Case {
    patch: Patch,
    friction: Friction,
    pressure: Pressure,
    icr: [f64; 2],
    rotation: f64,
}

impl Case {
    /// A patch 0.02 to 1 m wide and 0.05 to 2 m long; the ICR inside, on an edge, on a corner, or
    /// up to `reach` patch sizes away.
    fn random(random: &mut ChaCha8Rng, reach: f64) -> Self {
        let width = uniform(random, 0.02_f64.ln(), 0.0).exp();
        let length = uniform(random, 0.05_f64.ln(), 2.0_f64.ln()).exp();
        let centre = [uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)];
        let patch = Patch::centred(centre, width, length);
        let size = width.hypot(length);
        let mut along = |edges: [f64; 2]| match random.random_range(0..4) {
            0 => edges[0],
            1 => edges[1],
            2 => uniform(random, edges[0], edges[1]),
            _ => uniform(random, edges[0] - reach * size, edges[1] + reach * size),
        };
        let icr = [along(patch.x), along(patch.y)];
        let gradient = uniform(random, -2.0, 2.0);
        Self {
            patch,
            friction: Friction {
                across: uniform(random, 0.1, 2.0),
                along: uniform(random, 0.1, 2.0),
            },
            pressure: Pressure { at_origin: 1.0 - gradient * centre[1], gradient },
            icr,
            rotation: if random.random() { 1.0 } else { -1.0 } * uniform(random, 0.1, 3.0),
        }
    }

    fn slip(&self) -> SlipField {
        Self::slip_about(self.icr, self.rotation)
    }

    fn slip_about<S: Scalar>([x, y]: [S; 2], rotation: f64) -> SlipField<S> {
        SlipField {
            lateral: y * rotation,
            forward: x * -rotation,
            rotation: S::from(rotation),
            speed: S::from(1.0),
        }
    }

    fn pressure<S: Scalar>(&self) -> Pressure<S> {
        Pressure {
            at_origin: S::from(self.pressure.at_origin),
            gradient: S::from(self.pressure.gradient),
        }
    }

    /// The friction wrench of patches in this case's ground and pressure, to all digits.
    fn wrench<S: Scalar>(&self, patches: &[Patch], slip: &SlipField<S>) -> Wrench<S> {
        let patches = patches.iter().map(|patch| Patch { x: patch.x, y: patch.y.map(S::from) });
        friction_wrench(patches, self.friction, &self.pressure(), slip, Resolution::Fine)
    }

    /// Friction that the whole patch can give, N, and that at its largest lever about the origin,
    /// N·m.
    fn scale(&self) -> [f64; 3] {
        let mu = self.friction.across.max(self.friction.along);
        let [x, y] = self.patch.centre();
        let lever = x.hypot(y) + self.patch.width().hypot(self.patch.length());
        let steepest = self.pressure.gradient.abs() * self.patch.length() / 2.0;
        let force = mu * self.patch.area() * (1.0 + steepest);
        [force, force, force * lever]
    }

    /// ∬ (τ_x, τ_y, x τ_y − y τ_x) with τ = −[μ] p s/|s|, written out from eqs (14), (15), (22).
    fn by_quadrature(&self) -> [f64; 3] {
        let [x_icr, y_icr] = self.icr;
        let u = self.patch.x.map(|x| x - x_icr);
        let v = self.patch.y.map(|y| y - y_icr);
        integrate(u, v, |u, v| {
            let (x, y) = (u + x_icr, v + y_icr);
            let pressure = self.pressure.at_origin + self.pressure.gradient * y;
            let (s_x, s_y) = (-self.rotation * v, self.rotation * u);
            let speed = s_x.hypot(s_y).max(f64::MIN_POSITIVE);
            let tau_x = -self.friction.across * pressure * s_x / speed;
            let tau_y = -self.friction.along * pressure * s_y / speed;
            [tau_x, tau_y, x * tau_y - y * tau_x]
        })
    }
}

fn components<S: Copy>(wrench: &Wrench<S>) -> [S; 3] {
    [wrench.force_x, wrench.force_y, wrench.moment]
}

#[test]
fn closed_form_equals_quadrature() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    for _ in 0..120 {
        let case = Case::random(&mut random, 2.0);
        let wrench = case.wrench(&[case.patch], &case.slip());
        let expected = case.by_quadrature();
        for ((ours, theirs), scale) in components(&wrench).iter().zip(expected).zip(case.scale()) {
            assert!((ours - theirs).abs() < 1e-11 * scale, "{ours} {theirs} {case:?}");
        }
    }
}

#[test]
fn derivatives_equal_difference_quotients_of_the_quadrature() {
    const STEP: f64 = 2e-4;
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let mut compared = 0;
    while compared < 20 {
        let case = Case::random(&mut random, 2.0);
        // Difference quotients want a smooth neighbourhood: no edge within many steps of the ICR.
        let clear = |edges: [f64; 2], at: f64| edges.iter().all(|edge| (edge - at).abs() > 0.02);
        if !(clear(case.patch.x, case.icr[0]) && clear(case.patch.y, case.icr[1])) {
            continue;
        }
        compared += 1;
        let slip = Case::slip_about(Dual::<2>::variables(case.icr), case.rotation);
        let exact = case.wrench(&[case.patch], &slip);
        for variable in 0..2 {
            let at = |steps: f64| {
                let mut moved = case;
                moved.icr[variable] += steps * STEP;
                moved.by_quadrature()
            };
            let (one, two) = ([at(1.0), at(-1.0)], [at(2.0), at(-2.0)]);
            for k in 0..3 {
                let near = (one[0][k] - one[1][k]) / (2.0 * STEP);
                let far = (two[0][k] - two[1][k]) / (4.0 * STEP);
                // Richardson's extrapolation: an error of (STEP/0.02)⁴
                let quotient = (4.0 * near - far) / 3.0;
                let tolerance = 1e-6 * case.scale()[k] / case.patch.width();
                let error = (components(&exact)[k].gradient[variable] - quotient).abs();
                assert!(error < tolerance, "{error} over {tolerance}: {case:?}");
            }
        }
    }
}

/// Where the Gauss rule takes over, both have the digits that the resolution asks for.
#[test]
fn far_field_takes_over_without_a_step() {
    for (resolution, half_diagonals, error) in
        [(Resolution::Fine, 6.0, 1e-11), (Resolution::Coarse, 50.0, 1e-8)]
    {
        let mut random = ChaCha8Rng::seed_from_u64(13);
        for _ in 0..500 {
            let mut case = Case::random(&mut random, 0.0);
            let distance = half_diagonals * case.patch.width().hypot(case.patch.length()) / 2.0;
            let direction = uniform(&mut random, 0.0, std::f64::consts::TAU);
            let [x, y] = case.patch.centre();
            case.icr = [x + distance * direction.cos(), y + distance * direction.sin()];
            let Case { patch, friction, .. } = case;
            let (pressure, slip) = (case.pressure(), case.slip());
            let patch = [patch];
            let near = closed_form::friction_wrench(patch.into_iter(), friction, &pressure, &slip);
            let far = quadrature::far_field_wrench(
                patch.into_iter(),
                friction,
                &pressure,
                &slip,
                resolution,
            );
            let pairs = components(&near).into_iter().zip(components(&far));
            for ((a, b), scale) in pairs.zip(case.scale()) {
                assert!((a - b).abs() < error * scale, "{a} {b} {case:?}");
            }
        }
    }
}

#[test]
fn patches_near_and_far_add_up() {
    let mut random = ChaCha8Rng::seed_from_u64(18);
    for _ in 0..2000 {
        let case = Case::random(&mut random, 0.0);
        let [x, y] = case.patch.centre();
        let far = Patch::centred(
            [x, y + 12.0 * case.patch.length()],
            case.patch.width(),
            case.patch.length(),
        );
        let of = |patches: &[Patch]| components(&case.wrench(patches, &case.slip()));
        let (both, near, far) = (of(&[case.patch, far]), of(&[case.patch]), of(&[far]));
        for k in 0..3 {
            assert!((both[k] - near[k] - far[k]).abs() <= 1e-13 * (near[k].abs() + far[k].abs()));
        }
    }
}

#[test]
fn friction_dissipates() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    for _ in 0..20_000 {
        let case = Case::random(&mut random, 30.0);
        // Only where the pressure is positive everywhere is it friction.
        if case.patch.y.iter().any(|&y| case.pressure.at(y) <= 0.0) {
            continue;
        }
        let slip = case.slip();
        let wrench = case.wrench(&[case.patch], &slip);
        // P = F · s(0) + M · rotation < 0
        let power = wrench.force_x * slip.lateral
            + wrench.force_y * slip.forward
            + wrench.moment * slip.rotation;
        assert!(power < 0.0, "{power} {case:?}");
    }
}

#[test]
fn friction_is_bounded_by_the_load() {
    let mut random = ChaCha8Rng::seed_from_u64(15);
    for _ in 0..5_000 {
        let case = Case::random(&mut random, 30.0);
        let wrench = case.wrench(&[case.patch], &case.slip());
        let [x, y] = [wrench.force_x / case.friction.across, wrench.force_y / case.friction.along];
        assert!(x.hypot(y) <= case.scale()[0] / case.friction.across.max(case.friction.along));
    }
}

/// The departure of a linear viscous law, −[μ] p c s, is a polynomial: its integral is elementary.
#[test]
fn departure_of_a_polynomial_law_is_exact() {
    let mut random = ChaCha8Rng::seed_from_u64(16);
    for _ in 0..200 {
        let case = Case::random(&mut random, 2.0);
        let slip = case.slip();
        let departure = quadrature::departure_wrench(
            [case.patch].into_iter(),
            case.friction,
            &case.pressure(),
            &slip,
            Resolution::Fine,
            |_, site| {
                let mut stress = ShearStress::base();
                stress.scale(site.unit_slip_length + 1.0);
                stress
            },
        );
        let expected = integrate(case.patch.x, case.patch.y, |x, y| {
            let pressure = case.pressure.at(y);
            let [s_x, s_y] = slip.direction_at([x, y]);
            let tau_x = -case.friction.across * pressure * s_x;
            let tau_y = -case.friction.along * pressure * s_y;
            [tau_x, tau_y, x * tau_y - y * tau_x]
        });
        let size = expected.iter().fold(0.0_f64, |size, e| size.max(e.abs()));
        for (ours, theirs) in components(&departure).iter().zip(expected) {
            assert!((ours - theirs).abs() < 1e-12 * size.max(1e-3), "{ours} {theirs} {case:?}");
        }
    }
}
