//! The words of a name, as `front`, `left` and `wheel` of `frontLeftWheel`.

/// Words that name the left side: by themselves, or as a letter beside that of an axle.
pub(super) const LEFT: [&str; 8] = ["fl", "ml", "cl", "rl", "bl", "lf", "lm", "lb"];
/// Words that name the right side.
pub(super) const RIGHT: [&str; 8] = ["fr", "mr", "cr", "rr", "br", "rf", "rm", "rb"];

pub(super) const WHEEL: [&str; 19] = [
    "wheel",
    "wheels",
    "whl",
    "track",
    "tracks",
    "tread",
    "treads",
    "sprocket",
    "sprockets",
    "belt",
    "belts",
    "crawler",
    "crawlers",
    "drive",
    "motor",
    "motors",
    "tire",
    "tyre",
    "caterpillar",
];

/// Words that are written together, as in `frontleftwheel`.
const JOINED_WORDS: [&str; 10] =
    ["front", "rear", "back", "middle", "mid", "center", "centre", "left", "right", "joint"];

/// The words of a name in small letters: it is split at all that is no letter, at capitals, and
/// where words of sides, axles and wheels are written together.
pub(super) fn words(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut words = Vec::new();
    let mut word = String::new();
    for (place, &letter) in letters.iter().enumerate() {
        let before = place.checked_sub(1).map(|before| letters[before]);
        // frontLeft, FLWheel
        let begins = letter.is_uppercase()
            && before.is_some_and(|before| {
                before.is_lowercase()
                    || (before.is_uppercase()
                        && letters.get(place + 1).is_some_and(|next| next.is_lowercase()))
            });
        if (begins || !letter.is_alphabetic()) && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        if letter.is_alphabetic() {
            word.extend(letter.to_lowercase());
        }
    }
    if !word.is_empty() {
        words.push(word);
    }
    words.iter().flat_map(|word| parted(word)).collect()
}

/// The words that one is made of; itself where it is not made of known ones.
fn parted(word: &str) -> Vec<String> {
    let known = |part: &str| JOINED_WORDS.contains(&part) || WHEEL.contains(&part);
    let is_side =
        |part: &str| LEFT.contains(&part) || RIGHT.contains(&part) || part == "l" || part == "r";
    // Short words of a side stand at an end, before or after a longer word: lwheel, wheelfl.
    for length in [2, 1] {
        if let (Some(start), Some(rest)) = (word.get(..length), word.get(length..))
            && is_side(start)
            && let Some(parts) = all_known(rest, &known)
        {
            return [vec![start.to_owned()], parts].concat();
        }
        let at = word.len().saturating_sub(length);
        if let (Some(rest), Some(end)) = (word.get(..at), word.get(at..))
            && is_side(end)
            && let Some(parts) = all_known(rest, &known)
        {
            return [parts, vec![end.to_owned()]].concat();
        }
    }
    all_known(word, &known).unwrap_or_else(|| vec![word.to_owned()])
}

/// The known words that a word is made of; none where something is left.
fn all_known(word: &str, known: &impl Fn(&str) -> bool) -> Option<Vec<String>> {
    if known(word) {
        return Some(vec![word.to_owned()]);
    }
    let splits = word.char_indices().map(|(at, _)| at).skip(3);
    splits.filter(|&at| known(&word[..at])).find_map(|at| {
        let rest = all_known(&word[at..], known)?;
        Some([vec![word[..at].to_owned()], rest].concat())
    })
}
