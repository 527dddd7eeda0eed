//! Everything but the scenarios themselves, in one binary: the command, the harness, a project laid out by `init`,
//! and what must hold of every scene.

mod book;
mod command;
mod contact;
mod diff;
mod exact;
mod fit;
mod harness;
mod ledger;
mod metamorphic;
mod player;
mod project;
mod recording;
mod render;
mod report;
mod snapshots;
mod stability;
mod studio;
mod support;
mod sweep;
mod tidy;
mod unwritable;
