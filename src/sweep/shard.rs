//! A shard's file: the rows of its runs as they are made, so that a sweep that was stopped goes on where it was.
//!
//! The first line says what the rows belong to, the second names the columns; then a row a line, in the order in which
//! runs ended. Every row is written in one go; of a row that was cut off nothing counts.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::table::{Columns, Row};
use crate::Error;

/// What rows belong to: rows of two different ones must never meet in one table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// The program's version.
    pub version: String,
    /// The plan's fingerprint.
    pub plan: String,
    /// How many runs the plan has.
    pub runs: usize,
}

/// Which part of the runs: the k-th of n, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which.
    pub k: usize,
    /// Of how many.
    pub n: usize,
}

/// What the file of a shard holds.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The file.
    pub path: PathBuf,
    /// What its rows belong to.
    pub identity: Identity,
    /// In the order of the file.
    pub rows: Vec<Row>,
    /// Bytes up to the end of the last whole row.
    pub whole: u64,
}

/// What the first line begins with.
const MARK: &str = "# choque sweep";

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Shard = Shard { k: 1, n: 1 };

    /// Reads `k/n`.
    ///
    /// # Errors
    /// What is none.
    pub fn parse(text: &str) -> Result<Shard, String> {
        let read = |part: &str| part.trim().parse::<usize>().ok();
        let parts = text.split_once('/').and_then(|(k, n)| Some((read(k)?, read(n)?)));
        parts
            .filter(|(k, n)| (1..=*n).contains(k))
            .map(|(k, n)| Shard { k, n })
            .ok_or_else(|| "write it as K/N with K from 1 to N, for example --shard 2/8".to_owned())
    }

    /// Whether a run is one of its own.
    #[must_use]
    pub fn has(self, run: usize) -> bool {
        run % self.n == self.k - 1
    }

    /// The name of its file.
    #[must_use]
    pub fn file(self) -> String {
        format!("shard_{}_of_{}.csv", self.k, self.n)
    }
}

impl Identity {
    fn line(&self) -> String {
        let Identity { version, plan, runs } = self;
        format!("{MARK}, choque {version}, plan {plan}, {runs} runs\n")
    }

    fn parse(line: &str) -> Option<Identity> {
        let mut parts = line.strip_prefix(MARK)?.split(", ").skip(1);
        let version = parts.next()?.strip_prefix("choque ")?.to_owned();
        let plan = parts.next()?.strip_prefix("plan ")?.to_owned();
        let runs = parts.next()?.strip_suffix(" runs")?.parse().ok()?;
        Some(Identity { version, plan, runs })
    }

    /// Refuses rows that belong to something else.
    ///
    /// # Errors
    /// Which of the two differs.
    pub fn check(&self, rows: &Rows) -> Result<(), Error> {
        let other = &rows.identity;
        if self == other {
            return Ok(());
        }
        let why = if self.version != other.version {
            format!("was made by choque {}, and this is {}", other.version, self.version)
        } else {
            format!("belongs to another plan, or its scenarios have changed ({} here, {} there)", self.plan, other.plan)
        };
        let message = format!("{} {why}", rows.path.display());
        Err(Error::Call { message, hint: "give another folder: -o DIR; or remove this one".to_owned() })
    }
}

/// The shard files of a folder, in the order of their names; none when there is no such folder.
///
/// # Errors
/// What cannot be read, or is damaged.
pub fn read_all(folder: &Path, columns: &Columns) -> Result<Vec<Rows>, Error> {
    let mut files = Vec::new();
    if folder.is_dir() {
        let failed = |source| Error::File { verb: "read", path: folder.to_owned(), source };
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            let name = entry.map_err(failed)?.file_name();
            let is_shard = name.to_str().is_some_and(|name| name.starts_with("shard_") && name.ends_with(".csv"));
            files.extend(is_shard.then(|| folder.join(name)));
        }
    }
    files.sort();
    files.iter().map(|path| read(path, columns)).filter_map(Result::transpose).collect()
}

/// Reads a shard's file; nothing when not even its head was written whole.
fn read(path: &Path, columns: &Columns) -> Result<Option<Rows>, Error> {
    let bytes = std::fs::read(path).map_err(|source| Error::File { verb: "read", path: path.to_owned(), source })?;
    let end = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
    let damaged = |line: usize| Error::Call {
        message: format!("{}: line {line} is no row of this sweep", path.display()),
        hint: "remove the line, or the file: what is missing is run again".to_owned(),
    };
    let text = std::str::from_utf8(&bytes[..end])
        .map_err(|error| damaged(1 + bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count()))?;
    let mut lines = text.lines();
    let Some((first, headings)) = lines.next().zip(lines.next()) else { return Ok(None) };
    let identity = Identity::parse(first).ok_or_else(|| damaged(1))?;
    if [headings.as_bytes(), b"\n"].concat() != columns.headings() {
        let hint = "its plan was changed: give another folder".to_owned();
        return Err(Error::Call { message: format!("{} has other columns", path.display()), hint });
    }
    let body = &text[first.len() + headings.len() + 2..];
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(body.as_bytes());
    let mut rows = Vec::new();
    for (number, record) in reader.records().enumerate() {
        let row = record.ok().and_then(|record| columns.parse(&record.iter().collect::<Vec<_>>()));
        rows.push(row.filter(|row| row.run < identity.runs).ok_or_else(|| damaged(number + 3))?);
    }
    Ok(Some(Rows { path: path.to_owned(), identity, rows, whole: end as u64 }))
}

/// A shard's file, to which rows are added.
#[derive(Debug)]
pub struct Writer {
    path: PathBuf,
    file: File,
}

impl Writer {
    /// Opens the file after its last whole row, or begins it.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn open(
        folder: &Path,
        shard: Shard,
        identity: &Identity,
        columns: &Columns,
        known: Option<&Rows>,
    ) -> Result<Self, Error> {
        let path = folder.join(shard.file());
        let failed = |source| Error::File { verb: "write", path: path.clone(), source };
        let file = OpenOptions::new().create(true).append(true).open(&path).map_err(failed)?;
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            let hint = "wait for it, or give another folder: -o DIR".to_owned();
            return Err(Error::Call { message: format!("another sweep is writing {}", path.display()), hint });
        }
        file.set_len(known.map_or(0, |rows| rows.whole)).map_err(failed)?;
        let mut writer = Writer { path, file };
        if known.is_none() {
            writer.write(&[identity.line().as_bytes(), &columns.headings()].concat())?;
        }
        Ok(writer)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn add(&mut self, row: &Row) -> Result<(), Error> {
        self.write(&row.csv())
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let Writer { path, file } = self;
        file.write_all(bytes).map_err(|source| Error::File { verb: "write", path: path.clone(), source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_the_runs_out() {
        let shards: Vec<Shard> = (1..=3).map(|k| Shard { k, n: 3 }).collect();
        assert!((0..20).all(|run| shards.iter().filter(|shard| shard.has(run)).count() == 1));
        assert_eq!(Shard::parse(" 2/8"), Ok(Shard { k: 2, n: 8 }));
        for refused in ["", "2", "0/3", "4/3", "a/b", "1/0", "-1/2"] {
            assert!(Shard::parse(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn an_identity_reads_back() {
        let identity = Identity { version: "0.1.0".to_owned(), plan: "00ff".to_owned(), runs: 12 };
        assert_eq!(Identity::parse(identity.line().trim_end()), Some(identity));
        assert_eq!(Identity::parse("run,kind"), None);
    }
}
