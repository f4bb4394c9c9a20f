//! Where an exported file comes from, as a comment at its head.

/// Where an exported file comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Path of the kinematics file.
    pub source: String,
    /// Fingerprint of its bytes: see [`trackdyn_core::output::fingerprint`].
    pub fingerprint: String,
    /// Name of the vehicle whose kinematics they are.
    pub vehicle: String,
    /// Version of the program.
    pub version: String,
    /// The command line.
    pub command: String,
}

impl Provenance {
    /// The header and further lines of text as a comment of YAML and Python.
    pub(crate) fn hash_comment(&self, notes: &str) -> String {
        self.lines(notes).map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect()
    }

    /// The header and further lines of text as a comment of XML.
    pub(crate) fn xml_comment(&self, notes: &str) -> String {
        let lines: String = self
            .lines(notes)
            .map(|line| format!("  {line}").trim_end().to_owned() + "\n")
            .collect();
        // XML forbids two hyphens in a row within a comment.
        let mut apart = lines.replace("--", "- -");
        while apart.contains("--") {
            apart = apart.replace("--", "- -");
        }
        format!("<!--\n{apart}-->\n")
    }

    /// The header and further lines of text as a comment of C.
    pub(crate) fn c_comment(&self, notes: &str) -> String {
        let lines: String = self
            .lines(notes)
            .map(|line| format!(" * {}", line.replace("*/", "* /")).trim_end().to_owned() + "\n")
            .collect();
        format!("/*\n{lines} */\n")
    }

    fn lines(&self, notes: &str) -> impl Iterator<Item = String> {
        let header = [
            format!("Written by trackdyn {}", self.version),
            format!("command: {}", self.command),
            format!("source: {}, SHA-256 {}...", self.source, self.fingerprint),
            format!("vehicle: {}", self.vehicle),
            String::new(),
        ];
        // A path may hold a line break, which would end the comment.
        let header = header.map(|line| line.replace(char::is_control, " "));
        header.into_iter().chain(notes.lines().map(str::to_owned).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_hold_any_command() {
        let provenance = Provenance {
            command: "trackdyn export gz a---b\nc --out x-->".to_owned(),
            ..Provenance::default()
        };
        let xml = format!("{}<a/>", provenance.xml_comment("note\n"));
        assert!(roxmltree::Document::parse(&xml).is_ok(), "{xml}");
        let hash = provenance.hash_comment("note\n\nnote");
        assert!(hash.lines().all(|line| line.starts_with('#')), "{hash}");
    }
}
