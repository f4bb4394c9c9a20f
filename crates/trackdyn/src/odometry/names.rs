//! Names for sets of parameters.

use std::path::Path;
use trackdyn_core::input::name_of;
use trackdyn_estimate::odometry::ParameterSet;

/// Names for files and folders: their own without an ending, with the folder before them where two
/// are alike, and a number where these are alike too.
pub(super) fn names<'a>(paths: impl Iterator<Item = &'a Path>) -> Vec<String> {
    let paths: Vec<&Path> = paths.collect();
    let text = |name: &str| -> String {
        name.chars()
            .map(|c| if c.is_alphanumeric() || "._-".contains(c) { c } else { '_' })
            .collect()
    };
    let stems: Vec<String> = paths.iter().map(|path| text(&name_of(path))).collect();
    let mut names: Vec<String> = Vec::new();
    for (path, stem) in paths.iter().zip(&stems) {
        let alike = stems.iter().filter(|other| *other == stem).count() > 1;
        let folder = path.parent().and_then(Path::file_name).unwrap_or_default();
        let folder = text(&folder.to_string_lossy());
        let name =
            if alike && !folder.is_empty() { format!("{folder}-{stem}") } else { stem.clone() };
        let taken = |name: &str| {
            [ParameterSet::IDEAL_NAME, ParameterSet::PHYSICS_NAME, "recorded"].contains(&name)
                || name.ends_with("-no-alpha")
                || names.iter().any(|n| n == name)
        };
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken(name));
        names.push(free.unwrap_or(name));
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_has_a_name_of_its_own() {
        let of = |paths: &[&str]| names(paths.iter().map(Path::new));
        assert_eq!(of(&["a/fit.toml", "b/map.toml"]), ["fit", "map"]);
        assert_eq!(of(&["a/k.toml", "b/k.toml", "b/k.toml"]), ["a-k", "b-k", "b-k-2"]);
        assert_eq!(of(&["ideal.toml", "my robot.toml"]), ["ideal-2", "my_robot"]);
        assert_eq!(of(&["physics.toml"]), ["physics-2"]);
    }
}
