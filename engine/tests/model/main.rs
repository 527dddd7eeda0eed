//! The document's model, held to worked values, to its formulas, and to itself.

mod laws;
mod random_scenes;
mod worked;
