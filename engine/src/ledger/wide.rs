//! Sums in twice the precision, so that the books close however much has come and gone.
//!
//! A light body thrown by a heavy one may have ten thousand times the energy for a moment; what rounding leaves of that is
//! not small beside what stays. So what a body has is summed up as the sixteen digits of f64 twice over: the sums carry what
//! they round away (Neumaier 1974), and products are split into halves that multiply exactly (Dekker 1971).

use super::amounts::{Amounts, State};
use crate::bodies::Inertia;

/// A sum of terms that loses next to nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    pub(super) fn add(&mut self, term: f64) {
        let next = self.sum + term;
        let added = next - self.sum;
        self.lost += (self.sum - (next - added)) + (term - added);
        self.sum = next;
    }

    /// Adds a b c.
    fn add_product(&mut self, a: Split, b: Split, c: Split) {
        let (product, lost) = exact_product(a, b);
        let (whole, rest) = exact_product(Split::of(product), c);
        self.add(whole);
        self.add(rest + lost * c.whole);
    }

    /// Adds a b.
    fn add_product_of_two(&mut self, a: Split, b: Split) {
        let (product, lost) = exact_product(a, b);
        self.add(product);
        self.add(lost);
    }

    pub(super) fn value(self) -> f64 {
        self.sum + self.lost
    }
}

/// A product and what it rounds away. Beyond the numbers that can be split nothing is known to be lost.
fn exact_product(a: Split, b: Split) -> (f64, f64) {
    let product = a.whole * b.whole;
    let lost = ((a.high * b.high - product) + a.high * b.low + a.low * b.high) + a.low * b.low;
    (product, if lost.is_finite() { lost } else { 0.0 })
}

/// A number as the sum of two of 26 bits (Veltkamp 1968).
#[derive(Clone, Copy, Debug)]
struct Split {
    whole: f64,
    high: f64,
    low: f64,
}

impl Split {
    fn of(whole: f64) -> Split {
        let shifted = whole * 134_217_729.0; // 2²⁷ + 1
        let high = shifted - (shifted - whole);
        Split { whole, high, low: whole - high }
    }

    fn negative(self) -> Split {
        Split { whole: -self.whole, high: -self.high, low: -self.low }
    }

    fn half(self) -> Split {
        Split { whole: 0.5 * self.whole, high: 0.5 * self.high, low: 0.5 * self.low }
    }
}

/// The four quantities, each such a sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sums([Sum; Amounts::COUNT]);

impl Sums {
    /// What a body has more in one state than in another.
    pub(super) fn of_change(inertia: Inertia, from: State, to: State) -> Sums {
        let mut sums = Sums::default();
        sums.add_state(inertia, to, 1.0);
        sums.add_state(inertia, from, -1.0);
        sums
    }

    /// Adds what a body has, or takes it away.
    pub(super) fn add_state(&mut self, Inertia { mass, moment }: Inertia, State { o, motion }: State, sign: f64) {
        let [energy, momentum_x, momentum_z, angular_momentum] = &mut self.0;
        let (mass, moment) = (Split::of(mass * sign), Split::of(moment * sign));
        let (vx, vz, omega) = (Split::of(motion.v.x), Split::of(motion.v.y), Split::of(motion.omega));
        for (inertia, rate) in [(mass, vx), (mass, vz), (moment, omega)] {
            energy.add_product(rate, rate, inertia.half());
        }
        momentum_x.add_product_of_two(vx, mass);
        momentum_z.add_product_of_two(vz, mass);
        angular_momentum.add_product(Split::of(o.x), vz, mass);
        angular_momentum.add_product(Split::of(o.y), vx, mass.negative());
        angular_momentum.add_product_of_two(omega, moment);
    }

    pub(super) fn add(&mut self, amounts: Amounts) {
        self.0.iter_mut().zip(amounts.to_array()).for_each(|(sum, amount)| sum.add(amount));
    }

    pub(super) fn take(&mut self, amounts: Amounts) {
        self.0.iter_mut().zip(amounts.to_array()).for_each(|(sum, amount)| sum.add(-amount));
    }

    pub(super) fn add_all(&mut self, other: &Sums) {
        for (sum, Sum { sum: whole, lost }) in self.0.iter_mut().zip(other.0) {
            sum.add(whole);
            sum.add(lost);
        }
    }

    /// Split into the energy and the rest.
    pub(super) fn energy_and_momenta(&self) -> (Sums, Sums) {
        let [energy, x, z, angular] = self.0;
        let none = Sum::default();
        (Sums([energy, none, none, none]), Sums([none, x, z, angular]))
    }

    pub(super) fn value(&self) -> Amounts {
        Amounts::from_array(self.0.map(Sum::value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::area::Vec2;
    use crate::bodies::Motion;

    #[test]
    fn a_sum_keeps_what_a_plain_one_loses() {
        let mut sum = Sum::default();
        for term in [1e16, 1.0, -1e16, 1e-3] {
            sum.add(term);
        }
        assert_eq!(sum.value(), 1.001);
    }

    #[test]
    fn a_product_loses_nothing() {
        let a = 1.0 + f64::EPSILON;
        let product = |a: f64, b: f64| exact_product(Split::of(a), Split::of(b));
        assert_eq!(product(a, a), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
        assert_eq!(product(1e300, 1e300), (f64::INFINITY, 0.0));
        assert_eq!(product(1e305, 2.0), (2e305, 0.0));
    }

    #[test]
    fn a_change_is_the_difference_of_what_a_body_has() {
        let inertia = Inertia { mass: 2.0, moment: 0.5 };
        let state = |x, z, vx, vz, omega| State { o: Vec2::new(x, z), motion: Motion { v: Vec2::new(vx, vz), omega } };
        let (from, to) = (state(1.0, 2.0, 3.0, -1.0, 4.0), state(1.5, 2.5, -1.0, 2.0, 8.0));
        assert_eq!(Sums::of_change(inertia, from, to).value().to_array(), [7.0, -8.0, 6.0, 27.0]);
        let fast = state(1.0, 2.0, 3e9, -1.0, 4.0);
        let mut there_and_back = Sums::of_change(inertia, from, fast);
        there_and_back.add_all(&Sums::of_change(inertia, fast, to));
        assert_eq!(there_and_back.value().to_array(), [7.0, -8.0, 6.0, 27.0]);
    }
}
