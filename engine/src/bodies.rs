//! The bodies of a running world: one array per quantity, index = order of creation.

use crate::area::{Rect, Vec2};
use crate::detect::seams::Seams;
use crate::exchange::impact::Surface;
use crate::frame::{Angle, Frame, add_kept};
use crate::trig::sin_cos;

/// What collisions may do to a body, and what it hands over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Can be moved, takes part in the whole exchange (§2.5.1).
    Mobile,
    /// Cannot be moved, hands over its motion (§2.5.2).
    FixedWithPhysics,
    /// Cannot be moved, hands over nothing (§2.5.3).
    Fixed,
}

/// A body's motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Velocity of its centre O \[m/s\].
    pub v: Vec2,
    /// Spin ω \[rad/s\], +X towards +Z.
    pub omega: f64,
}

/// A body's mass and moment of inertia about its centre; read of mobile bodies only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// m \[kg\].
    pub mass: f64,
    /// I \[kg·m²\].
    pub moment: f64,
}

/// All bodies, a column per quantity.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Where each stands.
    pub frame: Vec<Frame>,
    /// What the running sum of each position has rounded away.
    pub lost: Vec<Vec2>,
    /// Each angle, kept without drift; `frame` holds its cosine and sine.
    pub angle: Vec<Angle>,
    /// How each moves.
    pub motion: Vec<Motion>,
    /// What collisions may do to each.
    pub role: Vec<Role>,
    /// Mass and moment of inertia of each.
    pub inertia: Vec<Inertia>,
    /// Restitution and friction of each; only the impulse exchange has them, without it there are none.
    pub surface: Vec<Surface>,
    /// The rectangles of all bodies, body after body.
    pub rects: Vec<Rect>,
    /// Where each body's rectangles begin in `rects`; one more entry closes the last.
    pub first_rect: Vec<u32>,
    /// Faces inside what rectangles make up together; only the complete detection has them.
    pub seams: Seams,
}

impl Bodies {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.frame.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.frame.is_empty()
    }

    /// The rectangles of one body; none of a body that is not collidable.
    #[inline]
    #[must_use]
    pub fn rects_of(&self, body: usize) -> &[Rect] {
        &self.rects[self.first_rect[body] as usize..self.first_rect[body + 1] as usize]
    }

    /// Half the least size of any of a body's rectangles \[m\]; infinite where it has none.
    #[must_use]
    pub fn smallest_half(&self, body: usize) -> f64 {
        self.rects_of(body).iter().map(|rect| rect.half().min()).fold(f64::INFINITY, f64::min)
    }

    /// A quick bound on how far a body's rectangles reach from its centre \[m\].
    #[must_use]
    pub fn reach(&self, body: usize) -> f64 {
        self.rects_of(body).iter().map(Rect::far).fold(0.0, f64::max)
    }

    /// Whether the body may be moved by collisions.
    #[inline]
    #[must_use]
    pub fn is_mobile(&self, body: usize) -> bool {
        self.role[body] == Role::Mobile
    }

    /// Moves a body's centre; what the addition rounds away is carried to the next.
    #[inline]
    pub fn shift(&mut self, body: usize, by: Vec2) {
        shift((&mut self.frame[body], &mut self.lost[body]), by);
    }

    /// Turns a body about its centre.
    #[inline]
    pub fn turn(&mut self, body: usize, by: f64) {
        turn((&mut self.frame[body], &mut self.angle[body]), by);
    }

    /// Puts a body at a place, exactly.
    pub fn place(&mut self, body: usize, o: Vec2) {
        self.frame[body].o = o;
        self.lost[body] = Vec2::zeros();
    }

    /// Gives a body an angle, exactly.
    pub fn set_angle(&mut self, body: usize, angle: f64) {
        self.angle[body] = Angle::new(angle);
        point(&mut self.frame[body], &self.angle[body]);
    }
}

/// Moves a body's centre, with what earlier additions have rounded away.
#[inline]
pub(crate) fn shift((frame, lost): (&mut Frame, &mut Vec2), by: Vec2) {
    (frame.o.x, lost.x) = add_kept(frame.o.x, lost.x, by.x);
    (frame.o.y, lost.y) = add_kept(frame.o.y, lost.y, by.y);
}

/// Turns a body about its centre.
#[inline]
pub(crate) fn turn((frame, angle): (&mut Frame, &mut Angle), by: f64) {
    angle.turn(by);
    point(frame, angle);
}

#[inline]
fn point(frame: &mut Frame, angle: &Angle) {
    (frame.sin, frame.cos) = sin_cos(angle.value);
}
