//! Names of topics.

/// Names that topics of ROS 2 can have: letters, digits and single `_`, with a letter first; each
/// once.
///
/// # Sources
/// ROS 2 design, "Topic and Service name mapping to DDS".
pub fn unique<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut unique: Vec<String> = Vec::new();
    for name in names {
        let name = valid(name);
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut choices = std::iter::once(name.clone()).chain(numbered);
        let free = choices.find(|choice| !unique.contains(choice));
        unique.push(free.unwrap_or(name));
    }
    unique
}

fn valid(name: &str) -> String {
    let mut valid = String::new();
    for letter in name.chars() {
        let letter = if letter.is_ascii_alphanumeric() { letter } else { '_' };
        if letter != '_' || !valid.ends_with('_') {
            valid.push(letter);
        }
    }
    let valid = valid.trim_matches('_');
    let has_letter = valid.starts_with(|first: char| first.is_ascii_alphabetic());
    if has_letter { valid.to_owned() } else { format!("set_{valid}").trim_end_matches('_').into() }
}

#[cfg(test)]
mod tests {
    use super::unique;

    #[test]
    fn names_are_those_of_topics_and_differ() {
        let names = ["ideal", "my-fit", "my_fit", "a--b..c", "2nd", "ä", "-", "_x_"];
        let expected = ["ideal", "my_fit", "my_fit_2", "a_b_c", "set_2nd", "set", "set_2", "x"];
        assert_eq!(unique(names), expected);
    }
}
