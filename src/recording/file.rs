//! The file of a recording.
//!
//! ```text
//! 89 'choque' 0a         eight bytes
//! format                 u32; all numbers with their lowest byte first
//! then sections:
//!   tag                  four letters: RUN_, BODY, FRMS (as many as there are), DONE
//!   packed, unpacked     u64, u64: length of the content in the file, and inflated
//!   checksum             u32: CRC-32 of the three above and of the content
//!   content              deflated; RON text, or a block of frames
//! ```
//!
//! A section of another tag is passed over: so later versions may add some without a new format. A file that ends before `DONE` is
//! no recording: it was cut off.

use std::fs;
use std::io::{self, Read, Write};
use std::ops::Range;
use std::path::Path;

use flate2::{Crc, read::DeflateDecoder};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::block::{self, Block, Memory};
use super::deflated::Deflater;
use super::error::{Broken, Wrong};
use super::{About, Body, Ending, Frame, Recording};
use crate::written::Kind;
use crate::{Error, written::replace};

/// The format that is written, and the newest that is read.
pub const FORMAT: u32 = 1;

/// How a recording is named.
pub const RECORDING: Kind = Kind { what: "recording", extension: "choque", flag: "--record" };

const BEGINNING: &[u8; 8] = b"\x89choque\n";
const RUN: &[u8; 4] = b"RUN_";
const BODIES: &[u8; 4] = b"BODY";
const FRAMES: &[u8; 4] = b"FRMS";
const DONE: &[u8; 4] = b"DONE";
/// Tag, two lengths and a checksum.
const HEAD: usize = 24;

/// States in a block: enough to deflate well, few enough to stay in a processor's cache.
const STATES_A_BLOCK: usize = 1 << 14;
/// Frames in a block at most: of few bodies too a block is packed while the run goes on, and not all of them at its end.
const FRAMES_A_BLOCK: usize = 1 << 7;

impl Recording {
    /// Reads a recording.
    ///
    /// # Errors
    /// A file that cannot be read; one that is broken, with the place.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let failed = |source| Error::File { verb: "read", path: path.to_owned(), source };
        let bytes = fs::read(path).map_err(failed)?;
        Recording::from_bytes(&bytes).map_err(|broken| Error::Recording { path: path.to_owned(), broken })
    }

    /// The recording that a file's bytes hold.
    ///
    /// # Errors
    /// Bytes that are none, with the place.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Broken> {
        let mut reader = Reader { bytes, at: 0 };
        reader.beginning()?;
        let about: About = reader.text(RUN)?;
        let bodies: Vec<Body> = reader.text(BODIES)?;
        let mut memory = Memory::new(about.time_step, bodies.len());
        let mut frames: Vec<Frame> = Vec::new();
        loop {
            let section = reader.section()?;
            match &section.tag {
                FRAMES => {
                    let read = block::read(&section.content, &mut memory);
                    frames.extend(read.ok_or_else(|| section.wrong(&"it is no block of frames"))?);
                }
                DONE => {
                    let ending: Ending = section.text()?;
                    return reader.end(Recording { about, bodies, frames, ending });
                }
                RUN | BODIES => return Err(section.at(Wrong::Place(name(section.tag)))),
                _ => {}
            }
        }
    }

    /// Writes it to a file, whole or not at all.
    ///
    /// # Errors
    /// A name that is none for a recording; a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        RECORDING.check(path)?;
        replace(path, self.to_bytes()?.as_slice())
    }

    /// The file's bytes.
    ///
    /// # Errors
    /// None that a recording can cause; the serialiser's own are passed on.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let unwritable = |error: io::Error| Error::unwritable("the recording", &error);
        let mut writer = Writer::begin(Vec::new(), &self.about, &self.bodies).map_err(unwritable)?;
        self.frames.iter().try_for_each(|frame| writer.put(frame.clone())).map_err(unwritable)?;
        writer.finish(&self.ending).map_err(unwritable)
    }
}

/// Writes a recording as it comes about.
pub(super) struct Writer<W> {
    out: Sections<W>,
    memory: Memory,
    block: Block,
    waiting: Vec<Frame>,
    /// Frames that are written, emptied.
    spent: Vec<Frame>,
    a_block: usize,
}

impl<W: Write> Writer<W> {
    pub(super) fn begin(out: W, about: &About, bodies: &[Body]) -> io::Result<Self> {
        let mut out = Sections { out, deflater: Deflater::new() };
        out.out.write_all(BEGINNING)?;
        out.out.write_all(&FORMAT.to_le_bytes())?;
        out.put_text(RUN, about)?;
        out.put_text(BODIES, &bodies)?;
        let a_block = (STATES_A_BLOCK / bodies.len().max(1)).clamp(1, FRAMES_A_BLOCK);
        Ok(Writer {
            out,
            memory: Memory::new(about.time_step, bodies.len()),
            block: Block::default(),
            waiting: Vec::new(),
            spent: Vec::new(),
            a_block,
        })
    }

    pub(super) fn put(&mut self, frame: Frame) -> io::Result<()> {
        self.waiting.push(frame);
        if self.waiting.len() >= self.a_block { self.put_block() } else { Ok(()) }
    }

    /// Frames that are written, emptied: their room may be used again.
    pub(super) fn spent(&mut self) -> impl Iterator<Item = Frame> {
        self.spent.drain(..)
    }

    fn put_block(&mut self) -> io::Result<()> {
        self.block.write(&self.waiting, &mut self.memory);
        self.spent.extend(self.waiting.drain(..).map(Frame::emptied));
        self.out.put(FRAMES, &self.block.bytes, &self.block.surprises)
    }

    pub(super) fn finish(mut self, ending: &Ending) -> io::Result<W> {
        if !self.waiting.is_empty() {
            self.put_block()?;
        }
        self.out.put_text(DONE, ending)?;
        self.out.out.flush()?;
        Ok(self.out.out)
    }
}

/// Writes section after section.
struct Sections<W> {
    out: W,
    deflater: Deflater,
}

impl<W: Write> Sections<W> {
    fn put_text(&mut self, tag: &[u8; 4], value: &impl Serialize) -> io::Result<()> {
        self.put(tag, ron::to_string(value).map_err(io::Error::other)?.as_bytes(), &[])
    }

    fn put(&mut self, tag: &[u8; 4], content: &[u8], stored: &[Range<usize>]) -> io::Result<()> {
        let packed = self.deflater.deflate(content, stored)?;
        let mut head = tag.to_vec();
        head.extend((packed.len() as u64).to_le_bytes());
        head.extend((content.len() as u64).to_le_bytes());
        let checksum = checksum(&head, packed);
        head.extend(checksum.to_le_bytes());
        self.out.write_all(&head)?;
        self.out.write_all(packed)
    }
}

fn checksum(head: &[u8], packed: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(head);
    crc.update(packed);
    crc.sum()
}

fn name(tag: [u8; 4]) -> String {
    tag.escape_ascii().to_string()
}

/// Reads sections one by one.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

/// A section as it stands in the file.
struct Section {
    tag: [u8; 4],
    offset: u64,
    content: Vec<u8>,
}

impl Section {
    fn at(&self, what: Wrong) -> Broken {
        Broken { offset: self.offset, what }
    }

    fn wrong(&self, why: &impl ToString) -> Broken {
        self.at(Wrong::Content(name(self.tag), why.to_string()))
    }

    fn text<T: DeserializeOwned>(&self) -> Result<T, Broken> {
        let text = str::from_utf8(&self.content).map_err(|error| self.wrong(&error))?;
        ron::from_str(text).map_err(|error| self.wrong(&error))
    }
}

impl<'a> Reader<'a> {
    fn wrong(&self, what: Wrong) -> Broken {
        Broken { offset: self.at as u64, what }
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Broken> {
        let left = &self.bytes[self.at..];
        let Some(taken) = left.get(..count) else {
            let offset = self.bytes.len() as u64;
            return Err(Broken { offset, what: Wrong::CutOff((count - left.len()) as u64) });
        };
        self.at += count;
        Ok(taken)
    }

    fn beginning(&mut self) -> Result<(), Broken> {
        let agreed = self.bytes.iter().zip(BEGINNING).take_while(|(byte, wanted)| byte == wanted).count();
        if agreed < BEGINNING.len() && agreed < self.bytes.len() || self.bytes.is_empty() {
            return Err(Broken { offset: agreed as u64, what: Wrong::Beginning });
        }
        self.take(BEGINNING.len())?;
        match number(self.take(4)?) as u32 {
            FORMAT => Ok(()),
            other => Err(Broken { offset: BEGINNING.len() as u64, what: Wrong::Format(other) }),
        }
    }

    fn section(&mut self) -> Result<Section, Broken> {
        let offset = self.at as u64;
        let head = self.take(HEAD)?;
        let (tag, packed) = ([head[0], head[1], head[2], head[3]], number(&head[4..12]));
        let at = |what| Broken { offset, what };
        let left = self.bytes.len() - self.at;
        let Some(length) = usize::try_from(packed).ok().filter(|length| *length <= left) else {
            let offset = self.bytes.len() as u64;
            return Err(Broken { offset, what: Wrong::CutOff(packed - left as u64) });
        };
        let packed = self.take(length)?;
        if u64::from(checksum(&head[..20], packed)) != number(&head[20..]) {
            return Err(at(Wrong::Checksum(name(tag))));
        }
        let unpacked = number(&head[12..20]);
        let mut content = Vec::new();
        let inflated = DeflateDecoder::new(packed).take(unpacked.saturating_add(1)).read_to_end(&mut content);
        let section = Section { tag, offset, content };
        match inflated {
            Ok(length) if length as u64 == unpacked => Ok(section),
            Ok(_) => Err(section.wrong(&"its length inflated is another")),
            Err(error) => Err(section.wrong(&error)),
        }
    }

    /// The next section that has that tag; those this version does not know are passed over.
    fn text<T: DeserializeOwned>(&mut self, tag: &[u8; 4]) -> Result<T, Broken> {
        loop {
            let section = self.section()?;
            match &section.tag {
                found if found == tag => return section.text(),
                RUN | BODIES | FRAMES | DONE => return Err(section.at(Wrong::Place(name(section.tag)))),
                _ => {}
            }
        }
    }

    fn end(&self, recording: Recording) -> Result<Recording, Broken> {
        match self.bytes.len() - self.at {
            0 => Ok(recording),
            rest => Err(self.wrong(Wrong::Rest(rest as u64))),
        }
    }
}

/// A number, its lowest byte first.
fn number(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}
