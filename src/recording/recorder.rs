//! Records a run while it goes on: into memory, or into a file that gets its name when all is well.

use std::io;
use std::path::Path;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread::{self, JoinHandle};

use choque_engine::detect::deepest::{Depths, Poses};
use choque_engine::ledger::Cause;
use choque_engine::{Hit, World};
use choque_scripting::{Moment, Run, Scenario};

use super::Recording;
use super::about::{About, Body, Ending};
use super::file::Writer;
use super::frame::{Books, Command, Frame, Push, State, Strike, Totals, Touch};
use crate::Error;
use crate::outcome::Judgement;
use crate::play::{Watch, play};
use crate::written::Nameless;

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
    /// Which bodies the iteration under way lists as overlapping.
    is_listed: Vec<bool>,
}

/// Where frames go.
pub trait Keep {
    /// Takes the next frame, in which all stands but how deep bodies overlap, and the world of it. Gives an empty one, with the room of
    /// an earlier one if there is any to be had.
    fn keep(&mut self, world: &World, frame: Frame) -> Frame;
}

/// Frames kept in memory: 48 bytes a body, and what happened.
#[derive(Debug)]
pub struct InMemory {
    about: About,
    bodies: Vec<Body>,
    frames: Vec<Frame>,
    depths: Depths,
    poses: Poses,
}

/// Frames packed and written by a thread of their own.
#[derive(Debug)]
pub struct IntoFile {
    frames: SyncSender<Message>,
    /// What is written, empty again.
    spent: Receiver<Taken>,
    /// Room for the next.
    poses: Poses,
    /// What is to be handed over together: a thread that sleeps costs as much to wake as many bodies to write.
    together: Vec<Taken>,
    most: usize,
    writing: JoinHandle<io::Result<Nameless>>,
}

/// Messages that may wait to be written: a run does not get further ahead.
const WAITING: usize = 16;

/// States that are handed over together, and frames at most.
const STATES_TOGETHER: usize = 1 << 12;
const FRAMES_TOGETHER: usize = 1 << 6;

/// A frame without its deepest overlap, and where that is to be searched for.
type Taken = (Frame, Poses);

enum Message {
    Frames(Vec<Taken>),
    Done(Ending),
}

impl Keep for InMemory {
    fn keep(&mut self, world: &World, mut frame: Frame) -> Frame {
        world.take_poses(&mut self.poses);
        frame.totals.deepest = self.depths.deepest(&self.poses);
        self.frames.push(frame);
        Frame::default()
    }
}

impl Keep for IntoFile {
    fn keep(&mut self, world: &World, frame: Frame) -> Frame {
        let mut poses = std::mem::take(&mut self.poses);
        world.take_poses(&mut poses);
        self.together.push((frame, poses));
        if self.together.len() >= self.most {
            self.hand_over();
        }
        let (frame, poses) = self.spent.try_recv().unwrap_or_default();
        self.poses = poses;
        frame
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
        let depths = Depths::of(&run.world());
        let poses = Poses::default();
        Recorder::begin(scenario, run, settings, |about, bodies| InMemory {
            about,
            bodies,
            frames: Vec::new(),
            depths,
            poses,
        })
    }

    /// The recording of what has been played so far.
    #[must_use]
    pub fn so_far(&self) -> Recording {
        let InMemory { about, bodies, frames, .. } = &self.frames;
        let ending = Ending { steps: self.last, ..Ending::default() };
        Recording { about: about.clone(), bodies: bodies.clone(), frames: frames.clone(), ending }
    }

    /// The recording of a run that has ended so.
    #[must_use]
    pub fn finish(mut self, world: &World, judgements: &[Judgement]) -> Recording {
        self.frame_of_the_end(world);
        let ending = ending(world, judgements);
        let InMemory { about, bodies, frames, .. } = self.frames;
        Recording { about, bodies, frames, ending }
    }
}

impl Recorder<IntoFile> {
    /// Begins with the run as it stands, which must be its start. The file gets its name in the end.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn into_file(scenario: &Scenario, run: &mut Run, settings: &Settings, path: &Path) -> Result<Self, Error> {
        let file = Nameless::to_become(path)?;
        let depths = Depths::of(&run.world());
        Ok(Recorder::begin(scenario, run, settings, |about, bodies| {
            let most = (STATES_TOGETHER / bodies.len().max(1)).clamp(1, FRAMES_TOGETHER);
            let (frames, taken) = sync_channel(WAITING);
            let (back, spent) = channel();
            let writing = thread::spawn(move || {
                let writer = Writer::begin(io::BufWriter::new(file), &about, &bodies)?;
                write(writer, depths, &taken, &back)
            });
            IntoFile { frames, spent, poses: Poses::default(), together: Vec::new(), most, writing }
        }))
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
        written.map_err(|source| Error::File { verb: "write", path: path.to_owned(), source })?.give_name()
    }
}

/// Writes what is taken, and gives it back empty.
fn write(
    mut writer: Writer<io::BufWriter<Nameless>>,
    mut depths: Depths,
    taken: &Receiver<Message>,
    back: &Sender<Taken>,
) -> io::Result<Nameless> {
    let mut looked_at = Vec::new();
    loop {
        match taken.recv() {
            Ok(Message::Frames(frames)) => {
                for (mut frame, poses) in frames {
                    frame.totals.deepest = depths.deepest(&poses);
                    looked_at.push(poses);
                    writer.put(frame)?;
                }
                // Nobody takes them only where the run has ended.
                writer.spent().for_each(|frame| drop(back.send((frame, looked_at.pop().unwrap_or_default()))));
            }
            Ok(Message::Done(ending)) => return Ok(writer.finish(&ending)?.into_inner()?),
            Err(_) => return Err(io::Error::other("the run was broken off")),
        }
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
        let next = Frame::default();
        let mut recorder =
            Recorder { every, steps, frames, last: 0, next, commanded: 0, exchanges: 0, is_listed: Vec::new() };
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
        frame.totals = Totals::of(world, 0.0);
        frame.states.extend(world.ids().map(|id| State::of(world, id)));
        frame.touches.extend(world.loads().iter().map(|load| Touch::of(world, load)));
        frame.books = world.ledger().map(|ledger| Books {
            booked: Cause::ALL.iter().map(|cause| ledger.booked(*cause).to_array()).collect(),
            relocated: ledger.relocated(),
            relocations: ledger.relocations(),
        });
        self.next = self.frames.keep(world, frame);
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
        self.is_listed.clear();
        self.is_listed.resize(world.len(), false);
        for (a, b) in world.listed() {
            self.is_listed[a.index()] = true;
            self.is_listed[b.index()] = true;
        }
        let listed = world.ids().filter(|id| self.is_listed[id.index()]);
        self.next.advanced.extend(listed.map(|id| (id.index() as u32, State::of(world, id))));
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
