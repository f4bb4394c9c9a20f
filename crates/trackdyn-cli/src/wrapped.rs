//! Lines that a terminal shows whole.

use trackdyn::crates::core::lines;

/// Most characters in a line.
pub const WIDTH: usize = 116;

/// A text behind a label, in lines that a terminal shows whole.
pub fn wrapped(label: &str, text: &str) -> String {
    lines::wrapped(label, text, WIDTH)
}

/// A message in several lines, those of it broken that are too long.
pub fn in_lines(text: &str) -> String {
    let lines = text.split_inclusive('\n').map(|line| {
        let bare = line.trim_end_matches('\n');
        if bare.chars().count() <= WIDTH {
            return line.to_owned();
        }
        let start = if bare.starts_with("error: ") { "error: ".len() } else { indent(bare) };
        let broken = wrapped(&bare[..start], &bare[start..]);
        if line.ends_with('\n') { broken } else { broken.trim_end().to_owned() }
    });
    lines.collect()
}

/// How many blanks a line begins with.
fn indent(line: &str) -> usize {
    line.len() - line.trim_start_matches(' ').len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_lines_of_a_message_are_broken() {
        let long = "word ".repeat(40);
        let text = format!("error: {long}\n\nUsage:  two  blanks\n  {long}");
        let broken = in_lines(&text);
        assert!(broken.lines().all(|line| line.chars().count() <= WIDTH), "{broken}");
        assert!(broken.contains("\n       word") && broken.contains("\n  word"), "{broken}");
        assert!(broken.contains("\n\nUsage:  two  blanks\n"), "{broken}");
        assert_eq!(in_lines("short\n"), "short\n");
    }

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
