//! Two runs of which each has bodies that the other lacks, or that made them in another order: both with all bodies in one order, so
//! that the bodies they share can be compared.

use std::collections::BTreeSet;

use crate::recording::{Body, Command, Frame, Push, Recording, Strike, Touch};

/// Bodies under other names: made alike in both, and standing alike at the start. Their names in A and in B.
pub(super) fn renamed(a: &Recording, b: &Recording) -> Vec<[String; 2]> {
    let names = |run: &Recording| -> BTreeSet<String> { run.bodies.iter().map(|body| body.name.clone()).collect() };
    let (in_a, in_b) = (names(a), names(b));
    let start = |run: &Recording, at: usize| run.frames.first().and_then(|frame| frame.states.get(at)).copied();
    let is_free = |at: usize| !in_a.contains(&b.bodies[at].name);
    let mut free: Vec<usize> = (0..b.bodies.len()).filter(|at| is_free(*at)).collect();
    let lacking = a.bodies.iter().enumerate().filter(|(_, body)| !in_b.contains(&body.name));
    let found = lacking.filter_map(|(at, body)| {
        let alike = |other: &usize| {
            let called = Body { name: body.name.clone(), ..b.bodies[*other].clone() };
            called == *body && start(a, at) == start(b, *other)
        };
        let place = free.iter().position(alike)?;
        Some([body.name.clone(), b.bodies[free.remove(place)].name.clone()])
    });
    found.collect()
}

/// Both with the bodies of A and then those that only B has. One that a run lacks stands in it as it does in the other.
pub(super) fn aligned(a: &Recording, b: &Recording) -> [Recording; 2] {
    let called = renamed(a, b);
    let mut b = b.clone();
    for body in &mut b.bodies {
        if let Some([name, _]) = called.iter().find(|[_, name]| *name == body.name) {
            body.name.clone_from(name);
        }
    }
    let b = &b;
    let place = |recording: &Recording, name: &str| recording.bodies.iter().position(|body| body.name == name);
    let new = b.bodies.iter().filter(|body| place(a, &body.name).is_none());
    let all: Vec<&Body> = a.bodies.iter().chain(new).collect();
    let places = [a, b].map(|run| all.iter().map(|body| place(run, &body.name)).collect::<Vec<_>>());
    let lent = |from: &Recording, to: &Recording, places: &[Option<usize>], other: &[Option<usize>]| Recording {
        about: to.about.clone(),
        bodies: all
            .iter()
            .zip(places)
            .map(|(body, place)| place.map_or(*body, |place| &to.bodies[place]).clone())
            .collect(),
        frames: to.frames.iter().map(|frame| placed(frame, places, &from.frames, other)).collect(),
        ending: to.ending.clone(),
    };
    [lent(b, a, &places[0], &places[1]), lent(a, b, &places[1], &places[0])]
}

/// A frame with its bodies at other places; those it lacks are of the other run's frame of the same iteration.
fn placed(frame: &Frame, places: &[Option<usize>], others: &[Frame], lent: &[Option<usize>]) -> Frame {
    let at = others.binary_search_by_key(&frame.iteration, |other| other.iteration);
    let other = at.ok().map(|at| &others[at]);
    let own = |place: &Option<usize>| place.and_then(|place| frame.states.get(place)).copied();
    let borrowed = |place: &Option<usize>| place.and_then(|place| other?.states.get(place)).copied();
    let state = |(mine, theirs)| own(mine).or_else(|| borrowed(theirs)).unwrap_or_default();
    let to = |old: u32| places.iter().position(|place| *place == Some(old as usize)).map_or(old, |new| new as u32);
    let mut listed: Vec<[u32; 2]> = frame.listed.iter().map(|pair| in_order(pair.map(to)).0).collect();
    listed.sort_unstable();
    let mut advanced: Vec<_> = frame.advanced.iter().map(|(body, state)| (to(*body), *state)).collect();
    // Those it lacks flew as they did in the other.
    let is_lacking = |body: usize| places[body].is_none();
    let flown = other.into_iter().flat_map(|other| &other.advanced);
    advanced.extend(flown.filter_map(|(old, state)| {
        let new = lent.iter().position(|place| *place == Some(*old as usize)).filter(|new| is_lacking(*new))?;
        Some((new as u32, *state))
    }));
    advanced.sort_unstable_by_key(|(body, _)| *body);
    Frame {
        states: places.iter().zip(lent).map(state).collect(),
        hits: frame.hits.iter().map(|hit| renumbered(hit, to)).collect(),
        commands: frame.commands.iter().map(|command| Command { body: to(command.body), ..*command }).collect(),
        pushes: frame.pushes.iter().map(|push| Push { body: to(push.body), ..*push }).collect(),
        touches: frame.touches.iter().map(|touch| Touch { a: to(touch.a), b: to(touch.b), ..*touch }).collect(),
        listed,
        advanced,
        ..frame.clone()
    }
}

fn renumbered(hit: &Strike, to: impl Fn(u32) -> u32) -> Strike {
    let ([a, b], turned) = in_order([to(hit.a), to(hit.b)]);
    let [first, second] = hit.after;
    Strike { a, b, after: if turned { [second, first] } else { [first, second] }, ..*hit }
}

/// A pair in order of creation, and whether it had to be turned for it.
fn in_order([a, b]: [u32; 2]) -> ([u32; 2], bool) {
    if a > b { ([b, a], true) } else { ([a, b], false) }
}
