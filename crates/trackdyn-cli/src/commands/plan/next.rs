//! How to go on with a plan: drive, record, diagnose both.

use crate::shell::{command, path};
use crate::wrapped::WIDTH;
use std::path::Path;
use trackdyn::{OpenQuestions, Plan};

/// Where the plan comes from and where it goes.
pub struct Place<'a> {
    /// The diagnosis file.
    pub diagnosis: &'a Path,
    /// The vehicle that has what the diagnosis found.
    pub vehicle: &'a Path,
    /// The folder of the plan.
    pub out: &'a Path,
}

/// What stands for the log of the driving that is planned.
const LOG: &str = "NEW_LOG";

/// The steps; nothing where there is nothing to drive.
pub fn text(plan: &Plan, questions: &OpenQuestions, place: &Place) -> String {
    if plan.schedule().is_none() {
        return String::new();
    }
    let schedule = path(&place.out.join("plan.csv"));
    let rehearsal = [
        "trackdyn simulate".to_owned(),
        format!("--schedule {schedule}"),
        format!("--vehicle {}", path(place.vehicle)),
        format!("--out {}", path(&place.out.join("rehearsal"))),
    ];
    let both = both(questions.command(), place.diagnosis);
    let inspect = format!("trackdyn inspect {LOG}");
    let line = |words: &[String]| command(words, WIDTH - 8).replace('\n', "\n          ");
    format!(
        "\ngo on with\n\
         \x20 drive    {schedule} (t,v_left,v_right: s, m/s of the tracks); in simulation first:\n\
         \x20          {}\n\
         \x20 record   tracks and poses as before, as {LOG}; look at it:\n\
         \x20          {inspect}\n\
         \x20 diagnose both together:\n\
         \x20          {}\n",
        line(&rehearsal),
        line(&both)
    )
}

/// The command that diagnoses earlier and new driving together: that of the diagnosis with one more
/// recording, into a folder of its own.
fn both(made_by: Option<&str>, diagnosis: &Path) -> Vec<String> {
    let folder = diagnosis.parent().unwrap_or(Path::new(""));
    let name = folder.file_name().unwrap_or("diagnosis".as_ref()).to_string_lossy();
    let out = format!("--out {}", path(&folder.with_file_name(format!("{name}-both"))));
    let unknown = || ["EARLIER_LOG", LOG, "--vehicle VEHICLE.toml"].map(str::to_owned).to_vec();
    let words = made_by.and_then(arguments).unwrap_or_else(unknown);
    let mut all = vec!["trackdyn diagnose".to_owned()];
    all.extend(words);
    all.push(out);
    all
}

/// The arguments of a diagnosis with the new log behind the first recording, without its folder;
/// none of what is no such command.
fn arguments(made_by: &str) -> Option<Vec<String>> {
    let words = shlex::split(made_by)?;
    let [program, diagnose, rest @ ..] = words.as_slice() else { return None };
    if program != "trackdyn" || diagnose != "diagnose" {
        return None;
    }
    let quoted = |word: &String| path(Path::new(word));
    let mut found = Vec::new();
    let mut has_log = false;
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        if let Some(option) = word.strip_prefix("--") {
            let is_whole = option.contains('=');
            let value = if is_whole { None } else { rest.next() };
            if option.split('=').next() == Some("out") {
                continue;
            }
            let value = value.map_or_else(String::new, |value| format!(" {}", quoted(value)));
            found.push(format!("{word}{value}"));
        } else {
            found.push(quoted(word));
            if !has_log {
                found.push(LOG.to_owned());
                has_log = true;
            }
        }
    }
    has_log.then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_new_log_stands_beside_the_earlier_one() {
        let made_by =
            "trackdyn diagnose --draws 1000 'my drive' --vehicle r.toml --out=robot/d --seed 2";
        let words = both(Some(made_by), Path::new("robot/d/diagnosis.toml"));
        assert_eq!(
            words.join(" "),
            "trackdyn diagnose --draws 1000 'my drive' NEW_LOG --vehicle r.toml --seed 2 \
             --out robot/d-both"
        );
        for other in [None, Some("my program"), Some("trackdyn diagnose"), Some("trackdyn 'x")] {
            let words = both(other, Path::new("diagnosis.toml")).join(" ");
            let expected = "trackdyn diagnose EARLIER_LOG NEW_LOG --vehicle VEHICLE.toml";
            assert_eq!(words, format!("{expected} --out diagnosis-both"));
        }
    }
}
