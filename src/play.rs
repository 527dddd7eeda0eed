//! A scenario played to its end, with someone watching.

use choque_engine::{Hit, World};
use choque_scripting::{Expectation, Moment, Run, Scenario, Step};

use crate::Error;
use crate::output::numbers::counted;

/// Told of every iteration once it is finished: the world as it stands then, and its exchanges in order.
pub trait Watch {
    /// One more iteration is finished.
    fn iteration(&mut self, world: &World, hits: &[Hit]);

    /// An iteration has come that far; most do not care.
    fn moment(&mut self, _: &World, _: Moment) {}
}

/// Nobody watches: only the end matters.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn iteration(&mut self, _: &World, _: &[Hit]) {}
}

/// Plays a run to its end and judges the expectations.
///
/// # Errors
/// A callback that fails; a body that left the finite numbers.
pub fn play(run: &mut Run, watch: &mut impl Watch) -> Result<Vec<Expectation>, Error> {
    let steps = run.world().plan().steps;
    while run.world().iteration() < steps {
        let step = run.step_told(&mut |world, moment| watch.moment(world, moment))?;
        watch.iteration(&run.world(), run.hits());
        if step == Step::Done {
            break;
        }
    }
    Ok(run.conclude()?)
}

/// Which callbacks a script has, for people: `on_step and 2 expectations`; `None` when it has none.
#[must_use]
pub fn callbacks_in_words(scenario: &Scenario) -> Option<String> {
    let callbacks = scenario.callbacks();
    let named =
        [(callbacks.on_step, "on_step"), (callbacks.on_collision, "on_collision"), (callbacks.stop_when, "stop_when")];
    let present = named.into_iter().filter(|(present, _)| *present);
    let mut words: Vec<String> = present.map(|(_, name)| name.to_owned()).collect();
    match callbacks.expect + callbacks.always {
        0 => {}
        count => words.push(counted(count, "expectation", "expectations")),
    }
    let last = words.pop()?;
    Some(if words.is_empty() { last } else { format!("{} and {last}", words.join(", ")) })
}

/// Remembers which pairs met first, and how often each of them did.
#[derive(Clone, Debug)]
pub struct FirstMeetings {
    /// In the order in which they met.
    pub meetings: Vec<Meeting>,
    most: usize,
}

/// A pair that met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The first exchange of the two.
    pub first: Hit,
    /// How many exchanges they had in all.
    pub times: u64,
}

impl FirstMeetings {
    /// Remembers that many pairs at most.
    #[must_use]
    pub fn new(most: usize) -> Self {
        FirstMeetings { meetings: Vec::new(), most }
    }
}

impl Watch for FirstMeetings {
    fn iteration(&mut self, _: &World, hits: &[Hit]) {
        for hit in hits {
            let known = self.meetings.iter().position(|known| (known.first.a, known.first.b) == (hit.a, hit.b));
            match known {
                Some(known) => self.meetings[known].times += 1,
                None if self.meetings.len() < self.most => self.meetings.push(Meeting { first: *hit, times: 1 }),
                None => {}
            }
        }
    }
}
