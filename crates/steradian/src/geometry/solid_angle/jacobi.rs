//! Eigenvalues of a symmetric matrix of three rows by Jacobi's rotations (Golub & Van Loan, *Matrix Computations*, 4th
//! ed., §8.5), which converge quadratically and keep the small eigenvalues of graded matrices.

const MOST_SWEEPS: u32 = 30;

/// The eigenvalues, in no order.
pub(super) fn eigenvalues(mut matrix: [[f64; 3]; 3]) -> [f64; 3] {
    for _ in 0..MOST_SWEEPS {
        let mut is_diagonal = true;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            is_diagonal &= rotated_away(&mut matrix, p, q);
        }
        if is_diagonal {
            break;
        }
    }
    [0, 1, 2].map(|i| matrix[i][i])
}

/// Makes an entry 0; true if it was already nothing beside the entries of the diagonal that it joins.
fn rotated_away(matrix: &mut [[f64; 3]; 3], p: usize, q: usize) -> bool {
    let (entry, first, second) = (matrix[p][q], matrix[p][p], matrix[q][q]);
    if entry * entry <= 1e-34 * (first * second).abs() {
        return true;
    }
    let slope = (second - first) / (2.0 * entry);
    let tan = 1.0_f64.copysign(slope) / (slope.abs() + (slope * slope + 1.0).sqrt());
    let cos = 1.0 / (tan * tan + 1.0).sqrt();
    let sin = tan * cos;
    let r = 3 - p - q;
    let (a, b) = (matrix[r][p], matrix[r][q]);
    matrix[p][p] = first - tan * entry;
    matrix[q][q] = second + tan * entry;
    let pairs = [
        (p, q, 0.0),
        (r, p, cos * a - sin * b),
        (r, q, sin * a + cos * b),
    ];
    for (i, j, value) in pairs {
        (matrix[i][j], matrix[j][i]) = (value, value);
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::testing::close;
    use proptest::prelude::*;

    #[test]
    fn a_matrix_with_known_eigenvalues() {
        // 2 on the diagonal and −1 beside it: 2 − √2, 2, 2 + √2.
        let mut found = eigenvalues([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]]);
        found.sort_by(f64::total_cmp);
        let root = f64::sqrt(2.0);
        for (found, expected) in found.iter().zip([2.0 - root, 2.0, 2.0 + root]) {
            assert!(close(*found, expected, 1e-15));
        }
        assert_eq!(eigenvalues([[0.0; 3]; 3]), [0.0; 3]);
    }

    proptest! {
        #[test]
        fn trace_and_determinant_are_kept(m in prop::array::uniform6(-1.0..1.0_f64)) {
            let [a, b, c, d, e, f] = m;
            let values = eigenvalues([[a, d, e], [d, b, f], [e, f, c]]);
            prop_assert!(close(values.iter().sum(), a + b + c, 1e-14));
            let determinant = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
            prop_assert!(close(values.iter().product(), determinant, 1e-14));
        }
    }
}
