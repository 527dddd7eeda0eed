//! What contacts need where bodies move in steps, hand impulses over and all overlaps are seen.

use core::fmt;

use crate::census::Census;
use crate::load;
use crate::scene::{Body, Kind, Scene};

/// Sub-steps where a scene does not say. Fewer hold piles worse, more take longer; 4 is also what Box2D v3 takes, so that
/// costs can be compared.
const SUBSTEPS: u32 = 4;

/// How contacts are solved in stepped motion with the impulse exchange, and what of it the scene needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactPlan {
    /// Equal parts an iteration is solved in, 1 … 1000.
    pub substeps: u32,
    /// Whether any pair that can collide has friction.
    pub friction: bool,
    /// Whether any pair that can collide has restitution.
    pub restitution: bool,
    /// Whether bodies at rest are put to sleep.
    pub sleeping: bool,
}

impl ContactPlan {
    /// `None` where contacts are not solved ([`Settings::solves_contacts`](crate::scene::Settings::solves_contacts)), and where
    /// nothing can collide.
    pub(super) fn resolve(scene: &Scene, census: &Census) -> Option<Self> {
        let settings = &scene.settings;
        (settings.solves_contacts() && census.pairs() > 0).then(|| ContactPlan {
            substeps: settings.substeps.unwrap_or(SUBSTEPS),
            friction: has_friction(scene),
            restitution: collidable(scene).any(|body| load::surface(body, settings).restitution > 0.0),
            sleeping: settings.sleeping,
        })
    }

    /// What pairs bring into an exchange, as the plan's line of it goes on.
    pub(super) fn of_pairs(self) -> &'static str {
        match (self.restitution, self.friction) {
            (true, true) => ", restitution and friction of each pair",
            (true, false) => ", restitution of each pair",
            (false, true) => ", friction of each pair",
            (false, false) => "",
        }
    }
}

impl fmt::Display for ContactPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = if self.substeps == 1 { "" } else { "s" };
        let sleep = if self.sleeping { ", bodies at rest sleep" } else { "" };
        write!(f, "solved in {} sub-step{plural}{sleep}", self.substeps)
    }
}

/// A pair takes the greater restitution, so that one body is enough, but the geometric mean of the frictions: it needs
/// two bodies that have some, one of them mobile.
fn has_friction(scene: &Scene) -> bool {
    let rough = || collidable(scene).filter(|body| load::surface(body, &scene.settings).friction > 0.0);
    rough().any(|body| body.kind == Kind::Mobile) && rough().nth(1).is_some()
}

fn collidable(scene: &Scene) -> impl Iterator<Item = &Body> {
    scene.bodies.iter().filter(|body| load::areas(body, scene.settings.plane).next().is_some())
}
