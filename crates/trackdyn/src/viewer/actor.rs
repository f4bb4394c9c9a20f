//! Who drives: the recorded robot, or a model of it.

use trackdyn_export::viewer::{Curve, MarkerLayer, PathLayer, Plot, Rgb, Trace, names};

/// Beginning of all topics.
pub(crate) const ROOT: &str = "/trackdyn";

/// The recorded robot, or a model of it.
#[derive(Clone, Debug)]
pub(crate) struct Actor {
    name: String,
    /// Beginning of its topics.
    topic: String,
    /// Its colour.
    pub(crate) colour: Rgb,
}

impl Actor {
    /// What was recorded, and models of these names and colours.
    pub(crate) fn all<'a>(models: impl IntoIterator<Item = (&'a str, Rgb)>) -> (Self, Vec<Self>) {
        // grey shows on white and on black
        let observed = ("observed", [128, 128, 128]);
        let named: Vec<(&str, Rgb)> = std::iter::once(observed).chain(models).collect();
        let topics = names::unique(named.iter().map(|(name, _)| *name));
        let actors = named.into_iter().zip(topics).map(|((name, colour), topic)| Self {
            name: name.to_owned(),
            topic: format!("{ROOT}/{topic}"),
            colour,
        });
        let mut actors: Vec<Self> = actors.collect();
        let models = actors.split_off(1);
        (actors.remove(0), models)
    }

    /// Frame that moves along its path where the log has none: none of a log begins so.
    pub(crate) fn frame(&self) -> &str {
        self.topic.trim_start_matches('/')
    }

    /// Its path in a frame, without poses yet.
    pub(crate) fn path(&self, frame: &str) -> PathLayer {
        PathLayer {
            name: self.name.clone(),
            topic: self.topic.clone(),
            frame: frame.to_owned(),
            colour: self.colour,
            ..PathLayer::default()
        }
    }

    /// Its markers in a frame, without places yet.
    pub(crate) fn markers(&self, topic: &str, frame: &str) -> MarkerLayer {
        MarkerLayer {
            topic: format!("{}/{topic}", self.topic),
            frame: frame.to_owned(),
            colour: self.colour,
            ..MarkerLayer::default()
        }
    }

    /// A number of it over time.
    pub(crate) fn curve(&self, topic: &str, trace: Trace) -> Curve {
        let topic = format!("{}/{topic}", self.topic);
        Curve { name: self.name.clone(), topic, colour: self.colour, trace }
    }
}

/// A plot of these curves.
pub(crate) fn plot(title: &str, curves: impl IntoIterator<Item = Curve>) -> Plot {
    Plot { title: title.to_owned(), curves: curves.into_iter().collect() }
}
