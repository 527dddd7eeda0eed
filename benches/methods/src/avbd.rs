//! Augmented vertex block descent (Giles, Diaz and Yuksel 2025): implicit Euler as a minimum over positions, body after body
//! (three unknowns each), contacts as penalties whose stiffness grows and whose forces are kept (augmented Lagrangian).
//!
//! Gaps are first order in the motion of a step. A contact that does not push, but may, is as stiff as one that does (without, the
//! descent overshoots), and one that slips is as stiff as the line from where it has not slipped. There is no restitution.

use choque_engine::area::Vec2;

use crate::contact::Contact;
use crate::method::{Method, Step};
use crate::world::{Body, World, cross, perp};

/// How much of a violation found at the beginning of a step is left for later ones.
const ALPHA: f64 = 0.95;
/// How much of forces (times α) and stiffness the next step takes over.
const GAMMA: f64 = 0.99;
/// Stiffness gained per metre of violation; these three in units of the pair's reduced mass over dt².
const BETA: f64 = 1000.0;
/// Stiffness at least and at most.
const STIFFNESS: [f64; 2] = [10.0, 1e6];

/// The method.
pub(crate) struct Descent {
    pub(crate) iterations: usize,
}

/// Along one direction at one point: how it moves with both bodies, what it was, what it is to hold.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    /// Change per displacement and turn of i and of j.
    along: [Vec2; 2],
    turning: [f64; 2],
    violation: f64,
    force: f64,
    stiffness: f64,
    /// The pair's reduced mass over dt².
    m: f64,
}

/// Where a body is, against the start of the step.
#[derive(Clone, Copy, Debug)]
struct Shift {
    by: Vec2,
    angle: f64,
}

impl Row {
    fn new(arms: [Vec2; 2], a: Vec2, violation: f64, (force, stiffness): (f64, f64), m: f64) -> Row {
        Row {
            along: [-a, a],
            turning: [-cross(arms[0], a), cross(arms[1], a)],
            violation,
            force: ALPHA * GAMMA * force,
            stiffness: (GAMMA * stiffness).clamp(m * STIFFNESS[0], m * STIFFNESS[1]),
            m,
        }
    }

    fn value(&self, one: Shift, two: Shift) -> f64 {
        let side = |k: usize, shift: Shift| self.along[k].dot(&shift.by) + self.turning[k] * shift.angle;
        self.violation + side(0, one) + side(1, two)
    }

    /// The force that its penalty and what it kept make together.
    fn wanted(&self, one: Shift, two: Shift) -> f64 {
        self.force - self.stiffness * self.value(one, two)
    }
}

impl Method for Descent {
    fn name(&self) -> &'static str {
        "AVBD"
    }

    fn step(&mut self, world: &mut World, contacts: &mut [Contact], dt: f64) -> Step {
        let mut rows = rows(world, contacts, dt);
        let of_body = of_body(world, contacts);
        let inertial: Vec<Shift> = world.bodies.iter().map(|body| inertial(body, world.gravity, dt)).collect();
        // What rests would begin in an overlap, had gravity moved it first.
        let start = |(body, shift): (&Body, &Shift)| Shift { by: body.v * dt, ..*shift };
        let mut shifts: Vec<Shift> = world.bodies.iter().zip(&inertial).map(start).collect();
        for _ in 0..self.iterations {
            for (b, body) in world.bodies.iter().enumerate().filter(|(_, body)| body.is_mobile()) {
                shifts[b] =
                    descended(b, body, &of_body[b], contacts, &rows, &shifts, inertial[b], (world.friction, dt));
            }
            for (contact, rows) in contacts.iter().zip(&mut rows) {
                harden(contact, rows, &shifts, world.friction);
            }
        }
        for (body, shift) in world.bodies.iter_mut().zip(&shifts).filter(|(body, _)| body.is_mobile()) {
            (body.v, body.w) = (shift.by / dt, shift.angle / dt);
            body.shift(shift.by, shift.angle);
        }
        world.turn_fixed(dt);
        for (contact, rows) in contacts.iter_mut().zip(&rows) {
            for (point, [normal, slip]) in contact.points.iter_mut().zip(rows) {
                (point.p, point.p_t) = (normal.force * dt, slip.force * dt);
                point.stiffness = [normal.stiffness, slip.stiffness];
            }
        }
        // A pass over the bodies sees every contact from both sides, and forces once more.
        Step { visits: 3 * self.iterations * contacts.len(), ..Step::default() }
    }
}

/// Normal and tangential rows of both points.
fn rows(world: &World, contacts: &[Contact], dt: f64) -> Vec<[[Row; 2]; 2]> {
    let of = |contact: &Contact| {
        let mut rows = [[Row::default(); 2]; 2];
        let m = 1.0 / ((world.bodies[contact.i].inverse_mass + world.bodies[contact.j].inverse_mass) * dt * dt);
        for (rows, point) in rows.iter_mut().zip(&contact.points) {
            // What overlaps already is to be taken out by and by.
            let violation = if point.found < 0.0 { (1.0 - ALPHA) * point.found } else { point.found };
            let kept = [(point.p / dt, point.stiffness[0]), (point.p_t / dt, point.stiffness[1])];
            rows[0] = Row::new(point.arms, contact.n, violation, kept[0], m);
            rows[1] = Row::new(point.arms, perp(contact.n), 0.0, kept[1], m);
        }
        rows
    };
    contacts.iter().map(of).collect()
}

fn of_body(world: &World, contacts: &[Contact]) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new(); world.bodies.len()];
    for (c, contact) in contacts.iter().enumerate() {
        all[contact.i].push(c);
        all[contact.j].push(c);
    }
    all
}

/// Where the body would be without contacts.
fn inertial(body: &Body, gravity: f64, dt: f64) -> Shift {
    let falls = if body.is_mobile() { gravity * dt * dt } else { 0.0 };
    Shift { by: body.v * dt + Vec2::new(0.0, falls), angle: body.w * dt }
}

/// One Newton step of one body, all others as they are.
#[expect(clippy::too_many_arguments, reason = "one equation")]
fn descended(
    b: usize,
    body: &Body,
    touching: &[usize],
    contacts: &[Contact],
    rows: &[[[Row; 2]; 2]],
    shifts: &[Shift],
    inertial: Shift,
    (friction, dt): (f64, f64),
) -> Shift {
    let (mass, inertia) = (1.0 / (body.inverse_mass * dt * dt), 1.0 / (body.inverse_inertia * dt * dt));
    let now = shifts[b];
    let mut system = System::new(mass, inertia);
    system.pull((inertial.by - now.by) * mass, (inertial.angle - now.angle) * inertia);
    for c in touching {
        let contact = &contacts[*c];
        let side = usize::from(contact.j == b);
        let (one, two) = (shifts[contact.i], shifts[contact.j]);
        for [normal, slip] in rows[*c].iter().take(contact.points.len()) {
            let force = normal.wanted(one, two).max(0.0);
            system.add(normal, side, force, normal.stiffness);
            let (bound, along) = (friction * force, slip.wanted(one, two));
            // What slips is as stiff as the line from where it has not slipped yet.
            let stiffness = if along.abs() <= bound || force == 0.0 {
                slip.stiffness
            } else {
                (bound / slip.value(one, two).abs()).min(slip.stiffness)
            };
            system.add(slip, side, along.clamp(-bound, bound), stiffness);
        }
    }
    let (by, angle) = system.solved();
    Shift { by: now.by + by, angle: now.angle + angle }
}

/// Keeps forces and makes what holds stiffer.
fn harden(contact: &Contact, rows: &mut [[Row; 2]; 2], shifts: &[Shift], friction: f64) {
    let (one, two) = (shifts[contact.i], shifts[contact.j]);
    for [normal, slip] in rows.iter_mut().take(contact.points.len()) {
        let grown = |row: &Row| (row.stiffness + row.m * BETA * row.value(one, two).abs()).min(row.m * STIFFNESS[1]);
        let force = normal.wanted(one, two);
        if force > 0.0 {
            normal.stiffness = grown(normal);
        }
        normal.force = force.max(0.0);
        let (bound, along) = (friction * normal.force, slip.wanted(one, two));
        if along.abs() < bound {
            slip.stiffness = grown(slip);
        }
        slip.force = along.clamp(-bound, bound);
    }
}

/// Three linear equations, symmetric and positive.
struct System {
    m: [[f64; 3]; 3],
    rhs: [f64; 3],
}

impl System {
    fn new(mass: f64, inertia: f64) -> System {
        System { m: [[mass, 0.0, 0.0], [0.0, mass, 0.0], [0.0, 0.0, inertia]], rhs: [0.0; 3] }
    }

    fn pull(&mut self, force: Vec2, torque: f64) {
        self.rhs = [self.rhs[0] + force.x, self.rhs[1] + force.y, self.rhs[2] + torque];
    }

    /// Force and stiffness of a row on one of its bodies.
    fn add(&mut self, row: &Row, side: usize, force: f64, stiffness: f64) {
        let j = [row.along[side].x, row.along[side].y, row.turning[side]];
        for a in 0..3 {
            self.rhs[a] += j[a] * force;
            for b in 0..3 {
                self.m[a][b] += stiffness * j[a] * j[b];
            }
        }
    }

    /// Gauss's elimination; the matrix needs no pivots.
    fn solved(mut self) -> (Vec2, f64) {
        for k in 0..2 {
            for row in k + 1..3 {
                let share = self.m[row][k] / self.m[k][k];
                for column in k..3 {
                    self.m[row][column] -= share * self.m[k][column];
                }
                self.rhs[row] -= share * self.rhs[k];
            }
        }
        let angle = self.rhs[2] / self.m[2][2];
        let y = (self.rhs[1] - self.m[1][2] * angle) / self.m[1][1];
        let x = (self.rhs[0] - self.m[0][1] * y - self.m[0][2] * angle) / self.m[0][0];
        (Vec2::new(x, y), angle)
    }
}
