//! Text that a terminal may be shown, wherever it is from.

/// Longest word, characters: longer ones are no paths.
const MAX_WORD: usize = 1000;

/// Most digits that a number is shown with; all that a number holds are 17.
const MAX_DIGITS: usize = 24;

/// A text without what a terminal would obey or a reader could not read. Characters that move the
/// cursor, colour, or turn the direction of writing stand by their code; very long words end with
/// how long they are; numbers of many digits have an exponent.
pub fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for piece in text.split_inclusive([' ', '\n']) {
        let word = piece.trim_end_matches([' ', '\n']);
        if !word.bytes().all(|byte| byte.is_ascii_graphic()) || word.len() > MAX_DIGITS {
            push_word(word, &mut plain);
        } else {
            plain.push_str(word);
        }
        plain.push_str(&piece[word.len()..]);
    }
    plain
}

fn push_word(word: &str, plain: &mut String) {
    let kept = word.char_indices().nth(MAX_WORD).map_or(word, |(end, _)| &word[..end]);
    let mut rest = kept;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        push_visible(&rest[..start], plain);
        let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
        let end = rest[start..].find(|c| !is_of_number(c)).map_or(rest.len(), |end| start + end);
        let number = &rest[start..end];
        match number.trim_end_matches('.').parse::<f64>() {
            // such as 1e308, which stands with all its zeros otherwise
            Ok(value) if number.len() > MAX_DIGITS => {
                let shown = format!("{value:e}");
                plain.push_str(&shown);
            }
            _ => plain.push_str(number),
        }
        rest = &rest[end..];
    }
    push_visible(rest, plain);
    if kept.len() < word.len() {
        let length = format!("… ({} characters)", word.chars().count());
        plain.push_str(&length);
    }
}

fn push_visible(text: &str, plain: &mut String) {
    for c in text.chars() {
        if is_obeyed(c) {
            plain.extend(c.escape_unicode());
        } else {
            plain.push(c);
        }
    }
}

/// Whether a terminal does something else with a character than to show it: control characters, and
/// those that set the direction of writing (Unicode, UAX #9) or are not seen.
fn is_obeyed(c: char) -> bool {
    let is_control = c.is_control() && c != '\t';
    is_control
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_stands_by_its_code() {
        assert_eq!(plain("a\u{1b}[31mb\u{202e}c\r\n\td"), "a\\u{1b}[31mb\\u{202e}c\\u{d}\n\td");
        assert_eq!(plain("±1 m/s², ψ = 3°  λ\n"), "±1 m/s², ψ = 3°  λ\n");
    }

    #[test]
    fn long_numbers_and_words_are_short() {
        assert_eq!(plain(&format!("speed={}: m", 1e308)), "speed=1e308: m");
        assert_eq!(plain(&format!("[{}, -{:?}]", 5e-324, 1e30)), "[5e-324, -1e30]");
        let hash = "0123456789abcdef".repeat(4);
        assert_eq!(plain(&hash), hash);
        assert_eq!(plain("0.12345678901234567 12."), "0.12345678901234567 12.");
        let long = plain(&"x".repeat(100_000));
        assert_eq!(long, "x".repeat(1000) + "… (100000 characters)");
    }
}
