//! A law that fails ends the work, and says why.

use std::sync::atomic::{AtomicUsize, Ordering};
use trackdyn::law::{Argument, CustomLaw, Declared, register};
use trackdyn::simulate::Driving;
use trackdyn::{Error, IcrMap, MapSettings, SimulateSettings, Vehicle, simulate, unobserved};

fn settings() -> SimulateSettings {
    SimulateSettings {
        driving: Driving::default(),
        runs: Some(2),
        duration: Some(4.0),
        ..SimulateSettings::default()
    }
}

/// A robot with a law that fails in the wanted way, though not at its typical strength.
fn robot(id: &str, fails: fn(f64) -> Result<f64, String>) -> Vehicle {
    let size = Declared::size("strength", "N", 1.0);
    let law = CustomLaw::force(id, "", &[size], move |at, values, adds| {
        for (force, v) in adds.column(0).iter_mut().zip(at.column(Argument::ForwardSpeed)) {
            *force = if values[0] > 1.0 { fails(*v)? } else { 0.0 };
        }
        Ok(())
    });
    register(law.expect("it can be defined")).expect("it does not fail at first");
    Vehicle::auriga_alpha().with_effect(&format!("{id}:strength=7")).expect("registered")
}

#[test]
fn its_words_and_numbers_come_out() {
    let raising = robot("my-limit", |v| {
        if v.abs() > 0.2 { Err(format!("{v} m/s is too fast")) } else { Ok(0.0) }
    });
    let error = simulate(&raising, &settings()).expect_err("it fails");
    assert!(matches!(error, Error::Law(_)), "{error:?}");
    let said = error.to_string();
    assert!(said.starts_with("law \"my-limit\" (strength = 7): "), "{said}");
    assert!(said.ends_with("too fast"), "{said}");

    let undefined = robot("my-hole", |v| Ok(if v.abs() > 0.2 { f64::NAN } else { 0.0 }));
    for error in [
        simulate(&undefined, &settings()).expect_err("it fails"),
        IcrMap::solve(&undefined, &MapSettings::default(), &unobserved).expect_err("it fails"),
    ] {
        let said = error.to_string();
        let names = ["my-hole", "strength = 7", "forward force NaN", "v_forward = ", "finite"];
        assert!(names.iter().all(|name| said.contains(name)), "{said}");
    }
}

/// Afterwards the same law and others work.
#[test]
fn a_failure_leaves_nothing_behind() {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    let once = robot("my-mood", |_| match CALLS.fetch_add(1, Ordering::Relaxed) {
        500 => Err("not now".to_owned()),
        _ => Ok(0.0),
    });
    assert!(simulate(&once, &settings()).expect_err("it fails").to_string().contains("not now"));
    let again = simulate(&once, &settings()).expect("it works");
    let without = simulate(&Vehicle::auriga_alpha(), &settings()).expect("it works");
    let end = |of: &trackdyn::Simulation| of.paths[0].1.moments().last().copied();
    let [again, without] = [again, without].map(|of| end(&of).expect("moments").pose);
    assert!((again.x - without.x).hypot(again.y - without.y) < 1e-9);
}

#[test]
fn a_law_that_fails_at_once_is_not_registered() {
    let size = Declared::size("strength", "N", 1.0);
    let law = CustomLaw::force("my-doubt", "", &[size], |_, _, _| Err("never".into()));
    let error = register(law.expect("defined")).expect_err("it fails").to_string();
    assert!(error.contains("my-doubt") && error.contains("never"), "{error}");
    assert!(trackdyn::EffectId::of("my-doubt").is_none());
}
