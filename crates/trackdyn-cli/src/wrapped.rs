//! Lines that a terminal shows whole.

use trackdyn::crates::core::lines;

/// Most characters in a line.
pub const WIDTH: usize = 116;

/// A text behind a label, in lines that a terminal shows whole.
pub fn wrapped(label: &str, text: &str) -> String {
    lines::wrapped(label, text, WIDTH)
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
