//! Questions on a terminal.

use std::io::{BufRead, Write, stderr, stdin};

/// Who answers, and where questions are asked.
pub struct Questions<'a> {
    answers: Box<dyn BufRead + 'a>,
    asked: Box<dyn Write + 'a>,
}

impl Questions<'static> {
    /// Of the terminal: questions are talk, and go to stderr.
    pub fn of_terminal() -> Self {
        Self::new(stdin().lock(), stderr())
    }
}

impl<'a> Questions<'a> {
    /// Questions to a writer, with answers line by line.
    pub fn new(answers: impl BufRead + 'a, asked: impl Write + 'a) -> Self {
        Self { answers: Box::new(answers), asked: Box::new(asked) }
    }

    /// Asks until the answer is understood.
    ///
    /// # Errors
    /// The question, where answers end.
    pub fn until<T>(
        &mut self,
        question: &str,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Result<T, String> {
        loop {
            let answer = self.answer(question)?;
            match read(&answer) {
                Ok(value) => return Ok(value),
                Err(expected) => self.say(&format!("  {answer}: {expected}\n")),
            }
        }
    }

    /// Asks where nothing is known.
    ///
    /// # Errors
    /// As [`Questions::until`].
    pub fn unless<T>(
        &mut self,
        known: Option<T>,
        question: &str,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Result<T, String> {
        known.map_or_else(|| self.until(question, read), Ok)
    }

    /// Asks for what may stay open; none by an empty answer.
    ///
    /// # Errors
    /// As [`Questions::until`].
    pub fn optional<T>(
        &mut self,
        question: &str,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Result<Option<T>, String> {
        let read = |text: &str| if text.is_empty() { Ok(None) } else { read(text).map(Some) };
        self.until(question, read)
    }

    /// Whether it is the second of two, by the beginning of its name.
    ///
    /// # Errors
    /// As [`Questions::until`].
    pub fn choice(&mut self, first: &str, second: &str) -> Result<bool, String> {
        self.until(&format!("{first} or {second}"), |text| {
            let is = |name: &str| !text.is_empty() && name.starts_with(&text.to_lowercase());
            match (is(first), is(second)) {
                (true, false) => Ok(false),
                (false, true) => Ok(true),
                _ => Err(format!("expected {first} or {second}")),
            }
        })
    }

    fn answer(&mut self, question: &str) -> Result<String, String> {
        self.say(&format!("{question}: "));
        let mut line = String::new();
        match self.answers.read_line(&mut line) {
            Ok(count) if count > 0 => Ok(line.trim().to_owned()),
            _ => Err(format!("no answer: expected {question}")),
        }
    }

    fn say(&mut self, text: &str) {
        // Where a question cannot be shown, its answer may still come.
        let _ = self.asked.write_all(text.as_bytes()).and_then(|()| self.asked.flush());
    }
}
