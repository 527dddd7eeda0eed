//! A moment of a run: every body, and what happened since the moment before.

use choque_engine::{BodyId, Load, PairKind, World};

/// All of a moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Iterations finished.
    pub iteration: u64,
    /// \[s\].
    pub time: f64,
    /// Over every bit that decides how the run goes on.
    pub digest: u64,
    /// Sums over the scene.
    pub totals: Totals,
    /// Every body, in order of creation.
    pub states: Vec<State>,
    /// The exchanges since the frame before, in order.
    pub hits: Vec<Strike>,
    /// What callbacks did to bodies since the frame before, in order.
    pub commands: Vec<Command>,
    /// The pushes that act over the next advance, as they stood before this frame's own iteration.
    pub pushes: Vec<Push>,
    /// The pairs that this frame's own iteration listed as overlapping, where motion is stepped and contacts do not last.
    pub listed: Vec<[u32; 2]>,
    /// The bodies of those pairs as they stood after the advance, before anything was relocated or exchanged.
    pub advanced: Vec<(u32, State)>,
    /// What contacts that last carry now.
    pub touches: Vec<Touch>,
    /// The ledger as it stands, where one is kept.
    pub books: Option<Books>,
}

impl Frame {
    /// An empty one that has the room of this.
    pub(super) fn emptied(mut self) -> Self {
        self.states.clear();
        self.hits.clear();
        self.commands.clear();
        self.pushes.clear();
        self.listed.clear();
        self.advanced.clear();
        self.touches.clear();
        Frame { books: None, ..self }
    }
}

/// Where a body is and how it moves: metres, radians, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Its centre O.
    pub x: f64,
    /// Its centre O.
    pub z: f64,
    /// In (−π, π].
    pub angle: f64,
    /// Velocity of its centre.
    pub vx: f64,
    /// Velocity of its centre.
    pub vz: f64,
    /// Spin.
    pub spin: f64,
}

impl State {
    /// How many numbers it is.
    pub const COUNT: usize = 6;
    /// Their names, as scripts write them.
    pub const NAMES: [&'static str; State::COUNT] = ["x", "z", "angle", "vx", "vz", "spin"];

    /// A body of a world as it is now.
    #[must_use]
    pub fn of(world: &World, id: BodyId) -> Self {
        let (position, velocity) = (world.position(id), world.velocity(id));
        State {
            x: position.x,
            z: position.y,
            angle: world.angle(id),
            vx: velocity.x,
            vz: velocity.y,
            spin: world.spin(id),
        }
    }

    /// In the order of the names.
    #[must_use]
    pub fn to_array(self) -> [f64; State::COUNT] {
        [self.x, self.z, self.angle, self.vx, self.vz, self.spin]
    }

    /// From numbers in the order of the names.
    #[must_use]
    pub fn from_array([x, z, angle, vx, vz, spin]: [f64; State::COUNT]) -> Self {
        State { x, z, angle, vx, vz, spin }
    }

    /// Whether every bit is the same; of numbers, −0 and 0 count as one.
    #[must_use]
    pub fn is(&self, other: &State) -> bool {
        let bits = |state: &State| state.to_array().map(|number| (number + 0.0).to_bits());
        bits(self) == bits(other)
    }
}

/// Sums over the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Totals {
    /// Of the mobile bodies \[J\].
    pub kinetic_energy: f64,
    /// Of the mobile bodies \[kg·m/s\].
    pub momentum: [f64; 2],
    /// Of the mobile bodies about the world's origin \[kg·m²/s\].
    pub angular_momentum: f64,
    /// Deepest overlap \[m\].
    pub deepest: f64,
}

impl Totals {
    /// Those of a world as it is now, but for the deepest overlap: that has to be searched for.
    #[must_use]
    pub fn of(world: &World, deepest: f64) -> Self {
        let momentum = world.momentum();
        Totals {
            kinetic_energy: world.kinetic_energy(),
            momentum: [momentum.x, momentum.y],
            angular_momentum: world.angular_momentum(),
            deepest,
        }
    }

    pub(super) fn to_array(self) -> [f64; 5] {
        [self.kinetic_energy, self.momentum[0], self.momentum[1], self.angular_momentum, self.deepest]
    }

    pub(super) fn from_array([kinetic_energy, x, z, angular_momentum, deepest]: [f64; 5]) -> Self {
        Totals { kinetic_energy, momentum: [x, z], angular_momentum, deepest }
    }
}

/// An exchange.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strike {
    /// The iteration it belongs to, the first being 0.
    pub iteration: u64,
    /// When \[s\]: within an iteration only where motion is continuous.
    pub time: f64,
    /// The pair, in order of creation.
    pub a: u32,
    /// The later-created of the two.
    pub b: u32,
    /// Which case of the exchange it was.
    pub kind: PairKind,
    /// The point of collision \[m\].
    pub point: [f64; 2],
    /// Outward normal of the face that was hit.
    pub normal: [f64; 2],
    /// How deep the vertex was found \[m\].
    pub depth: f64,
    /// The two right after it. Where contacts last, exchanges are told at the end of an iteration, and so are these.
    pub after: [State; 2],
}

/// A body that a callback wrote to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// The iteration it belongs to, the first being 0.
    pub iteration: u64,
    /// How many of the iteration's exchanges had been made: 0 in `on_step`, else the one that `on_collision` answers.
    pub exchanges: u64,
    /// The body.
    pub body: u32,
    /// The body afterwards.
    pub after: State,
}

/// A push and a twist on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// The body.
    pub body: u32,
    /// \[N\].
    pub force: [f64; 2],
    /// \[N·m\].
    pub torque: f64,
}

/// What a contact that lasts carries, to seven digits: to be looked at, nothing is computed from it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// The two bodies, the earlier created first.
    pub a: u32,
    /// The other.
    pub b: u32,
    /// The face's normal, from a to b.
    pub normal: [f32; 2],
    /// Where they touch, from the centre of a along the world's axes \[m\]; twice the same where only one point does.
    pub points: [[f32; 2]; 2],
    /// The force at each of the points, from a on b along the normal \[N\].
    pub push: [f32; 2],
    /// The force of friction on b, along the normal turned from +Z to +X \[N\].
    pub friction: f32,
}

impl Touch {
    pub(super) const NUMBERS: usize = 9;

    pub(super) fn of(world: &World, load: &Load) -> Self {
        let from = world.position(load.a);
        let near = |x: f64, z: f64| [x as f32, z as f32];
        Touch {
            a: load.a.index() as u32,
            b: load.b.index() as u32,
            normal: near(load.normal.x, load.normal.y),
            points: load.points.map(|point| near(point.x - from.x, point.y - from.y)),
            push: load.push.map(|push| push as f32),
            friction: load.friction as f32,
        }
    }

    /// Where they touch \[m\], when a stands there.
    #[must_use]
    pub fn places(&self, a: &State) -> [[f64; 2]; 2] {
        self.points.map(|[x, z]| [a.x + f64::from(x), a.z + f64::from(z)])
    }

    pub(super) fn numbers(&self) -> [f32; Touch::NUMBERS] {
        let ([n0, n1], [[x0, z0], [x1, z1]], [p0, p1]) = (self.normal, self.points, self.push);
        [n0, n1, x0, z0, x1, z1, p0, p1, self.friction]
    }

    pub(super) fn from_numbers(a: u32, b: u32, numbers: [f32; Touch::NUMBERS]) -> Self {
        let [n0, n1, x0, z0, x1, z1, p0, p1, friction] = numbers;
        Touch { a, b, normal: [n0, n1], points: [[x0, z0], [x1, z1]], push: [p0, p1], friction }
    }
}

/// The ledger as it stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Books {
    /// What each cause changed, by [`About::causes`](super::About::causes) and
    /// [`Amounts::NAMES`](choque_engine::ledger::Amounts::NAMES).
    pub booked: Vec<[f64; 4]>,
    /// How far bodies were relocated in all \[m\].
    pub relocated: f64,
    /// How often.
    pub relocations: u64,
}
