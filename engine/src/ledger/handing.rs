//! The document's relocation and exchange in the books.

use super::Ledger;
use super::amounts::{Booked, Cause, State, change_at, cross};
use super::wide::Sums;
use crate::area::Vec2;
use crate::bodies::{Bodies, Motion};
use crate::exchange::document::{Losses, STAGES, stages};
use crate::relocate::Placed;

/// What each stage of the exchange adds to the one before ([`stages`]).
const CAUSES: [Cause; STAGES - 1] = [Cause::Exchange, Cause::FixedBodies, Cause::MuL, Cause::MuA];

/// One pair as it is treated: where the body that is moved stood, and what the exchange will do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Handing {
    /// The body that was relocated, from where to where, and how far \[m\].
    moved: usize,
    from: Vec2,
    to: Vec2,
    distance: f64,
    pair: [usize; 2],
    start: [Motion; 2],
    /// The motions stage by stage; `None` when nothing is exchanged.
    stages: Option<[[Motion; 2]; STAGES]>,
}

impl Handing {
    /// A pair that was placed and is about to exchange; `moved` stood at `from`.
    pub(crate) fn new(
        bodies: &Bodies,
        placed: &Placed,
        (moved, from, distance): (usize, Vec2, f64),
        losses: Losses,
    ) -> Self {
        let stages = stages(bodies, placed, losses);
        let pair = stages.map_or([placed.reference, placed.owner], |(pair, _)| pair);
        Handing {
            moved,
            from,
            to: bodies.frame[moved].o,
            distance,
            pair,
            start: pair.map(|body| bodies.motion[body]),
            stages: stages.map(|(_, stages)| stages),
        }
    }

    /// Which of the two a body is, if one.
    fn place_of(&self, body: usize) -> Option<usize> {
        self.pair.iter().position(|known| *known == body)
    }
}

impl Ledger {
    /// Books pairs treated at one instant, each from the motions before it; those that exchanged are entered, in order.
    pub(crate) fn book_handings(&mut self, bodies: &Bodies, handings: &[Handing]) {
        let parts = handings.iter().map(|handing| self.of_handing(bodies, handings, handing));
        let mut all: Vec<Booked> = parts.collect();
        let mut rest = whole_change(self, bodies, handings);
        for (handing, booked) in handings.iter().zip(&all) {
            Cause::ALL.iter().for_each(|cause| rest.take(booked[*cause]));
            self.book_all(booked);
            self.relocated.add(handing.distance);
            self.relocations += 1;
        }
        let exchanged = handings.iter().position(|handing| handing.stages.is_some());
        self.book_rest(if exchanged.is_some() { Cause::Exchange } else { Cause::Relocation }, &rest);
        if let Some(first) = exchanged {
            all[first][Cause::Exchange] += rest.value();
        }
        for (handing, booked) in handings.iter().zip(all).filter(|(handing, _)| handing.stages.is_some()) {
            self.enter(booked, handing.distance);
        }
    }

    /// What one pair changed. Relocation comes first, with the motions from before; then stage by stage, each seen with
    /// what the others of the instant have done by then.
    fn of_handing(&self, bodies: &Bodies, all: &[Handing], handing: &Handing) -> Booked {
        let mut booked = Booked::default();
        if let Some(which) = handing.place_of(handing.moved) {
            let (mass, v) = (bodies.inertia[handing.moved].mass, handing.start[which].v);
            booked[Cause::Relocation].angular_momentum = mass * cross(handing.to - handing.from, v);
        }
        let Some(stages) = handing.stages else { return booked };
        for (k, cause) in CAUSES.into_iter().enumerate() {
            for (which, body) in handing.pair.into_iter().enumerate().filter(|(_, body)| bodies.is_mobile(*body)) {
                let (from, to) = (stages[k][which], stages[k + 1][which]);
                if from == to {
                    continue;
                }
                let (half_v, half_omega) = ((to.v - from.v) * 0.5, (to.omega - from.omega) * 0.5);
                let mean = mean_at(all, body, k, handing.start[which]);
                let about = |sign: f64| Motion { v: mean.v + half_v * sign, omega: mean.omega + half_omega * sign };
                let o = self.state(bodies, body).o;
                booked[cause] += change_at(bodies.inertia[body], o, about(-1.0), about(1.0));
            }
        }
        booked
    }
}

/// A body's motion halfway through a stage, all pairs together.
fn mean_at(all: &[Handing], body: usize, k: usize, start: Motion) -> Motion {
    let mut mean = start;
    for handing in all {
        if let (Some(stages), Some(which)) = (&handing.stages, handing.place_of(body)) {
            let (from, to) = (stages[k][which], stages[k + 1][which]);
            mean.v += (from.v - start.v + (to.v - start.v)) * 0.5;
            mean.omega += (from.omega - start.omega + (to.omega - start.omega)) * 0.5;
        }
    }
    mean
}

/// What all pairs together changed: every mobile body once, from where it stood before to where it stands.
fn whole_change(ledger: &Ledger, bodies: &Bodies, handings: &[Handing]) -> Sums {
    let mut sum = Sums::default();
    for (k, handing) in handings.iter().enumerate() {
        for (which, body) in handing.pair.into_iter().enumerate().filter(|(_, body)| bodies.is_mobile(*body)) {
            if handings[..k].iter().any(|earlier| earlier.place_of(body).is_some()) {
                continue;
            }
            let now = ledger.state(bodies, body);
            let stood = handings.iter().find(|handing| handing.moved == body).map_or(now.o, |h| h.from + ledger.origin);
            let before = State { o: stood, motion: handing.start[which] };
            sum.add_all(&Sums::of_change(bodies.inertia[body], before, now));
        }
    }
    sum
}
