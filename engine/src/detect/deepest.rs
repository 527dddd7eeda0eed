//! The deepest overlap of a whole world, asked once or again and again.

use std::borrow::Cow;

use super::overlap;
use crate::bodies::Bodies;
use crate::broad_phase::BroadPhase;
use crate::frame::Frame;
use crate::work::Work;
use crate::world::World;

/// Where all bodies of a world stand at a moment: what [`Depths`] looks at, without the world.
#[derive(Clone, Debug, Default)]
pub struct Poses(Vec<Frame>);

/// Finds the deepest overlap again and again as a world moves, and keeps its search from one time to the next. It looks at poses, so
/// that another thread may do it while the world goes on.
#[derive(Clone, Debug)]
pub struct Depths {
    broad_phase: BroadPhase,
    /// The areas of a world, and whose they are; of what changes, where the bodies stand.
    bodies: Bodies,
}

impl Depths {
    /// A search through that world.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let Bodies { frame, role, rects, first_rect, .. } = &world.bodies;
        let bodies = Bodies {
            frame: frame.clone(),
            role: role.clone(),
            rects: rects.clone(),
            first_rect: first_rect.clone(),
            ..Bodies::default()
        };
        Depths { broad_phase: BroadPhase::new(world.plan.broad_phase), bodies }
    }

    /// What [`World::deepest`] is when that world's bodies stand so \[m\].
    ///
    /// # Panics
    /// On poses of a world with another number of bodies.
    #[must_use]
    pub fn deepest(&mut self, poses: &Poses) -> f64 {
        self.bodies.frame.copy_from_slice(&poses.0);
        deepest(&mut self.broad_phase, &self.bodies)
    }
}

impl World {
    /// Deepest overlap of any pair that can collide, now \[m\], by separating axes: also of a pair the vertex
    /// test does not see. 0 when nothing overlaps.
    #[must_use]
    pub fn deepest(&self) -> f64 {
        deepest(&mut BroadPhase::new(self.plan.broad_phase), &self.bodies_now())
    }

    /// Takes down where the bodies stand now.
    pub fn take_poses(&self, poses: &mut Poses) {
        poses.0.clear();
        match self.bodies_now() {
            Cow::Borrowed(bodies) => poses.0.extend_from_slice(&bodies.frame),
            Cow::Owned(bodies) => poses.0 = bodies.frame,
        }
    }
}

fn deepest(broad_phase: &mut BroadPhase, bodies: &Bodies) -> f64 {
    let mut deepest: f64 = 0.0;
    broad_phase.visit(bodies, &mut Work::default(), |i, j, _| {
        deepest = deepest.max(overlap::between(bodies, i, j));
    });
    deepest
}
