//! What scripts hold in their hands: a body, the world, its ledger, a hit.

/// A body, by its order of creation; while the scene is built and while it runs alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Body {
    pub(crate) index: u32,
}

/// The world of the session.
#[derive(Clone, Copy, Debug)]
pub(crate) struct World;

/// The ledger of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ledger;

/// What the ledger has on one quantity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Account {
    /// Its place among the quantities.
    pub(crate) quantity: usize,
}

/// One exchange, as `on_collision` gets it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) a: Body,
    pub(crate) b: Body,
    pub(crate) x: f64,
    pub(crate) z: f64,
    pub(crate) depth: f64,
    pub(crate) iteration: u64,
}

impl From<choque_engine::Hit> for Hit {
    fn from(hit: choque_engine::Hit) -> Self {
        let body = |id: choque_engine::BodyId| Body { index: id.index() as u32 };
        Hit {
            a: body(hit.a),
            b: body(hit.b),
            x: hit.point.x,
            z: hit.point.y,
            depth: hit.depth,
            iteration: hit.iteration,
        }
    }
}
