//! A point that presses alone, between bodies that touch no other: push and friction together, exactly.
//!
//! Sweeps take the one after the other. Where friction is at its limit and turns the body so that the push grows or shrinks, they may
//! go to and fro for ever between two wrong answers, and a push that parts too fast makes energy.
//!
//! ```text
//!   u = q + k p + t g      what parts, of which is asked u ≥ asked    (p ≥ 0)
//!   s = r + t p + f g      what slips: g holds it, or |g| = μ p is against it
//! ```

use super::Contacts;
use super::arms::Arms;
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, SPIN, VX, VZ};

/// What a point parts and slips by more than it should were nothing pushed, and how that answers pushes and friction.
struct Alone {
    parts: f64,
    slips: f64,
    to_push: f64,
    across: f64,
    to_grip: f64,
    friction: f64,
}

impl Alone {
    /// Push and friction; none where bodies jam.
    fn solve(&self) -> Option<(f64, f64)> {
        let &Alone { parts: q, slips: r, to_push: k, across: t, to_grip: f, friction } = self;
        let determinant = k * f - t * t;
        let (push, grip) = ((r * t - q * f) / determinant, (q * t - r * k) / determinant);
        if push >= 0.0 && grip.abs() <= friction * push {
            return Some((push, grip));
        }
        let first = if grip >= 0.0 { friction } else { -friction };
        let slides = [first, -first].into_iter().find_map(|limit| {
            let stiff = k + limit * t;
            let push = -q / stiff;
            let slip = r + t * push + f * limit * push;
            (stiff > 0.0 && push >= 0.0 && slip * limit <= 0.0).then_some((push, limit * push))
        });
        slides.or((q >= 0.0).then_some((0.0, 0.0)))
    }
}

impl Contacts {
    /// Solves the lonely touches of which one point presses.
    pub(super) fn slide(&mut self) {
        for at in 0..self.lonely.len() {
            let k = self.lonely[at] as usize;
            if self.is_lonely(k) {
                self.slide_one(k);
            }
        }
    }

    fn slide_one(&mut self, k: usize) {
        let ([one, two], grip) = self.blocks.pushes(k);
        let Some((block, lane)) = self.blocks.lane(k).filter(|_| (one > 0.0) != (two > 0.0)) else { return };
        let p = usize::from(two > 0.0);
        let slips_on =
            self.blocks.turned.get(self.blocks.place[k].0 as usize).map_or(0.0, |turned| turned.slips.0[lane]);
        let (rows, (row_a, row_b)) = (&mut self.rows.rows, self.of_touch[k]);
        let (a, b) = (rows[row_a as usize].0, rows[row_b as usize].0);
        let arms = Arms::in_lane(block, lane, &a, &b);
        let levers = |p: usize| [arms.lever_a[p], arms.lever_b[p]];
        let ([lever_a, lever_b], Arms { along_a, along_b, .. }) = (levers(p), &arms);
        let (nx, nz) = (block.nx.0[lane], block.nz.0[lane]);
        let (ux, uz) = (b[VX] - a[VX], b[VZ] - a[VZ]);
        let [turn_a, turn_b] = [a[INVERSE_MOMENT], b[INVERSE_MOMENT]];
        let mass = a[INVERSE_MASS] + b[INVERSE_MASS];
        let to_push = mass + turn_a * lever_a * lever_a + turn_b * lever_b * lever_b;
        let across = turn_a * lever_a * along_a + turn_b * lever_b * along_b;
        let to_grip = mass + turn_a * along_a * along_a + turn_b * along_b * along_b;
        let push = one + two;
        let parts = |[lever_a, lever_b]: [f64; 2]| nx * ux + nz * uz + lever_b * b[SPIN] - lever_a * a[SPIN];
        let slips = nz * ux - nx * uz + along_b * b[SPIN] - along_a * a[SPIN];
        let alone = Alone {
            parts: parts([lever_a, lever_b]) - block.asked[p].0[lane] - (to_push * push + across * grip),
            slips: slips - slips_on - (across * push + to_grip * grip),
            to_push,
            across,
            to_grip,
            friction: block.friction.0[lane],
        };
        let Some((now, holds)) = alone.solve() else { return };
        let (dp, dg) = (now - push, holds - grip);
        // The other point is not to come nearer than it asks for.
        let [other_a, other_b] = levers(1 - p);
        let more = (mass + turn_a * lever_a * other_a + turn_b * lever_b * other_b) * dp
            + (turn_a * along_a * other_a + turn_b * along_b * other_b) * dg;
        if parts([other_a, other_b]) + more < block.asked[1 - p].0[lane] {
            return;
        }
        let (x, z) = (nx * dp + nz * dg, nz * dp - nx * dg);
        for (row, sign, twist) in
            [(row_a, -1.0, lever_a * dp + along_a * dg), (row_b, 1.0, lever_b * dp + along_b * dg)]
        {
            let row = &mut rows[row as usize].0;
            row[VX] += sign * row[INVERSE_MASS] * x;
            row[VZ] += sign * row[INVERSE_MASS] * z;
            row[SPIN] += sign * row[INVERSE_MOMENT] * twist;
        }
        self.blocks.set_pushes(k, p, now, holds);
    }
}
