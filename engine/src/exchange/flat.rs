//! A flat hit: two points of one face, solved together.

use super::impact::Surface;

/// The response of the two ends of a face, and of the tangential motion they share: a face is rigid and lies along
/// t, so it slips or sticks as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flat {
    /// u_n at one end per normal impulse at the other.
    pub k_nn: [[f64; 2]; 2],
    /// u_n at an end per tangential impulse, and u_t per normal impulse there.
    pub k_nt: [f64; 2],
    /// u_t per tangential impulse.
    pub k_tt: f64,
}

/// The impulse of a flat hit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlatImpulse {
    /// Tangential, on the face as a whole.
    pub t: f64,
    /// Normal, at each end.
    pub n: [f64; 2],
}

/// What friction does at the end of the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Stick,
    /// Slip along +t (1) or −t (−1).
    Slip(f64),
}

/// Halvings of e when a hit would create energy: more than f64 has bits.
const HALVINGS: u32 = 60;

impl Flat {
    /// The impulse of a hit at u_t and u_n, one of which at least is negative.
    ///
    /// With e = 0 it never creates energy: pᵀu⁺ ≤ 0, and what it changes is pᵀu⁺ − ½ pᵀKp. So where Newton's law would,
    /// there is a largest e at which it does not, and that one is used.
    #[must_use]
    pub fn impulse(&self, u_t: f64, u_n: [f64; 2], surface: Surface) -> FlatImpulse {
        let full = self.with_restitution(u_t, u_n, surface);
        if self.energy(u_t, u_n, &full) <= 0.0 || surface.friction == 0.0 {
            return full;
        }
        let (mut low, mut high) = (0.0, surface.restitution);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let p = self.with_restitution(u_t, u_n, Surface { restitution: middle, ..surface });
            *(if self.energy(u_t, u_n, &p) <= 0.0 { &mut low } else { &mut high }) = middle;
        }
        self.with_restitution(u_t, u_n, Surface { restitution: low, ..surface })
    }

    /// The first way to end that is consistent with itself: sticking, slipping on, slipping back.
    fn with_restitution(&self, u_t: f64, u_n: [f64; 2], surface: Surface) -> FlatImpulse {
        let wanted = u_n.map(|u| if u < 0.0 { u * (1.0 + surface.restitution) } else { u });
        let on = if u_t >= 0.0 { 1.0 } else { -1.0 };
        if surface.friction == 0.0 {
            return FlatImpulse { t: 0.0, n: complementary(self.k_nn, wanted) };
        }
        [End::Stick, End::Slip(on), End::Slip(-on)]
            .into_iter()
            .find_map(|end| self.ending(end, u_t, wanted, surface.friction))
            .unwrap_or_else(|| FlatImpulse { t: 0.0, n: complementary(self.k_nn, wanted) })
    }

    /// The impulse that ends so, if there is one.
    fn ending(&self, end: End, u_t: f64, wanted: [f64; 2], friction: f64) -> Option<FlatImpulse> {
        let Flat { k_nn, k_nt, k_tt } = *self;
        // p_t = offset + Σ slope_b p_b
        let (offset, slope) = match end {
            End::Stick => (-u_t / k_tt, k_nt.map(|k| -k / k_tt)),
            End::Slip(direction) => (0.0, [-direction * friction; 2]),
        };
        let k = [0, 1].map(|a| [0, 1].map(|b| k_nn[a][b] + k_nt[a] * slope[b]));
        let b = [0, 1].map(|a| wanted[a] + k_nt[a] * offset);
        let n = complementary(k, b);
        let t = offset + slope[0] * n[0] + slope[1] * n[1];
        let parts = (0..2).all(|a| k[a][0] * n[0] + k[a][1] * n[1] + b[a] >= -1e-12 * (b[0].abs() + b[1].abs()));
        let u_t_after = u_t + k_nt[0] * n[0] + k_nt[1] * n[1] + k_tt * t;
        let is_so = match end {
            End::Stick => t.abs() <= friction * (n[0] + n[1]),
            End::Slip(direction) => u_t_after * direction >= 0.0,
        };
        (parts && is_so).then_some(FlatImpulse { t, n })
    }

    /// What an impulse changes of the kinetic energy: pᵀ(u⁻ + ½ K p).
    fn energy(&self, u_t: f64, u_n: [f64; 2], p: &FlatImpulse) -> f64 {
        let du_t = self.k_nt[0] * p.n[0] + self.k_nt[1] * p.n[1] + self.k_tt * p.t;
        let du_n = [0, 1].map(|a| self.k_nn[a][0] * p.n[0] + self.k_nn[a][1] * p.n[1] + self.k_nt[a] * p.t);
        p.t * (u_t + 0.5 * du_t) + p.n[0] * (u_n[0] + 0.5 * du_n[0]) + p.n[1] * (u_n[1] + 0.5 * du_n[1])
    }
}

/// p ≥ 0 with K p + b ≥ 0, and where one is positive the other is zero: the four cases of two unknowns.
fn complementary(k: [[f64; 2]; 2], b: [f64; 2]) -> [f64; 2] {
    let determinant = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    let both = [(k[0][1] * b[1] - k[1][1] * b[0]) / determinant, (k[1][0] * b[0] - k[0][0] * b[1]) / determinant];
    if both[0] >= 0.0 && both[1] >= 0.0 {
        return both;
    }
    let (first, second) = (-b[0] / k[0][0], -b[1] / k[1][1]);
    if first >= 0.0 && k[1][0] * first + b[1] >= 0.0 {
        return [first, 0.0];
    }
    if second >= 0.0 && k[0][1] * second + b[0] >= 0.0 {
        return [0.0, second];
    }
    [0.0, 0.0]
}
