//! Effects are known by their cards and sheets: no source but their own names one.

use super::crates::{all, code};
use std::path::Path;
use trackdyn_model::CATALOGUE;
use trackdyn_second_simulator::MECHANISMS;

/// Sources, each with why it may write words that are ids as well.
const ARGUED_SOURCES: [(&str, &str, &str); 1] = [(
    "estimate",
    "sensor.rs",
    "names of the two quantities of a pose sensor that `identify --fit` takes and files state: \
     they come of no catalogue, and identification knows no effects",
)];

/// Whether code names an id: in a string of its own, or with settings behind a colon; an id of
/// several words also anywhere in a longer string.
fn names(code: &str, id: &str) -> bool {
    let is_of_id = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let mut places = code.match_indices(id).filter(|(at, _)| !code[..*at].ends_with(is_of_id));
    places.any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + id.len()..]);
        let has_settings =
            after.strip_prefix(':').is_some_and(|key| key.starts_with(char::is_alphabetic));
        let is_alone = before.ends_with('"') && after.starts_with(['"', ':']);
        is_alone || has_settings || (id.contains('-') && !after.starts_with(is_of_id))
    })
}

/// Whether a source is that of an effect or a mechanism: what it says of another one is prose.
fn is_of_list(path: &Path) -> bool {
    ["effects", "mechanisms"].iter().any(|folder| path.starts_with(folder))
}

#[test]
fn no_source_names_an_effect_but_its_own() {
    let ids = CATALOGUE.iter().map(|card| card.id).chain(MECHANISMS.iter().map(|sheet| sheet.id));
    let ids: Vec<&str> = ids.collect();
    let (mut found, mut own, mut argued) = (Vec::new(), 0, Vec::new());
    for of in all() {
        for (path, code) in of.code() {
            let is_own =
                |id: &str| path.file_stem().is_some_and(|stem| *stem == *id.replace('-', "_"));
            let is_named = |id: &str| {
                if is_of_list(&path) {
                    code.contains(&format!("\"{id}\""))
                } else {
                    names(&code, id)
                }
            };
            for id in ids.iter().filter(|id| is_named(id)) {
                let file = path.to_string_lossy();
                let is_argued = ARGUED_SOURCES
                    .iter()
                    .any(|(name, source, _)| *name == of.name && *source == file);
                if is_own(id) {
                    own += 1;
                } else if is_argued {
                    argued.push(format!("{}/{file}", of.name));
                } else {
                    found.push(format!("{}/{file} names {id}", of.name));
                }
            }
        }
    }
    found.dedup();
    assert!(found.is_empty(), "what is to be known of an effect stands on its card:\n{found:#?}");
    assert!(own >= 2 * CATALOGUE.len() - 1, "{own} own names: sources are not where they were");
    for (name, source, _) in ARGUED_SOURCES {
        assert!(argued.contains(&format!("{name}/{source}")), "{name}/{source} needs no argument");
    }
}

#[test]
fn a_name_is_seen() {
    assert!(names("let it = \"slope\";", "slope") && names("\"slope:angle_deg=3\"", "slope"));
    assert!(!names("let slope = \"slopes\";", "slope"));
    assert!(names("\"the effect yaw-inertia says it\"", "yaw-inertia"));
    assert!(names("\"--effect slope:angle_deg=3\"", "slope"));
    assert!(!names("\"down the slope: it slides\"; slope::Slope", "slope"));
    assert!(!names("\"no-time-offset\", \"time-offsets\"", "time-offset"));
    assert!(!code("// \"slope\"\n#[cfg(test)]\nmod tests {\n    \"slope\"\n}").contains("slope"));
}
