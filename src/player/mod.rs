//! The player: a recording in one page that needs nothing else, and the same as a module for other pages.
//!
//! | what | file |
//! |---|---|
//! | a page of its own: of a run, of two runs laid over each other | [`page`](mod@page), `page.html`, `page.css`, `page.js` |
//! | the player's sources, for any page | [`assets`], `player.js`, `player.css` and what `assets` lists |
//! | a recording as the player is handed it, and how exactly | [`film`](mod@film), `quantum`, `events`, `code`; `unpack.js` reads it |
//! | texts that become parts of a page | `text` |
//!
//! A page of another's making loads [`style`] and [`script`] and then says
//!
//! ```js
//! const film = await choque.unpack(await (await fetch("/film")).arrayBuffer());   // what `film` makes
//! const player = new choque.Player(document.getElementById("player"), film);
//! ```
//!
//! `player.js` begins with all that a player is told.

pub mod assets;
mod code;
mod events;
pub mod film;
pub mod page;
mod quantum;
mod text;

pub use assets::{script, style};
pub use film::{film, plain_film};
pub use page::{page, page_of_two};

use crate::Error;
