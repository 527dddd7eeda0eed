//! Choque beside Box2D and Rapier: the same scenes, the same exact cases, one process, engine after engine.
//!
//! | what | file |
//! |---|---|
//! | what there is to simulate | [`scene`] |
//! | who simulates it | [`engine`] |
//! | what came of it | [`judge`], [`memory`] |
//! | speed: scenes run in turns | [`speed`] |
//! | the cost of an error, the growth of cost | [`equal`], [`growth`] |
//! | exact cases | [`accuracy`] |
//! | calls, tables, the page | [`cli`], [`table`], [`written`] |

pub mod accuracy;
pub mod cli;
pub mod engine;
pub mod equal;
pub mod growth;
pub mod judge;
pub mod memory;
pub mod scene;
pub mod speed;
pub mod table;
pub mod written;

/// Everything this program allocates is counted, engines written in C included.
#[global_allocator]
static ALLOCATOR: memory::Counted = memory::Counted;
