//! Text in lines.

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
