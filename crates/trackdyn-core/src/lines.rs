//! Text in lines.

/// A text of at most so many characters; where it has more, its beginning and how many it has.
pub fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
    }
}

/// A count with its noun.
///
/// ```
/// use trackdyn_core::lines::counted;
/// assert_eq!([counted(1, "run"), counted(2, "run")], ["1 run", "2 runs"]);
/// ```
pub fn counted(count: usize, noun: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{ending}")
}

/// A text behind a label in lines of at most `width` characters, its further lines below its first.
/// A text that fits stays as it is. Words that are longer than a line stay whole, for they are
/// paths to be copied.
pub fn wrapped(label: &str, text: &str, width: usize) -> String {
    let indent = label.chars().count();
    if !text.contains('\n') && indent + text.chars().count() <= width {
        return format!("{label}{text}").trim_end().to_owned() + "\n";
    }
    let mut lines = vec![label.to_owned()];
    let mut used = indent;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if used > indent && used + 1 + length > width {
            lines.push(" ".repeat(indent));
            used = indent;
        }
        if let Some(line) = lines.last_mut() {
            if used > indent {
                line.push(' ');
                used += 1;
            }
            line.push_str(word);
            used += length;
        }
    }
    lines.join("\n").trim_end().to_owned() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_is_shortened_and_counted() {
        assert_eq!(shortened("übel", 4), "übel");
        assert_eq!(shortened("übler", 4), "üble… (5 characters)");
    }
}
