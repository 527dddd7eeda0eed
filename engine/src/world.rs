//! A running world: the bodies of a scene, where they stand and how they move.

use std::borrow::Cow;

use crate::advance::Movers;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::broad_phase::BroadPhase;
use crate::contact::Contacts;
use crate::continuous::Continuous;
use crate::detect::seams::Seams;
use crate::detect::sides::Sides;
use crate::directory::Directory;
use crate::error::{Fault, SceneError};
use crate::ledger::Ledger;
use crate::load;
use crate::plan::{ExchangePlan, MotionPlan, Plan};
use crate::push::Push;
use crate::scene::{Detection, Kind, Scene};
use crate::threads::Threads;
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
    /// The bodies that commands wrote to since the last iteration began, once that is asked for.
    pub(crate) commanded: Option<Vec<BodyId>>,
    /// From which side overlaps came about.
    pub(crate) sides: Sides,
    /// Pairs listed as overlapping in this iteration, in order, and how many of them have been treated.
    pub(crate) listed: Vec<(u32, u32)>,
    pub(crate) treated: usize,
    /// Iterations finished, and advances made: they differ within an iteration.
    pub(crate) iteration: u64,
    pub(crate) advances: u64,
    pub(crate) collisions: u64,
    pub(crate) fault: Option<Fault>,
    pub(crate) work: Work,
    /// What continuous motion keeps; a stepped world has none.
    pub(crate) continuous: Option<Box<Continuous>>,
    /// What the contact solver keeps, where the plan has one.
    pub(crate) contacts: Option<Box<Contacts>>,
    /// The books, once they are asked for.
    pub(crate) ledger: Option<Box<Ledger>>,
    pub(crate) directory: Directory,
    /// Threads an iteration may be shared by, at least 1; no result depends on it.
    pub(crate) threads: Threads,
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
        if plan.detection == Detection::Complete {
            bodies.seams = Seams::of(&bodies);
        }
        let continuous = match plan.motion {
            MotionPlan::Stepped => None,
            MotionPlan::Continuous { middling } => {
                Some(Box::new(Continuous::new(middling, plan.exchange == ExchangePlan::Impulse, bodies.len())))
            }
        };
        let contacts = plan.contact.map(|contact| Box::new(Contacts::new(contact, plan.flight, &bodies)));
        Ok(World {
            continuous,
            contacts,
            ledger: None,
            broad_phase: BroadPhase::new(plan.broad_phase),
            plan,
            bodies,
            movers,
            pushes: Vec::new(),
            commanded: None,
            sides: Sides::default(),
            listed: Vec::with_capacity(scene.bodies.len() / 2 + 16),
            treated: 0,
            iteration: 0,
            advances: 0,
            collisions: 0,
            fault: None,
            work: Work::default(),
            directory: Directory::new(scene),
            threads: Threads::new(1),
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
        let elapsed = self.continuous.as_ref().map_or(0.0, |state| state.elapsed());
        self.advances as f64 * self.plan.time_step + elapsed
    }

    /// Exchanges so far.
    #[must_use]
    pub fn collisions(&self) -> u64 {
        self.collisions
    }

    /// Threads an iteration may be shared by: 1 unless [`set_threads`](Self::set_threads) says otherwise.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.threads.count()
    }

    /// Lets an iteration be shared by up to so many threads, 64 at most; 0 counts as 1. Results have the same bits at any number.
    pub fn set_threads(&mut self, threads: usize) {
        if threads.max(1) != self.threads.count() {
            self.threads = Threads::new(threads);
        }
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
        self.directory.name(id.0)
    }

    /// Its labels.
    pub fn tags(&self, id: BodyId) -> impl Iterator<Item = &str> {
        self.directory.tags_of(id.0)
    }

    /// The bodies with that label, in order of creation.
    #[must_use]
    pub fn tagged(&self, tag: &str) -> Vec<BodyId> {
        self.directory.tagged(tag).map(BodyId).collect()
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
    #[inline]
    #[must_use]
    pub fn position(&self, id: BodyId) -> Vec2 {
        let frame = self.path_now(id.index()).map_or(self.bodies.frame[id.index()], |path| path.frame);
        frame.o + self.plan.origin
    }

    /// Its angle \[rad\], in (−π, π].
    #[inline]
    #[must_use]
    pub fn angle(&self, id: BodyId) -> f64 {
        match self.path_now(id.index()) {
            Some(path) => libm::atan2(path.frame.sin, path.frame.cos),
            None => self.bodies.angle[id.index()].value,
        }
    }

    /// Velocity of its centre \[m/s\].
    #[inline]
    #[must_use]
    pub fn velocity(&self, id: BodyId) -> Vec2 {
        self.motion_now(id.index()).v
    }

    /// Its spin \[rad/s\].
    #[inline]
    #[must_use]
    pub fn spin(&self, id: BodyId) -> f64 {
        self.motion_now(id.index()).omega
    }

    /// How a body moves now, also while an iteration is under way.
    #[inline]
    pub(crate) fn motion_now(&self, body: usize) -> Motion {
        self.path_now(body).map_or(self.bodies.motion[body], |path| path.motion)
    }

    /// All bodies as they are now, also while an iteration is under way.
    pub(crate) fn bodies_now(&self) -> Cow<'_, Bodies> {
        if self.path_now(0).is_none() {
            return Cow::Borrowed(&self.bodies);
        }
        let mut bodies = self.bodies.clone();
        for (body, path) in (0..bodies.len()).filter_map(|body| Some((body, self.path_now(body)?))) {
            bodies.frame[body] = path.frame;
            bodies.motion[body] = path.motion;
        }
        Cow::Owned(bodies)
    }
}
