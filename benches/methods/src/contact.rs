//! A contact: what it knows of the step, and the smallest problem it can solve alone.

use choque_engine::area::Vec2;

use crate::world::{Body, World, cross, perp, rotated};

/// A blow within a sub-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// Seconds after its beginning.
    pub(crate) after: f64,
    /// Whether the point leaves again before its end.
    pub(crate) bounces: bool,
}

/// One of the one or two points of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// From both centres to the middle between the two surfaces, when the contact was found.
    pub(crate) arms: [Vec2; 2],
    /// The first arm as the body sees it: by this a point is known again in the next step.
    local: Vec2,
    /// Distance when the contact was found, m; negative in an overlap.
    pub(crate) found: f64,
    /// Distance now.
    pub(crate) gap: f64,
    /// Normal impulse, N s.
    pub(crate) p: f64,
    /// Tangential impulse, N s, for methods with friction at each point.
    pub(crate) p_t: f64,
    /// Normal velocity the point is to have at least, m/s.
    pub(crate) wanted: f64,
    /// When during the sub-step it is hit, s, and whether it bounces; for methods that know.
    pub(crate) hit: Option<Hit>,
    /// Stiffness of the normal and the tangential row, N/m, for methods with such.
    pub(crate) stiffness: [f64; 2],
}

impl Point {
    pub(crate) fn new(arm_i: Vec2, arm_j: Vec2, local: Vec2, gap: f64) -> Point {
        Point {
            arms: [arm_i, arm_j],
            local,
            found: gap,
            gap,
            p: 0.0,
            p_t: 0.0,
            wanted: 0.0,
            hit: None,
            stiffness: [0.0; 2],
        }
    }
}

/// Two rectangles that touch, or may soon.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    pub(crate) i: usize,
    pub(crate) j: usize,
    /// From i to j.
    pub(crate) n: Vec2,
    pub(crate) points: Vec<Point>,
    /// From both centres to where friction acts.
    pub(crate) middle: [Vec2; 2],
    /// Tangential impulse, N s, for methods with friction once per contact.
    pub(crate) p_t: f64,
    /// Normal response of both points, and the tangential one in the middle: velocity per impulse.
    pub(crate) k: Block,
    pub(crate) k_t: f64,
}

/// A symmetric matrix of two rows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Block {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
}

impl Block {
    /// Impulses of one or two points from given ones and what velocity they lack: none pulls, and what pushes lacks nothing.
    pub(crate) fn improved(self, given: [f64; 2], lacks: [f64; 2], points: usize) -> [f64; 2] {
        if points == 1 {
            return [(given[0] - lacks[0] / self.a).max(0.0), 0.0];
        }
        let first = lacks[0] - self.a * given[0] - self.b * given[1];
        self.complementary([first, lacks[1] - self.b * given[0] - self.c * given[1]])
    }

    /// p ≥ 0 with K p + q ≥ 0, and one of the two 0 in each row.
    fn complementary(self, q: [f64; 2]) -> [f64; 2] {
        let Block { a, b, c } = self;
        let det = a * c - b * b;
        // Two points in one place are one.
        if det > 1e-9 * a * c {
            let both = [(b * q[1] - c * q[0]) / det, (b * q[0] - a * q[1]) / det];
            if both[0] >= 0.0 && both[1] >= 0.0 {
                return both;
            }
        }
        let (one, two) = ((-q[0] / a).max(0.0), (-q[1] / c).max(0.0));
        if b * one + q[1] >= 0.0 && one > 0.0 {
            [one, 0.0]
        } else if b * two + q[0] >= 0.0 && two > 0.0 {
            [0.0, two]
        } else {
            [0.0, 0.0]
        }
    }
}

impl Contact {
    pub(crate) fn new(world: &World, (i, j): (usize, usize), n: Vec2, points: &[Point]) -> Contact {
        let share = 1.0 / points.len() as f64;
        let middle = [0, 1].map(|side| points.iter().fold(Vec2::zeros(), |sum, point| sum + point.arms[side]) * share);
        let points = points.to_vec();
        let mut contact = Contact { i, j, n, points, middle, p_t: 0.0, k: Block::default(), k_t: 0.0 };
        (contact.k, contact.k_t) = contact.responses(world, [1.0, 1.0]);
        contact
    }

    /// Takes over what the same pair had in the last step, unless it has turned.
    pub(crate) fn inherit(&mut self, old: &Contact) {
        if self.n.dot(&old.n) < 0.9 {
            return;
        }
        self.p_t = old.p_t;
        let several = self.points.len() > 1;
        for point in &mut self.points {
            let distance = |was: &&Point| (was.local - point.local).norm_squared();
            let near = old.points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(was) = near.filter(|_| several == (old.points.len() > 1)) {
                (point.p, point.p_t, point.stiffness) = (was.p, was.p_t, was.stiffness);
            }
        }
    }

    /// Responses when the two bodies' masses count by 1/shares.
    pub(crate) fn responses(&self, world: &World, shares: [f64; 2]) -> (Block, f64) {
        let along = |arms: [Vec2; 2], a: Vec2, others: [Vec2; 2], b: Vec2| {
            let of = |side: usize, body: &Body| {
                let turning = cross(arms[side], a) * cross(others[side], b) * body.inverse_inertia;
                shares[side] * (a.dot(&b) * body.inverse_mass + turning)
            };
            of(0, &world.bodies[self.i]) + of(1, &world.bodies[self.j])
        };
        let (first, last) = (self.points[0].arms, self.points[self.points.len() - 1].arms);
        let (n, t) = (self.n, perp(self.n));
        let k = Block { a: along(first, n, first, n), b: along(first, n, last, n), c: along(last, n, last, n) };
        (k, along(self.middle, t, self.middle, t))
    }

    /// How fast j moves against i at a point.
    pub(crate) fn velocity(&self, bodies: &[Body], arms: [Vec2; 2]) -> Vec2 {
        bodies[self.j].velocity_at(arms[1]) - bodies[self.i].velocity_at(arms[0])
    }

    /// Pushes the two apart at a point.
    pub(crate) fn push(&self, bodies: &mut [Body], arms: [Vec2; 2], impulse: Vec2) {
        bodies[self.i].push(arms[0], -impulse);
        bodies[self.j].push(arms[1], impulse);
    }

    /// What the gaps are with the bodies where they are now; `start` is where the contact was found.
    pub(crate) fn measure(&mut self, bodies: &[Body], start: &[Body]) {
        let moved = |body: usize, arm: Vec2| {
            let (now, was) = (&bodies[body], &start[body]);
            let turn = rotated(Vec2::new(was.turn.x, -was.turn.y), now.turn);
            now.x - was.x + rotated(turn, arm) - arm
        };
        for point in &mut self.points {
            let apart = moved(self.j, point.arms[1]) - moved(self.i, point.arms[0]);
            point.gap = point.found + apart.dot(&self.n);
        }
    }
}
