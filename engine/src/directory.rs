//! Names and labels of bodies: for look-up and for output, never read by a step.

use crate::scene::Scene;

/// Names and labels: never read by a step.
#[derive(Clone, Debug)]
pub(crate) struct Directory {
    names: Vec<Box<str>>,
    /// Bodies in the order of their names, for look-up.
    by_name: Vec<u32>,
    tags: Vec<(u32, Box<str>)>,
}

impl Directory {
    /// The names and labels of a scene's bodies.
    pub(crate) fn new(scene: &Scene) -> Self {
        let names: Vec<Box<str>> = scene.bodies.iter().map(|body| body.name.as_str().into()).collect();
        let mut by_name: Vec<u32> = (0..names.len() as u32).collect();
        by_name.sort_unstable_by(|a, b| names[*a as usize].cmp(&names[*b as usize]));
        let tags = scene.bodies.iter().enumerate();
        let tags = tags.flat_map(|(i, body)| body.tags.iter().map(move |tag| (i as u32, tag.as_str().into())));
        Directory { tags: tags.collect(), names, by_name }
    }

    /// The body of that name.
    pub(crate) fn find(&self, name: &str) -> Option<u32> {
        let at = self.by_name.binary_search_by(|i| (*self.names[*i as usize]).cmp(name)).ok()?;
        Some(self.by_name[at])
    }

    /// A body's name.
    pub(crate) fn name(&self, body: u32) -> &str {
        &self.names[body as usize]
    }

    /// A body's labels.
    pub(crate) fn tags_of(&self, body: u32) -> impl Iterator<Item = &str> {
        self.tags.iter().filter(move |(owner, _)| *owner == body).map(|(_, tag)| &**tag)
    }

    /// The bodies with that label, each once, in order of creation.
    pub(crate) fn tagged(&self, tag: &str) -> impl Iterator<Item = u32> {
        let with_tag = self.tags.iter().filter(move |(_, t)| &**t == tag).map(|(body, _)| *body);
        let mut last = None;
        with_tag.filter(move |body| last.replace(*body) != Some(*body))
    }
}
