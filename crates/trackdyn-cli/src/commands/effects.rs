//! `trackdyn effects`: the catalogue.

use crate::commands::Outcome;
use crate::exit::Exit;
use crate::stdout::show;
use crate::wrapped::wrapped;
use clap::Args;
use std::fmt::Write;
use trackdyn::{ActiveEffect, Card, Parameter, Symmetry, Term, effects};

/// Options of `trackdyn effects`.
#[derive(Args)]
pub struct Options {
    /// Show one effect in full
    id: Option<String>,
    /// Print the catalogue as the Markdown of docs/effects.md
    #[arg(long)]
    markdown: bool,
}

/// Prints the catalogue or one card.
pub fn run(options: &Options) -> Outcome {
    let text = match &options.id {
        Some(id) => {
            let effect = ActiveEffect::new(id, &[])?;
            if options.markdown { markdown_card(effect.card()) } else { card(effect.card()) }
        }
        None if options.markdown => markdown(),
        None => list(),
    };
    show(&text)?;
    Ok(Exit::Done)
}

/// The letters of the symmetries that an effect, or a term of a form, breaks.
fn letters(breaks: &[Symmetry]) -> String {
    let of = |symmetry| if breaks.contains(&symmetry) { symmetry.letter() } else { '.' };
    Symmetry::ALL.map(of).into_iter().collect()
}

/// Parameters that no term of a form holds: all of a mechanism.
fn alone(card: &Card) -> impl Iterator<Item = &'static Parameter> {
    let of_terms: Vec<usize> = card.terms().into_iter().flat_map(|one| one.coefficients).collect();
    let all = card.parameters.iter().enumerate();
    all.filter(move |(place, _)| !of_terms.contains(place)).map(|(_, parameter)| parameter)
}

/// Keys of the coefficients of a term.
fn keys(card: &Card, term: &Term) -> Vec<&'static str> {
    term.coefficients.iter().map(|&place| card.parameters[place].key).collect()
}

fn stages(card: &Card) -> String {
    card.stages.iter().map(|stage| stage.name()).collect::<Vec<_>>().join(", ")
}

fn list() -> String {
    let width = effects().iter().map(|card| card.id.len()).max().unwrap_or(0);
    let mut text = format!("{:width$}  breaks  what it is\n", "effect");
    for card in effects() {
        let _ = writeln!(text, "{:width$}  {}   {}", card.id, letters(card.breaks), card.title);
    }
    text += "\n\
        breaks: the ICRs change with S speed, R reversal, P manoeuvre, M mirror, H heading,\n\
        X place, T time, D transients; 0: equal track speeds do not drive straight ahead as \
        encoders show.\n\
        `trackdyn effects ID` shows law, parameters and sources.\n";
    if let Some(card) = effects().iter().find(|card| card.moves_load()) {
        let (id, Parameter { key, typical, .. }) = (card.id, &card.parameters[0]);
        let _ = write!(
            text,
            "Switch one on: --effect {id}:{key}={typical}, or in a vehicle file\n\
             [effect.{id}]\n\
             {key} = {typical}\n"
        );
    }
    text
}

fn card(card: &Card) -> String {
    let mut text = format!("{}: {}\n\n", card.id, card.title);
    let mut row = |name: &str, value: &str| {
        text.push_str(&wrapped(&format!("{name:9}"), value));
    };
    row("law", card.law);
    row("assumes", card.assumes);
    row("shows", card.shows);
    if !card.resembles.is_empty() {
        row("alike", card.resembles);
    }
    row("breaks", &letters(card.breaks));
    row("acts at", &stages(card));
    for term in card.terms() {
        row(if term.key == card.parameters[0].key { "terms" } else { "" }, &{
            format!("{}  {}", letters(&term.breaks), keys(card, &term).join(", "))
        });
    }
    for parameter in alone(card) {
        let [low, high] = parameter.range;
        row("", "");
        row(parameter.symbol, &format!("{} [{}]", parameter.key, parameter.unit));
        row("", parameter.meaning);
        row("", &format!("{low} to {high}, typically {}", parameter.typical));
    }
    row("", "");
    for (k, source) in card.sources.iter().enumerate() {
        row(if k == 0 { "source" } else { "" }, source);
    }
    text
}

fn markdown() -> String {
    let mut text = "# Effects\n\n\
        Physics beyond the base model, each in one file of `crates/trackdyn-model/src/effects`. \
        This page is printed by `trackdyn effects --markdown`.\n\n\
        An effect *breaks* a symmetry when the ICRs change under it: **S** all speeds scaled, \
        **R** all speeds reversed, **P** another manoeuvre, **M** left and right exchanged, \
        **H** another heading, **X** another place, **T** another time, **D** speeds that change \
        instead of steady ones. It breaks **0** when equal track speeds do not drive straight \
        ahead as fast as the encoders show.\n\n\
        The *class of constants* moves the constant ICRs and nothing else. ICRs alone do not tell \
        its members apart.\n\n\
        A parameter's *role* is **size** (how large the effect is: with neutral sizes there is \
        none), **place** or **direction** (where in the world it acts), **time** (when it acts), \
        or **shape** (a constant of the law).\n\n\
        An effect is a mechanism, unless its section has a table of coefficients: then it is a \
        *form*, which describes without a cause. A diagnosis never names a form; it proposes \
        terms of one. Coefficients in one row are one term, described by the first. Those left \
        out are zero.\n\n"
        .to_owned();
    text += "| effect | what it is | breaks | acts at |\n|---|---|---|---|\n";
    for card in effects() {
        let breaks: String = card.breaks.iter().map(|symmetry| symmetry.letter()).collect();
        let (id, title, stages) = (card.id, card.title, stages(card));
        let _ = writeln!(text, "| [{id}](#{id}) | {title} | {breaks} | {stages} |");
    }
    for card in effects() {
        text += "\n";
        text += &markdown_card(card);
    }
    text
}

/// Smallest and largest value of a parameter.
fn range(parameter: &Parameter) -> String {
    let [low, high] = parameter.range;
    if low + high == 0.0 { format!("±{high}") } else { format!("{low} to {high}") }
}

/// The terms of a form; nothing of a mechanism.
fn markdown_terms(card: &Card) -> String {
    let terms = card.terms();
    let mut text = String::new();
    if terms.is_empty() {
        return text;
    }
    text +=
        "| coefficients | what they multiply | breaks | typical | range |\n|---|---|---|---|---|\n";
    for term in terms {
        let keys: Vec<String> = keys(card, &term).iter().map(|key| format!("`{key}`")).collect();
        let parameter = &card.parameters[term.coefficients[0]];
        let breaks: String = term.breaks.iter().map(|symmetry| symmetry.letter()).collect();
        let _ = writeln!(
            text,
            "| {} | {} | {breaks} | {} | {} |",
            keys.join(", "),
            parameter.meaning.replace('|', "\\|"),
            parameter.typical,
            range(parameter),
        );
    }
    text.push('\n');
    text
}

fn markdown_card(card: &Card) -> String {
    let mut text = format!("## {}\n\n", card.id);
    let _ = writeln!(text, "**Law.** {}\n", card.law);
    let _ = writeln!(text, "**Assumes.** {}\n", card.assumes);
    let _ = writeln!(text, "**Shows.** {}\n", card.shows);
    if !card.resembles.is_empty() {
        let _ = writeln!(text, "**Acts alike.** {}\n", card.resembles);
    }
    text += &markdown_terms(card);
    for parameter in alone(card) {
        let unit = if parameter.unit == "1" { "" } else { parameter.unit };
        let _ = writeln!(
            text,
            "- `{}` ({}, {}): {}; {}, typically {} {unit}",
            parameter.key,
            parameter.symbol,
            parameter.role.name(),
            parameter.meaning,
            range(parameter),
            parameter.typical,
        );
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    let _ = writeln!(text, "\n**Sources.** {}.", card.sources.join("; "));
    text
}
