//! What is booked: four amounts, under ten causes.

use core::ops::{Add, AddAssign, Index, IndexMut, Sub};

use crate::area::Vec2;
use crate::bodies::{Inertia, Motion};

/// The four quantities of the mobile bodies that are kept account of, or a change of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amounts {
    /// \[J\].
    pub kinetic_energy: f64,
    /// \[kg·m/s\].
    pub momentum_x: f64,
    /// \[kg·m/s\].
    pub momentum_z: f64,
    /// About the world's origin \[kg·m²/s\].
    pub angular_momentum: f64,
}

impl Amounts {
    /// How many quantities there are.
    pub const COUNT: usize = 4;

    /// Their names, as scripts and results write them.
    pub const NAMES: [&'static str; Amounts::COUNT] =
        ["kinetic_energy", "momentum_x", "momentum_z", "angular_momentum"];

    /// In the order of the names.
    #[must_use]
    pub fn to_array(self) -> [f64; Amounts::COUNT] {
        [self.kinetic_energy, self.momentum_x, self.momentum_z, self.angular_momentum]
    }

    pub(super) fn from_array([kinetic_energy, momentum_x, momentum_z, angular_momentum]: [f64; 4]) -> Self {
        Amounts { kinetic_energy, momentum_x, momentum_z, angular_momentum }
    }

    /// What an impulse at a point does, leaving its work aside.
    pub(super) fn of_impulse(p: Vec2, at: Vec2) -> Self {
        Amounts { kinetic_energy: 0.0, momentum_x: p.x, momentum_z: p.y, angular_momentum: cross(at, p) }
    }

    /// What a change of spin does, leaving its work aside.
    pub(super) fn of_twist(angular_momentum: f64) -> Self {
        Amounts { angular_momentum, ..Amounts::default() }
    }

    pub(super) fn of_energy(kinetic_energy: f64) -> Self {
        Amounts { kinetic_energy, ..Amounts::default() }
    }
}

impl Add for Amounts {
    type Output = Amounts;

    fn add(self, other: Amounts) -> Amounts {
        let (a, b) = (self.to_array(), other.to_array());
        Amounts::from_array([0, 1, 2, 3].map(|k| a[k] + b[k]))
    }
}

impl AddAssign for Amounts {
    fn add_assign(&mut self, other: Amounts) {
        *self = *self + other;
    }
}

impl Sub for Amounts {
    type Output = Amounts;

    fn sub(self, other: Amounts) -> Amounts {
        let (a, b) = (self.to_array(), other.to_array());
        Amounts::from_array([0, 1, 2, 3].map(|k| a[k] - b[k]))
    }
}

macro_rules! causes {
    ($($(#[$doc:meta])* $cause:ident: $word:literal,)+) => {
        /// What changed them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Cause { $($(#[$doc])* $cause,)+ }

        impl Cause {
            /// All of them, in the order in which they are told.
            pub const ALL: [Cause; [$($word),+].len()] = [$(Cause::$cause),+];

            /// Their names, in the same order, as scripts and results write them.
            pub const WORDS: [&'static str; Cause::ALL.len()] = [$($word),+];
        }
    };
}

causes! {
    /// What collisions do by themselves. The document's exchange: what its rule does at μ_L = μ_A = 1, the fixed body's own
    /// motion taken as zero. The impulse exchange: the momentum that fixed bodies take up along the normal, and where contacts are
    /// solved in sub-steps the little angular momentum that comes of two bodies slipping past each other within one.
    Exchange: "exchange",
    /// What μ_L < 1 changes of that, then.
    MuL: "mu_l",
    /// What μ_A < 1 changes of that, last.
    MuA: "mu_a",
    /// The impulse exchange: the work of the normal impulses, spent in compression and partly given back. Contacts that last
    /// are booked as impacts are, here and under the next: forces times time in place of impulses.
    Restitution: "restitution",
    /// The impulse exchange: the work of the tangential impulses, and the momentum that fixed bodies take up along the
    /// tangent.
    Friction: "friction",
    /// Bodies put elsewhere so that pairs part, or overlaps be let go: an angular momentum, for they go on with the same velocity
    /// from there.
    Relocation: "relocation",
    /// Drag.
    Drag: "drag",
    /// Gravity.
    Gravity: "gravity",
    /// What scripts write, push and twist.
    Commands: "commands",
    /// Work of fixed bodies with physics. The document's exchange: all that their own motion adds at μ = 1. The impulse
    /// exchange: impulse times their velocity at the point; its momentum is under `exchange` and `friction`.
    FixedBodies: "fixed_bodies",
}

impl Cause {
    /// Its name, as scripts and results write it.
    #[must_use]
    pub fn word(self) -> &'static str {
        Cause::WORDS[self as usize]
    }
}

/// Amounts by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Booked([Amounts; Cause::ALL.len()]);

impl Booked {
    /// All causes together.
    #[must_use]
    pub fn total(&self) -> Amounts {
        self.0.iter().fold(Amounts::default(), |sum, amounts| sum + *amounts)
    }
}

impl Index<Cause> for Booked {
    type Output = Amounts;

    fn index(&self, cause: Cause) -> &Amounts {
        &self.0[cause as usize]
    }
}

impl IndexMut<Cause> for Booked {
    fn index_mut(&mut self, cause: Cause) -> &mut Amounts {
        &mut self.0[cause as usize]
    }
}

/// Where a body's centre is, from the world's origin, and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct State {
    pub(super) o: Vec2,
    pub(super) motion: Motion,
}

/// What a body's amounts change from one motion to another at the same place: from the differences, so that little cancels.
pub(super) fn change_at(Inertia { mass, moment }: Inertia, o: Vec2, from: Motion, to: Motion) -> Amounts {
    let (v, omega) = (to.v - from.v, to.omega - from.omega);
    let twice = mass * v.dot(&(from.v + to.v)) + moment * omega * (from.omega + to.omega);
    Amounts {
        kinetic_energy: 0.5 * twice,
        momentum_x: mass * v.x,
        momentum_z: mass * v.y,
        angular_momentum: mass * cross(o, v) + moment * omega,
    }
}

pub(super) fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}
