//! Exchange (§2.5): what two bodies hand each other at a collision.

pub mod document;
pub mod flat;
pub mod impact;
pub mod impulse;
pub mod together;

use crate::bodies::Role;

/// Which of the document's three cases a pair is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairKind {
    /// Both can be moved (§2.5.1).
    Mobile,
    /// One is fixed and hands over its motion (§2.5.2).
    FixedWithPhysics,
    /// One is fixed and at rest (§2.5.3).
    Fixed,
}

impl PairKind {
    /// The case of a pair of which at least one is mobile; two fixed bodies never meet here (R3).
    #[must_use]
    pub fn of(one: Role, two: Role) -> Self {
        match (one, two) {
            (Role::Mobile, Role::Mobile) => PairKind::Mobile,
            (Role::FixedWithPhysics, _) | (_, Role::FixedWithPhysics) => PairKind::FixedWithPhysics,
            (Role::Fixed, _) | (_, Role::Fixed) => PairKind::Fixed,
        }
    }
}
