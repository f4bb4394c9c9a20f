//! Many robots at once: what a study of parameters calls.

use super::{Prepared, SimulateSettings, Simulation};
use crate::progress::Counter;
use crate::{Error, Observer, Vehicle};
use trackdyn_model::custom::together;

/// Simulates several robots, each with its seed in place of that of the settings, in parallel,
/// observed: a part is a robot. The results are in the order of the robots; one that cannot be
/// simulated has the error of [`Prepared::new`] or [`Prepared::run`] in its place.
///
/// # Errors
/// [`Error::Cancelled`].
pub fn simulate_all(
    robots: &[(Vehicle, u64)],
    settings: &SimulateSettings,
    observer: &Observer,
) -> Result<Vec<Result<Simulation, Error>>, Error> {
    let counter = Counter::new(observer, robots.len());
    let one = |(vehicle, seed): &(Vehicle, u64)| {
        counter.check()?;
        let settings = SimulateSettings { seed: *seed, ..settings.clone() };
        // within a robot nothing is told: it is only asked whether to go on
        let prepared = Prepared::new(vehicle, &settings);
        let simulated = prepared.and_then(|prepared| prepared.run(&|_| counter.state()));
        let is_wanted = counter.advance("robots", 1).is_continue();
        is_wanted.then_some(simulated).ok_or(Error::Cancelled)
    };
    let share_calls = robots.iter().any(|(vehicle, _)| vehicle.effects().share_calls());
    together(robots, share_calls, one).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::simulate;
    use crate::unobserved;
    use std::ops::ControlFlow;

    fn settings() -> SimulateSettings {
        SimulateSettings { runs: Some(1), duration: Some(5.0), ..SimulateSettings::default() }
    }

    #[test]
    fn each_is_the_simulation_of_that_robot_and_seed() {
        let tall = Vehicle::auriga_alpha()
            .with_effect("load-transfer:cog_height_m=0.05")
            .expect("an effect");
        let robots = [(Vehicle::auriga_alpha(), 1), (tall.clone(), 1), (tall, 7)];
        let all = simulate_all(&robots, &settings(), &unobserved).expect("nobody stops it");
        assert_eq!(all.len(), robots.len());
        for (found, (vehicle, seed)) in all.iter().zip(&robots) {
            let alone = simulate(vehicle, &SimulateSettings { seed: *seed, ..settings() });
            let (found, alone) = (found.as_ref().expect("it drives"), alone.expect("it drives"));
            assert_eq!(found.recording.fingerprint(), alone.recording.fingerprint());
        }
        let prints: Vec<_> = all.iter().flatten().map(|one| one.recording.fingerprint()).collect();
        assert_ne!(prints[1], prints[2]);
    }

    #[test]
    fn one_that_fails_leaves_the_others() {
        let tips = Vehicle::auriga_alpha().with_effect("load-transfer:cog_height_m=2");
        let robots = [(tips.expect("an effect"), 1), (Vehicle::auriga_alpha(), 1)];
        let all = simulate_all(&robots, &settings(), &unobserved).expect("nobody stops it");
        assert!(matches!(all[0], Err(Error::Run { .. })) && all[1].is_ok());
    }

    #[test]
    fn it_stops_when_asked_to() {
        let robots = [(Vehicle::auriga_alpha(), 1), (Vehicle::auriga_alpha(), 2)];
        let stopped = simulate_all(&robots, &settings(), &|_| ControlFlow::Break(()));
        assert!(matches!(stopped, Err(Error::Cancelled)));
    }
}
