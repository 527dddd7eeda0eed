//! The scene while a script builds it: plain data, and where in the script each body was made.

use std::collections::BTreeMap;

use choque_engine::Scene;
use choque_engine::scene::{Body, Kind, Part};
use rhai::ImmutableString;

use crate::error::Complaint;
use crate::session::Site;

/// Bodies a script may make; far beyond what runs, near enough that a runaway loop stops before memory does.
const MOST_BODIES: usize = 1_000_000;
/// Rectangles a script may make, over all bodies.
const MOST_PARTS: usize = 2_000_000;
/// Labels one body may have.
const MOST_TAGS: usize = 100;

/// A scene in the making.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) scene: Scene,
    /// Where each body was made.
    pub(crate) sites: Vec<Site>,
    by_name: BTreeMap<ImmutableString, u32>,
    parts: usize,
}

impl Draft {
    /// Makes a body; its index is the script's handle.
    pub(crate) fn add(&mut self, name: ImmutableString, kind: Kind, site: Site) -> Result<u32, Complaint> {
        if let Some(first) = self.by_name.get(&name) {
            let line = self.sites[*first as usize].seen_from(&site);
            return Err(Complaint::new(format!("there is a body \"{name}\" already; it was made in {line}"))
                .hint(format!("names are unique; in a loop write {}(\"{name}\" + i)", kind.word())));
        }
        if self.scene.bodies.len() >= MOST_BODIES {
            return Err(Complaint::new(format!("a scene may have {MOST_BODIES} bodies at most")));
        }
        let index = self.scene.bodies.len() as u32;
        self.scene.bodies.push(Body::new(name.as_str(), kind));
        self.sites.push(site);
        self.by_name.insert(name, index);
        Ok(index)
    }

    /// The body of a handle.
    pub(crate) fn body(&mut self, index: u32) -> Result<&mut Body, Complaint> {
        let strange = || Complaint::new("this body belongs to another scene");
        self.scene.bodies.get_mut(index as usize).ok_or_else(strange)
    }

    /// Gives a body one more rectangle.
    pub(crate) fn add_part(&mut self, index: u32, part: Part) -> Result<(), Complaint> {
        if self.parts >= MOST_PARTS {
            return Err(Complaint::new(format!("a scene may have {MOST_PARTS} rectangles at most")));
        }
        self.parts += 1;
        self.body(index)?.parts.push(part);
        Ok(())
    }

    /// Gives a body one more label; one it has already is not repeated.
    pub(crate) fn add_tag(&mut self, index: u32, tag: &str) -> Result<(), Complaint> {
        let body = self.body(index)?;
        if body.tags.len() >= MOST_TAGS {
            return Err(Complaint::new(format!("a body may have {MOST_TAGS} tags at most")));
        }
        if !body.tags.iter().any(|known| known == tag) {
            body.tags.push(tag.to_owned());
        }
        Ok(())
    }
}
