//! Commands (§2.1, step 1): what the user of a world may do to its bodies between iterations.

use crate::area::Vec2;
use crate::bodies::Role;
use crate::check;
use crate::error::CommandError;
use crate::push::Push;
use crate::world::{BodyId, World};

/// Commands: what a user of the world may do between iterations, or after an exchange.
impl World {
    /// Puts a body's centre somewhere.
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn set_position(&mut self, id: BodyId, position: Vec2) -> Result<(), CommandError> {
        self.finite(id, "x", position.x)?;
        self.finite(id, "z", position.y)?;
        self.disturb(id);
        self.part_seams(id);
        let o = position - self.plan.origin;
        self.command(id.index(), |bodies| bodies.place(id.index(), o));
        Ok(())
    }

    /// Turns a body to an angle \[rad\].
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn set_angle(&mut self, id: BodyId, angle: f64) -> Result<(), CommandError> {
        self.finite(id, "angle", angle)?;
        self.disturb(id);
        self.part_seams(id);
        self.command(id.index(), |bodies| bodies.set_angle(id.index(), angle));
        Ok(())
    }

    /// Gives a body a velocity \[m/s\]; a fixed body has physics from then on (R9), and its patrol ends.
    ///
    /// # Errors
    /// A component that is not finite.
    pub fn set_velocity(&mut self, id: BodyId, velocity: Vec2) -> Result<(), CommandError> {
        self.finite(id, "vx", velocity.x)?;
        self.finite(id, "vz", velocity.y)?;
        self.disturb(id);
        self.command(id.index(), |bodies| bodies.motion[id.index()].v = velocity);
        self.give_physics(id);
        self.movers.end_course(id.index());
        Ok(())
    }

    /// Gives a body a spin \[rad/s\]; a fixed body has physics from then on (R9), and its swing ends.
    ///
    /// # Errors
    /// A spin that is not finite.
    pub fn set_spin(&mut self, id: BodyId, spin: f64) -> Result<(), CommandError> {
        self.finite(id, "spin", spin)?;
        self.disturb(id);
        self.command(id.index(), |bodies| bodies.motion[id.index()].omega = spin);
        self.give_physics(id);
        self.movers.end_swing(id.index());
        Ok(())
    }

    /// A force on a mobile body's centre over the next advance \[N\]; several add up.
    ///
    /// # Errors
    /// A force that is not finite; a fixed body.
    pub fn push(&mut self, id: BodyId, force: Vec2) -> Result<(), CommandError> {
        self.finite(id, "push: fx", force.x)?;
        self.finite(id, "push: fz", force.y)?;
        self.pushed(id, "push")?.force += force;
        Ok(())
    }

    /// A torque on a mobile body over the next advance \[N·m\]; several add up.
    ///
    /// # Errors
    /// A torque that is not finite; a fixed body.
    pub fn twist(&mut self, id: BodyId, torque: f64) -> Result<(), CommandError> {
        self.finite(id, "twist: torque", torque)?;
        self.pushed(id, "twist")?.torque += torque;
        Ok(())
    }

    /// Has the world remember which bodies commands write to.
    pub fn remember_commands(&mut self) {
        self.commanded.get_or_insert_default();
    }

    /// The bodies that commands wrote to since the last iteration began, in order, each as often as it was; none unless
    /// [`remember_commands`](Self::remember_commands) was called.
    #[must_use]
    pub fn commanded(&self) -> &[BodyId] {
        self.commanded.as_deref().unwrap_or_default()
    }

    /// The pushes that act over the next advance, by body: force \[N\] and torque \[N·m\].
    pub fn pushes(&self) -> impl Iterator<Item = (BodyId, Vec2, f64)> {
        self.pushes.iter().map(|push| (BodyId(push.body), push.force, push.torque))
    }

    fn pushed(&mut self, id: BodyId, verb: &'static str) -> Result<&mut Push, CommandError> {
        if !self.bodies.is_mobile(id.index()) {
            return Err(CommandError::Fixed { body: self.name(id).to_owned(), verb });
        }
        self.work.commands += 1;
        let at = match self.pushes.binary_search_by_key(&id.0, |push| push.body) {
            Ok(at) => at,
            Err(at) => {
                self.pushes.insert(at, Push { body: id.0, force: Vec2::zeros(), torque: 0.0 });
                at
            }
        };
        Ok(&mut self.pushes[at])
    }

    /// Something is about to be done to a body: what is foreseen of it no longer holds.
    fn disturb(&mut self, id: BodyId) {
        self.interrupt(id.index());
        if let Some(commanded) = &mut self.commanded {
            commanded.push(id);
        }
        if let Some(contacts) = &mut self.contacts {
            contacts.wake(self.bodies.is_mobile(id.index()));
        }
    }

    fn finite(&self, id: BodyId, what: &str, value: f64) -> Result<(), CommandError> {
        let named = |number| CommandError::Number { body: self.name(id).to_owned(), number };
        check::finite(what, value).map(|_| ()).map_err(named)
    }

    /// A fixed body that is moved is no longer one with those it adjoined.
    fn part_seams(&mut self, id: BodyId) {
        let mut seams = core::mem::take(&mut self.bodies.seams);
        if !self.bodies.is_mobile(id.index()) {
            seams.part(&self.bodies, id.index());
        }
        self.bodies.seams = seams;
    }

    fn give_physics(&mut self, id: BodyId) {
        if self.bodies.role[id.index()] == Role::Fixed {
            self.bodies.role[id.index()] = Role::FixedWithPhysics;
            self.part_seams(id);
            if self.is_collidable(id) {
                self.plan.census.fixed -= 1;
                self.plan.census.fixed_with_physics += 1;
            }
            self.movers.add_fixed(id.0);
        }
    }
}
