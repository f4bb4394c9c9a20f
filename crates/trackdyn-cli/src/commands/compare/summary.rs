//! A comparison in one screen.

use crate::wrapped::wrapped;
use trackdyn::Comparison;
use trackdyn::crates::diagnose::compare::words;

/// The text of a comparison.
pub fn text(comparison: &Comparison) -> String {
    let [sim, real] = comparison.names();
    let found = comparison.found();
    let mut text = wrapped("SIM      ", sim);
    text += &wrapped("REAL     ", real);
    text += &wrapped("vehicle  ", comparison.vehicle().name());
    text +=
        &wrapped("\nstatus   ", &format!("{}: {}", found.status().name(), words::headline(found)));
    text += &wrapped("where    ", &found.place());
    if found.differences.is_empty() {
        text += &wrapped("differs  ", &words::nothing_named(found));
    }
    for one in &found.differences {
        let sentence = format!("{} ({})", words::sentence(one), words::support(one));
        text += &wrapped("differs  ", &sentence);
        for setting in words::settings(found, one) {
            text += &wrapped("  set    ", &setting);
        }
    }
    for one in words::refused(found) {
        text += &wrapped("refused  ", &one);
    }
    for one in words::not_shown(found) {
        text += &wrapped("unknown  ", &one);
    }
    for (head, line) in [
        ("closer   ", words::closer(found)),
        ("alike    ", words::common(found)),
        ("sensors  ", words::instruments(found)),
    ] {
        if let Some(line) = line {
            text += &wrapped(head, &line);
        }
    }
    text
}
