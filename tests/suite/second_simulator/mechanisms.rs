//! What every mechanism must satisfy.

use std::collections::BTreeSet;
use trackdyn_model::CATALOGUE;
use trackdyn_model::effect::{Parameter, Role};
use trackdyn_second_simulator::{
    ActiveMechanism, Error, Form, MECHANISMS, Origin, Robot, Setup, page, sheet_of,
};

use crate::second_simulator::turn::{auriga, typical};

#[test]
fn every_file_is_registered() {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/laboratory/second-simulator/src/mechanisms"
    );
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder of mechanisms")
        .map(|entry| entry.expect("readable").path())
        .map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned())
        .filter(|stem| !["active", "registry"].contains(&stem.as_str()))
        .collect();
    let ids: BTreeSet<String> = MECHANISMS.iter().map(|sheet| sheet.id.replace('-', "_")).collect();
    assert_eq!(files, ids, "one file per mechanism, one line per file in mechanisms.rs");
    assert_eq!(ids.len(), MECHANISMS.len(), "ids are unique");
}

#[test]
fn sheets_are_complete() {
    for sheet in MECHANISMS {
        assert!(!sheet.law.is_empty() && !sheet.size.is_empty(), "{}", sheet.id);
        assert!(sheet.breaks.is_sorted(), "{}", sheet.id);
        for parameter in sheet.parameters {
            let [low, high] = parameter.range;
            assert!(low < high && (low..=high).contains(&parameter.typical), "{}", sheet.id);
            let suffix = parameter.unit.replace('/', "_per_").replace(' ', "_").to_lowercase();
            let named = parameter.unit == "1" || parameter.key.ends_with(&suffix);
            assert!(named, "{}.{}", sheet.id, parameter.key);
        }
    }
}

#[test]
fn effects_of_the_catalogue_have_their_names_and_parameters_here() {
    // A form has no mechanism.
    for card in CATALOGUE.iter().filter(|card| !card.is_form()) {
        let sheet = sheet_of(card.id);
        let sheet = sheet.unwrap_or_else(|| panic!("no mechanism {}", card.id));
        assert_eq!(sheet.origin, Origin::Catalogue, "{}", card.id);
        let (theirs, constants): (Vec<&Parameter>, Vec<&Parameter>) =
            card.parameters.iter().partition(|p| sheet.parameters.iter().any(|q| q.key == p.key));
        // a shape of the catalogue's law may be a constant of the one here
        assert!(constants.iter().all(|p| p.role == Role::Shape), "{}", card.id);
        let ours: Vec<_> = sheet.parameters.iter().map(|p| (p.key, p.unit)).collect();
        let named: Vec<_> = theirs.iter().map(|p| (p.key, p.unit)).collect();
        assert_eq!(ours, named, "{}", card.id);
        for (ours, theirs) in sheet.parameters.iter().zip(theirs) {
            let within = ours.range[0] >= theirs.range[0] && ours.range[1] <= theirs.range[1];
            assert!(within, "{} {}", card.id, ours.key);
        }
    }
}

#[test]
fn mistakes_are_refused() {
    let unknown = ActiveMechanism::new("centripedal", &[]).expect_err("a mistake").to_string();
    assert!(unknown.contains("no mechanism \"centripedal\""), "{unknown}");
    assert!(MECHANISMS.iter().all(|sheet| unknown.contains(sheet.id)), "{unknown}");
    let message = |settings: &[(&str, f64)]| {
        ActiveMechanism::new("slope", settings).expect_err("a mistake").to_string()
    };
    assert!(message(&[("angel_deg", 1.0)]).contains("it has angle_deg, uphill_deg"));
    assert!(message(&[("angle_deg", f64::NAN)]).contains("expected 0 to 60 deg"));
    let twice = typical(&["slope", "slope"]);
    let refused = Robot::new(&auriga([0.0, 0.0]), &twice, &Setup::default());
    assert_eq!(refused.expect_err("a refusal"), Error::Repeated("slope"));
    let form = |text: &str| text.parse::<ActiveMechanism>();
    let refused = form("slope:angle_deg=3,form=7").expect_err("a mistake").to_string();
    assert!(refused.contains("slope has one form of its law"), "{refused}");
    assert!(form("tether:form=-1").is_err() && form("tether:form=0.5").is_err());
}

#[test]
fn a_drawn_form_is_written_and_read_back() {
    for sheet in MECHANISMS.iter().filter(|sheet| sheet.family.is_some()) {
        let drawn = typical(&[sheet.id]).remove(0).with(Form::Drawn(4_000_000_000));
        let drawn = drawn.expect("a family");
        assert_eq!(drawn.to_string().parse(), Ok(drawn), "{}", sheet.id);
    }
}

/// The page of the documents is what the program prints.
#[test]
fn the_page_is_the_list() {
    let path = "docs/trials/forms.md";
    let written = include_str!("../../../docs/trials/forms.md");
    let command = "cargo run -p trackdyn-second-simulator --example mechanisms";
    assert_eq!(written, page(), "{command} > {path}");
}
