//! Contacts that last, in stepped motion with the impulse exchange: sliding, leaning, rocking, stacked, crushed.
//!
//! A test's name begins with the row it holds the solver to. References are closed forms, or integrals to 17 digits; what a stepper may
//! be off by is written in its time step, as a named constant with the value observed beside it:
//!
//! * **first order**: an error of C · dt with the C of a symplectic Euler stepper, which for a block that friction stops is v/2;
//! * **at rest**: positions to 1e-9, what a solver that balances forces reaches and one that lets things sink does not;
//! * **algebra**: momentum, symmetry and energy to rounding.
//!
//! | rows | where |
//! |---|---|
//! | P1, P2, P3, P11: sliding | [`sliding`] |
//! | P4, P5, P7, P8, P9: tipping, toppling, leaning | [`toppling`] |
//! | P6, P6b, P6c, P6d: rocking | [`rocking`] |
//! | P10, mass ratios, symmetry: stacks | [`stacks`] |
//! | P12, P12b: static loads | [`loads`] |
//! | P13: dominoes | [`dominoes`] |
//! | P14, random piles: energy never grows | [`energy`] |
//! | restitution beside and on what rests | [`bouncing`] |
//! | T30, walls that close on fifty cars | [`crush`] |
//! | momenta of what is driven apart | [`momenta`] |
//! | T11, T12, darts, what is struck before a wall: fast bodies | [`fast`] |
//! | what lies still until it is hit | [`still`] |
//!
//! Most are scenarios too: `scenarios/contact`.

#![expect(clippy::excessive_precision, reason = "exact answers are quoted with all their digits")]

mod bouncing;
mod crush;
mod dominoes;
mod energy;
mod fast;
mod kit;
mod loads;
mod momenta;
mod rocking;
mod sliding;
mod stacks;
mod still;
mod toppling;
