//! What drives bodies in continuous motion: forces and pushes over an iteration, courses and swings from turn to turn.

use super::Continuous;
use super::forecast::What;
use crate::flight::Pull;
use crate::plan::FlightPlan;
use crate::world::World;

impl Continuous {
    /// What acts on the bodies in this iteration: the scene's forces, and pushes.
    pub(super) fn set_pulls(&mut self, world: &mut World) {
        let forces = match world.plan.flight {
            FlightPlan::Free => None,
            FlightPlan::Forced { gravity, drag, .. } => Some(Pull { a: gravity, alpha: 0.0, drag }),
        };
        self.pulls.clear();
        self.free.clear();
        self.holding.clear();
        if forces.is_none() && world.pushes.is_empty() && self.lasting.is_empty() {
            return;
        }
        self.pulls.resize(world.bodies.len(), Pull::NONE);
        for &body in &world.movers.mobile {
            self.pulls[body as usize] = forces.unwrap_or(Pull::NONE);
        }
        for push in &world.pushes {
            let body = push.body as usize;
            self.pulls[body].a += push.force / world.bodies.inertia[body].mass;
            self.pulls[body].alpha += push.torque / world.bodies.inertia[body].moment;
        }
        world.pushes.clear();
        self.free.clone_from(&self.pulls);
    }

    /// Prescribed bodies stand where they are prescribed to, and their next corners are foreseen.
    pub(super) fn begin_prescribed(&mut self, world: &mut World) {
        for at in 0..world.movers.prescribed.len() {
            self.prescribe(world, at, 0.0);
        }
    }

    /// A prescribed body turns: it and those near it are looked at again.
    pub(super) fn turn(&mut self, world: &mut World, at: usize) {
        let Some(which) = world.movers.prescribed.iter().position(|p| p.body == at) else { return };
        self.forecast.changed(at);
        self.bring(world, at);
        self.since[at] = self.now;
        self.prescribe(world, which, self.now);
        self.dirty.push(at as u32);
        self.struck.push(at as u32);
    }

    /// Puts a prescribed body where it stands now, moving as it will until its next turn.
    pub(super) fn prescribe(&mut self, world: &mut World, which: usize, now: f64) {
        let start = world.advances as f64 * world.plan.time_step + self.segment_start();
        let prescription = &world.movers.prescribed[which];
        let next = prescription.next_turn(start + now);
        prescription.apply_until(&mut world.bodies, start + now, next);
        world.work.prescribed += 1;
        let body = prescription.body;
        if next - start <= self.length {
            self.forecast.expect((next - start).max(now), 0.0, What::Turn(body as u32));
        }
    }
}
