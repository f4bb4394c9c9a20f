//! All mechanisms as a page of the documents.

use crate::mechanisms::MECHANISMS;
use crate::sheet::{Origin, Sheet, Trial};

const HEAD: &str = "# Laws of the second simulator

All mechanisms of the [second simulator](../theory/second-simulator.md). Printed by
`cargo run -p trackdyn-second-simulator --example mechanisms`.

## Of the catalogue

The plain form of each law. The last column compares its size with that of the catalogue's law.
";

const FAMILIES: &str = "
## Families of forms

A [trial](../trials.md) draws a form for each case, by a number in its answers, so that no form can
be learnt. All forms of a family are measured to break one set of symmetries; their sizes mean the
same.
`trackdyn simulate --ground independent --mechanism ID:form=NUMBER` drives on one.
";

const SUM: &str = "
S is a sum of three to six logistic steps, `S(x) = Σ h_i/(1 + (c_i/x)^(1/w_i))`, with random heights
h_i, Σ h_i = 1, places c_i random in ln x between the limits given, and widths w_i from 0.3 to 1.1.
";

const OUTSIDE: &str = "
## Outside the catalogue

The right answer is \"something unknown\". The last column has the
[symmetries](../notation.md#glossary) that are measured to break.
";

/// All mechanisms in words, as Markdown.
pub fn page() -> String {
    let of = |origin: Origin| MECHANISMS.iter().filter(move |sheet| sheet.origin == origin);
    let families = MECHANISMS.iter().filter_map(|sheet| Some((sheet.id, sheet.family?)));
    let drawn: Vec<&str> =
        of(Origin::Outside).filter(|sheet| is_late(sheet)).map(|of| of.id).collect();
    let mut page = HEAD.to_owned();
    page += &table(
        ["id", "law", "size"],
        of(Origin::Catalogue).map(|sheet| [sheet.id.into(), sheet.law.into(), sheet.size.into()]),
    );
    page += FAMILIES;
    page += &table(
        ["id", "law", "a size means"],
        families.map(|(id, family)| [id.into(), family.law.into(), family.size.into()]),
    );
    page += SUM;
    page = page + OUTSIDE + "In trials of drawn forms alone: " + &drawn.join(", ") + ".\n";
    page + &table(
        ["id", "law", "what it is", "breaks"],
        of(Origin::Outside)
            .map(|sheet| [sheet.id.into(), sheet.law.into(), sheet.size.into(), letters(sheet)]),
    )
}

/// Whether trials of plain forms do without it.
fn is_late(sheet: &Sheet) -> bool {
    matches!(sheet.trial, Trial::Law(law) if law.needs_drawn_forms)
}

/// Letters of the symmetries that it breaks.
fn letters(sheet: &Sheet) -> String {
    let letters = sheet.breaks.iter().map(|broken| broken.letter().to_string());
    let letters = letters.collect::<Vec<_>>().join(" ");
    if letters.is_empty() { "none".to_owned() } else { letters }
}

/// A table of Markdown.
fn table<const N: usize>(head: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let escaped = |cells: [String; N]| row(cells.map(|cell| cell.replace('|', "\\|")).to_vec());
    let head = row(head.map(str::to_owned).to_vec()) + "|" + &"---|".repeat(N) + "\n";
    rows.fold(format!("\n{head}"), |table, cells| table + &escaped(cells))
}
