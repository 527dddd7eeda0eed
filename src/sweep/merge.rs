//! The rows of all shards put together: each run once, in order.

use std::path::Path;

use super::shard::{Identity, Rows};
use super::table::{Cell, Columns, Row};
use crate::Error;
use crate::output::numbers::counted;

/// The rows of a finished sweep in order.
///
/// # Errors
/// Shards of different plans or versions; runs that came out differently in two of them; runs that are missing.
pub fn merged(folder: &Path, shards: &[Rows], columns: &Columns) -> Result<(Identity, Vec<Row>), Error> {
    let Some(first) = shards.first() else {
        let hint = "choque sweep PLAN.ron -o DIR makes some".to_owned();
        return Err(Error::Call { message: format!("{} holds no shards", folder.display()), hint });
    };
    let identity = first.identity.clone();
    for shard in shards {
        same_sweep(first, shard)?;
    }
    let mut rows: Vec<Option<(&Row, &Rows)>> = vec![None; identity.runs];
    // Rows stand in the order in which runs ended, which is never the same: of several that contradict the first run is told of.
    let mut contradiction: Option<[(&Row, &Rows); 2]> = None;
    for (shard, row) in shards.iter().flat_map(|shard| shard.rows.iter().map(move |row| (shard, row))) {
        match rows[row.run] {
            None => rows[row.run] = Some((row, shard)),
            Some((known, _)) if known.cells == row.cells => {}
            Some(_) if contradiction.is_some_and(|[(first, _), _]| first.run <= row.run) => {}
            Some(known) => contradiction = Some([known, (row, shard)]),
        }
    }
    if let Some([one, other]) = contradiction {
        return Err(differ(one, other, columns));
    }
    let missing: Vec<usize> = (0..rows.len()).filter(|run| rows[*run].is_none()).collect();
    if !missing.is_empty() {
        let message =
            format!("{} of {} are missing: {}", missing.len(), counted(identity.runs, "run", "runs"), ranges(&missing));
        let hint =
            "run the other shards into this folder, or call choque sweep again: it goes on where it was".to_owned();
        return Err(Error::Call { message, hint });
    }
    Ok((identity, rows.into_iter().flatten().map(|(row, _)| row.clone()).collect()))
}

fn same_sweep(first: &Rows, other: &Rows) -> Result<(), Error> {
    if first.identity == other.identity {
        return Ok(());
    }
    let different = if first.identity.version == other.identity.version { "plans" } else { "versions of choque" };
    let message = format!("{} and {} come from different {different}", first.path.display(), other.path.display());
    Err(Error::Call { message, hint: "keep the shards of one sweep in a folder of their own".to_owned() })
}

/// A run that was made twice and did not come out alike: its machine, its build or its files differ.
fn differ((a, in_a): (&Row, &Rows), (b, in_b): (&Row, &Rows), columns: &Columns) -> Error {
    let cell = |row: &Row, name: &str| columns.position(name).map_or(Cell::Missing, |at| row.cells[at].clone()).text();
    let digests = [a, b].map(|row| match cell(row, "digest") {
        digest if digest.is_empty() => "an error".to_owned(),
        digest => format!("digest {digest}"),
    });
    let column = (0..a.cells.len()).find(|at| a.cells[*at] != b.cells[*at]).map_or("", |at| &columns.all[at].name);
    let message = format!(
        "run {} (scenario {}, point {}, seed {}) was made twice and came out differently: {} in {}, {} in {}; the first \
         column that differs is {column}",
        a.run,
        cell(a, "scenario"),
        cell(a, "point"),
        cell(a, "seed"),
        digests[0],
        in_a.path.display(),
        digests[1],
        in_b.path.display(),
    );
    Error::Call { message, hint: "the two were not made by the same program from the same files".to_owned() }
}

/// `0–3, 7 and 12 more`.
fn ranges(numbers: &[usize]) -> String {
    const TOLD: usize = 5;
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for number in numbers {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == *number => *last = *number,
            _ => ranges.push((*number, *number)),
        }
    }
    let rest: usize = ranges.iter().skip(TOLD).map(|(from, to)| to - from + 1).sum();
    let told = ranges.iter().take(TOLD);
    let told = told.map(|(from, to)| if from == to { from.to_string() } else { format!("{from}–{to}") });
    let told = told.collect::<Vec<_>>().join(", ");
    if rest == 0 { told } else { format!("{told} and {rest} more") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_runs_are_told_in_ranges() {
        assert_eq!(ranges(&[0, 1, 2, 3, 7]), "0–3, 7");
        assert_eq!(ranges(&[0, 2, 4, 6, 8, 10, 11]), "0, 2, 4, 6, 8 and 2 more");
    }
}
