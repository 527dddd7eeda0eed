//! Frames as bytes and back. A block holds several; what a frame is expected to be carries over from block to block.
//!
//! Three packs a block: what stands once in a frame; the bodies, column by column in the order of [`ORDER`] and body by body, so
//! that what repeats stands together; what happened. Everything that is a number is written as its distance from what
//! was expected.

use std::ops::Range;

use choque_engine::PairKind;

use super::foretold::{Course, ORDER};
use super::frame::{Books, Command, Frame, Push, State, Strike, Totals, Touch};
use super::pack::{Pack, Unpack, append};

/// What writer and reader both know of the frames before.
pub(super) struct Memory {
    time_step: f64,
    courses: Vec<Course>,
    iteration: u64,
    totals: [f64; 5],
    books: Vec<f64>,
    touches: Vec<Touch>,
    states: Vec<State>,
}

const KINDS: [PairKind; 3] = [PairKind::Mobile, PairKind::FixedWithPhysics, PairKind::Fixed];

impl Memory {
    pub(super) fn new(time_step: f64, bodies: usize) -> Self {
        Memory {
            time_step,
            courses: vec![Course::default(); bodies],
            iteration: 0,
            totals: [0.0; 5],
            books: Vec::new(),
            touches: Vec::new(),
            states: vec![State::default(); bodies],
        }
    }

    /// Where a body would be at the end of an iteration if it went on as it did.
    fn ahead(&self, body: u32) -> State {
        let state = self.states.get(body as usize).copied().unwrap_or_default();
        let State { x, z, angle, vx, vz, spin } = state;
        let dt = self.time_step;
        State { x: x + vx * dt, z: z + vz * dt, angle: angle + spin * dt, ..state }
    }
}

/// A block being written, and the room of the one before.
#[derive(Default)]
pub(super) struct Block {
    pub(super) bytes: Vec<u8>,
    /// Where those stand that deflate to nothing less.
    pub(super) surprises: [Range<usize>; 3],
    once: Pack,
    columns: [Pack; State::COUNT],
    events: Pack,
    /// From each frame to the next \[s\].
    times: Vec<f64>,
    /// One body's numbers, frame after frame.
    numbers: [Vec<f64>; State::COUNT],
}

impl Block {
    /// Puts frames in the place of what it held.
    pub(super) fn write(&mut self, frames: &[Frame], memory: &mut Memory) {
        let Block { once, columns, events, .. } = self;
        [&mut *once, events].into_iter().chain(columns).for_each(Pack::clear);
        once.put(frames.len() as u64);
        let first = memory.iteration;
        for frame in frames {
            write_once(frame, memory, once);
        }
        self.write_states(frames, first, memory);
        let Block { bytes, surprises, once, columns, events, .. } = self;
        for frame in frames {
            write_events(frame, memory, events);
            memory.states.copy_from_slice(&frame.states);
        }
        bytes.clear();
        let columns = ORDER.map(|column| &columns[column]);
        *surprises = [[&*once].as_slice(), &columns, &[events]].map(|packs| append(packs, bytes));
    }

    /// Packed body by body, each column for itself: frames are many and far apart in memory. `first` is the iteration of the frame
    /// before the first.
    fn write_states(&mut self, frames: &[Frame], first: u64, memory: &mut Memory) {
        let Block { columns, times, numbers, .. } = self;
        let before = [first].into_iter().chain(frames.iter().map(|frame| frame.iteration));
        let iterations = frames.iter().zip(before).map(|(frame, before)| frame.iteration.wrapping_sub(before));
        times.clear();
        times.extend(iterations.map(|iterations| iterations as f64 * memory.time_step));
        for (body, (course, last)) in memory.courses.iter_mut().zip(&memory.states).enumerate() {
            numbers.iter_mut().for_each(Vec::clear);
            for state in frames.iter().map(|frame| frame.states[body].to_array()) {
                numbers.iter_mut().zip(state).for_each(|(numbers, number)| numbers.push(number));
            }
            let last = last.to_array();
            for (column, pack) in columns.iter_mut().enumerate() {
                let mut seen = course.columns[column];
                if column >= 3 {
                    for number in &numbers[column] {
                        pack.put_near(seen.velocity(), *number);
                        seen.see_velocity(*number);
                    }
                } else {
                    let mut before = last[column + 3];
                    for ((time, number), velocity) in times.iter().zip(&numbers[column]).zip(&numbers[column + 3]) {
                        let expected = seen.place(column, 0.5 * (before + velocity), *time);
                        pack.put_near(expected.value, *number);
                        seen.see_place(expected, *number);
                        before = *velocity;
                    }
                }
                course.columns[column] = seen;
            }
        }
    }
}

/// `None` when the bytes are not what [`write`] gives.
pub(super) fn read(mut block: &[u8], memory: &mut Memory) -> Option<Vec<Frame>> {
    let mut packs = [(); 3].map(|()| Unpack::take_from(&mut block));
    let [Some(once), Some(bodies), Some(events)] = &mut packs else { return None };
    let count = once.count()?;
    let first = memory.iteration;
    let mut frames = (0..count).map(|_| read_once(memory, once)).collect::<Option<Vec<Frame>>>()?;
    read_states(&mut frames, first, memory, bodies)?;
    for frame in &mut frames {
        read_events(frame, memory, events)?;
        memory.states.copy_from_slice(&frame.states);
    }
    (block.is_empty() && once.is_empty() && bodies.is_empty() && events.is_empty()).then_some(frames)
}

fn write_once(frame: &Frame, memory: &mut Memory, pack: &mut Pack) {
    pack.put(frame.iteration.wrapping_sub(memory.iteration));
    memory.iteration = frame.iteration;
    pack.put_near(frame.iteration as f64 * memory.time_step, frame.time);
    pack.put(frame.digest);
    for (last, total) in memory.totals.iter_mut().zip(frame.totals.to_array()) {
        pack.put_near(*last, total);
        *last = total;
    }
    pack.put(frame.books.as_ref().map_or(0, |books| books.booked.len() as u64 + 1));
    if let Some(books) = &frame.books {
        pack.put(books.relocations);
        memory.books.resize(4 * books.booked.len() + 1, 0.0);
        let numbers = books.booked.iter().flatten().chain([&books.relocated]);
        for (last, number) in memory.books.iter_mut().zip(numbers) {
            pack.put_near(*last, *number);
            *last = *number;
        }
    }
}

fn read_once(memory: &mut Memory, pack: &mut Unpack) -> Option<Frame> {
    let iteration = memory.iteration.checked_add(pack.get()?)?;
    memory.iteration = iteration;
    let time = pack.get_near(iteration as f64 * memory.time_step)?;
    let digest = pack.get()?;
    for total in &mut memory.totals {
        *total = pack.get_near(*total)?;
    }
    let totals = Totals::from_array(memory.totals);
    let books = match pack.count()? {
        0 => None,
        causes => Some(read_books(causes - 1, memory, pack)?),
    };
    Some(Frame { iteration, time, digest, totals, books, ..Frame::default() })
}

fn read_books(causes: usize, memory: &mut Memory, pack: &mut Unpack) -> Option<Books> {
    let relocations = pack.get()?;
    memory.books.resize(4 * causes + 1, 0.0);
    for number in &mut memory.books {
        *number = pack.get_near(*number)?;
    }
    let (relocated, booked) = memory.books.split_last()?;
    let (booked, _) = booked.as_chunks();
    Some(Books { booked: booked.to_vec(), relocated: *relocated, relocations })
}

fn read_states(frames: &mut [Frame], first: u64, memory: &mut Memory, pack: &mut Unpack) -> Option<()> {
    let bodies = memory.courses.len();
    // A number takes a byte at least: of bodies that are not there no room is made.
    if !pack.has(bodies.checked_mul(frames.len())?.checked_mul(State::COUNT)?) {
        return None;
    }
    frames.iter_mut().for_each(|frame| frame.states = vec![State::default(); bodies]);
    for column in ORDER {
        for body in 0..bodies {
            let mut before = (first, memory.states[body].to_array());
            for frame in &mut *frames {
                let course = &mut memory.courses[body].columns[column];
                let mut state = frame.states[body].to_array();
                let number = if column >= 3 {
                    let number = pack.get_near(course.velocity())?;
                    course.see_velocity(number);
                    number
                } else {
                    let mean = 0.5 * (before.1[column + 3] + state[column + 3]);
                    let expected = course.place(column, mean, (frame.iteration - before.0) as f64 * memory.time_step);
                    let number = pack.get_near(expected.value)?;
                    course.see_place(expected, number);
                    number
                };
                state[column] = number;
                frame.states[body] = State::from_array(state);
                before = (frame.iteration, state);
            }
        }
    }
    Some(())
}

fn write_events(frame: &Frame, memory: &mut Memory, pack: &mut Pack) {
    pack.put(frame.hits.len() as u64);
    for hit in &frame.hits {
        pack.put(frame.iteration.wrapping_sub(hit.iteration));
        pack.put_near(frame.time, hit.time);
        let kind = KINDS.iter().position(|kind| *kind == hit.kind).unwrap_or(0);
        [hit.a.into(), hit.b.into(), kind as u64].into_iter().for_each(|number| pack.put(number));
        let [a, b] = [hit.a, hit.b].map(|body| of(frame, body));
        pack.put_all_near([a.x, a.z], hit.point);
        pack.put_all_near([0.0; 2], hit.normal);
        pack.put_near(0.0, hit.depth);
        put_state(pack, &a, &hit.after[0]);
        put_state(pack, &b, &hit.after[1]);
    }
    pack.put(frame.commands.len() as u64);
    for command in &frame.commands {
        pack.put(frame.iteration.wrapping_sub(command.iteration));
        [command.exchanges, command.body.into()].into_iter().for_each(|number| pack.put(number));
        put_state(pack, &of(frame, command.body), &command.after);
    }
    pack.put(frame.pushes.len() as u64);
    for push in &frame.pushes {
        pack.put(push.body.into());
        pack.put_all_near([0.0; 2], push.force);
        pack.put_near(0.0, push.torque);
    }
    pack.put(frame.listed.len() as u64);
    frame.listed.iter().flatten().for_each(|body| pack.put((*body).into()));
    pack.put(frame.advanced.len() as u64);
    for (body, state) in &frame.advanced {
        pack.put((*body).into());
        put_state(pack, &memory.ahead(*body), state);
    }
    write_touches(&frame.touches, memory, pack);
}

fn read_events(frame: &mut Frame, memory: &mut Memory, pack: &mut Unpack) -> Option<()> {
    for _ in 0..pack.count()? {
        let iteration = frame.iteration.checked_sub(pack.get()?)?;
        let time = pack.get_near(frame.time)?;
        let [a, b] = [body(memory, pack)?, body(memory, pack)?];
        let kind = *KINDS.get(usize::try_from(pack.get()?).ok()?)?;
        let states = [a, b].map(|body| of(frame, body));
        let point = get_numbers(pack, [states[0].x, states[0].z])?;
        let normal = get_numbers(pack, [0.0; 2])?;
        let depth = pack.get_near(0.0)?;
        let after = [get_state(pack, &states[0])?, get_state(pack, &states[1])?];
        frame.hits.push(Strike { iteration, time, a, b, kind, point, normal, depth, after });
    }
    for _ in 0..pack.count()? {
        let iteration = frame.iteration.checked_sub(pack.get()?)?;
        let exchanges = pack.get()?;
        let body = body(memory, pack)?;
        let after = get_state(pack, &of(frame, body))?;
        frame.commands.push(Command { iteration, exchanges, body, after });
    }
    for _ in 0..pack.count()? {
        let body = body(memory, pack)?;
        let force = get_numbers(pack, [0.0; 2])?;
        frame.pushes.push(Push { body, force, torque: pack.get_near(0.0)? });
    }
    for _ in 0..pack.count()? {
        frame.listed.push([body(memory, pack)?, body(memory, pack)?]);
    }
    for _ in 0..pack.count()? {
        let body = body(memory, pack)?;
        frame.advanced.push((body, get_state(pack, &memory.ahead(body))?));
    }
    frame.touches = read_touches(memory, pack)?;
    Some(())
}

/// Each by what stood in its place the frame before.
fn write_touches(touches: &[Touch], memory: &mut Memory, pack: &mut Pack) {
    pack.put(touches.len() as u64);
    for (i, touch) in touches.iter().enumerate() {
        let last = memory.touches.get(i).copied().unwrap_or_default();
        pack.put((touch.a ^ last.a).into());
        pack.put((touch.b ^ last.b).into());
        for (last, number) in last.numbers().into_iter().zip(touch.numbers()) {
            pack.put((last.to_bits() ^ number.to_bits()).into());
        }
    }
    memory.touches.clear();
    memory.touches.extend_from_slice(touches);
}

fn read_touches(memory: &mut Memory, pack: &mut Unpack) -> Option<Vec<Touch>> {
    let mut touches = Vec::new();
    for i in 0..pack.count()? {
        let last = memory.touches.get(i).copied().unwrap_or_default();
        let mut other = |last: u32| Some(last ^ u32::try_from(pack.get()?).ok()?);
        let [a, b] = [other(last.a)?, other(last.b)?];
        let mut numbers = last.numbers();
        for number in &mut numbers {
            *number = f32::from_bits(other(number.to_bits())?);
        }
        if [a, b].iter().any(|body| *body as usize >= memory.courses.len()) {
            return None;
        }
        touches.push(Touch::from_numbers(a, b, numbers));
    }
    memory.touches.clone_from(&touches);
    Some(touches)
}

/// A body that is there.
fn body(memory: &Memory, pack: &mut Unpack) -> Option<u32> {
    let body = u32::try_from(pack.get()?).ok()?;
    ((body as usize) < memory.courses.len()).then_some(body)
}

fn of(frame: &Frame, body: u32) -> State {
    frame.states.get(body as usize).copied().unwrap_or_default()
}

fn put_state(pack: &mut Pack, expected: &State, state: &State) {
    pack.put_all_near(expected.to_array(), state.to_array());
}

fn get_state(pack: &mut Unpack, expected: &State) -> Option<State> {
    get_numbers(pack, expected.to_array()).map(State::from_array)
}

fn get_numbers<const N: usize>(pack: &mut Unpack, mut expected: [f64; N]) -> Option<[f64; N]> {
    for number in &mut expected {
        *number = pack.get_near(*number)?;
    }
    Some(expected)
}
