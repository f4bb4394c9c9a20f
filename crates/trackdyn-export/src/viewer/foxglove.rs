//! A layout of Foxglove that shows what is in the file.
//!
//! # Sources
//! Lichtblick (the open successor of Foxglove Studio) 1.2, settings of the panels "3D", "Plot",
//! "StateTransitions" and "Tab".

use super::{Curve, Layers, Plot, Rgb};
use serde_json::{Map, Value, json};
use trackdyn_core::real;

/// Thickness of a path, m.
const PATH_WIDTH: f64 = 0.03;

/// The layout, JSON.
pub fn layout(layers: &Layers) -> String {
    let mut panels = Map::new();
    let scene = "3D!drive";
    panels.insert(scene.to_owned(), scene_settings(layers));
    let mut tabs = Vec::new();
    for (number, tab) in layers.tabs.iter().enumerate() {
        let ids: Vec<String> =
            (0..tab.plots.len()).map(|plot| format!("Plot!{number}-{plot}")).collect();
        panels.extend(ids.iter().cloned().zip(tab.plots.iter().map(plot_settings)));
        tabs.push(json!({ "title": tab.title, "layout": column(&ids) }));
    }
    let left = if layers.texts.is_empty() {
        json!(scene)
    } else {
        let states = "StateTransitions!texts";
        panels.insert(states.to_owned(), text_settings(layers));
        json!({ "direction": "column", "first": scene, "second": states, "splitPercentage": 85 })
    };
    let layout = if tabs.is_empty() {
        left
    } else {
        let plots = "Tab!plots";
        panels.insert(plots.to_owned(), json!({ "activeTabIdx": 0, "tabs": tabs }));
        json!({ "direction": "row", "first": left, "second": plots, "splitPercentage": 55 })
    };
    let all = json!({
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": { "speed": 1 },
        "layout": layout,
    });
    format!("{all:#}\n")
}

/// Panels below each other, all as high.
fn column(ids: &[String]) -> Value {
    match ids {
        [] => Value::Null,
        [one] => json!(one),
        [first, others @ ..] => json!({
            "direction": "column",
            "first": first,
            "second": column(others),
            "splitPercentage": 100.0 / real(ids.len()),
        }),
    }
}

/// The scene from above: paths, frames and markers, around the paths.
fn scene_settings(layers: &Layers) -> Value {
    let mut topics = Map::new();
    for path in &layers.paths {
        let colour = css(path.colour);
        let settings = json!({
            "visible": true,
            "type": "line",
            "lineWidth": PATH_WIDTH,
            "gradient": [colour, colour],
        });
        topics.insert(format!("{}/path", path.topic), settings);
    }
    topics.extend(layers.markers.iter().map(|of| (of.topic.clone(), json!({ "visible": true }))));
    let frames = layers.paths.iter().map(|path| path.frame.as_str());
    let frames: Map<String, Value> = std::iter::once(layers.fixed_frame.as_str())
        .chain(frames)
        .map(|frame| (format!("frame:{frame}"), json!({ "visible": true })))
        .collect();
    let ([x, y], extent) = layers.extent();
    json!({
        "followMode": "follow-none",
        "followTf": layers.fixed_frame,
        "cameraState": {
            "perspective": false,
            "distance": 1.5 * extent,
            "phi": 0,
            "thetaOffset": 0,
            "target": [0, 0, 0],
            "targetOffset": [x, y, 0],
            "targetOrientation": [0, 0, 0, 1],
            "fovy": 45,
            "near": 0.1,
            "far": 10.0 * extent,
        },
        "scene": { "backgroundColor": "#ffffff", "transforms": { "axisScale": 0.5 } },
        "transforms": frames,
        "topics": topics,
        "layers": { "grid": {
            "layerId": "foxglove.Grid",
            "instanceId": "grid",
            "label": "Grid of 1 m",
            "visible": true,
            "size": 100,
            "divisions": 100,
            "lineWidth": 1,
            "color": "#00000018",
            "position": [0, 0, 0],
            "rotation": [0, 0, 0],
        } },
        "publish": {},
        "imageMode": {},
    })
}

fn text_settings(layers: &Layers) -> Value {
    let path = |topic: &str| {
        let label = topic.rsplit('/').next();
        let value = format!("{topic}.data");
        json!({ "value": value, "label": label, "timestampMethod": "receiveTime" })
    };
    let paths: Vec<Value> = layers.texts.iter().map(|of| path(&of.topic)).collect();
    json!({ "paths": paths, "isSynced": true })
}

fn plot_settings(plot: &Plot) -> Value {
    let curve = |curve: &Curve| {
        json!({
            "value": format!("{}.data", curve.topic),
            "label": curve.name,
            "color": css(curve.colour),
            "enabled": true,
            "timestampMethod": "receiveTime",
        })
    };
    json!({
        "foxglovePanelTitle": plot.title,
        "paths": plot.curves.iter().map(curve).collect::<Vec<_>>(),
        "isSynced": true,
        "xAxisVal": "timestamp",
        "showLegend": true,
        "legendDisplay": "floating",
        "showPlotValuesInLegend": false,
        "showXAxisLabels": true,
        "showYAxisLabels": true,
        "sidebarDimension": 240,
    })
}

/// A colour as style sheets have it.
pub(super) fn css([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
