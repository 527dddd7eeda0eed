//! A reference that the caller gives: where bodies are at known times, as CSV or RON.
//!
//! ```text
//! time,body,x,z,angle
//! 10,rod0,0.75,0,0
//! ```

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use choque_engine::{Scene, Vec2};
use choque_scripting::Diagnostic;
use serde::{Deserialize, Serialize};

use super::ladder::Ladder;
use super::poses::{Pose, Shapes, Stand};
use crate::Error;

const COLUMNS: &str = "time,body,x,z,angle";

/// Where one body is at one time, in seconds, metres and radians.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// When.
    pub time: f64,
    /// Who.
    pub body: String,
    /// Its centre.
    pub x: f64,
    /// Its centre.
    pub z: f64,
    /// Its angle, of any number of turns.
    pub angle: f64,
}

/// A reference that was given.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// The bodies it tells of.
    pub shapes: Shapes,
    /// The moments, in iterations of the longest time step.
    pub checkpoints: Vec<u64>,
    /// Where they are then.
    pub stands: Vec<Stand>,
}

/// Reads a reference for a scene.
///
/// # Errors
/// A file that cannot be read or understood, told with its line; a body the scene does not have; a time that not every
/// time step meets; a body that is told of at one time and not at another.
pub fn read(file: &Path, scene: &Scene, ladder: &Ladder) -> Result<ClosedForm, Error> {
    let text =
        fs::read_to_string(file).map_err(|source| Error::File { verb: "read", path: file.to_owned(), source })?;
    let known = match file.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => from_csv(file, &text)?,
        Some("ron") => from_ron(file, &text)?,
        _ => return Err(complain(file, "a reference is a .csv or a .ron file".to_owned())),
    };
    let mut moments: BTreeMap<u64, BTreeMap<usize, Pose>> = BTreeMap::new();
    for Known { time, body, x, z, angle } in known {
        let index = scene.bodies.iter().position(|known| known.name == body);
        let index = index.ok_or_else(|| complain(file, format!("the scenario has no body \"{body}\"")))?;
        let pose = Pose { at: Vec2::new(x, z), angle };
        if moments.entry(moment(file, time, ladder)?).or_default().insert(index, pose).is_some() {
            return Err(complain(file, format!("body \"{body}\" is told of twice at time {time}")));
        }
    }
    let Some(bodies) = moments.values().next().map(|poses| poses.keys().copied().collect::<Vec<_>>()) else {
        return Err(complain(file, "it tells of no body".to_owned()));
    };
    if moments.values().any(|poses| !poses.keys().eq(&bodies)) {
        return Err(complain(file, "every time must tell of the same bodies".to_owned()));
    }
    let shapes = Shapes::only(scene, &bodies);
    let stand = |poses: &BTreeMap<usize, Pose>| shapes.stand_at(|index| poses[&index]);
    let (checkpoints, stands) = (moments.keys().copied().collect(), moments.values().map(stand).collect());
    Ok(ClosedForm { shapes, checkpoints, stands })
}

/// Which iteration of the longest time step ends at that time.
fn moment(file: &Path, time: f64, ladder: &Ladder) -> Result<u64, Error> {
    let place = time / ladder.time_step(0);
    let whole = place.round();
    let meets = (place - whole).abs() <= 1e-9 * place.abs() && whole >= 1.0 && whole <= ladder.coarsest as f64;
    meets.then_some(whole as u64).ok_or_else(|| {
        let (every, last) = (ladder.name(0), ladder.time);
        complain(
            file,
            format!("time {time} is no moment that every time step meets: multiples of {every} s up to {last} s"),
        )
    })
}

fn from_csv(file: &Path, text: &str) -> Result<Vec<Known>, Error> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let complain_at = |line: usize, column: usize, message: &str| -> Error {
        Diagnostic::new(message).at(file, text, line + 1, column + 1).into()
    };
    match lines.next() {
        Some((_, head)) if head.replace(' ', "") == COLUMNS => {}
        Some((line, _)) => return Err(complain_at(line, 0, &format!("the first line must be {COLUMNS}"))),
        None => return Err(complain(file, "it is empty".to_owned())),
    }
    let known = |(line, row): (usize, &str)| {
        let cells: Vec<&str> = row.split(',').collect();
        let [time, body, x, z, angle] = cells[..] else {
            return Err(complain_at(line, 0, &format!("a row has five cells, {COLUMNS}, not {}", cells.len())));
        };
        let number = |cell: usize, name: &str, text: &str| match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                let column = cells[..cell].iter().map(|before| before.chars().count() + 1).sum();
                Err(complain_at(line, column, &format!("{name} must be a finite number, not `{}`", text.trim())))
            }
        };
        Ok(Known {
            time: number(0, "time", time)?,
            body: body.trim().to_owned(),
            x: number(2, "x", x)?,
            z: number(3, "z", z)?,
            angle: number(4, "angle", angle)?,
        })
    };
    lines.map(known).collect()
}

fn from_ron(file: &Path, text: &str) -> Result<Vec<Known>, Error> {
    let known: Vec<Known> = ron::from_str(text).map_err(|error| {
        let at = error.span.start;
        Error::from(Diagnostic::new(format!("not a reference: {}", error.code)).at(file, text, at.line, at.col))
    })?;
    let finite = |known: &Known| [known.time, known.x, known.z, known.angle].iter().all(|number| number.is_finite());
    match known.iter().find(|known| !finite(known)) {
        Some(bad) => Err(complain(file, format!("body \"{}\": every number must be finite", bad.body))),
        None => Ok(known),
    }
}

fn complain(file: &Path, message: String) -> Error {
    Diagnostic::new(message).in_file(file).into()
}
