//! A recording as the player is handed it: a head of JSON, numbers as bytes, all of it deflated in a page.
//!
//! `unpack.js` reads what is written here; the two change together, and then the format's number with them.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use choque_engine::ledger::Amounts;
use choque_engine::scene::Kind;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde::Serialize;

use super::Error;
use super::code::Bytes;
use super::events::{hits, touches};
use super::quantum::{self, HALF_TURN, Quantum};
use crate::recording::{Body, Frame, Recording, State};

/// What `unpack.js` checks.
const FORMAT: u32 = 1;

/// The most that a film may take in a page: 9.6 MB in base64, below 10 MB with the page around it.
const MOST_DEFLATED: usize = 7_200_000;

/// The most that is handed over as it is: a browser makes several times as much of it.
const MOST_PLAIN: usize = 64_000_000;

/// How many times coarser numbers are told before frames are left out.
const COARSEST: f64 = 16.0;

#[derive(Serialize)]
struct Head<'a> {
    format: u32,
    title: &'a str,
    plane: f64,
    /// Frames that are here, and that were recorded.
    frames: usize,
    recorded: usize,
    quantum: Quantum,
    /// What places are counted from.
    middle: [f64; 2],
    bodies: Vec<Actor<'a>>,
    causes: &'a [String],
    hits: usize,
    touches: usize,
    series: Vec<String>,
    /// Bytes of: iterations, poses, hits, touches, series.
    sections: [usize; 5],
    notes: Vec<String>,
}

/// A body as the head tells of it.
#[derive(Serialize)]
struct Actor<'a> {
    name: &'a str,
    kind: &'static str,
    mass: f64,
    rects: Vec<[f64; 4]>,
    /// Whether any of its numbers ever changes or is a motion; else its place is written once.
    moves: bool,
}

/// A recording from the frame of that iteration on (or the last one before it), deflated: what `choque.unpack` takes. While
/// it is too long for a page, numbers are told more coarsely, and then frames are left out evenly, with their exchanges; the page
/// says so.
///
/// # Errors
/// A body that is at no finite place.
pub fn film(recording: &Recording, from: u64) -> Result<Vec<u8>, Error> {
    fitted(recording, from, MOST_DEFLATED, deflated)
}

/// All of a recording, not deflated: what `choque.read` takes. For a page on this machine deflating takes longer than the way.
///
/// # Errors
/// As [`film`].
pub fn plain_film(recording: &Recording) -> Result<Vec<u8>, Error> {
    fitted(recording, 0, MOST_PLAIN, plain)
}

type Joined = std::io::Result<Vec<u8>>;

fn fitted(
    recording: &Recording,
    from: u64,
    most: usize,
    join: impl Fn(&[u8], &[Vec<u8>]) -> Joined,
) -> Result<Vec<u8>, Error> {
    let first = recording.frames.partition_point(|frame| frame.iteration <= from).saturating_sub(1);
    let all: Vec<&Frame> = recording.frames.iter().skip(first).collect();
    let (mut coarser, mut every) = (1.0, 1);
    loop {
        let kept = thinned(&all, every);
        let (head, sections) = packed(recording, all.len(), &kept, coarser)?;
        let bytes = join(&head, &sections).map_err(|why| Error::unwritable("the film", &why))?;
        if bytes.len() <= most || kept.len() <= 2 {
            return Ok(bytes);
        }
        if coarser < COARSEST {
            coarser *= 4.0;
        } else {
            every *= 2;
        }
    }
}

/// The same as text, for a page.
pub(super) fn film_in_text(recording: &Recording, from: u64) -> Result<String, Error> {
    Ok(BASE64.encode(film(recording, from)?))
}

/// Every so many frames, and the last.
fn thinned<'a>(all: &[&'a Frame], every: usize) -> Vec<&'a Frame> {
    let last = all.len().saturating_sub(1);
    all.iter().enumerate().filter(|(index, _)| index % every == 0 || *index == last).map(|(_, frame)| *frame).collect()
}

/// The head, and the sections it tells of.
fn packed(
    recording: &Recording,
    recorded: usize,
    kept: &[&Frame],
    coarser: f64,
) -> Result<(Vec<u8>, [Vec<u8>; 5]), Error> {
    let (quantum, middle) = quantum::of(recording, coarser)?;
    let moves: Vec<bool> = (0..recording.bodies.len()).map(|body| ever_moves(kept, body)).collect();
    let mut iterations = Bytes::default();
    iterations.put_steps(kept.iter().map(|frame| frame.iteration as i64));
    let poses = poses(kept, &moves, quantum, middle);
    let (hits, hit_bytes) = hits(kept, quantum);
    let (touches, touch_bytes) = touches(kept, quantum);
    let (names, series) = series(kept, &recording.about.causes);
    let sections = [iterations, poses, hit_bytes, touch_bytes, Bytes(series)].map(|bytes| bytes.0);
    let head = Head {
        format: FORMAT,
        title: &recording.about.title,
        plane: recording.about.settings.plane,
        frames: kept.len(),
        recorded,
        quantum,
        middle,
        bodies: recording.bodies.iter().zip(moves).map(|(body, moves)| Actor::of(body, moves)).collect(),
        causes: &recording.about.causes,
        hits,
        touches,
        series: names,
        sections: [0, 1, 2, 3, 4].map(|k| sections[k].len()),
        notes: notes(recording, recorded, kept.len()),
    };
    let head = serde_json::to_vec(&head).map_err(|why| Error::unwritable("the film", &why))?;
    Ok((head, sections))
}

fn deflated(head: &[u8], sections: &[Vec<u8>]) -> Joined {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    write(&mut encoder, head, sections)?;
    encoder.finish()
}

fn plain(head: &[u8], sections: &[Vec<u8>]) -> Joined {
    let mut bytes = Vec::new();
    write(&mut bytes, head, sections)?;
    Ok(bytes)
}

fn write(to: &mut impl Write, head: &[u8], sections: &[Vec<u8>]) -> std::io::Result<()> {
    to.write_all(&(head.len() as u32).to_le_bytes())?;
    to.write_all(head)?;
    sections.iter().try_for_each(|section| to.write_all(section))
}

impl<'a> Actor<'a> {
    fn of(body: &'a Body, moves: bool) -> Self {
        let kind = match body.kind {
            Kind::Mobile => "mobile",
            Kind::Fixed if moves => "driven",
            Kind::Fixed => "fixed",
        };
        let rects = body.rects.iter().map(|rect| [rect.x_min, rect.x_max, rect.z_min, rect.z_max]).collect();
        Actor { name: &body.name, kind, mass: body.mass, rects, moves }
    }
}

fn ever_moves(frames: &[&Frame], body: usize) -> bool {
    let Some(first) = frames.first().map(|frame| frame.states[body]) else { return false };
    let State { vx, vz, spin, .. } = first;
    [vx, vz, spin] != [0.0; 3] || frames.iter().any(|frame| frame.states[body] != first)
}

/// Body after body, one of its six numbers after the other: what hardly changes stands together. Velocities as they change; places
/// by their distance from where the mean of the velocities before and after leads.
fn poses(frames: &[&Frame], moves: &[bool], quantum: Quantum, middle: [f64; 2]) -> Bytes {
    let mut bytes = Bytes::default();
    let Quantum { place, angle, velocity, spin, .. } = quantum;
    for (body, moves) in moves.iter().enumerate() {
        let column = |read: fn(&State) -> f64, zero: f64, step: f64| -> Vec<i64> {
            frames.iter().map(|frame| whole(read(&frame.states[body]) - zero, step)).collect()
        };
        let x = column(|state| state.x, middle[0], place);
        let z = column(|state| state.z, middle[1], place);
        let turned = column(|state| state.angle, 0.0, angle);
        if !moves {
            [x, z, turned].iter().flat_map(|column| column.first()).for_each(|number| bytes.put(*number));
            continue;
        }
        let vx = column(|state| state.vx, 0.0, velocity);
        let vz = column(|state| state.vz, 0.0, velocity);
        let turns = column(|state| state.spin, 0.0, spin);
        for (places, motion, turn, ratio) in
            [(x, vx, 0, velocity / place), (z, vz, 0, velocity / place), (turned, turns, HALF_TURN, spin / angle)]
        {
            bytes.put_steps(motion.iter().copied());
            bytes.put_expected(places, turn, |frame, last| match frame {
                0 => 0,
                _ => {
                    let mean = 0.5 * (motion[frame - 1] as f64 + motion[frame] as f64);
                    last + led(mean * ratio, frames[frame].time - frames[frame - 1].time)
                }
            });
        }
    }
    bytes
}

/// How far a motion leads in that time, in whole steps, rounded as JavaScript rounds; a motion that would lead out of the scene
/// altogether leads nowhere.
fn led(motion: f64, time: f64) -> i64 {
    let far = (motion * time + 0.5).floor();
    if far.abs() < quantum::MOST { far as i64 } else { 0 }
}

/// A number in steps of that size.
pub(super) fn whole(number: f64, step: f64) -> i64 {
    (number / step).round() as i64
}

/// Columns of f64 with their names; what a cause never changed is left out.
fn series(frames: &[&Frame], causes: &[String]) -> (Vec<String>, Vec<u8>) {
    type Reading = Box<dyn Fn(&Frame) -> f64>;
    let mut columns: Vec<(String, Reading)> = vec![
        ("time".to_owned(), Box::new(|frame| frame.time)),
        ("kinetic_energy".to_owned(), Box::new(|frame| frame.totals.kinetic_energy)),
        ("momentum_x".to_owned(), Box::new(|frame| frame.totals.momentum[0])),
        ("momentum_z".to_owned(), Box::new(|frame| frame.totals.momentum[1])),
        ("angular_momentum".to_owned(), Box::new(|frame| frame.totals.angular_momentum)),
        ("deepest".to_owned(), Box::new(|frame| frame.totals.deepest)),
    ];
    let always = columns.len();
    for (cause, word) in causes.iter().enumerate() {
        for (quantity, name) in Amounts::NAMES.iter().enumerate() {
            let booked = move |frame: &Frame| Some(frame.books.as_ref()?.booked.get(cause)?[quantity]);
            columns.push((format!("{word}.{name}"), Box::new(move |frame| booked(frame).unwrap_or(0.0))));
        }
    }
    let (mut names, mut bytes) = (Vec::new(), Vec::new());
    for (index, (name, read)) in columns.into_iter().enumerate() {
        let column = || frames.iter().map(|frame| read(frame));
        if index < always || column().any(|value| value != 0.0) {
            names.push(name);
            bytes.extend(column().flat_map(f64::to_le_bytes));
        }
    }
    (names, bytes)
}

/// What a page should say of how it differs from the run.
fn notes(recording: &Recording, recorded: usize, kept: usize) -> Vec<String> {
    let mut notes = Vec::new();
    if recording.about.every > 1 {
        notes.push(format!("A frame every {} iterations was recorded.", recording.about.every));
    }
    if kept < recorded {
        notes.push(format!(
            "{kept} of {recorded} recorded frames are here, with their exchanges, so that the page stays below 10 MB."
        ));
    }
    notes
}
