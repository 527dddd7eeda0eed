//! What a finished sweep leaves: the table as CSV or Parquet, the plots as SVG.

use std::path::{Path, PathBuf};

use super::table::{Columns, Row};
use crate::Error;
use crate::written;

/// How a table is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// A line for each run, read by everything
    #[default]
    Csv,
    /// Typed columns, for data tools
    Parquet,
}

/// Where a sweep writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The folder of its shards and plots.
    pub folder: PathBuf,
    /// The table.
    pub table: PathBuf,
    /// How the table is written.
    pub format: Format,
}

impl Place {
    /// A folder, or a table with a folder beside it: `crash.csv` and `crash.sweep/`.
    ///
    /// # Errors
    /// A name that is neither; a format this program was built without.
    pub fn of(output: &Path, format: Option<Format>) -> Result<Place, Error> {
        let of_name = match output.extension().and_then(|extension| extension.to_str()) {
            Some("csv") => Some(Format::Csv),
            Some("parquet") => Some(Format::Parquet),
            _ => None,
        };
        let refuse = |message: String, hint: &str| Err(Error::Call { message, hint: hint.to_owned() });
        if output.is_file() && of_name.is_none() || output.is_dir() && of_name.is_some() {
            return refuse(
                format!("{} is there already and is no place for a sweep", output.display()),
                "-o is a folder, or a file whose name ends in .csv or .parquet",
            );
        }
        let place = match (of_name, format) {
            (Some(of_name), Some(format)) if of_name != format => {
                return refuse(format!("{} is the name of another format", output.display()), "leave --format out");
            }
            (Some(format), _) => Place { folder: output.with_extension("sweep"), table: output.to_owned(), format },
            (None, format) => {
                let format = format.unwrap_or_default();
                Place {
                    folder: output.to_owned(),
                    table: output.join("rows").with_extension(format.extension()),
                    format,
                }
            }
        };
        if place.format == Format::Parquet && cfg!(not(feature = "parquet")) {
            return refuse("this choque was built without Parquet".to_owned(), "build it with --features parquet");
        }
        Ok(place)
    }

    /// Makes the folder.
    ///
    /// # Errors
    /// One that cannot be made.
    pub fn make(&self) -> Result<(), Error> {
        std::fs::create_dir_all(&self.folder).map_err(|source| Error::File {
            verb: "create",
            path: self.folder.clone(),
            source,
        })
    }

    /// Writes the table, whole or not at all.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_table(&self, columns: &Columns, rows: &[Row]) -> Result<(), Error> {
        let bytes = match self.format {
            Format::Csv => csv(columns, rows),
            Format::Parquet => parquet(columns, rows)?,
        };
        written::replace(&self.table, bytes.as_slice())
    }
}

impl Format {
    fn extension(self) -> &'static str {
        match self {
            Format::Csv => "csv",
            Format::Parquet => "parquet",
        }
    }
}

fn csv(columns: &Columns, rows: &[Row]) -> Vec<u8> {
    rows.iter().fold(columns.headings(), |mut text, row| {
        text.extend(row.csv());
        text
    })
}

#[cfg(feature = "parquet")]
fn parquet(columns: &Columns, rows: &[Row]) -> Result<Vec<u8>, Error> {
    super::parquet::bytes(columns, rows).map_err(|error| Error::unwritable("the table", &error))
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &Columns, _: &[Row]) -> Result<Vec<u8>, Error> {
    Err(Error::unwritable("the table", &"this choque was built without Parquet"))
}
