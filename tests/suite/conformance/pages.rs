//! Pages: each stands in the summary of the book, and each link leads somewhere, in the repository
//! as in the book.

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Where pages stand, from the top.
const PLACES: [&str; 4] = ["README.md", "benches", "crates", "docs"];

/// What links of a page need: its own, and the places in it that others may lead to.
#[derive(Default)]
struct Page {
    links: Vec<String>,
    anchors: BTreeSet<String>,
}

impl Page {
    fn of(text: &str) -> Self {
        let mut page = Self::default();
        let mut heading: Option<String> = None;
        for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    page.links.push(dest_url.into_string());
                }
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::Text(text) | Event::Code(text) => {
                    if let Some(heading) = &mut heading {
                        heading.push_str(&text);
                    }
                }
                Event::End(TagEnd::Heading(_)) => {
                    let name = anchor(&heading.take().unwrap_or_default());
                    // a heading that stands twice has its number behind it
                    let numbered = (1..).map(|count| format!("{name}-{count}"));
                    let mut names = std::iter::once(name.clone()).chain(numbered);
                    page.anchors.extend(names.find(|name| !page.anchors.contains(name)));
                }
                _ => {}
            }
        }
        page
    }
}

/// The anchor of a heading, by GitHub and by mdBook.
fn anchor(heading: &str) -> String {
    let signs = heading.trim().chars().filter_map(|sign| match sign {
        ' ' => Some('-'),
        sign if sign.is_alphanumeric() || "-_".contains(sign) => Some(sign),
        _ => None,
    });
    signs.flat_map(char::to_lowercase).collect()
}

/// A path without `.` and `..`; none of one that leaves the repository.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                if !plain.pop() {
                    return None;
                }
            }
            part => plain.push(part),
        }
    }
    Some(plain)
}

/// What is wrong with a link on a page.
fn fault(pages: &BTreeMap<PathBuf, Page>, top: &Path, from: &Path, link: &str) -> Option<String> {
    let is_of_book = from.starts_with("docs");
    if link.contains("://") {
        return None;
    }
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let folder = from.parent().unwrap_or(Path::new(""));
    let to = if file.is_empty() { Some(from.to_owned()) } else { plain(&folder.join(file)) };
    let Some(to) = to.filter(|to| top.join(to).exists()) else {
        return Some("leads nowhere".to_owned());
    };
    if is_of_book && !to.starts_with("docs") {
        return Some("leaves docs, and so the book".to_owned());
    }
    if is_of_book && from != Path::new("docs/SUMMARY.md") && to.ends_with("README.md") {
        return Some("is index.html in the book, where this leads to README.html".to_owned());
    }
    if is_of_book && top.join(&to).is_dir() {
        return Some("leads to a folder, which the book does not show: name a page".to_owned());
    }
    let is_anchor = |page: &Page| anchor.is_empty() || page.anchors.contains(anchor);
    match pages.get(&to) {
        Some(page) if !is_anchor(page) => {
            let anchors: Vec<&str> = page.anchors.iter().map(String::as_str).collect();
            Some(format!("no such heading; there are {}", anchors.join(", ")))
        }
        None if !anchor.is_empty() => Some("an anchor of what is no page".to_owned()),
        _ => None,
    }
}

/// Texts of all pages below a place, by their path from the top.
fn collect(top: &Path, place: &Path, pages: &mut BTreeMap<PathBuf, Page>) {
    let path = top.join(place);
    if path.is_dir() {
        for entry in fs::read_dir(&path).expect("a folder") {
            collect(top, &place.join(entry.expect("readable").file_name()), pages);
        }
        return;
    }
    let text = || fs::read_to_string(&path).expect("text");
    let page = match path.extension().and_then(OsStr::to_str) {
        Some("md") => Page::of(&text()),
        Some("ipynb") => Page::of(&said(&text())),
        _ => return,
    };
    pages.insert(place.to_owned(), page);
}

/// What a notebook says between its code.
fn said(notebook: &str) -> String {
    let notebook: serde_json::Value = serde_json::from_str(notebook).expect("JSON");
    let cells = notebook["cells"].as_array().expect("cells").iter();
    let texts = cells.filter(|cell| cell["cell_type"] == "markdown");
    let lines = texts.flat_map(|cell| cell["source"].as_array().expect("lines"));
    let lines = lines.map(|line| line.as_str().expect("a line").trim_end());
    lines.collect::<Vec<_>>().join("\n")
}

fn all() -> (PathBuf, BTreeMap<PathBuf, Page>) {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut pages = BTreeMap::new();
    for place in PLACES {
        collect(&top, Path::new(place), &mut pages);
    }
    assert!(pages.len() > 50, "only {} pages were seen", pages.len());
    (top, pages)
}

#[test]
fn links_lead_somewhere() {
    let (top, pages) = all();
    let links = pages.iter().flat_map(|(path, page)| page.links.iter().map(move |of| (path, of)));
    let faults: Vec<String> = links
        .filter_map(|(path, link)| {
            let fault = fault(&pages, &top, path, link)?;
            Some(format!("{}: {link}: {fault}", path.display()))
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// What is not in the summary is not in the book.
#[test]
fn the_summary_lists_every_page_once() {
    let (_, mut pages) = all();
    let summary = pages.remove(Path::new("docs/SUMMARY.md")).expect("a summary");
    let is_page = |path: &&PathBuf| path.extension().is_some_and(|extension| extension == "md");
    let pages = pages.keys().filter(is_page);
    let of_docs = pages.filter_map(|path| path.strip_prefix("docs").ok());
    let mut expected: Vec<String> = of_docs.map(|path| path.display().to_string()).collect();
    let mut listed = summary.links;
    expected.sort();
    listed.sort();
    assert_eq!(listed, expected, "docs/SUMMARY.md");
}

#[test]
fn faults_are_seen() {
    let page = Page::of("# A `b`: c, d\n\n## Twice\n\n## Twice\n\n[x](#y) ![z](z.png)\n");
    assert_eq!(page.links, ["#y", "z.png"]);
    let anchors: Vec<&str> = page.anchors.iter().map(String::as_str).collect();
    assert_eq!(anchors, ["a-b-c-d", "twice", "twice-1"]);
    let (top, pages) = all();
    for (from, link, expected) in [
        ("docs/design.md", "theory/diagnosis.md", ""),
        ("docs/design.md", "design.md#scalar-type", ""),
        ("docs/design.md", "#scalar-type", ""),
        ("docs/design.md", "https://example.org", ""),
        ("docs/design.md", "theory", "a folder"),
        ("docs/design.md", "../README.md", "leaves docs"),
        ("docs/design.md", "../../README.md", "leads nowhere"),
        ("docs/design.md", "none.md", "leads nowhere"),
        ("docs/design.md", "#none", "no such heading"),
        ("docs/design.md", "images/power.png#x", "no page"),
        ("README.md", "docs/theory", ""),
        ("README.md", "../trackdyn/index.html", "leads nowhere"),
    ] {
        let found = fault(&pages, &top, Path::new(from), link).unwrap_or_default();
        let is_expected =
            if expected.is_empty() { found.is_empty() } else { found.contains(expected) };
        assert!(is_expected, "{from}: {link}: {found}");
    }
}
