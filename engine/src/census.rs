//! The census: how many bodies of each sort a scene has.

use core::fmt;

use crate::bodies::Role;
use crate::load::{areas, role};
use crate::scene::Scene;

/// How many bodies of each sort a scene has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Mobile bodies that take part in collisions.
    pub mobile: usize,
    /// Fixed bodies that take part, without physics.
    pub fixed: usize,
    /// Fixed bodies that take part, with physics.
    pub fixed_with_physics: usize,
    /// Bodies that do not cross the plane.
    pub not_collidable: usize,
    /// Bodies of several rectangles.
    pub compound: usize,
    /// Bodies with a prescribed motion.
    pub prescribed: usize,
    /// Rectangles in all.
    pub rectangles: usize,
}

impl Census {
    /// Counts the bodies of each sort.
    #[must_use]
    pub fn of(scene: &Scene) -> Census {
        let mut census = Census::default();
        for body in &scene.bodies {
            let rectangles = areas(body, scene.settings.plane).count();
            census.rectangles += rectangles;
            census.compound += usize::from(rectangles > 1);
            census.prescribed += usize::from(body.patrol.is_some() || body.swing.is_some());
            match (rectangles, role(body)) {
                (0, _) => census.not_collidable += 1,
                (_, Role::Mobile) => census.mobile += 1,
                (_, Role::FixedWithPhysics) => census.fixed_with_physics += 1,
                (_, Role::Fixed) => census.fixed += 1,
            }
        }
        census
    }

    /// Pairs of bodies that could collide.
    pub(crate) fn pairs(&self) -> usize {
        self.mobile * self.mobile.saturating_sub(1) / 2 + self.mobile * (self.fixed + self.fixed_with_physics)
    }

    /// The document's cases of exchange that can happen.
    pub(crate) fn exchange_cases(&self) -> Vec<&'static str> {
        [
            (self.mobile > 1, "mobile–mobile (§2.5.1)"),
            (self.fixed_with_physics > 0, "mobile–fixed with physics (§2.5.2)"),
            (self.fixed > 0, "mobile–fixed (§2.5.3)"),
        ]
        .into_iter()
        .filter_map(|(present, case)| present.then_some(case))
        .collect()
    }
}

impl fmt::Display for Census {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = [
            (self.mobile, "mobile"),
            (self.fixed_with_physics, "fixed with physics"),
            (self.fixed, "fixed"),
            (self.not_collidable, "not collidable"),
        ];
        let present: Vec<String> =
            counts.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect();
        write!(f, "{}", if present.is_empty() { "none".to_owned() } else { present.join(", ") })?;
        if self.rectangles > 0 {
            write!(f, "; {} rectangle{}", self.rectangles, if self.rectangles == 1 { "" } else { "s" })?;
        }
        if self.compound > 0 {
            write!(f, ", {} compound", self.compound)?;
        }
        Ok(())
    }
}
