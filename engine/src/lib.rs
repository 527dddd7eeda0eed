//! Rectangle collisions on a plane, after a design document of 2007: areas, detection, relocation, exchange.
//!
//! | stage | file | document |
//! |---|---|---|
//! | what a scene says | [`scene`] | |
//! | what it needs, decided once | [`plan`], [`census`], [`load`], [`area`] | §2.1, §2.2 |
//! | one iteration, the story | [`step`] | §2.1 |
//! | the other story: stop at every impact | `continuous`, [`impact_time`], [`flight`] | |
//! | advance | [`advance`], [`forces`], [`prescribed`], [`push`] | §2.1 |
//! | broad phase | [`broad_phase`] | §2.3 |
//! | detect | [`detect`] | §2.3 |
//! | relocate | [`relocate`] | §2.4 |
//! | exchange | [`exchange`] | §2.5 |
//! | totals, digest | [`totals`] | |
//! | what changed them, and why | [`ledger`] | |
//!
//! The engine does no IO, reads no clock, draws no random numbers and knows no script. It gives the same bits in
//! debug and release and on every platform: f64, `+ − × ÷ √` and the `libm` crate only, and the order of creation
//! wherever an order is needed.
//!
//! ```
//! use choque_engine::{area::Rect, scene::{Body, Kind, Part, Scene}, World};
//!
//! let mut a = Body::new("a", Kind::Mobile);
//! a.parts.push(Part::Rect(Rect::centred(1.0, 1.0)));
//! a.at = (-2.0, 0.0);
//! a.velocity = Some((2.0, 0.0));
//! let mut wall = Body::new("wall", Kind::Fixed);
//! wall.parts.push(Part::Rect(Rect::centred(1.0, 10.0)));
//! let scene = Scene { bodies: vec![a, wall], ..Scene::default() };
//!
//! let mut world = World::new(&scene)?;
//! for _ in 0..60 {
//!     world.step();
//! }
//! assert!(world.collisions() > 0);
//! assert!(world.velocity(world.find("a").unwrap()).x < 2.0);
//! # Ok::<(), choque_engine::SceneError>(())
//! ```

pub mod advance;
pub mod area;
pub mod bodies;
pub mod broad_phase;
pub mod census;
pub mod check;
pub mod command;
mod contact;
mod continuous;
pub mod detect;
mod directory;
pub mod error;
pub mod exchange;
pub mod flight;
pub mod forces;
pub mod frame;
pub mod impact_time;
mod lanes;
pub mod ledger;
pub mod load;
pub mod note;
pub mod plan;
pub mod prescribed;
pub mod push;
pub mod relocate;
pub mod scene;
pub mod step;
mod threads;
pub mod totals;
pub mod trig;
pub mod width;
pub mod work;
pub mod world;

pub use area::{Extent, Rect, Vec2};
pub use check::BadNumber;
pub use contact::Load;
pub use error::{CommandError, Fault, SceneError};
pub use exchange::PairKind;
pub use ledger::Ledger;
pub use note::Note;
pub use plan::Plan;
pub use scene::Scene;
pub use step::Hit;
pub use work::Work;
pub use world::{BodyId, World};
