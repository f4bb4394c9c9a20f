//! Drives as files that Foxglove, Rerun and PlotJuggler open.

mod actor;
mod icrs;
mod motion;
mod timeline;

pub(crate) use actor::{Actor, ROOT, plot};
pub(crate) use icrs::{COORDINATES, Moment, PIECE, markers, places};
pub(crate) use motion::{RATES, track_speeds, tracks};
pub(crate) use timeline::Timeline;
pub use trackdyn_export::viewer::Layers;

use crate::change::Folder;
use crate::{Change, Error};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use trackdyn_export::viewer::{bag, foxglove, plotjuggler};
use trackdyn_recording::Recording as Motion;

/// Writes layers as `NAME.mcap`, with layouts beside it that show what is in it:
/// `NAME.foxglove.json` and `NAME.plotjuggler.xml`.
///
/// # Errors
/// [`Error::Output`] with the file, also for layers that no viewer can show.
pub fn write(layers: &Layers, folder: impl AsRef<Path>, name: &str) -> Result<Vec<Change>, Error> {
    let mut folder = Folder::prepare(folder.as_ref())?;
    write_into(&mut folder, layers, name)?;
    Ok(folder.changes())
}

/// Writes layers into a folder in which other files are written, too.
pub(crate) fn write_into(folder: &mut Folder, layers: &Layers, name: &str) -> Result<(), Error> {
    let [bag, foxglove, plotjuggler] = files(name);
    folder.write_stream(&bag, |file| bag::write(layers, file))?;
    folder.write(&foxglove, foxglove::layout(layers).as_bytes())?;
    folder.write(&plotjuggler, plotjuggler::layout(layers).as_bytes())
}

/// Removes the files of an earlier run whose document is `written`, of which this run has none.
pub(crate) fn remove_earlier(folder: &mut Folder, written: &str, name: &str) -> Result<(), Error> {
    let files: Vec<PathBuf> = files(name).iter().map(|file| folder.file(file)).collect();
    folder.remove_earlier(written, files)
}

fn files(name: &str) -> [String; 3] {
    ["mcap", "foxglove.json", "plotjuggler.xml"].map(|extension| format!("{name}.{extension}"))
}

/// Where layers come from: keys and texts, without those that say nothing.
pub(crate) fn notes<const N: usize>(notes: [(&str, String); N]) -> BTreeMap<String, String> {
    let said = notes.into_iter().filter(|(_, text)| !text.is_empty());
    said.map(|(key, text)| (key.to_owned(), text)).collect()
}

/// Frames that poses of a recording are expressed in, and that they are of, as its log calls them.
pub(crate) fn frames(motion: &Motion) -> [String; 2] {
    let names = motion.source().names.as_deref();
    let parent = names.and_then(|names| names.parent_frame.as_deref());
    let child = names.and_then(|names| names.child_frame.as_deref());
    let frame = |name: Option<&str>, usual: &str| {
        let name = name.map(|name| name.trim_start_matches('/')).filter(|name| !name.is_empty());
        name.unwrap_or(usual).to_owned()
    };
    let [parent, child] = [frame(parent, "map"), frame(child, "base_link")];
    if parent == child { [format!("{parent}_origin"), child] } else { [parent, child] }
}
