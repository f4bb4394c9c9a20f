//! What was simulated, in one screen.

use std::fmt::Write;
use trackdyn::Simulation;
use trackdyn_second_simulator::ActiveMechanism;

/// What the user sees.
pub fn text(simulation: &Simulation, mechanisms: &[ActiveMechanism]) -> String {
    let vehicle = simulation.vehicle();
    let mut text = format!("{}, sensors: {}\n", vehicle.name(), simulation.sensors().name);
    let effects: Vec<String> = vehicle.effects().iter().map(ToString::to_string).collect();
    let effects = if effects.is_empty() { "none".to_owned() } else { effects.join("\n          ") };
    let _ = writeln!(text, "effects   {effects}");
    for mechanism in mechanisms {
        let _ = writeln!(text, "ground    {mechanism}");
    }
    text.push('\n');
    let _ = writeln!(text, "run      time     path  readings  poses");
    // runs without readings are none of the recording's
    for run in simulation.recording.runs() {
        let Some(length) = simulation.path_length(run.id()) else { continue };
        let _ = writeln!(
            text,
            "{:3}  {:6.1} s  {:5.1} m  {:8}  {:5}",
            run.id(),
            run.duration(),
            length,
            run.tracks().len(),
            run.poses().len()
        );
    }
    text
}
