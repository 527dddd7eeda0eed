//! How results are printed: for people, and as data.

pub mod json;
pub mod ledger;
pub mod numbers;
pub mod ron;
pub mod rows;
pub mod table;
pub mod text;
