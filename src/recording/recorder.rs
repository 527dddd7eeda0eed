//! Records a run while it goes on: into memory, or into a file that gets its name when all is well.

use std::fs::File;
use std::io::{self, Seek};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread::{self, JoinHandle};

use choque_engine::ledger::Cause;
use choque_engine::{BodyId, Hit, World};
use choque_scripting::{Moment, Run, Scenario};

use super::Recording;
use super::about::{About, Body, Ending};
use super::file::{Writer, give_name, nameless};
use super::frame::{Books, Command, Frame, Push, State, Strike, Totals, Touch};
use crate::Error;
use crate::outcome::Judgement;
use crate::play::{Watch, play};

/// What is recorded of a run.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Iterations from one frame to the next, at least 1. What happened in between is kept.
    pub every: u64,
    /// Whether the ledger is kept and recorded.
    pub ledger: bool,
    /// The call that makes it, word by word.
    pub command: Vec<String>,
}

impl Default for Settings {
    /// A frame an iteration, without a ledger.
    fn default() -> Self {
        Settings { every: 1, ledger: false, command: Vec::new() }
    }
}

/// Plays a scenario to its end and gives the recording.
///
/// # Errors
/// A scenario that cannot start; a callback that fails; a body that left the finite numbers.
pub fn record(scenario: &Scenario, settings: &Settings) -> Result<Recording, Error> {
    let mut run = scenario.start()?;
    let mut recorder = Recorder::in_memory(scenario, &mut run, settings);
    let judgements: Vec<Judgement> = play(&mut run, &mut recorder)?.into_iter().map(Judgement::from).collect();
    Ok(recorder.finish(&run.world(), &judgements))
}

/// Records a run. It is told of moments within iterations too, so it has to watch the whole run.
#[derive(Debug)]
pub struct Recorder<K = InMemory> {
    every: u64,
    steps: u64,
    frames: K,
    /// The iteration of the last frame.
    last: u64,
    /// What happened since the last frame.
    next: Frame,
    /// How many bodies that callbacks wrote to have been seen in this iteration, and after how many exchanges.
    commanded: usize,
    exchanges: u64,
}

/// Where frames go.
pub trait Keep {
    /// Takes the next frame, and gives an empty one, with the room of an earlier one if there is any to be had.
    fn keep(&mut self, frame: Frame) -> Frame;
}

/// Frames kept in memory: 48 bytes a body, and what happened.
#[derive(Debug)]
pub struct InMemory {
    about: About,
    bodies: Vec<Body>,
    frames: Vec<Frame>,
}

/// Frames packed and written by a thread of their own.
#[derive(Debug)]
pub struct IntoFile {
    frames: SyncSender<Message>,
    /// Frames that are written, empty again.
    spent: Receiver<Frame>,
    /// Frames to be handed over together: a thread that sleeps costs as much to wake as many bodies to write.
    together: Vec<Frame>,
    most: usize,
    writing: JoinHandle<io::Result<File>>,
}

/// Messages that may wait to be written: a run does not get further ahead.
const WAITING: usize = 16;

/// States that are handed over together, and frames at most.
const STATES_TOGETHER: usize = 1 << 12;
const FRAMES_TOGETHER: usize = 1 << 6;

enum Message {
    Frames(Vec<Frame>),
    Done(Ending),
}

impl Keep for InMemory {
    fn keep(&mut self, frame: Frame) -> Frame {
        self.frames.push(frame);
        Frame::default()
    }
}

impl Keep for IntoFile {
    fn keep(&mut self, frame: Frame) -> Frame {
        self.together.push(frame);
        if self.together.len() >= self.most {
            self.hand_over();
        }
        self.spent.try_recv().unwrap_or_default()
    }
}

impl IntoFile {
    fn hand_over(&mut self) {
        let frames = std::mem::replace(&mut self.together, Vec::with_capacity(self.most));
        // Nobody takes them only where writing failed, which is told in the end.
        let _ = self.frames.send(Message::Frames(frames));
    }
}

impl Recorder<InMemory> {
    /// Begins with the run as it stands, which must be its start.
    #[must_use]
    pub fn in_memory(scenario: &Scenario, run: &mut Run, settings: &Settings) -> Self {
        Recorder::begin(scenario, run, settings, |about, bodies| InMemory { about, bodies, frames: Vec::new() })
    }

    /// The recording of what has been played so far.
    #[must_use]
    pub fn so_far(&self) -> Recording {
        let InMemory { about, bodies, frames } = &self.frames;
        let ending = Ending { steps: self.last, ..Ending::default() };
        Recording { about: about.clone(), bodies: bodies.clone(), frames: frames.clone(), ending }
    }

    /// The recording of a run that has ended so.
    #[must_use]
    pub fn finish(mut self, world: &World, judgements: &[Judgement]) -> Recording {
        self.frame_of_the_end(world);
        let ending = ending(world, judgements);
        let InMemory { about, bodies, frames } = self.frames;
        Recording { about, bodies, frames, ending }
    }
}

impl Recorder<IntoFile> {
    /// Begins with the run as it stands, which must be its start.
    #[must_use]
    pub fn into_file(scenario: &Scenario, run: &mut Run, settings: &Settings) -> Self {
        Recorder::begin(scenario, run, settings, |about, bodies| {
            let most = (STATES_TOGETHER / bodies.len().max(1)).clamp(1, FRAMES_TOGETHER);
            let (frames, taken) = sync_channel(WAITING);
            let (back, spent) = channel();
            let writing = thread::spawn(move || {
                let mut writer = Writer::begin(io::BufWriter::new(nameless()?), &about, &bodies)?;
                loop {
                    match taken.recv() {
                        Ok(Message::Frames(frames)) => {
                            frames.into_iter().try_for_each(|frame| writer.put(frame))?;
                            // Nobody takes them only where the run has ended.
                            writer.spent().for_each(|frame| drop(back.send(frame)));
                        }
                        Ok(Message::Done(ending)) => return Ok(writer.finish(&ending)?.into_inner()?),
                        Err(_) => return Err(io::Error::other("the run was broken off")),
                    }
                }
            });
            IntoFile { frames, spent, together: Vec::new(), most, writing }
        })
    }

    /// Ends the recording of a run that has ended so, and gives the file its name.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(mut self, world: &World, judgements: &[Judgement], path: &Path) -> Result<(), Error> {
        self.frame_of_the_end(world);
        self.frames.hand_over();
        let IntoFile { frames, writing, .. } = self.frames;
        let _ = frames.send(Message::Done(ending(world, judgements)));
        let written = writing.join().unwrap_or_else(|_| Err(io::Error::other("the thread that writes it panicked")));
        let rewound = written.and_then(|mut file| file.rewind().map(|()| file));
        let file = rewound.map_err(|source| Error::File { verb: "write", path: path.to_owned(), source })?;
        give_name(path, file)
    }
}

impl<K: Keep> Recorder<K> {
    fn begin(
        scenario: &Scenario,
        run: &mut Run,
        settings: &Settings,
        keep: impl FnOnce(About, Vec<Body>) -> K,
    ) -> Self {
        run.remember_commands();
        if settings.ledger {
            run.keep_ledger();
        }
        let world = run.world();
        let every = settings.every.max(1);
        let about = About::of(scenario, &world, settings.command.clone(), every);
        let bodies = Body::all(scenario.scene(), &world);
        let frames = keep(about, bodies);
        let steps = world.plan().steps;
        let mut recorder =
            Recorder { every, steps, frames, last: 0, next: Frame::default(), commanded: 0, exchanges: 0 };
        recorder.frame(&world);
        recorder
    }

    /// A run may end where no frame was due.
    fn frame_of_the_end(&mut self, world: &World) {
        if self.last != world.iteration() {
            self.frame(world);
        }
    }

    fn frame(&mut self, world: &World) {
        self.last = world.iteration();
        let mut frame = std::mem::take(&mut self.next);
        frame.iteration = world.iteration();
        frame.time = world.time();
        frame.digest = world.digest();
        frame.totals = Totals::of(world);
        frame.states.extend(world.ids().map(|id| State::of(world, id)));
        frame.touches.extend(world.loads().iter().map(|load| Touch::of(world, load)));
        frame.books = world.ledger().map(|ledger| Books {
            booked: Cause::ALL.iter().map(|cause| ledger.booked(*cause).to_array()).collect(),
            relocated: ledger.relocated(),
            relocations: ledger.relocations(),
        });
        self.next = self.frames.keep(frame);
    }

    /// The bodies that callbacks have written to since this was last asked.
    fn note_commands(&mut self, world: &World) {
        for id in &world.commanded()[self.commanded..] {
            let (body, after) = (id.index() as u32, State::of(world, *id));
            let [iteration, exchanges] = [world.iteration(), self.exchanges];
            let next = &mut self.next.commands;
            match next.last_mut() {
                // A callback writes numbers one by one.
                Some(last) if (last.iteration, last.exchanges, last.body) == (iteration, exchanges, body) => {
                    last.after = after;
                }
                _ => next.push(Command { iteration, exchanges, body, after }),
            }
        }
        self.commanded = world.commanded().len();
    }

    fn note_beginning(&mut self, world: &World) {
        (self.commanded, self.exchanges) = (0, 0);
        self.next.listed.clear();
        self.next.advanced.clear();
        if !self.is_due(world.iteration() + 1) {
            return;
        }
        self.next.listed.extend(world.listed().map(|(a, b)| [a, b].map(|id| id.index() as u32)));
        let mut ids: Vec<BodyId> = world.listed().flat_map(|(a, b)| [a, b]).collect();
        ids.sort_unstable();
        ids.dedup();
        self.next.advanced.extend(ids.into_iter().map(|id| (id.index() as u32, State::of(world, id))));
    }

    fn is_due(&self, iteration: u64) -> bool {
        iteration.is_multiple_of(self.every) || iteration >= self.steps
    }
}

impl<K: Keep> Watch for Recorder<K> {
    fn moment(&mut self, world: &World, moment: Moment) {
        match moment {
            Moment::Commanded => {
                (self.commanded, self.exchanges) = (0, 0);
                self.note_commands(world);
                self.next.pushes.clear();
                self.next.pushes.extend(world.pushes().map(|(id, force, torque)| Push {
                    body: id.index() as u32,
                    force: [force.x, force.y],
                    torque,
                }));
            }
            Moment::Begun => self.note_beginning(world),
            Moment::Exchanged(hit) => {
                self.exchanges += 1;
                self.next.hits.push(Strike {
                    iteration: hit.iteration,
                    time: world.time(),
                    a: hit.a.index() as u32,
                    b: hit.b.index() as u32,
                    kind: hit.kind,
                    point: [hit.point.x, hit.point.y],
                    normal: [hit.normal.x, hit.normal.y],
                    depth: hit.depth,
                    after: [hit.a, hit.b].map(|id| State::of(world, id)),
                });
            }
            Moment::Answered(_) => self.note_commands(world),
        }
    }

    fn iteration(&mut self, world: &World, _: &[Hit]) {
        if self.is_due(world.iteration()) {
            self.frame(world);
        }
    }
}

fn ending(world: &World, judgements: &[Judgement]) -> Ending {
    Ending { steps: world.iteration(), collisions: world.collisions(), expectations: judgements.to_vec() }
}
