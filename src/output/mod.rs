//! How results are printed: for people, and as data.

pub mod json;
pub mod numbers;
pub mod ron;
pub mod table;
pub mod text;
