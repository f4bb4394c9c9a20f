//! Lines that a terminal shows whole.

/// Most characters in a line.
pub const WIDTH: usize = 116;

/// A text behind a label, its further lines below its first. A text that fits stays as it is. Words
/// that are longer than a line stay whole, for they are paths to be copied.
pub fn wrapped(label: &str, text: &str) -> String {
    let indent = label.chars().count();
    if !text.contains('\n') && indent + text.chars().count() <= WIDTH {
        return format!("{label}{text}").trim_end().to_owned() + "\n";
    }
    let mut lines = vec![label.to_owned()];
    let mut used = indent;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if used > indent && used + 1 + length > WIDTH {
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
    fn long_text_is_broken_between_words_below_its_beginning() {
        let text = "word ".repeat(60);
        let wrapped = wrapped("  - ", &text);
        assert!(wrapped.lines().all(|line| line.chars().count() <= WIDTH));
        assert!(wrapped.lines().skip(1).all(|line| line.starts_with("    word")), "{wrapped}");
        assert_eq!(wrapped.matches("word").count(), 60);
        let long = "x".repeat(200);
        assert_eq!(super::wrapped("a ", &format!("b {long}")), format!("a b\n  {long}\n"));
        assert_eq!(super::wrapped("a", ""), "a\n");
    }
}
