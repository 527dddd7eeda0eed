//! Frames: where a body's own axes stand in the world, kept without drift.
//!
//! Angle θ turns +X towards +Z: `R(θ) = [[cos, −sin], [sin, cos]]` on (x, z).

use crate::area::Vec2;
use crate::trig::sin_cos;

/// A body's frame (SRO → SRU): a rotation, then a translation to its centre O.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Frame {
    /// The body's centre O, from the plan's origin \[m\].
    pub o: Vec2,
    /// cos θ.
    pub cos: f64,
    /// sin θ.
    pub sin: f64,
}

impl Frame {
    /// As it lies in memory: O's x and z, cos θ, sin θ.
    #[inline(always)]
    pub(crate) fn row(&self) -> [f64; 4] {
        [self.o.x, self.o.y, self.cos, self.sin]
    }

    /// The frame at O turned by θ in −π … π.
    #[must_use]
    pub fn new(o: Vec2, angle: f64) -> Self {
        let (sin, cos) = sin_cos(angle);
        Frame { o, cos, sin }
    }

    /// R(θ)·v: a direction out of the frame into the world.
    #[inline]
    #[must_use]
    pub fn outward(&self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// R(θ)ᵀ·v: a direction from the world into the frame.
    #[inline]
    #[must_use]
    pub fn inward(&self, v: Vec2) -> Vec2 {
        Vec2::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }

    /// This frame as seen from another: the one combined transformation of §2.3.
    ///
    /// Positions enter as a difference only, so it is as exact far from the origin as near it.
    #[inline]
    #[must_use]
    pub fn seen_from(&self, other: &Frame) -> Frame {
        Frame {
            o: other.inward(self.o - other.o),
            cos: self.cos * other.cos + self.sin * other.sin,
            sin: self.sin * other.cos - self.cos * other.sin,
        }
    }

    /// A point of the frame's own, brought out.
    #[inline]
    #[must_use]
    pub fn place(&self, point: Vec2) -> Vec2 {
        self.o + self.outward(point)
    }
}

/// perp(x, z) = (−z, x): the vector turned by a right angle from +X towards +Z.
#[inline]
#[must_use]
pub fn perp(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// One term added to a running sum whose rounding is carried along (Kahan 1965).
///
/// `lost` holds what earlier additions rounded away; a million additions err by about one rounding.
#[inline]
#[must_use]
pub fn add_kept(sum: f64, lost: f64, term: f64) -> (f64, f64) {
    let wanted = term + lost;
    let next = sum + wanted;
    (next, wanted - (next - sum))
}

/// An angle in (−π, π] whose running sum loses nothing over any number of steps.
///
/// A plain sum `θ += ω·dt` is off by 1.7e-5 rad after 1e7 steps of 1/60; this one by about one rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle {
    /// θ \[rad\], in (−π, π].
    pub value: f64,
    /// What the sum has rounded away so far \[rad\].
    pub lost: f64,
}

/// 2π as the nearest f64 and the rest of it, so that wrapping costs no accuracy.
const TURN: f64 = core::f64::consts::TAU;
const TURN_REST: f64 = 2.449_293_598_294_706_4e-16;

impl Angle {
    /// That angle, brought into (−π, π].
    #[must_use]
    pub fn new(value: f64) -> Self {
        let mut angle = Angle { value, lost: 0.0 };
        if !angle.is_wrapped() {
            angle = angle.wrapped();
            if angle.lost.abs() > f64::EPSILON * 4.0 {
                angle.turn(0.0); // many turns carry a rest worth folding in
            }
        }
        angle
    }

    /// Turned by `by` \[rad\]; one addition, so `by` may be many turns.
    #[inline]
    pub fn turn(&mut self, by: f64) {
        let (value, lost) = add_kept(self.value, self.lost, by);
        *self = Angle { value, lost };
        if !self.is_wrapped() {
            *self = self.wrapped();
        }
    }

    #[inline]
    fn is_wrapped(self) -> bool {
        use core::f64::consts::PI;
        -PI < self.value && self.value <= PI
    }

    /// Brought back by whole turns: the remainder is exact, and what 2π itself lacks is carried.
    /// Not for a value that is not finite: that is found and named by the check after the step.
    #[cold]
    fn wrapped(self) -> Self {
        let nearest = libm::remainder(self.value, TURN);
        let value = if nearest <= -core::f64::consts::PI { nearest + TURN } else { nearest };
        let turns = libm::round((self.value - value) / TURN);
        Angle { value, lost: self.lost - turns * TURN_REST }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_million_steps_of_rotation_stay_within_a_rounding_or_two() {
        // ω = 1 rad/s at 1/60 s; the exact angle is n·fl(1/60) mod 2π, formed in two parts.
        let (n, by) = (10_000_000_u32, 1.0 / 60.0);
        let mut angle = Angle::default();
        for _ in 0..n {
            angle.turn(by);
        }
        // 1e7·fl(1/60) = 166666.66666666666… ; reduce the exact product with the two-part 2π.
        let product = f64::from(n) * by;
        let turns = libm::round(product / TURN);
        let exact = libm::remainder(product, TURN) - turns * TURN_REST;
        let product_rounding = 1.5e-11; // half an ulp of 166666
        assert!((angle.value - exact).abs() < product_rounding, "{} against {exact}", angle.value);
    }

    #[test]
    fn an_angle_is_kept_in_the_half_open_turn() {
        use core::f64::consts::PI;
        for (given, kept) in [(PI, PI), (-PI, PI), (3.0 * PI, PI), (0.5, 0.5), (-0.5, -0.5)] {
            let value = Angle::new(given).value;
            assert!((value - kept).abs() < 1e-15 && -PI < value && value <= PI, "{given} became {value}");
        }
    }
}
