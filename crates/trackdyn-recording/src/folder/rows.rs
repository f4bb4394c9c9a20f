//! The rows of one CSV file, sorted into runs.

use crate::Error;
use crate::recording::Warning;
use crate::sample::{Cells, Column, Sample, Series};
use crate::table::{Table, number};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

/// The series of every run in a file.
pub(crate) struct Rows<S> {
    /// Whether the file has a column `run`; without it, all is run 0.
    pub(crate) has_runs: bool,
    /// The series by the number of their run.
    pub(crate) runs: BTreeMap<i64, Series<S>>,
    /// What was left out.
    pub(crate) warnings: Vec<Warning>,
}

/// Reads a file with the columns of `S`, maybe `run`, and any others.
///
/// # Errors
/// Those of [`Table`]; [`Error::Empty`] when there is no row.
pub(crate) fn read_rows<S: Sample>(path: &Path) -> Result<Rows<S>, Error> {
    let mut texts = BTreeSet::new();
    loop {
        match attempt(path, &texts)? {
            Attempt::Done(rows) => return Ok(rows),
            Attempt::AreTexts(columns) => texts.extend(columns),
        }
    }
}

enum Attempt<S> {
    Done(Rows<S>),
    /// Columns in which a row has text where rows before it had numbers.
    AreTexts(Vec<usize>),
}

/// One pass over the file that takes all further columns but `texts` for numbers.
fn attempt<S: Sample>(path: &Path, texts: &BTreeSet<usize>) -> Result<Attempt<S>, Error> {
    let mut table = Table::open(path, S::COLUMNS)?.of_log(S::COLUMNS);
    let known: Vec<usize> = S::COLUMNS.iter().filter_map(|name| table.column(name)).collect();
    let run_column = table.column("run");
    let further: Vec<usize> = (0..table.header().len())
        .filter(|column| !known.contains(column) && Some(*column) != run_column)
        .collect();
    let empty = || Series {
        samples: Vec::new(),
        extra: further
            .iter()
            .map(|&column| Column {
                name: table.header()[column].clone(),
                cells: if texts.contains(&column) {
                    Cells::Texts(Vec::new())
                } else {
                    Cells::Numbers(Vec::new())
                },
            })
            .collect(),
    };
    let pattern = empty();

    let mut ids: Vec<i64> = Vec::new();
    let mut places: HashMap<i64, usize> = HashMap::new();
    let mut series: Vec<Series<S>> = Vec::new();
    let mut current = 0;
    let mut columns = vec![0.0; known.len()];
    while table.advance()? {
        for (value, &column) in columns.iter_mut().zip(&known) {
            *value = table.number(column)?;
        }
        let id = run_column.map_or(Ok(0), |column| table.integer(column))?;
        if ids.get(current) != Some(&id) {
            current = *places.entry(id).or_insert(ids.len());
            if current == ids.len() {
                ids.push(id);
                series.push(pattern.clone());
            }
        }
        let target = &mut series[current];
        let mut are_texts = Vec::new();
        target.samples.push(S::from_columns(&columns));
        for (column, &at) in target.extra.iter_mut().zip(&further) {
            match &mut column.cells {
                Cells::Numbers(cells) => match number(table.cell(at)) {
                    Some(value) => cells.push(value),
                    None => are_texts.push(at),
                },
                Cells::Texts(cells) => {
                    cells.push(String::from_utf8_lossy(table.cell(at)).into_owned());
                }
            }
        }
        if !are_texts.is_empty() {
            return Ok(Attempt::AreTexts(are_texts));
        }
    }
    if ids.is_empty() {
        let message = "no rows below the header".to_owned();
        return Err(Error::Empty { path: path.to_owned(), message });
    }
    let runs = ids.into_iter().zip(series).collect();
    let (has_runs, warnings) = (run_column.is_some(), table.left_out());
    Ok(Attempt::Done(Rows { has_runs, runs, warnings }))
}
