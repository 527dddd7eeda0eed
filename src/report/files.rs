//! A study as files: the plot as SVG and PNG, the rows as CSV, everything as RON.

use std::fs;
use std::path::{Path, PathBuf};

use super::picture::figure;
use super::study::{Row, Study};
use crate::Error;
use crate::output::ron;
use crate::plot::{raster, svg};
use crate::written;

/// Pixels of the PNG for each of the plot's.
const SCALE: f64 = 2.0;

/// Writes a study's files into a folder, which is made when it does not exist. All of them are ready before the first is
/// written, and each appears whole. Gives their names.
///
/// # Errors
/// A folder that cannot be made, a file that cannot be written.
pub fn write(study: &Study, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let drawing = figure(study).draw();
    let png = raster::png(&drawing, SCALE).ok_or_else(|| Error::unwritable("the plot", &"it is too large"))?;
    let contents = [
        ("svg", svg::svg(&drawing).into_bytes()),
        ("png", png),
        ("csv", csv(study).into_bytes()),
        ("ron", ron::pretty(study, "the report")?.into_bytes()),
    ];
    fs::create_dir_all(folder).map_err(|source| Error::File { verb: "create", path: folder.to_owned(), source })?;
    let mut paths = Vec::new();
    for (extension, content) in contents {
        let path = folder.join(format!("{}.report.{extension}", study.scenario));
        written::replace(&path, content.as_slice())?;
        paths.push(path);
    }
    Ok(paths)
}

/// The rows as CSV, numbers as the shortest text that reads back to the same f64; what is not known is empty.
#[must_use]
pub fn csv(study: &Study) -> String {
    let head = "exchange,motion,detection,time_step,steps,error,error_at_end,error_rms,error_worst,starts,cpu,runs,\
                cpu_per_second,collisions,digest";
    let counts = |row: &Row| row.work.rows();
    let labels = study.rows.first().map(counts).unwrap_or_default();
    let mut text = head.to_owned();
    for (label, _) in &labels {
        text += &format!(",{}", label.replace(['–', ' '], "_"));
    }
    text += "\n";
    for row in &study.rows {
        text += &line(study, row);
        text += &counts(row).into_iter().map(|(_, count)| format!(",{count}")).collect::<String>();
        text += "\n";
    }
    text
}

fn line(study: &Study, row: &Row) -> String {
    let known = |number: Option<f64>| number.map(|number| format!("{number:?}")).unwrap_or_default();
    let cells = [
        study.exchange.clone(),
        row.method.motion.word().to_owned(),
        row.method.detection.word().to_owned(),
        format!("{:?}", row.time_step),
        row.steps.to_string(),
        known(row.error),
        known(row.error_at_end),
        known(row.error_rms),
        known(row.error_worst),
        row.starts.to_string(),
        format!("{:?}", row.cpu),
        row.runs.to_string(),
        format!("{:?}", row.cpu_per_second),
        row.collisions.to_string(),
        row.digest.clone(),
    ];
    cells.join(",")
}
