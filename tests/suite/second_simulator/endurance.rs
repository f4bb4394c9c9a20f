//! Whatever is switched on, a robot that can drive does.

use crate::second_simulator::turn::{auriga, typical};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::time::Instant;
use trackdyn_core::{Command, PerSide, Plant, Schedule};
use trackdyn_model::{RunningGear, Vehicle};
use trackdyn_second_simulator::{ActiveMechanism, Form, MECHANISMS, Robot, Setup};

/// Steps, ramps and standstill as a restless driver makes them, s.
fn restless(random: &mut ChaCha8Rng, duration: f64) -> Schedule {
    let mut commands = Vec::new();
    let (mut t, mut speeds) = (0.0, PerSide::new(0.0, 0.0));
    while t < duration {
        commands.push(Command { t, speeds });
        if random.random::<f64>() < 0.3 {
            t += 0.5 + random.random::<f64>();
            let mut draw = || 2.0 * random.random::<f64>() - 1.0;
            speeds = PerSide::new(draw(), draw());
            if draw() < -0.6 {
                speeds = PerSide::new(speeds.left, speeds.left);
            } else if draw() < -0.8 {
                speeds = PerSide::new(0.0, 0.0);
            }
        } else {
            t += 0.05;
            speeds = speeds.map(|speed| speed + 0.05 * (random.random::<f64>() - 0.5));
        }
    }
    Schedule::new(commands).expect("a schedule")
}

fn drives(
    vehicle: &Vehicle,
    active: &[ActiveMechanism],
    schedule: &Schedule,
) -> Result<f64, String> {
    let begin = Instant::now();
    let mut robot =
        Robot::new(vehicle, active, &Setup::default()).map_err(|error| error.to_string())?;
    let way = robot.follow(schedule).map_err(|stop| stop.to_string())?;
    let end = way.moments().last().expect("a motion");
    assert!((end.pose.x + end.pose.y + end.pose.yaw).is_finite(), "{active:?}");
    Ok(begin.elapsed().as_secs_f64() / schedule.duration())
}

fn wheeled() -> Vehicle {
    Vehicle {
        running_gear: RunningGear::Wheels {
            contact_length: 0.1,
            width: 0.12,
            axles: vec![0.256, -0.256],
        },
        ..auriga([-0.015, 0.04])
    }
}

#[test]
fn every_mechanism_drives_restlessly_on_tracks_and_wheels() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut stopped = Vec::new();
    for (number, sheet) in (0..).zip(MECHANISMS) {
        let mut forms = typical(&[sheet.id]);
        if sheet.family.is_some() {
            forms.push(forms[0].clone().with(Form::Drawn(number)).expect("a form"));
        }
        for (name, vehicle) in [("tracks", auriga([-0.015, 0.04])), ("wheels", wheeled())] {
            let schedule = restless(&mut random, 10.0);
            for active in &forms {
                match drives(&vehicle, std::slice::from_ref(active), &schedule) {
                    Ok(cost) => println!("{active} {name}: {:.3} s for a minute", 60.0 * cost),
                    Err(reason) => stopped.push(format!("{active} on {name}: {reason}")),
                }
            }
        }
    }
    assert!(stopped.is_empty(), "{stopped:#?}");
}

#[test]
fn pairs_of_mechanisms_drive_restlessly() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    let vehicle = auriga([-0.015, 0.04]);
    let mut stopped = Vec::new();
    for _ in 0..60 {
        let a = random.random_range(0..MECHANISMS.len());
        let b = (a + random.random_range(1..MECHANISMS.len())) % MECHANISMS.len();
        let ids = [MECHANISMS[a].id, MECHANISMS[b].id];
        if let Err(reason) = drives(&vehicle, &typical(&ids), &restless(&mut random, 10.0)) {
            stopped.push(format!("{ids:?}: {reason}"));
        }
    }
    assert!(stopped.is_empty(), "{stopped:#?}");
}
