//! A running world: the bodies of a scene, where they stand and how they move.

use crate::advance::Movers;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion, Role};
use crate::broad_phase::BroadPhase;
use crate::check;
use crate::command::Push;
use crate::detect::overlap;
use crate::error::{CommandError, Fault, SceneError};
use crate::load;
use crate::plan::Plan;
use crate::scene::{Kind, Scene};
use crate::work::Work;

/// A body of a world: its index in order of creation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(pub(crate) u32);

impl BodyId {
    /// Its place in the order of creation.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A scene in motion. `Clone` makes an independent copy that runs on to the same bits.
#[derive(Clone, Debug)]
pub struct World {
    pub(crate) plan: Plan,
    pub(crate) bodies: Bodies,
    pub(crate) movers: Movers,
    pub(crate) broad_phase: BroadPhase,
    pub(crate) pushes: Vec<Push>,
    /// Pairs listed as overlapping in this iteration, in order, and how many of them have been treated.
    pub(crate) listed: Vec<(u32, u32)>,
    pub(crate) treated: usize,
    /// Iterations finished, and advances made: they differ within an iteration.
    pub(crate) iteration: u64,
    pub(crate) advances: u64,
    pub(crate) collisions: u64,
    pub(crate) fault: Option<Fault>,
    pub(crate) work: Work,
    directory: Directory,
}

/// Names and labels: never read by a step.
#[derive(Clone, Debug)]
struct Directory {
    names: Vec<Box<str>>,
    /// Bodies in the order of their names, for look-up.
    by_name: Vec<u32>,
    tags: Vec<(u32, Box<str>)>,
}

impl World {
    /// A world at the scene's start.
    ///
    /// # Errors
    /// What [`Plan::resolve`] refuses.
    pub fn new(scene: &Scene) -> Result<World, SceneError> {
        let plan = Plan::resolve(scene)?;
        let mut bodies = load::bodies(scene, plan.origin);
        let movers = Movers::new(&bodies, load::prescriptions(scene, plan.origin));
        for prescription in &movers.prescribed {
            prescription.apply(&mut bodies, 0.0);
        }
        Ok(World {
            broad_phase: BroadPhase::new(plan.broad_phase),
            plan,
            bodies,
            movers,
            pushes: Vec::new(),
            listed: Vec::with_capacity(scene.bodies.len() / 2 + 16),
            treated: 0,
            iteration: 0,
            advances: 0,
            collisions: 0,
            fault: None,
            work: Work::default(),
            directory: Directory::new(scene),
        })
    }

    /// What is modelled, and how.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The body that left the finite numbers, once one has; no step is made after that.
    #[must_use]
    pub fn fault(&self) -> Option<&Fault> {
        self.fault.as_ref()
    }

    /// Iterations finished.
    #[must_use]
    pub fn iteration(&self) -> u64 {
        self.iteration
    }

    /// The time at which the bodies stand where they stand \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.advances as f64 * self.plan.time_step
    }

    /// Exchanges so far.
    #[must_use]
    pub fn collisions(&self) -> u64 {
        self.collisions
    }

    /// Counted work so far.
    #[must_use]
    pub fn work(&self) -> &Work {
        &self.work
    }
}

/// Reading bodies.
impl World {
    /// How many bodies there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// All bodies in order of creation.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = BodyId> + use<> {
        (0..self.bodies.len() as u32).map(BodyId)
    }

    /// The body of that name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<BodyId> {
        self.directory.find(name).map(BodyId)
    }

    /// Its name.
    #[must_use]
    pub fn name(&self, id: BodyId) -> &str {
        &self.directory.names[id.index()]
    }

    /// Its labels.
    pub fn tags(&self, id: BodyId) -> impl Iterator<Item = &str> {
        self.directory.tags.iter().filter(move |(body, _)| *body == id.0).map(|(_, tag)| &**tag)
    }

    /// The bodies with that label, in order of creation.
    #[must_use]
    pub fn tagged(&self, tag: &str) -> Vec<BodyId> {
        let mut with_tag: Vec<BodyId> =
            self.directory.tags.iter().filter(|(_, t)| &**t == tag).map(|(body, _)| BodyId(*body)).collect();
        with_tag.dedup();
        with_tag
    }

    /// Mobile or fixed.
    #[must_use]
    pub fn kind(&self, id: BodyId) -> Kind {
        if self.bodies.is_mobile(id.index()) { Kind::Mobile } else { Kind::Fixed }
    }

    /// Whether it takes part in collisions: it crosses the plane.
    #[must_use]
    pub fn is_collidable(&self, id: BodyId) -> bool {
        !self.bodies.rects_of(id.index()).is_empty()
    }

    /// Its mass \[kg\].
    #[must_use]
    pub fn mass(&self, id: BodyId) -> f64 {
        self.bodies.inertia[id.index()].mass
    }

    /// Its moment of inertia about O \[kg·m²\].
    #[must_use]
    pub fn inertia(&self, id: BodyId) -> f64 {
        self.bodies.inertia[id.index()].moment
    }

    /// Where its centre O is \[m\].
    #[must_use]
    pub fn position(&self, id: BodyId) -> Vec2 {
        self.bodies.frame[id.index()].o + self.plan.origin
    }

    /// Its angle \[rad\], in (−π, π].
    #[must_use]
    pub fn angle(&self, id: BodyId) -> f64 {
        self.bodies.angle[id.index()].value
    }

    /// Velocity of its centre \[m/s\].
    #[must_use]
    pub fn velocity(&self, id: BodyId) -> Vec2 {
        self.bodies.motion[id.index()].v
    }

    /// Its spin \[rad/s\].
    #[must_use]
    pub fn spin(&self, id: BodyId) -> f64 {
        self.bodies.motion[id.index()].omega
    }

    /// Deepest overlap of any pair that can collide, now \[m\], by separating axes: also of a pair the vertex
    /// test does not see. 0 when nothing overlaps.
    #[must_use]
    pub fn deepest(&self) -> f64 {
        let mut broad_phase = BroadPhase::new(self.plan.broad_phase);
        let mut deepest: f64 = 0.0;
        broad_phase.visit(&self.bodies, &mut Work::default(), |i, j, _| {
            deepest = deepest.max(overlap::between(&self.bodies, i, j));
        });
        deepest
    }
}

/// Commands: what a user of the world may do between iterations, or after an exchange.
impl World {
    /// Puts a body's centre somewhere.
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn set_position(&mut self, id: BodyId, position: Vec2) -> Result<(), CommandError> {
        self.finite(id, "x", position.x)?;
        self.finite(id, "z", position.y)?;
        self.bodies.place(id.index(), position - self.plan.origin);
        Ok(())
    }

    /// Turns a body to an angle \[rad\].
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn set_angle(&mut self, id: BodyId, angle: f64) -> Result<(), CommandError> {
        self.finite(id, "angle", angle)?;
        self.bodies.set_angle(id.index(), angle);
        Ok(())
    }

    /// Gives a body a velocity \[m/s\]; a fixed body has physics from then on (R9), and its patrol ends.
    ///
    /// # Errors
    /// A component that is not finite.
    pub fn set_velocity(&mut self, id: BodyId, velocity: Vec2) -> Result<(), CommandError> {
        self.finite(id, "vx", velocity.x)?;
        self.finite(id, "vz", velocity.y)?;
        self.bodies.motion[id.index()].v = velocity;
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
        self.bodies.motion[id.index()] = Motion { omega: spin, ..self.bodies.motion[id.index()] };
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

    fn finite(&self, id: BodyId, what: &str, value: f64) -> Result<(), CommandError> {
        let named = |number| CommandError::Number { body: self.name(id).to_owned(), number };
        check::finite(what, value).map(|_| ()).map_err(named)
    }

    fn give_physics(&mut self, id: BodyId) {
        if self.bodies.role[id.index()] == Role::Fixed {
            self.bodies.role[id.index()] = Role::FixedWithPhysics;
            self.movers.add_fixed(id.0);
        }
    }
}

impl Directory {
    fn new(scene: &Scene) -> Self {
        let names: Vec<Box<str>> = scene.bodies.iter().map(|body| body.name.as_str().into()).collect();
        let mut by_name: Vec<u32> = (0..names.len() as u32).collect();
        by_name.sort_unstable_by(|a, b| names[*a as usize].cmp(&names[*b as usize]));
        let tags = scene.bodies.iter().enumerate();
        let tags = tags.flat_map(|(i, body)| body.tags.iter().map(move |tag| (i as u32, tag.as_str().into())));
        Directory { tags: tags.collect(), names, by_name }
    }

    fn find(&self, name: &str) -> Option<u32> {
        let at = self.by_name.binary_search_by(|i| (*self.names[*i as usize]).cmp(name)).ok()?;
        Some(self.by_name[at])
    }
}
