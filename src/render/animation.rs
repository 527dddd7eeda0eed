//! A run as a GIF, in its own time: only what changes from picture to picture is written.

use std::borrow::Cow;

use gif::{DisposalMethod, Encoder, Repeat};

use super::colours::{Colours, UNCHANGED};
use super::moment::Moment;
use super::view::View;
use crate::Error;
use crate::plot::raster;
use crate::recording::Recording;

/// How long trails are \[s\].
const TRAIL: f64 = 0.8;
/// Pictures whose colours make the table.
const LOOKED_AT: usize = 12;
/// How long the last picture stays, in hundredths of a second.
const LAST: u16 = 150;

pub(super) fn gif(recording: &Recording, width: f64, fps: u32) -> Result<Vec<u8>, Error> {
    let unwritable = |why: &dyn std::fmt::Display| Error::unwritable("the moving picture", why);
    let view = View::of(recording, &recording.frames, width);
    let delay = (100.0 / f64::from(fps)).round().max(2.0); // hundredths of a second are the format's unit
    let moments = moments(recording, delay / 100.0);
    let looked = moments.iter().step_by(moments.len().div_ceil(LOOKED_AT).max(1)).chain(moments.last());
    let looked = looked.map(|at| Pixels::of(recording, &view, *at)).collect::<Result<Vec<Pixels>, Error>>()?;
    let mut colours = Colours::of(looked.iter().map(|picture| picture.colours.as_slice()));
    let Some([wide, high]) = looked.first().and_then(Pixels::size) else { return Err(unwritable(&"it is too large")) };
    let mut encoder = Encoder::new(Vec::new(), wide, high, &colours.bytes()).map_err(|error| unwritable(&error))?;
    encoder.set_repeat(Repeat::Infinite).map_err(|error| unwritable(&error))?;
    let mut before = vec![UNCHANGED; usize::from(wide) * usize::from(high)];
    for (i, at) in moments.iter().enumerate() {
        let picture = Pixels::of(recording, &view, *at)?;
        let now: Vec<u8> = picture.colours.iter().map(|colour| colours.nearest(*colour)).collect();
        let mut frame = changed(&before, &now, usize::from(wide));
        frame.delay = if i + 1 == moments.len() { LAST } else { delay as u16 };
        encoder.write_frame(&frame).map_err(|error| unwritable(&error))?;
        before = now;
    }
    encoder.into_inner().map_err(|error| unwritable(&error))
}

/// The frames nearest to regular moments, the last one always among them.
fn moments(recording: &Recording, apart: f64) -> Vec<usize> {
    let frames = &recording.frames;
    let (Some(first), Some(last)) = (frames.first(), frames.last()) else { return Vec::new() };
    let count = ((last.time - first.time) / apart).ceil();
    let mut at = 0;
    let mut moments: Vec<usize> = Vec::new();
    for picture in 0..=count.clamp(0.0, frames.len() as f64 * 50.0) as usize {
        let time = first.time + picture as f64 * apart;
        while at + 1 < frames.len() && frames[at + 1].time <= time {
            at += 1;
        }
        moments.push(at);
    }
    moments.pop(); // the last one stands for itself
    moments.push(frames.len() - 1);
    moments
}

/// What a picture looks like.
struct Pixels {
    wide: u32,
    high: u32,
    colours: Vec<[u8; 3]>,
}

impl Pixels {
    fn of(recording: &Recording, view: &View, at: usize) -> Result<Self, Error> {
        let time = recording.frames.get(at).map_or(0.0, |frame| frame.time);
        let since = recording.frames.partition_point(|frame| frame.time < time - TRAIL);
        let drawing = Moment::of(recording, at).since(since).draw_in(view);
        let too_large = || Error::unwritable("the moving picture", &"it is too large");
        let pixels = raster::pixels(&drawing, 1.0).ok_or_else(too_large)?;
        let colours = pixels.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
        Ok(Pixels { wide: pixels.width(), high: pixels.height(), colours })
    }

    /// As the format counts it.
    fn size(&self) -> Option<[u16; 2]> {
        Some([u16::try_from(self.wide).ok()?, u16::try_from(self.high).ok()?])
    }
}

/// The least part of a picture that holds all that changed, what did not left open.
fn changed(before: &[u8], now: &[u8], wide: usize) -> gif::Frame<'static> {
    let differs = |at: &usize| before[*at] != now[*at];
    let all = || (0..now.len()).filter(differs);
    let span = |numbers: &mut dyn Iterator<Item = usize>| {
        numbers.fold(None, |span: Option<(usize, usize)>, n| Some(span.map_or((n, n), |(a, b)| (a.min(n), b.max(n)))))
    };
    let (left, right) = span(&mut all().map(|at| at % wide)).unwrap_or((0, 0));
    let (top, bottom) = span(&mut all().map(|at| at / wide)).unwrap_or((0, 0));
    let buffer: Vec<u8> = (top..=bottom)
        .flat_map(|y| (left..=right).map(move |x| y * wide + x))
        .map(|at| if differs(&at) { now[at] } else { UNCHANGED })
        .collect();
    let size = |length: usize| u16::try_from(length).unwrap_or(u16::MAX);
    gif::Frame {
        left: size(left),
        top: size(top),
        width: size(right - left + 1),
        height: size(bottom - top + 1),
        transparent: Some(UNCHANGED),
        dispose: DisposalMethod::Keep,
        buffer: Cow::Owned(buffer),
        ..gif::Frame::default()
    }
}
