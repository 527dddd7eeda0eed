//! Free flight under gravity, drag and commands, solved exactly over one iteration.
//!
//! `v̇ = a − k v` with constant a has the solution `v′ = A v + B a`, `x′ = x + B v + C a` with
//! `A = e^{−k dt}`, `B = (1 − A)/k`, `C = (dt − B)/k`; without drag `A = 1`, `B = dt`, `C = dt²/2`.
//! So a projectile is exact at any time step, and halving the step changes nothing but rounding.

/// The three coefficients of one decay rate over one time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// A: what is left of the velocity.
    pub keep: f64,
    /// B \[s\]: displacement per velocity, and velocity gained per acceleration.
    pub reach: f64,
    /// C \[s²\]: displacement per acceleration.
    pub fall: f64,
}

impl Flight {
    /// The coefficients for a decay rate k ≥ 0 \[1/s\] over dt \[s\].
    #[must_use]
    pub fn new(k: f64, dt: f64) -> Self {
        let slowed = Flight::slowed(k, dt);
        let fall = if k == 0.0 { 0.5 * dt * dt } else { fall_per_square(k * dt) * dt * dt };
        Flight { fall, ..slowed }
    }

    /// The same of what nothing accelerates: C is not worked out, and 0.
    #[must_use]
    pub fn slowed(k: f64, dt: f64) -> Self {
        if k == 0.0 {
            return Flight { keep: 1.0, reach: dt, fall: 0.0 };
        }
        let y = k * dt;
        Flight { keep: libm::exp(-y), reach: -libm::expm1(-y) / k, fall: 0.0 }
    }
}

/// C/dt² = (y − 1 + e^{−y})/y² for y = k·dt: by its series where the formula would cancel.
fn fall_per_square(y: f64) -> f64 {
    if y > 0.5 {
        return (y + libm::expm1(-y)) / (y * y);
    }
    // 1/2! − y/3! + y²/4! − …: 14 terms reach rounding for y ≤ 1/2.
    let mut term = 0.5;
    let mut sum = term;
    for n in 3..17 {
        term *= -y / f64::from(n);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_and_the_formula_meet() {
        for y in [0.4, 0.499_999, 0.5, 0.500_001, 0.7] {
            let formula = (y + libm::expm1(-y)) / (y * y);
            assert!((fall_per_square(y) - formula).abs() < 3e-15, "at {y}");
        }
    }

    #[test]
    fn two_half_steps_make_a_whole_one() {
        let (k, dt, v, a) = (0.7, 0.3, 2.0, -9.81);
        let whole = Flight::new(k, dt);
        let half = Flight::new(k, 0.5 * dt);
        let step = |f: Flight, x: f64, v: f64| (x + f.reach * v + f.fall * a, f.keep * v + f.reach * a);
        let (x1, v1) = step(whole, 0.0, v);
        let (x, u) = step(half, 0.0, v);
        let (x2, v2) = step(half, x, u);
        assert!((x1 - x2).abs() < 1e-15 && (v1 - v2).abs() < 1e-15);
    }
}
