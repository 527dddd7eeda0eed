//! The scripting crate from the outside, in one binary: a file for each thing a designer may ask.

#![allow(clippy::unwrap_used)] // a test that cannot go on should stop

mod callbacks;
mod expectations;
mod files;
mod fit;
mod ledger;
mod manual;
mod mathematics;
mod params;
mod sandbox;
mod support;
mod words;
mod write_back;
mod wrong_names;
mod wrong_places;
mod wrong_rules;
mod wrong_values;
