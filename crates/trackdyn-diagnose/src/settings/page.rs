//! The settings as a page of the documents.

use super::{Entry, Settings};
use std::fmt::Write as _;
use toml::Value;

const HEAD: &str = "# Settings of the diagnosis

All numbers that decide an answer, by stage: what each is, why, and what happens when it is wrong.
Printed by `cargo run -p trackdyn-diagnose --example settings`.

A caller sets what differs, in Rust or as a table:

```toml
[verdict]
max_p = 0.001
```

`diagnosis.toml` records it in `[settings]`. Units: gauge is that of the vehicle, sd a standard
deviation of the noise. When wrong: ↓ a lower value, ↑ a higher one.

*Accuracy* decides nothing by itself. Coarser values make minima jump and derivatives err, finer
ones take longer. Each is explained at its field in `trackdyn_diagnose::settings`.
";

/// All settings in words, as Markdown.
pub fn page() -> String {
    let mut page = HEAD.to_owned();
    for (group, about, entries) in Settings::groups() {
        let _ = write!(page, "\n## {group}\n\n{about}\n");
        let (decides, accuracy): (Vec<&Entry>, Vec<&Entry>) =
            entries.iter().partition(|entry| entry.if_wrong.is_some());
        if !decides.is_empty() {
            page += "\nname | default | what, why, when wrong\n---|---|---\n";
        }
        for entry in decides {
            let Entry { meaning, why, .. } = entry;
            let wrong = with_arrows(entry.if_wrong.unwrap_or_default());
            let (name, default) = (name(entry), default(entry));
            let _ = writeln!(page, "`{name}` | {default} | {meaning} {why} {wrong}");
        }
        if !accuracy.is_empty() {
            let accuracy = accuracy.into_iter();
            let accuracy = accuracy.map(|entry| format!("`{}` {}", name(entry), default(entry)));
            let _ = writeln!(page, "\n*Accuracy:* {}.", accuracy.collect::<Vec<_>>().join("; "));
        }
    }
    page
}

/// What happens when a setting is wrong, with arrows for the words "lower" and "higher".
fn with_arrows(if_wrong: &str) -> String {
    let words = [("Lower: ", "↓ "), ("lower: ", "↓ "), ("Higher: ", "↑ "), ("higher: ", "↑ ")];
    words.into_iter().fold(if_wrong.to_owned(), |text, (word, arrow)| text.replace(word, arrow))
}

/// The name within the group.
fn name(entry: &Entry) -> &str {
    entry.path.split_once('.').map_or(&*entry.path, |(_, name)| name)
}

/// The default with its unit.
fn default(entry: &Entry) -> String {
    let default = text(&entry.default);
    if entry.unit.is_empty() { default } else { format!("{default} {}", entry.unit) }
}

/// A value as one reads it.
fn text(value: &Value) -> String {
    match value {
        Value::Float(number) => number.to_string(),
        Value::Array(values) => values.iter().map(text).collect::<Vec<_>>().join(", "),
        other => other.to_string(),
    }
}
