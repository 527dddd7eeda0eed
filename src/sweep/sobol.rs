//! Sobol's sequence: points that fill a cube more evenly than chance.
//!
//! The primitive polynomials and first direction numbers are those of S. Joe and F. Y. Kuo, *Constructing Sobol sequences
//! with better two-dimensional projections*, SIAM J. Sci. Comput. 30 (2008), in the order of their table
//! `new-joe-kuo-6.21201`; points come in the order of Gray codes (Antonov and Saleev 1979), the corner at 0 first.

/// Of each dimension but the first: the coefficients between the ends of its polynomial, as bits, and m₁ … m_s, whose number
/// is the polynomial's degree.
const TABLE: [(u32, &[u32]); 20] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// How many dimensions a point may have.
pub const MOST_DIMENSIONS: usize = TABLE.len() + 1;

/// Bits of a coordinate, and so 2³² points before one comes again.
const BITS: usize = 32;

/// The direction numbers of a cube.
#[derive(Clone, Debug)]
pub struct Sobol {
    /// By dimension and bit.
    directions: Vec<[u32; BITS]>,
}

impl Sobol {
    /// Of a cube with so many dimensions, [`MOST_DIMENSIONS`] at most.
    #[must_use]
    pub fn new(dimensions: usize) -> Self {
        let first = std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
        let others = TABLE.iter().map(|(polynomial, initial)| directions(*polynomial, initial));
        Sobol { directions: std::iter::once(first).chain(others).take(dimensions).collect() }
    }

    /// The point with that number, counted from 0; coordinates from 0 up to 1.
    #[must_use]
    pub fn point(&self, number: u32) -> Vec<f64> {
        let gray = number ^ (number >> 1);
        let coordinate = |directions: &[u32; BITS]| {
            let chosen = directions.iter().enumerate().filter(|(bit, _)| gray >> bit & 1 == 1);
            f64::from(chosen.fold(0, |sum, (_, direction)| sum ^ direction)) / (1u64 << BITS) as f64
        };
        self.directions.iter().map(coordinate).collect()
    }
}

/// `v_i = v_{i−s} / 2^s ⊕ v_{i−s} ⊕ a_1 v_{i−1} ⊕ … ⊕ a_{s−1} v_{i−s+1}`, the first s being `m_i / 2^i`.
fn directions(polynomial: u32, initial: &[u32]) -> [u32; BITS] {
    let degree = initial.len();
    let mut directions = [0; BITS];
    for bit in 0..BITS {
        directions[bit] = if bit < degree {
            initial[bit] << (BITS - 1 - bit)
        } else {
            let before = directions[bit - degree];
            let set = (1..degree).filter(|i| polynomial >> (degree - 1 - i) & 1 == 1);
            set.fold(before ^ (before >> degree), |sum, i| sum ^ directions[bit - i])
        };
    }
    directions
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first points in ten dimensions as Joe and Kuo's own program prints them, and the hundredth in all 21 as SciPy 1
    /// computes it from the same table.
    #[test]
    fn points_are_those_published() {
        let eighths: [[u32; 10]; 6] = [
            [0; 10],
            [4; 10],
            [6, 2, 2, 2, 6, 6, 2, 6, 6, 6],
            [2, 6, 6, 6, 2, 2, 6, 2, 2, 2],
            [3, 3, 5, 7, 3, 1, 3, 7, 7, 5],
            [7, 7, 1, 3, 7, 5, 7, 3, 3, 1],
        ];
        let sobol = Sobol::new(10);
        for (number, point) in eighths.into_iter().enumerate() {
            assert_eq!(sobol.point(number as u32), point.map(|eighth| f64::from(eighth) / 8.0), "{number}");
        }
        let hundredth = [53, 33, 99, 93, 113, 95, 3, 61, 81, 89, 59, 87, 61, 109, 41, 63, 87, 95, 107, 43, 97];
        assert_eq!(Sobol::new(21).point(100), hundredth.map(|part| f64::from(part) / 128.0));
    }

    #[test]
    fn every_dimension_puts_one_point_into_each_stratum() {
        let sobol = Sobol::new(MOST_DIMENSIONS);
        for dimension in 0..MOST_DIMENSIONS {
            let mut strata: Vec<usize> =
                (0..256).map(|number| (256.0 * sobol.point(number)[dimension]) as usize).collect();
            strata.sort_unstable();
            assert_eq!(strata, (0..256).collect::<Vec<_>>(), "dimension {dimension}");
        }
    }
}
