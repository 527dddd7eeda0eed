//! The player's own sources, put together: nothing of them is fetched when a page is shown.

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use sha2::{Digest, Sha256};

/// The scripts in the order in which they need each other.
const SCRIPTS: [&str; 15] = [
    include_str!("dom.js"),
    include_str!("theme.js"),
    include_str!("unpack.js"),
    include_str!("film.js"),
    include_str!("camera.js"),
    include_str!("labels.js"),
    include_str!("stage.js"),
    include_str!("plots.js"),
    include_str!("tables.js"),
    include_str!("rhai.js"),
    include_str!("player.js"),
    include_str!("controls.js"),
    include_str!("keys.js"),
    include_str!("page.js"),
    "globalThis.choque = { Player, Film, read, unpack, fromBase64, lit, listing, themeSwitch, startPage, KEYS_IN_WORDS };\n",
];

/// The player as one script, for any page: it defines `choque`, with `Player` and `unpack`, and does nothing else.
#[must_use]
pub fn script() -> String {
    format!("\"use strict\";\n(() => {{\n{}}})();\n", SCRIPTS.concat())
}

/// The player's style, for any page.
#[must_use]
pub fn style() -> &'static str {
    include_str!("player.css")
}

/// The style of what is around the player on a page like ours.
pub(super) fn page_style() -> &'static str {
    include_str!("page.css")
}

/// What a page's rules allow in place of all scripts, or all styles: this very text.
pub(super) fn source_digest(text: &str) -> String {
    format!("sha256-{}", BASE64.encode(Sha256::digest(text)))
}
