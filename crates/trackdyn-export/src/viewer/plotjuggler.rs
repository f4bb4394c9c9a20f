//! A layout of PlotJuggler that shows what is in the file.
//!
//! # Sources
//! PlotJuggler 3, `plotwidget.cpp` and `plot_docker.cpp`: what they read of a layout.

use super::foxglove::css;
use super::{Layers, PathLayer, Plot};
use std::fmt::Write;

/// The layout, XML.
pub fn layout(layers: &Layers) -> String {
    let mut text = String::from(
        "<?xml version='1.0' encoding='UTF-8'?>\n<root>\n \
         <tabbed_widget name=\"Main Window\" parent=\"main_window\">\n",
    );
    let plots = layers
        .tabs
        .iter()
        .map(|tab| (tab.title.as_str(), tab.plots.iter().map(plot).collect::<Vec<String>>()));
    let paths = std::iter::once(("Paths", vec![paths(&layers.paths)]));
    for (title, areas) in plots.chain(paths) {
        let share = format!("{}", 1.0 / trackdyn_core::real(areas.len().max(1)));
        let sizes = vec![share.as_str(); areas.len()].join(";");
        let (title, count) = (escaped(title), areas.len());
        let _ = writeln!(
            text,
            "  <Tab tab_name=\"{title}\" containers=\"1\">\n   <Container>\n    \
             <DockSplitter orientation=\"-\" count=\"{count}\" sizes=\"{sizes}\">"
        );
        text += &areas.concat();
        text += "    </DockSplitter>\n   </Container>\n  </Tab>\n";
    }
    text += "  <currentTabIndex index=\"0\"/>\n </tabbed_widget>\n \
             <use_relative_time_offset enabled=\"1\"/>\n</root>\n";
    text
}

/// Curves over time.
fn plot(plot: &Plot) -> String {
    let curves = plot.curves.iter().map(|curve| {
        let (name, colour) = (escaped(&curve.topic), css(curve.colour));
        format!("       <curve name=\"{name}/data\" color=\"{colour}\"/>\n")
    });
    area(&plot.title, "TimeSeries", &curves.collect::<String>())
}

/// All paths in the plane.
fn paths(paths: &[PathLayer]) -> String {
    let curves = paths.iter().map(|path| {
        let (topic, colour) = (escaped(&path.topic), css(path.colour));
        format!(
            "       <curve name=\"{name}\" curve_x=\"{topic}/pose/pose/position/x\" \
             curve_y=\"{topic}/pose/pose/position/y\" color=\"{colour}\"/>\n",
            name = escaped(&path.name)
        )
    });
    area("Paths [m]", "XYPlot", &curves.collect::<String>())
}

fn area(title: &str, mode: &str, curves: &str) -> String {
    format!(
        "     <DockArea name=\"{title}\">\n      <plot mode=\"{mode}\" style=\"Lines\">\n\
         {curves}      </plot>\n     </DockArea>\n",
        title = escaped(title)
    )
}

/// A text as the value of an attribute.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
    text.replace(char::is_control, " ")
}
