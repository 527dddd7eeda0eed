//! What a run says to its page: one after the other, each with its kind and length before it.

use axum::body::Bytes;
use serde_json::Value;

/// The byte before a text: JSON.
const TEXT: u8 = b'J';
/// The byte before a film, as the player takes it.
const FILM: u8 = b'F';

/// JSON for the page.
pub(super) fn text(value: &Value) -> Bytes {
    framed(TEXT, value.to_string().as_bytes())
}

/// Frames so far, or all of them.
pub(super) fn film(film: &[u8]) -> Bytes {
    framed(FILM, film)
}

/// Kind, length in four bytes with the lowest first, content.
fn framed(kind: u8, content: &[u8]) -> Bytes {
    let length = u32::try_from(content.len()).unwrap_or(u32::MAX);
    let content = &content[..length as usize];
    [&[kind], length.to_le_bytes().as_slice(), content].concat().into()
}
