//! `trackdyn export sdf|mjcf|usd|chrono`: vehicles for simulators.

use crate::Workplace;
use trackdyn::effects;

/// Command and file.
const FORMATS: [(&str, &str); 4] = [
    ("sdf", "vehicle.sdf"),
    ("mjcf", "vehicle.mjcf.xml"),
    ("usd", "vehicle.usda"),
    ("chrono", "vehicle.chrono.json"),
];

/// Centre of gravity (right, forward) and height of the vehicle below.
const COG: [f64; 2] = [-0.015, 0.04];
const HEIGHT: f64 = 0.2;

/// The default vehicle with its centre of gravity elsewhere, and these effects.
fn exported(format: &str, effects: &str) -> (Workplace, String) {
    let place = Workplace::new();
    let cog = format!("--cog {},{}", COG[0], COG[1]);
    let height = format!("--effect load-transfer:cog_height_m={HEIGHT}");
    let run = place.run(&format!("export {format} {cog} {height} {effects}"));
    assert_eq!((run.status, run.stdout.as_str()), (0, ""), "{}", run.stderr);
    let (_, file) = FORMATS.iter().find(|(name, _)| *name == format).expect("a format");
    assert!(run.stderr.contains(&format!("wrote out/{file}")), "{}", run.stderr);
    let text = String::from_utf8(place.read(&format!("out/{file}"))).expect("text");
    (place, text)
}

/// Numbers in a text, whatever stands between them.
fn numbers(text: &str) -> Vec<f64> {
    let is_number = |c: char| c.is_ascii_digit() || "+-.e".contains(c);
    text.split(|c| !is_number(c)).filter_map(|word| word.parse().ok()).collect()
}

/// Mass and first moments of bodies are those of the vehicle.
fn expect_vehicle(bodies: &[([f64; 3], f64)]) {
    let mass: f64 = bodies.iter().map(|(_, mass)| mass).sum();
    assert!((mass - 258.0).abs() < 1e-6, "{mass}");
    for (axis, expected) in [COG[1], -COG[0], HEIGHT].into_iter().enumerate() {
        let mean = bodies.iter().map(|(place, mass)| place[axis] * mass).sum::<f64>() / mass;
        assert!((mean - expected).abs() < 1e-8, "axis {axis}: {mean}, {expected}");
    }
}

fn place_of(text: &str) -> [f64; 3] {
    let all = numbers(text);
    [all[0], all[1], all[2]]
}

#[test]
fn mjcf_is_xml_with_the_masses_of_the_vehicle() {
    let (_, text) = exported("mjcf", "");
    let xml = roxmltree::Document::parse(&text).expect("XML");
    let mut bodies = Vec::new();
    for node in xml.descendants().filter(|node| node.has_tag_name("inertial")) {
        let body = node.parent().expect("a body");
        let at = place_of(body.attribute("pos").unwrap_or("0 0 0"));
        let cog = place_of(node.attribute("pos").expect("a place"));
        let mass = node.attribute("mass").expect("a mass").parse().expect("a number");
        bodies.push((std::array::from_fn(|axis| at[axis] + cog[axis]), mass));
    }
    assert_eq!(bodies.len(), 17, "a chassis and eight rollers on each side");
    expect_vehicle(&bodies);
    let option = xml.descendants().find(|node| node.has_tag_name("option")).expect("options");
    assert_eq!(option.attribute("cone"), Some("elliptic"));
    let pair = xml.descendants().find(|node| node.has_tag_name("pair")).expect("a pair");
    let friction = numbers(pair.attribute("friction").expect("friction"));
    // across less than the vehicle's 0.9, because MuJoCo opposes slip more; along as in the vehicle
    assert!(friction[0] < 0.85 && friction[0] > 0.75 && friction[1] == 0.7, "{friction:?}");
    // both lines of chi agree, which the friction was chosen for
    let chi: Vec<&str> = text.lines().filter(|line| line.contains(": chi ")).collect();
    let [vehicle, contacts] = [0, 1].map(|k| numbers(chi[k].split("chi ").nth(1).expect("chi"))[0]);
    assert!((vehicle - 0.5044).abs() < 1e-4 && vehicle == contacts, "{chi:?}");
}

#[test]
fn sdf_is_xml_with_friction_along_and_across() {
    let (_, text) = exported("sdf", "--effect friction-split:split=0.1");
    let xml = roxmltree::Document::parse(&text).expect("XML");
    let value = |node: roxmltree::Node, tag: &str| -> String {
        let found = node.descendants().find(|inner| inner.has_tag_name(tag));
        found.and_then(|inner| inner.text().map(str::to_owned)).expect("a value")
    };
    let links: Vec<_> = xml.descendants().filter(|n| n.has_tag_name("link")).collect();
    let links: Vec<_> = links.into_iter().filter(|n| n.attribute("name").is_some()).collect();
    let bodies: Vec<([f64; 3], f64)> = links
        .iter()
        .map(|link| {
            let own = link.children().find(|n| n.has_tag_name("pose")).and_then(|n| n.text());
            let (at, cog) = (
                place_of(own.unwrap_or("0 0 0")),
                place_of(&{
                    let inertial = link.children().find(|n| n.has_tag_name("inertial"));
                    value(inertial.expect("mass"), "pose")
                }),
            );
            let mass = value(*link, "mass").parse().expect("a number");
            (std::array::from_fn(|axis| at[axis] + cog[axis]), mass)
        })
        .collect();
    expect_vehicle(&bodies);
    let mus: Vec<[String; 3]> = xml
        .descendants()
        .filter(|node| node.has_tag_name("ode"))
        .map(|node| ["mu", "mu2", "fdir1"].map(|tag| value(node, tag)))
        .collect();
    let expected = [["0.77", "0.99", "1 0 0"], ["0.63", "0.81", "1 0 0"]];
    assert_eq!(mus, expected.map(|row| row.map(str::to_owned)));
    assert_eq!(text.matches("gz::sim::systems::TrackController").count(), 2);
    assert_eq!(text.matches("gz::sim::systems::TrackedVehicle").count(), 1);
}

#[test]
fn chrono_is_json_behind_its_comment() {
    let (_, text) = exported("chrono", "");
    let (comment, json) = text.split_once("*/").expect("a comment");
    // JSON is YAML.
    let json: serde_yaml_ng::Value = serde_yaml_ng::from_str(json).expect("JSON");
    let part = &json["Components"][0];
    assert_eq!(part["Mass"].as_f64(), Some(258.0));
    let cog = &part["Centroidal Frame"]["Location"];
    assert_eq!([0, 1, 2].map(|k| cog[k].as_f64()), [Some(0.04), Some(0.015), Some(0.2)]);
    let material = &json["Contact Materials"]["left"];
    assert_eq!(material["Coefficient of Friction"].as_f64(), Some(0.7));
    // one coefficient for all directions turns otherwise, and the file says by how much
    let chi = comment.lines().filter(|line| line.contains(": chi "));
    assert_eq!(chi.count(), 2, "{comment}");
}

/// The mass properties of the stage; `usd-core` reads it in the tests of the Python package.
#[test]
fn usd_has_the_masses_of_the_vehicle() {
    let (_, text) = exported("usd", "");
    let line = |key: &str| -> Vec<Vec<f64>> {
        let lines = text.lines().filter(|line| line.trim_start().starts_with(key));
        lines.map(|line| numbers(line.split_once('=').expect("a value").1)).collect()
    };
    let masses = line("float physics:mass");
    let cogs = line("point3f physics:centerOfMass");
    let places = line("double3 xformOp:translate");
    assert_eq!(masses.len(), 65, "a chassis and 32 balls with their carriers");
    // the hull is seen only, and stands behind the chassis
    let places: Vec<&Vec<f64>> =
        places.iter().enumerate().filter(|(k, _)| *k != 1).map(|(_, place)| place).collect();
    let bodies: Vec<([f64; 3], f64)> = masses
        .iter()
        .zip(&cogs)
        .zip(places)
        .map(|((mass, cog), at)| (std::array::from_fn(|axis| at[axis] + cog[axis]), mass[0]))
        .collect();
    expect_vehicle(&bodies);
}

/// Contacts slip in proportion to a force below friction, at the speed that the vehicle says.
#[test]
fn softness_is_carried_by_gazebo_and_mujoco() {
    let number = |format: &str, effect: &str, name: &str| -> Option<f64> {
        let (_, text) = exported(format, effect);
        let behind = text.split(name).nth(1)?;
        numbers(behind).first().copied()
    };
    let creep = |speed: f64| format!("--effect friction-creep:speed_m_per_s={speed}");
    assert_eq!(number("sdf", "", "<slip1>"), None);
    let [slow, fast] =
        [0.02, 0.04].map(|speed| number("sdf", &creep(speed), "<slip1>").expect("slip"));
    assert!((fast / slow - 2.0).abs() < 1e-6, "{slow} {fast}");
    let ratio = |effect: &str| number("mjcf", effect, "impratio=\"").expect("a ratio");
    assert_eq!(ratio(""), 10_000.0);
    // less softness than the contacts have anyway cannot be told
    assert_eq!(ratio(&creep(1e-4)), 10_000.0);
    let [slow, fast] = [0.02, 0.04].map(|speed| ratio(&creep(speed)));
    assert!((slow / fast - 2.0).abs() < 1e-6 && slow < 1500.0, "{slow} {fast}");
}

/// No effect is silently lost, in any format.
#[test]
fn every_effect_is_said_or_listed_as_lacking() {
    let all = effects().iter().filter(|card| !card.is_form());
    let all = all.filter(|card| card.id != "load-transfer");
    let effects: Vec<String> = all.clone().map(|card| format!("--effect {}", card.id)).collect();
    for (format, _) in FORMATS {
        let (_, text) = exported(format, &effects.join(" "));
        let [has, lacks] = ["this file has:", "this file does not have:"]
            .map(|title| text.find(title).unwrap_or_else(|| panic!("{format}: {title}")));
        assert!(has < lacks, "{format}");
        for card in all.clone() {
            assert!(text[has..].contains(&format!("- {}", card.id)), "{format}: {}", card.id);
        }
        for (id, is_carried) in [("cog-shift", true), ("tether", false), ("friction-drift", false)]
        {
            let place = text[has..].find(&format!("- {id}")).expect("in a list") + has;
            assert_eq!(place < lacks, is_carried, "{format}: {id}");
        }
        let is_narrow = |line: &str| line.chars().count() < 400 || line.contains("command:");
        assert!(text.lines().all(is_narrow), "{format}");
    }
}

#[test]
fn bad_input_writes_no_file() {
    let place = Workplace::new();
    for (arguments, part) in [
        ("sdf --vehicle no-such", "no-such"),
        ("mjcf --effect no-such", "no-such"),
        ("usd --effect slope:angle_deg=-3", "angle_deg"),
        ("mjcf --effect cog-shift:x_m=0.5", "Auriga-alpha: by its forces it does not turn"),
        ("chrono kinematics.toml", "unexpected argument"),
    ] {
        let run = place.run(&format!("export {arguments} --out new"));
        assert_eq!(run.status, 1, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(part), "{arguments}: {part:?} is not in:\n{}", run.stderr);
        assert!(!place.path().join("new").exists(), "{arguments}");
    }
}
