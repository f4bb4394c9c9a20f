//! Layouts name what is in the file.

use super::{bytes, messages, synthetic_layers};
use std::collections::BTreeSet;
use trackdyn::crates::export::viewer::{foxglove, plotjuggler};

/// The texts of the quoted values of a key.
fn quoted<'a>(text: &'a str, key: &str) -> Vec<&'a str> {
    let parts = text.split(key).skip(1);
    parts.filter_map(|part| part.split('"').next()).collect()
}

#[test]
fn foxglove_shows_what_is_there() {
    let layers = synthetic_layers();
    let found = messages(&bytes(&layers));
    // YAML takes JSON
    let layout: serde_yaml_ng::Value =
        serde_yaml_ng::from_str(&foxglove::layout(&layers)).expect("JSON");
    let panels = layout["configById"].as_mapping().expect("panels");
    let mut shown = BTreeSet::new();
    for (id, panel) in panels {
        let id = id.as_str().expect("a name");
        for path in panel["paths"].as_sequence().into_iter().flatten() {
            let value = path["value"].as_str().expect("a path");
            let topic = value.strip_suffix(".data").expect("a number");
            assert_eq!(found[topic][0].kind, "std_msgs/msg/Float64", "{id}");
            shown.insert(topic.to_owned());
        }
    }
    let numbers = found.iter().filter(|(_, of)| of[0].kind == "std_msgs/msg/Float64");
    assert_eq!(shown, numbers.map(|(topic, _)| topic.clone()).collect());
    let scene = &panels["3D!drive"];
    let topics = scene["topics"].as_mapping().expect("topics");
    assert_eq!(topics.len(), 3 * 2);
    assert!(topics.keys().all(|topic| found.contains_key(topic.as_str().expect("a name"))));
    assert_eq!(scene["followTf"].as_str(), Some("map"));
    // every panel has its place
    let mut places: BTreeSet<String> = panels
        .iter()
        .flat_map(|(_, panel)| panel["tabs"].as_sequence().into_iter().flatten())
        .flat_map(|tab| leaves(&tab["layout"]))
        .collect();
    places.extend(leaves(&layout["layout"]));
    let panels: BTreeSet<String> =
        panels.keys().map(|id| id.as_str().expect("a name").to_owned()).collect();
    assert_eq!(places, panels);
}

/// The panels of a layout.
fn leaves(layout: &serde_yaml_ng::Value) -> Vec<String> {
    match layout.as_str() {
        Some(panel) => vec![panel.to_owned()],
        None => ["first", "second"].iter().flat_map(|part| leaves(&layout[*part])).collect(),
    }
}

#[test]
fn plotjuggler_shows_what_is_there() {
    let layers = synthetic_layers();
    let found = messages(&bytes(&layers));
    let text = plotjuggler::layout(&layers);
    let document = roxmltree::Document::parse(&text).expect("XML");
    for splitter in document.descendants().filter(|node| node.has_tag_name("DockSplitter")) {
        let areas = splitter.children().filter(|node| node.has_tag_name("DockArea")).count();
        let sizes = splitter.attribute("sizes").expect("sizes").split(';').count();
        assert_eq!(splitter.attribute("count"), Some(areas.to_string().as_str()));
        assert_eq!(sizes, areas);
    }
    let mut curves = 0;
    for curve in document.descendants().filter(|node| node.has_tag_name("curve")) {
        let (topic, kind) = match curve.attribute("curve_x") {
            Some(x) => (x.strip_suffix("/pose/pose/position/x"), "geometry_msgs/msg/PoseStamped"),
            None => (curve.attribute("name"), "std_msgs/msg/Float64"),
        };
        let topic = topic.expect("a topic");
        let topic = match kind {
            "std_msgs/msg/Float64" => topic.strip_suffix("/data").expect("a number").to_owned(),
            _ => format!("{topic}/pose"),
        };
        assert_eq!(found[&topic][0].kind, kind);
        curves += 1;
    }
    assert_eq!(curves, layers.curves().count() + layers.paths.len());
    assert!(quoted(&text, "tab_name=\"").contains(&"Residuals"));
}
