//! How bodies in contact go on over a sub-step: what acts on them, and where that takes them.

use super::midway::HALF;
use super::pulls::Pulls;
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row, Rows, SPIN, TURN, VX, VZ, X, Z};
use super::touch::Touch;
use crate::area::Vec2;
use crate::bodies::Motion;
use crate::flight::{Path, Pull, turned};
use crate::forces::Flight;
use crate::frame::Frame;
use crate::lanes::LANES;
use crate::threads::{PER_THREAD, Threads};

/// A change of motion within a sub-step no greater than this many times what gravity would do is a force's, and acts all
/// along; a greater one is an impact's, and acts from the start.
pub(super) const FORCEFUL: f64 = 2.0;

/// What a fixed body can pass on of its speed, squared.
const TWICE: f64 = 4.0;

/// What a body in contact remembers over a sub-step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flier {
    /// Its velocity when the sub-step began: vx, vz.
    start: [f64; 2],
    /// Its motion at the end were there no contact.
    pub(super) free: [f64; 3],
    /// How far it would come: x, z, turn.
    way: [f64; 3],
    /// What contact changed in the sub-step before: contacts that last do it again.
    carried: [f64; 3],
}

impl Flier {
    /// Whether what changed its motion to that of its row acted all along the sub-step.
    pub(super) fn is_forced(&self, row: &[f64; LANES], pull: &Pull, h: f64) -> bool {
        let (dx, dz) = (row[VX] - self.start[0], row[VZ] - self.start[1]);
        let pulled = pull.a.norm_squared();
        dx * dx + dz * dz <= FORCEFUL * FORCEFUL * pulled * h * h
    }

    /// What contact changed of its motion.
    pub(super) fn changed(&self, row: &[f64; LANES]) -> [f64; 3] {
        [row[VX] - self.free[0], row[VZ] - self.free[1], row[SPIN] - self.free[2]]
    }

    /// A sub-step begins: gravity, drag and pushes act on the body of that row, which has spent some of it in impacts.
    #[inline]
    fn set_out(&mut self, row: &mut [f64; LANES], body: u32, spent: f64, setting: &Setting) {
        self.start = [row[VX], row[VZ]];
        let (v, omega, left) = (Vec2::new(row[VX], row[VZ]), row[SPIN], setting.h - spent);
        match setting.coefficients {
            None => {
                self.free = [row[VX], row[VZ], row[SPIN]];
                self.way = self.free.map(|v| v * left);
            }
            Some((linear, angular)) => {
                let pull = setting.pulls.on_mobile(body as usize);
                let (linear, angular) = if spent == 0.0 {
                    (*linear, *angular)
                } else {
                    (Flight::new(pull.drag.0, left), Flight::new(pull.drag.1, left))
                };
                let after = v * linear.keep + pull.a * linear.reach;
                let way = v * linear.reach + pull.a * linear.fall;
                self.free = [after.x, after.y, omega * angular.keep + pull.alpha * angular.reach];
                self.way = [way.x, way.y, omega * angular.reach + pull.alpha * angular.fall];
            }
        }
        [row[VX], row[VZ], row[SPIN]] = self.free;
    }

    /// How far it goes in what is left of the sub-step: x, z, turn.
    pub(super) fn goes(&self, row: &[f64; LANES], left: f64, by_force: bool) -> [f64; 3] {
        let share = if by_force { 0.5 * left } else { left };
        let changed = self.changed(row);
        core::array::from_fn(|k| self.way[k] + share * changed[k])
    }
}

/// What acts on bodies over a whole sub-step of length h \[s\]; nothing where there are no coefficients.
struct Setting<'a> {
    pulls: &'a Pulls,
    coefficients: &'a Option<(Flight, Flight)>,
    h: f64,
}

/// All bodies in contact, in the order of their rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Fliers {
    pub(super) fliers: Vec<Flier>,
    /// How much of the sub-step each row has used up in impacts \[s\], and which have any.
    pub(super) spent: Vec<f64>,
    pub(super) spenders: Vec<u32>,
    /// The last round of impacts that changed each row's motion.
    pub(super) stirred: Vec<u32>,
    coefficients: Option<(Flight, Flight)>,
}

impl Fliers {
    /// A step begins: contacts push so many times as hard as they did at the end of the last.
    pub(super) fn begin(&mut self, rows: &Rows, (touches, of_touch): (&[Touch], &[(u32, u32)]), times: f64) {
        self.fliers.clear();
        self.fliers.resize(rows.mobile.len(), Flier::default());
        self.spent.clear();
        self.spent.resize(rows.rows.len(), 0.0);
        self.spenders.clear();
        self.stirred.clear();
        self.stirred.resize(rows.rows.len(), 0);
        self.carry(rows, (touches, of_touch), times);
    }

    /// Over sub-steps of that length something acts on bodies, with these decay rates; nothing does without any.
    pub(super) fn pace(&mut self, drag: Option<(f64, f64)>, h: f64) {
        self.coefficients = drag.map(|drag| (Flight::new(drag.0, h), Flight::new(drag.1, h)));
    }

    /// Contacts push so many times as hard as their touches say.
    pub(super) fn carry(&mut self, rows: &Rows, (touches, of_touch): (&[Touch], &[(u32, u32)]), times: f64) {
        self.fliers.iter_mut().for_each(|flier| flier.carried = [0.0; 3]);
        for (touch, (row_a, row_b)) in touches.iter().zip(of_touch) {
            let sum = touch.push[0] + touch.push[1];
            if sum == 0.0 {
                continue;
            }
            let t = Vec2::new(touch.n.y, -touch.n.x);
            let p = touch.n * sum + t * touch.grip;
            let twist =
                |lever: [f64; 2], along: f64| lever[0] * touch.push[0] + lever[1] * touch.push[1] + along * touch.grip;
            let ends = [
                (*row_a, -1.0, twist(touch.lever_a, touch.along_a)),
                (*row_b, 1.0, twist(touch.lever_b, touch.along_b)),
            ];
            for (row, sign, twist) in ends {
                let Some(k) = rows.mobile_of(row) else { continue };
                let carried = &mut self.fliers[k].carried;
                let (sign, row) = (sign * times, &rows.rows[row as usize].0);
                carried[0] += sign * row[INVERSE_MASS] * p.x;
                carried[1] += sign * row[INVERSE_MASS] * p.y;
                carried[2] += sign * row[INVERSE_MOMENT] * twist;
            }
        }
    }

    /// Whether contact has made more of the motions than it can: it takes energy, but for what fixed bodies give that drive others, at
    /// that square of a speed. Where those give any, they make nothing faster than what they can pass on: a row of bodies between walls
    /// that close is a toggle, and would fling what slips out of it as fast as one likes.
    pub(super) fn gained(&self, rows: &Rows, driven: f64) -> bool {
        let square = |row: &[f64]| row[VX] * row[VX] + row[VZ] * row[VZ];
        let (mut free, mut now, mut fastest_free, mut fastest, mut given) = (0.0, 0.0, 0.0_f64, 0.0_f64, 0.0);
        for (row, flier) in rows.of_mobile().iter().zip(&self.fliers) {
            let (row, [vx, vz, spin]) = (&row.0, flier.free);
            let ((mass, moment), came) = ((1.0 / row[INVERSE_MASS], 1.0 / row[INVERSE_MOMENT]), vx * vx + vz * vz);
            free += mass * came + moment * spin * spin;
            now += mass * square(row) + moment * row[SPIN] * row[SPIN];
            given += mass * driven;
            fastest_free = fastest_free.max(came);
            fastest = fastest.max(square(row));
        }
        let free = free * (1.0 + 1e-12);
        let flings = now > free && fastest > fastest_free.max(TWICE * driven);
        flings || now > free + TWICE * given || fastest > TWICE * fastest_free.max(driven)
    }

    /// All mobile bodies stop, and stay where they are through the time.
    pub(super) fn stand(&mut self, rows: &mut Rows, time: f64, threads: &Threads) {
        let parts = (&mut self.fliers[..], rows.of_mobile_mut());
        threads.each(parts, (1, PER_THREAD), |_, (fliers, rows)| {
            for (flier, row) in fliers.iter_mut().zip(rows) {
                flier.carried = flier.changed(&row.0);
                row.set_motion(Motion::default());
                flier.way = flier.changed(&row.0).map(|changed| -(0.5 * time) * changed);
            }
        });
    }

    /// The motions of bodies on which no contact pushes.
    pub(super) fn let_go(&self, rows: &mut Rows) {
        for (row, flier) in rows.of_mobile_mut().iter_mut().zip(&self.fliers) {
            [row.0[VX], row.0[VZ], row.0[SPIN]] = flier.free;
        }
    }

    /// The motions of bodies on which contacts push as they are now said to.
    pub(super) fn renew(&self, rows: &mut Rows, threads: &Threads) {
        threads.each(rows.of_mobile_mut(), (1, PER_THREAD), |from, rows| {
            for (flier, Row(row)) in self.fliers[from..].iter().zip(rows) {
                for (at, q) in [VX, VZ, SPIN].into_iter().enumerate() {
                    row[q] = flier.free[at] + flier.carried[at];
                }
            }
        });
    }

    /// How bodies are likely to move on the whole of a sub-step: if forces change their motions as they did in the one before.
    pub(super) fn foresee(&self, rows: &Rows, pulls: &Pulls, h: f64, mean: &mut Vec<Row>) {
        mean.clear();
        mean.extend(rows.rows.iter().zip(&self.spent).map(|(row, spent)| {
            let mut row = *row;
            row.0[HALF] = 0.5 * (h - spent);
            row
        }));
        for (k, flier) in self.fliers.iter().enumerate() {
            let (row, pull) = (&mut mean[rows.first() + k].0, pulls.on_mobile(rows.mobile[k] as usize));
            let [x, z, spin] = flier.carried;
            let (v, omega) = (Vec2::new(x, z) + pull.a * h, spin + pull.alpha * h);
            if v.norm_squared() <= FORCEFUL * FORCEFUL * pull.a.norm_squared() * h * h {
                (row[VX], row[VZ], row[SPIN]) = (row[VX] + 0.5 * v.x, row[VZ] + 0.5 * v.y, row[SPIN] + 0.5 * omega);
            }
        }
    }

    /// A sub-step begins: gravity, drag and pushes act.
    pub(super) fn set_out(&mut self, rows: &mut Rows, pulls: &Pulls, h: f64, threads: &Threads) {
        let Fliers { fliers, spent, coefficients, .. } = self;
        let (setting, spent) = (Setting { pulls, coefficients, h }, &spent[rows.first()..]);
        let (mobile, rows) = rows.mobile_and_rows();
        threads.each((&mut fliers[..], rows), (1, PER_THREAD), |from, (fliers, rows)| {
            for ((flier, Row(row)), k) in fliers.iter_mut().zip(rows).zip(from..) {
                flier.set_out(row, mobile[k], spent[k], &setting);
            }
        });
    }

    /// A body has been given a row, the last; in the midst of a sub-step where that has set out already.
    pub(super) fn join(&mut self, rows: &mut Rows, under_way: Option<(&Pulls, f64)>) {
        self.fliers.push(Flier::default());
        self.spent.push(0.0);
        self.stirred.push(0);
        if let Some((pulls, h)) = under_way {
            let Fliers { fliers, coefficients, .. } = self;
            let (Some(flier), Some(body)) = (fliers.last_mut(), rows.mobile.last()) else { return };
            let Some(Row(row)) = rows.rows.last_mut() else { return };
            flier.set_out(row, *body, 0.0, &Setting { pulls, coefficients, h });
        }
    }

    /// The sub-step ends: bodies have come where their motions took them.
    pub(super) fn arrive(&mut self, rows: &mut Rows, pulls: &Pulls, h: f64) {
        let spent = &self.spent[rows.first()..];
        let (mobile, moving) = rows.mobile_and_rows();
        for (k, (flier, Row(row))) in self.fliers.iter_mut().zip(moving).enumerate() {
            let by_force = flier.is_forced(row, &pulls.on_mobile(mobile[k] as usize), h);
            let goes = flier.goes(row, h - spent[k], by_force);
            flier.carried = flier.changed(row);
            for (d, goes) in [X, Z, TURN].into_iter().zip(goes) {
                row[d] += goes;
            }
        }
        for row in rows.of_fixed_mut() {
            *row = row.after(h);
        }
        for row in self.spenders.drain(..) {
            self.spent[row as usize] = 0.0;
        }
    }

    /// How a row's body flies from where it stands now in the sub-step.
    pub(super) fn path(row: &Row, frame: &Frame, pull: Pull) -> Path {
        Path { frame: turned(frame, frame.o + row.place(), row.0[TURN]), motion: row.motion(), pull }
    }

    /// A row's body flies on for some time of the sub-step, ahead of the others.
    pub(super) fn go_on(&mut self, rows: &mut Rows, row: u32, path: &Path, time: f64) {
        if time == 0.0 {
            return;
        }
        rows.rows[row as usize].come(&path.change(time));
        if self.spent[row as usize] == 0.0 {
            self.spenders.push(row);
        }
        self.spent[row as usize] += time;
    }
}
