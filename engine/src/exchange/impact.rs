//! A hit at one point: Routh's process with Stronge's restitution.

/// Restitution and friction of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// e, 0 … 1.
    pub restitution: f64,
    /// μ ≥ 0.
    pub friction: f64,
}

impl Surface {
    /// What two bodies make of each other: the livelier restitution, and the geometric mean of their frictions, so that
    /// ice is slippery to everyone.
    #[must_use]
    pub fn of_pair(one: Surface, two: Surface) -> Surface {
        Surface { restitution: one.restitution.max(two.restitution), friction: (one.friction * two.friction).sqrt() }
    }
}

/// An impulse, or a velocity, along the tangent and the normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Components {
    /// Along the tangent.
    pub t: f64,
    /// Along the normal.
    pub n: f64,
}

/// The response of one point of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// u_t per tangential impulse.
    pub k_tt: f64,
    /// u_t per normal impulse, and u_n per tangential.
    pub k_tn: f64,
    /// u_n per normal impulse.
    pub k_nn: f64,
}

/// Slip at the contact, which decides what friction does with a growing normal impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Slip {
    Forward,
    Backward,
    Stick,
}

impl Impact {
    /// The impulse of a hit at u = (u_t, u_n < 0), by Routh's process with Stronge's restitution.
    #[must_use]
    pub fn impulse(&self, u_t: f64, u_n: f64, surface: Surface) -> Components {
        self.impulse_and_work(u_t, u_n, surface).0
    }

    /// The same with the work done on the normal motion: what compression took, less what was given back \[J\].
    #[must_use]
    pub fn impulse_and_work(
        &self,
        u_t: f64,
        u_n: f64,
        Surface { restitution, friction }: Surface,
    ) -> (Components, f64) {
        let mut u = Components { t: u_t, n: u_n };
        let mut p = Components::default();
        let taken = self.grow(&mut u, &mut p, friction, Until::Compressed);
        let returned = self.grow(&mut u, &mut p, friction, Until::Returned(-taken * restitution * restitution));
        (p, taken + returned)
    }

    /// Lets the normal impulse grow until an end is reached; gives the work done on the normal motion.
    ///
    /// u and p change linearly as long as slip keeps its direction; it stops at most once in all, and may then
    /// stick or turn round, so the loop is short.
    fn grow(&self, u: &mut Components, p: &mut Components, friction: f64, until: Until) -> f64 {
        let mut work = 0.0;
        loop {
            let slip = self.slip(u.t, friction);
            let drag = match slip {
                Slip::Forward => -friction,
                Slip::Backward => friction,
                Slip::Stick => -self.k_tn / self.k_tt,
            };
            let (rate_t, rate_n) = (self.k_tn + drag * self.k_tt, self.k_nn + drag * self.k_tn);
            let slip_ends = if slip == Slip::Stick || rate_t * u.t >= 0.0 { f64::INFINITY } else { -u.t / rate_t };
            let end = until.reached(u.n, rate_n, work);
            let q = end.min(slip_ends);
            work += q * (u.n + 0.5 * rate_n * q);
            *p = Components { t: p.t + drag * q, n: p.n + q };
            *u = Components { t: if q == slip_ends { 0.0 } else { u.t + rate_t * q }, n: u.n + rate_n * q };
            if end <= slip_ends {
                if until == Until::Compressed {
                    u.n = 0.0;
                }
                return work;
            }
        }
    }

    /// What slip there is: by its direction; from rest it sticks, unless it is driven faster than friction can hold.
    fn slip(&self, u_t: f64, friction: f64) -> Slip {
        let holds = self.k_tn.abs() <= friction * self.k_tt;
        match if u_t == 0.0 && !holds { self.k_tn } else { u_t } {
            direction if direction > 0.0 => Slip::Forward,
            direction if direction < 0.0 => Slip::Backward,
            _ => Slip::Stick,
        }
    }
}

/// How long a normal impulse grows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Until {
    /// Until the bodies no longer approach.
    Compressed,
    /// Until that much work was given back.
    Returned(f64),
}

impl Until {
    /// The further normal impulse after which the end is reached, at a constant rate; infinite if never.
    fn reached(self, u_n: f64, rate: f64, work: f64) -> f64 {
        match self {
            Until::Compressed if rate > 0.0 => -u_n / rate,
            Until::Compressed => f64::INFINITY,
            // u_n q + rate q²/2 = what is still to be given back
            Until::Returned(whole) => {
                let rest = (whole - work).max(0.0);
                let root = (u_n * u_n + 2.0 * rate * rest).max(0.0).sqrt();
                if rest == 0.0 { 0.0 } else { 2.0 * rest / (u_n + root) }
            }
        }
    }
}
