//! The ledger: what changed the mobile bodies' kinetic energy, momentum and angular momentum, and by how much.
//!
//! What they had when the ledger was begun and all that was booked since make up what they have:
//! `initial + Σ booked = final`, to rounding. Free flight changes nothing and is not booked. What a body changes is known in
//! twice the precision (`wide.rs`); the causes have their parts of it, and what rounding leaves between them and the whole
//! is booked too.
//!
//! A world keeps no ledger unless asked to ([`World::keep_ledger`]); it decides nothing, so results are the same
//! to the bit.

mod amounts;
mod contact;
mod flight;
mod handing;
mod impact;
mod wide;

use std::borrow::Cow;

use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::world::World;
use amounts::State;
pub use amounts::{Amounts, Booked, Cause};
use contact::InContact;
pub(crate) use contact::{Pressing, Stint};
pub(crate) use flight::Forces;
pub(crate) use handing::Handing;
use wide::{Sum, Sums};

/// What was booked.
#[derive(Clone, Debug)]
pub struct Ledger {
    /// Where positions count from: angular momentum is about the world's origin.
    origin: Vec2,
    initial: Amounts,
    booked: [Sums; Cause::ALL.len()],
    relocated: Sum,
    relocations: u64,
    entries: Vec<Entry>,
    /// The time of what happens now \[s\].
    now: f64,
    /// How bodies were before they flew.
    set_out: Vec<State>,
    /// What is known of bodies and touches while contacts are solved.
    contact: InContact,
}

/// One exchange in the books.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// When it happened \[s\].
    pub time: f64,
    /// How far a body was relocated \[m\].
    pub relocated: f64,
    /// What it changed.
    pub booked: Booked,
}

impl Ledger {
    /// What the mobile bodies had when the ledger was begun.
    #[must_use]
    pub fn initial(&self) -> Amounts {
        self.initial
    }

    /// What a cause has changed since.
    #[must_use]
    pub fn booked(&self, cause: Cause) -> Amounts {
        self.booked[cause as usize].value()
    }

    /// How far bodies were relocated in all \[m\].
    #[must_use]
    pub fn relocated(&self) -> f64 {
        self.relocated.value()
    }

    /// How often bodies were relocated.
    #[must_use]
    pub fn relocations(&self) -> u64 {
        self.relocations
    }

    /// The exchanges of the iteration, each in the place of its [`Hit`](crate::Hit). Contacts that last have none: what they change is
    /// only booked.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// An iteration begins: its exchanges will be entered.
    pub(crate) fn begin(&mut self) {
        self.entries.clear();
    }

    /// What is booked from now on happens at that time \[s\].
    pub(crate) fn at(&mut self, time: f64) {
        self.now = time;
    }

    fn book(&mut self, cause: Cause, amounts: Amounts) {
        self.booked[cause as usize].add(amounts);
    }

    /// Books what is left between the parts of a change and the whole of it, which is rounding or the part of that cause.
    fn book_rest(&mut self, cause: Cause, rest: &Sums) {
        self.booked[cause as usize].add_all(rest);
    }

    fn book_all(&mut self, booked: &Booked) {
        for cause in Cause::ALL {
            self.book(cause, booked[cause]);
        }
    }

    /// Enters an exchange that was booked.
    fn enter(&mut self, booked: Booked, relocated: f64) {
        self.entries.push(Entry { time: self.now, relocated, booked });
    }

    fn state(&self, bodies: &Bodies, body: usize) -> State {
        State { o: bodies.frame[body].o + self.origin, motion: bodies.motion[body] }
    }
}

impl World {
    /// Keeps a ledger from now on, if none is kept yet.
    pub fn keep_ledger(&mut self) {
        if self.ledger.is_some() {
            return;
        }
        let mut ledger = Box::new(Ledger {
            origin: self.plan.origin,
            initial: Amounts::default(),
            booked: [Sums::default(); Cause::ALL.len()],
            relocated: Sum::default(),
            relocations: 0,
            entries: Vec::new(),
            now: self.time(),
            set_out: Vec::new(),
            contact: InContact::default(),
        });
        let mut has = Sums::default();
        for body in self.movers.mobile.iter().map(|body| *body as usize) {
            has.add_state(self.bodies.inertia[body], ledger.state(&self.bodies, body), 1.0);
        }
        ledger.initial = has.value();
        self.ledger = Some(ledger);
    }

    /// What the mobile bodies have of the four quantities, as exact as a number can say it: books close to the last digit
    /// even where much that cancels is added up. Slower than [`World::kinetic_energy`] and its sisters.
    #[must_use]
    pub fn totals(&self) -> Amounts {
        let mut has = Sums::default();
        for body in self.movers.mobile.iter().map(|body| *body as usize) {
            let frame = self.path_now(body).map_or(self.bodies.frame[body], |path| path.frame);
            let state = State { o: frame.o + self.plan.origin, motion: self.motion_now(body) };
            has.add_state(self.bodies.inertia[body], state, 1.0);
        }
        has.value()
    }

    /// The ledger, if one is kept, as it is now: also while an iteration is under way.
    #[must_use]
    pub fn ledger(&self) -> Option<Cow<'_, Ledger>> {
        let ledger = self.ledger.as_deref()?;
        let under_way = self.continuous.as_ref().filter(|state| state.is_flying());
        Some(match under_way {
            Some(state) => Cow::Owned(state.ledger_now(self, ledger.clone())),
            None => Cow::Borrowed(ledger),
        })
    }

    /// Lets a command change a body; the books see what.
    pub(crate) fn command(&mut self, body: usize, change_it: impl FnOnce(&mut Bodies)) {
        let Some(ledger) = self.ledger.as_deref_mut().filter(|_| self.bodies.is_mobile(body)) else {
            return change_it(&mut self.bodies);
        };
        let before = ledger.state(&self.bodies, body);
        change_it(&mut self.bodies);
        let after = ledger.state(&self.bodies, body);
        ledger.book_rest(Cause::Commands, &Sums::of_change(self.bodies.inertia[body], before, after));
    }
}
