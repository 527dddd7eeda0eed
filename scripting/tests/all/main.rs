//! The scripting crate from the outside, in one binary: a file for each thing a designer may ask.

mod callbacks;
mod diagnostics;
mod expectations;
mod files;
mod manual;
mod mathematics;
mod params;
mod sandbox;
mod support;
mod words;
