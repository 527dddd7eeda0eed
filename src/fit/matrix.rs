//! The little linear algebra of a fit: matrices of a few rows.

/// A square matrix, row by row.
pub type Square = Vec<Vec<f64>>;

/// An eigenvalue with its vector of length 1.
pub type Eigen = (f64, Vec<f64>);

/// Sweeps after which rotations have long come to an end: each squares what is left beside the diagonal.
const SWEEPS: usize = 60;

/// The eigenvalues of a symmetric matrix with their vectors, greatest first, by Jacobi's rotations (1846).
#[must_use]
pub fn eigen(matrix: &Square) -> Vec<Eigen> {
    let n = matrix.len();
    let mut a = matrix.clone();
    let mut vectors: Square = (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for _ in 0..SWEEPS {
        for p in 0..n {
            for q in p + 1..n {
                rotate(&mut a, &mut vectors, p, q);
            }
        }
    }
    let mut pairs: Vec<Eigen> = (0..n).map(|k| (a[k][k], vectors.iter().map(|row| row[k]).collect())).collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

/// Turns two axes so that the element that couples them vanishes.
fn rotate(a: &mut Square, vectors: &mut Square, p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let tangent = f64::copysign(1.0, theta) / (theta.abs() + (theta * theta + 1.0).sqrt());
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    let turned = |x: f64, y: f64| (cosine * x - sine * y, sine * x + cosine * y);
    for row in a.iter_mut().chain(vectors) {
        (row[p], row[q]) = turned(row[p], row[q]);
    }
    let (above, below) = a.split_at_mut(q);
    for (x, y) in above[p].iter_mut().zip(&mut below[0]) {
        (*x, *y) = turned(*x, *y);
    }
    (a[p][q], a[q][p]) = (0.0, 0.0);
}

/// JᵀJ of rows of derivatives, one row per varied number.
#[must_use]
pub fn normal(derivatives: &[Vec<f64>]) -> Square {
    derivatives.iter().map(|a| derivatives.iter().map(|b| dot(a, b)).collect()).collect()
}

/// The sum of the products.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_solve_their_equation_and_are_orthonormal() {
        let a = vec![vec![4.0, 1.0, -2.0], vec![1.0, 2.0, 0.5], vec![-2.0, 0.5, 3.0]];
        let pairs = eigen(&a);
        for (i, (value, vector)) in pairs.iter().enumerate() {
            for row in 0..3 {
                assert!((dot(&a[row], vector) - value * vector[row]).abs() < 1e-12);
            }
            for (j, (_, other)) in pairs.iter().enumerate() {
                assert!((dot(vector, other) - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
        assert!(pairs[0].0 > pairs[1].0 && pairs[1].0 > pairs[2].0);
    }

    #[test]
    fn nothing_but_zeros_is_a_matrix_too() {
        assert_eq!(eigen(&vec![vec![0.0; 2]; 2])[1], (0.0, vec![0.0, 1.0]));
        assert!(eigen(&Vec::new()).is_empty());
    }
}
