//! Vehicles that are known by their name.

use trackdyn_core::document::Document;
use trackdyn_model::VehicleFile;

/// Name of the vehicle that counts where none is chosen.
pub(crate) const DEFAULT: &str = "auriga-alpha";

/// Names of the other vehicles, which are those of their files in `configs/vehicles`, and the texts
/// of these files.
const OTHER_VEHICLES: [(&str, &str); 4] = [
    ("husky-a200", include_str!("preset/husky-a200.toml")),
    ("marmotte", include_str!("preset/marmotte.toml")),
    ("maxxii", include_str!("preset/maxxii.toml")),
    ("warthog", include_str!("preset/warthog.toml")),
];

/// All names, in the order of the alphabet.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    std::iter::once(DEFAULT).chain(OTHER_VEHICLES.map(|(name, _)| name))
}

/// The vehicle of a name; none where no vehicle has it.
pub(crate) fn named(name: &str) -> Option<VehicleFile> {
    if name == DEFAULT {
        return Some(VehicleFile::auriga_alpha());
    }
    let (name, text) = OTHER_VEHICLES.into_iter().find(|(other, _)| *other == name)?;
    VehicleFile::from_document(&Document::new(name, text)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_its_vehicle() {
        let all: Vec<&str> = names().collect();
        assert!(all.is_sorted(), "{all:?}");
        let vehicles = all.iter().map(|name| named(name).expect(name).vehicle.name);
        let called = vehicles.map(|name| name.to_lowercase().replace(' ', "-"));
        assert_eq!(called.collect::<Vec<_>>(), all);
        assert_eq!(named("no-such-vehicle"), None);
    }
}
