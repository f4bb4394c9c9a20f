//! What plans must separate, and what they cannot, on Auriga-alpha.

use super::*;
use std::ops::ControlFlow;
use trackdyn_core::document::Document;

/// A question whose fitted effect is the first member, at this size.
fn question(members: &[&str], parameters: &str) -> Vec<Question> {
    let list: Vec<String> = members.iter().map(|id| format!("\"{id}\"")).collect();
    let text = format!(
        "schema = \"trackdyn.diagnosis/1\"\nstatus = \"ambiguous\"\n\
         located = {{ excess_over_noise = 2.0, channels = {{ lateral = 1.0, longitudinal = 0.0, \
         yaw = 0.0 }}, \
         broken = [], where = \"\" }}\n\
         fit = {{ held_out_before = 2.0, held_out_after = 1.0, noise_floor = 1.0, \
         excess_explained = 1.0 }}\n\
         [[missing]]\neffect = {}\none_of = [{}]\nparameters = [{parameters}]\n\
         evidence = {{ p = 0.001, ln_bayes_factor = 20.0, held_out_gain = 20.0 }}\n",
        list[0],
        list.join(", ")
    );
    Question::of(&Document::new("diagnosis.toml", text)).expect("a diagnosis")
}

fn planned(members: &[&str], parameters: &str, file: &VehicleFile) -> Plan {
    let plan = plan(&question(members, parameters), file, &Options::default(), &|_| {
        ControlFlow::Continue(())
    });
    let plan = plan.expect("a plan");
    for pair in &plan.pairs {
        let [a, b] = pair.effects.map(trackdyn_model::EffectId::name);
        println!("{a} | {b}: z {:.2}, menu {:.2}, {:?}", pair.z, pair.menu, pair.answer);
    }
    for step in &plan.steps {
        println!("  {:5.2} s {:50} {:.2?}", step.manoeuvre.duration(), step.manoeuvre.name, step.z);
    }
    plan
}

#[test]
fn a_clock_and_a_lag_differ_where_speeds_change_only() {
    let file = VehicleFile::auriga_alpha();
    let members = ["time-offset", "drivetrain-lag"];
    let plan = planned(
        &members,
        "{ name = \"delay_s\", value = 0.12, low95 = 0.1, high95 = 0.14, unit = \"s\" }",
        &file,
    );
    // Sharper than any gentle ramp up to the same speed.
    let gentle = Options::default().fastest / 0.51;
    let Manoeuvre { name, interval, speeds } = &plan.steps[0].manoeuvre;
    let changes = speeds
        .windows(2)
        .map(|pair| (pair[1].left - pair[0].left).abs().max((pair[1].right - pair[0].right).abs()));
    let sharpest = changes.fold(0.0, f64::max) / interval;
    assert!(sharpest > 1.5 * gentle, "{name}: {sharpest}");
    // Steady driving: constant readings.
    let question = &question(&members, "")[0];
    let menu = menu(1.0, 0.83, &Options::default().method);
    let class = Class::new(question, &file, &menu, &Options::default()).expect("a class");
    let steady = Manoeuvre {
        name: String::new(),
        interval: *interval,
        speeds: vec![PerSide::new(0.3, 0.9); 30 * crate::evidence::planned::READINGS],
    };
    let products = class.products(&[run(&[&steady], 0.0, Pose::default())], &Options::default());
    let z = squared(products[0].total(), &class.pairs[0].prior).sqrt();
    // Far below the resolution of one pose.
    assert!(z < 0.1, "{z}");
}

#[test]
fn resistance_and_a_drag_behind_are_told_apart_within_a_minute() {
    let plan = planned(
        &["motion-resistance", "hitch-drag"],
        "{ name = \"coefficient\", value = 0.05, low95 = 0.04, high95 = 0.06, unit = \"1\" }",
        &VehicleFile::auriga_alpha(),
    );
    assert!(plan.pairs[0].z > 5.0 && plan.pairs[0].answer == Answer::Plan);
    assert!(plan.duration() <= 60.0 + 1e-9);
    let squares: f64 = plan.steps.iter().map(|step| step.z[0].powi(2)).sum();
    // The rest is the penalty of the unknowns' priors.
    assert!((squares.sqrt() / plan.pairs[0].z - 1.0).abs() < 0.05);
    let schedule = plan.schedule().expect("a schedule");
    assert!((schedule.duration() - plan.duration()).abs() < 1e-6);
    let sizes = schedule.commands().iter().map(|c| c.speeds.left.abs().max(c.speeds.right.abs()));
    assert!(sizes.fold(0.0, f64::max) <= 1.0);
}

#[test]
fn what_only_moves_constant_icrs_is_never_told_apart() {
    let plan = planned(
        &["cog-shift", "friction-split"],
        "{ name = \"x_m\", value = 0.02, low95 = 0.01, high95 = 0.03, unit = \"m\" }, \
         { name = \"y_m\", value = 0.0, low95 = -0.01, high95 = 0.01, unit = \"m\" }",
        &VehicleFile::auriga_alpha(),
    );
    assert_eq!(plan.pairs[0].answer, Answer::Never);
    assert!(plan.steps.is_empty() && plan.schedule().is_none());
    assert_eq!(measurements(plan.pairs[0].effects).len(), 2);
}

/// Mirrored members are separated as well as before.
#[test]
fn mirrored_members_have_the_same_separation() {
    let members = ["resistance-split", "motion-resistance", "encoder-scale"];
    let z = |sign: f64| {
        let mut file = VehicleFile::auriga_alpha();
        file.vehicle.cog[0] *= sign;
        let size = sign * 0.05;
        let parameter = format!(
            "{{ name = \"difference\", value = {size}, low95 = {size}, high95 = {size}, unit = \
             \"1\" }}"
        );
        let plan = planned(&members, &parameter, &file);
        plan.pairs.iter().map(|pair| pair.z).collect::<Vec<f64>>()
    };
    for (one, other) in z(1.0).into_iter().zip(z(-1.0)) {
        assert!((one / other - 1.0).abs() < 0.03, "{one} {other}");
    }
}
