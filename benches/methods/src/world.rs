//! What every method works on: rectangles, and the gravity and the surfaces they share.

use choque_engine::area::Vec2;

/// A rectangle.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Half its width and height, m.
    pub(crate) half: Vec2,
    /// 1/kg; 0 for what is fixed.
    pub(crate) inverse_mass: f64,
    /// 1/(kg m²); 0 for what is fixed.
    pub(crate) inverse_inertia: f64,
    /// Its centre, m.
    pub(crate) x: Vec2,
    /// Its angle, rad.
    pub(crate) angle: f64,
    /// Cosine and sine of the angle.
    pub(crate) turn: Vec2,
    /// m/s.
    pub(crate) v: Vec2,
    /// rad/s.
    pub(crate) w: f64,
    /// What a fixed body circles with its spin.
    pub(crate) centre: Option<Vec2>,
}

impl Body {
    /// A rectangle at rest whose square metre weighs so many kilograms.
    pub(crate) fn mobile(half: Vec2, x: Vec2, density: f64) -> Body {
        let mass = 4.0 * half.x * half.y * density;
        let inertia = mass * half.norm_squared() / 3.0;
        Body { inverse_mass: 1.0 / mass, inverse_inertia: 1.0 / inertia, ..Body::fixed(half, x) }
    }

    /// A rectangle that stays where it is.
    pub(crate) fn fixed(half: Vec2, x: Vec2) -> Body {
        Body {
            half,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            x,
            angle: 0.0,
            turn: Vec2::new(1.0, 0.0),
            v: Vec2::zeros(),
            w: 0.0,
            centre: None,
        }
    }

    /// The same, turned to an angle.
    pub(crate) fn turned(self, angle: f64) -> Body {
        let (sine, cosine) = libm::sincos(angle);
        Body { angle, turn: Vec2::new(cosine, sine), ..self }
    }

    pub(crate) fn is_mobile(&self) -> bool {
        self.inverse_mass > 0.0
    }

    /// A direction of the body's own in the world.
    pub(crate) fn outwards(&self, local: Vec2) -> Vec2 {
        rotated(self.turn, local)
    }

    /// A direction in the world as the body sees it.
    pub(crate) fn inwards(&self, world: Vec2) -> Vec2 {
        rotated(Vec2::new(self.turn.x, -self.turn.y), world)
    }

    /// Moves on and turns.
    pub(crate) fn shift(&mut self, by: Vec2, angle: f64) {
        self.x += by;
        self.angle += angle;
        let (sine, cosine) = libm::sincos(self.angle);
        self.turn = Vec2::new(cosine, sine);
    }

    /// Speed of whatever part of it is fastest, at most.
    pub(crate) fn fastest(&self) -> f64 {
        self.v.norm() + self.w.abs() * self.half.norm()
    }

    /// Velocity at a point so far from its centre.
    pub(crate) fn velocity_at(&self, arm: Vec2) -> Vec2 {
        self.v + perp(arm) * self.w
    }

    /// Takes an impulse at a point so far from its centre.
    pub(crate) fn push(&mut self, arm: Vec2, impulse: Vec2) {
        self.v += impulse * self.inverse_mass;
        self.w += cross(arm, impulse) * self.inverse_inertia;
    }
}

/// Everything there is.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) bodies: Vec<Body>,
    /// m/s², downwards along y if negative.
    pub(crate) gravity: f64,
    /// Of every pair.
    pub(crate) friction: f64,
    /// Of every pair.
    pub(crate) restitution: f64,
}

impl World {
    /// Lets gravity act.
    pub(crate) fn fall(&mut self, h: f64) {
        for body in self.bodies.iter_mut().filter(|body| body.is_mobile()) {
            body.v.y += h * self.gravity;
        }
    }

    /// Moves what is fixed and turns about a centre.
    pub(crate) fn turn_fixed(&mut self, h: f64) {
        for body in self.bodies.iter_mut().filter(|body| !body.is_mobile()) {
            let Some(centre) = body.centre else { continue };
            let (sine, cosine) = libm::sincos(h * body.w);
            let at = centre + rotated(Vec2::new(cosine, sine), body.x - centre);
            body.shift(at - body.x, h * body.w);
            body.v = perp(body.x - centre) * body.w;
        }
    }

    /// Kinetic and potential energy of what moves, J.
    pub(crate) fn energy(&self) -> f64 {
        let of = |body: &Body| {
            let (mass, inertia) = (1.0 / body.inverse_mass, 1.0 / body.inverse_inertia);
            0.5 * (mass * body.v.norm_squared() + inertia * body.w * body.w) - mass * self.gravity * body.x.y
        };
        self.bodies.iter().filter(|body| body.is_mobile()).map(of).sum()
    }
}

/// A quarter turn to the left.
pub(crate) fn perp(a: Vec2) -> Vec2 {
    Vec2::new(-a.y, a.x)
}

pub(crate) fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Turned by an angle of that cosine and sine.
pub(crate) fn rotated(turn: Vec2, a: Vec2) -> Vec2 {
    Vec2::new(turn.x * a.x - turn.y * a.y, turn.y * a.x + turn.x * a.y)
}
