//! The document's exchange (§2.5), in its own letters.
//!
//! ```text
//!      1                         r1, r2   from each centre to the point of collision P
//!      O1 ──r1──> P <──r2── O2   d = r/‖r‖,  d⊥ = perp(d)
//!                          2     v′ = (v·d) d  along the arm,  v″ = (v·d⊥) d⊥  across it
//! ```
//!
//! What goes along the arm is handed over, what goes across is kept; μ_L and μ_A are the shares handed on.

use super::PairKind;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::frame::perp;
use crate::relocate::Placed;

/// The coefficients of loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// μ_L: share of linear momentum handed over.
    pub mu_l: f64,
    /// μ_A: share of angular momentum handed over.
    pub mu_a: f64,
}

/// One body as the exchange sees it, with the values from before the impact.
struct Party {
    v: Vec2,
    omega: f64,
    /// ‖r‖.
    arm: f64,
    /// d.
    d: Vec2,
    /// d⊥.
    d_perp: Vec2,
}

impl Party {
    /// `None` when the point of collision is the body's centre: then there is no direction to hand along (R6).
    fn new(motion: Motion, r: Vec2) -> Option<Self> {
        let arm = (r.x * r.x + r.y * r.y).sqrt();
        let d = r / arm;
        (arm > 0.0).then_some(Party { v: motion.v, omega: motion.omega, arm, d, d_perp: perp(d) })
    }

    /// v′: the part of v along the arm.
    fn v_along(&self) -> Vec2 {
        self.d * self.v.dot(&self.d)
    }

    /// v″: the part of v across the arm.
    fn v_across(&self) -> Vec2 {
        self.d_perp * self.v.dot(&self.d_perp)
    }
}

/// Exchanges motion between the two bodies of a contact; `None` when an arm is zero and nothing happens.
pub fn exchange(bodies: &mut Bodies, placed: &Placed, losses: Losses) -> Option<PairKind> {
    let meeting = Meeting::of(bodies, placed);
    let [one, two] = meeting.outcome(meeting.motions(bodies), losses)?;
    bodies.motion[meeting.one.0] = one;
    bodies.motion[meeting.two.0] = two;
    Some(meeting.kind)
}

/// How many motions [`stages`] tells of.
pub(crate) const STAGES: usize = 5;

/// The exchange in steps that each add one thing: the motions before; with nothing lost and the fixed body, if there is one,
/// taken to be at rest; with its motion; with μ_L; with μ_A, which is what [`exchange`] does. With the two bodies, in the
/// order of the motions. `None` when an arm is zero.
pub(crate) fn stages(bodies: &Bodies, placed: &Placed, losses: Losses) -> Option<([usize; 2], [[Motion; 2]; STAGES])> {
    let meeting = Meeting::of(bodies, placed);
    let before = meeting.motions(bodies);
    let still = if meeting.kind == PairKind::FixedWithPhysics { [Motion::default(), before[1]] } else { before };
    let nothing_lost = Losses { mu_l: 1.0, mu_a: 1.0 };
    let of_rule = meeting.outcome(still, nothing_lost)?;
    let with_motion = meeting.outcome(before, nothing_lost)?;
    let with_mu_l = meeting.outcome(before, Losses { mu_a: 1.0, ..losses })?;
    let with_mu_a = meeting.outcome(before, losses)?;
    Some(([meeting.one.0, meeting.two.0], [before, of_rule, with_motion, with_mu_l, with_mu_a]))
}

/// Two bodies at a point of collision, each with its arm.
struct Meeting {
    one: (usize, Vec2),
    two: (usize, Vec2),
    kind: PairKind,
    /// m1, m2.
    masses: (f64, f64),
}

impl Meeting {
    fn of(bodies: &Bodies, placed: &Placed) -> Self {
        // Reading R7 wants the fixed body, where there is one, as body 1.
        let (one, two) = if bodies.is_mobile(placed.owner) {
            ((placed.reference, placed.r_reference), (placed.owner, placed.r_owner))
        } else {
            ((placed.owner, placed.r_owner), (placed.reference, placed.r_reference))
        };
        let kind = PairKind::of(bodies.role[one.0], bodies.role[two.0]);
        Meeting { one, two, kind, masses: (bodies.inertia[one.0].mass, bodies.inertia[two.0].mass) }
    }

    fn motions(&self, bodies: &Bodies) -> [Motion; 2] {
        [bodies.motion[self.one.0], bodies.motion[self.two.0]]
    }

    /// The motions after the exchange; a fixed body keeps its own.
    fn outcome(&self, before: [Motion; 2], losses: Losses) -> Option<[Motion; 2]> {
        let party1 = Party::new(before[0], self.one.1)?;
        let party2 = Party::new(before[1], self.two.1)?;
        Some(match self.kind {
            PairKind::Mobile => {
                let (m1, m2) = self.masses;
                [
                    after(&party1, handed_over(&party2, &party1, m2 / m1, losses)),
                    after(&party2, handed_over(&party1, &party2, m1 / m2, losses)),
                ]
            }
            PairKind::FixedWithPhysics => {
                [before[0], after(&party2, handed_over(&party1, &party2, INFINITE_OVER_FINITE, losses))]
            }
            PairKind::Fixed => [before[0], Motion { v: party2.v_across(), omega: -party2.omega }],
        })
    }
}

/// m1/m2 of a body of infinite mass (reading R7): the one finite choice that goes over into §2.5.3.
const INFINITE_OVER_FINITE: f64 = 1.0;

/// What body 1 hands to body 2: (v1→v2 + ω1→v2, v1→ω2 + ω1→ω2), with `ratio` = m1/m2.
fn handed_over(one: &Party, two: &Party, ratio: f64, Losses { mu_l, mu_a }: Losses) -> Motion {
    let v1 = one.v_along();
    // (m1 ω1 ‖r1‖ d1⊥)/m2, of which the parts along d2 and d2⊥ are handed on
    let w1 = one.d_perp * (ratio * one.omega * one.arm);

    let v1_v2 = two.d * (mu_l * ratio * v1.dot(&two.d));
    let v1_w2 = mu_a * ratio / two.arm * v1.dot(&two.d_perp);
    let w1_v2 = two.d * (mu_l * w1.dot(&two.d));
    let w1_w2 = mu_a * (w1.dot(&two.d_perp) / one.arm) * two.d_perp.dot(&-one.d_perp);

    Motion { v: v1_v2 + w1_v2, omega: v1_w2 + w1_w2 }
}

/// v2 ← v2″ + what was handed over; ω2 ← what was handed over.
fn after(two: &Party, given: Motion) -> Motion {
    Motion { v: two.v_across() + given.v, omega: given.omega }
}
