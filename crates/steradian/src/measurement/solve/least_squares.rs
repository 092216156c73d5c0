//! Least squares with bounds, for few unknowns: min |A x − b|² with lower ≤ x ≤ upper.
//!
//! An active-set method (Stark & Parker 1995, *Bounded-variable least squares*; Lawson & Hanson 1974, ch. 23): unknowns wait at
//! a bound; that which would lower the sum of squares most is set free, the free ones are solved for, and those that leave
//! their bounds are put back on them, until no unknown at a bound wants to leave it.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | A, b | coefficients and right-hand sides, rows of size about 1 | – |
//! | x | unknowns | – |
//!
//! Free unknowns are solved for by orthogonalisation (modified Gram–Schmidt, which is stable for least squares: Björck 1967),
//! and not by normal equations, which would square the condition number.

/// Smaller than this part of a column, what is left of it when the others are taken away is rounding.
const RANK_TOLERANCE: f64 = 1e-10;
/// Smaller gradients, against rows of size 1, are rounding.
const GRADIENT_TOLERANCE: f64 = 1e-12;

/// The best x, and whether there is no other.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Solved {
    pub x: Vec<f64>,
    pub is_unique: bool,
}

/// A row of A with its b.
pub(super) type Row = (Vec<f64>, f64);

/// The best x. The number of rounds is limited; with exact arithmetic each lowers the sum of squares.
pub(super) fn bounded(rows: &[Row], bounds: &[[f64; 2]]) -> Solved {
    let mut x: Vec<f64> = bounds.iter().map(|[low, _]| *low).collect();
    let mut free = vec![false; x.len()];
    for _ in 0..10 * (x.len() + 1) {
        let Some(next) = wants_to_leave(rows, bounds, &x, &free) else {
            break;
        };
        free[next] = true;
        while let Some(target) = solve(rows, &x, &free) {
            if move_towards(&target, bounds, &mut x, &mut free) {
                break;
            }
        }
    }
    let gradient = gradient(rows, &x);
    let loose = |i: usize| free[i] || gradient[i].abs() <= GRADIENT_TOLERANCE;
    let movable: Vec<bool> = (0..x.len())
        .map(|i| loose(i) && bounds[i][0] < bounds[i][1])
        .collect();
    let is_unique = solve(rows, &x, &movable).is_some();
    Solved { x, is_unique }
}

/// Aᵀ (b − A x).
fn gradient(rows: &[Row], x: &[f64]) -> Vec<f64> {
    let mut gradient = vec![0.0; x.len()];
    for row in rows {
        let residual = row.1 - dot(&row.0, x);
        for (sum, a) in gradient.iter_mut().zip(&row.0) {
            *sum += a * residual;
        }
    }
    gradient
}

/// The unknown at a bound whose way inwards is steepest.
fn wants_to_leave(rows: &[Row], bounds: &[[f64; 2]], x: &[f64], free: &[bool]) -> Option<usize> {
    let gradient = gradient(rows, x);
    let inwards = |i: usize| {
        let [low, high] = bounds[i];
        let up = if x[i] < high { gradient[i] } else { 0.0 };
        let down = if x[i] > low { -gradient[i] } else { 0.0 };
        up.max(down)
    };
    let bound = (0..x.len()).filter(|i| !free[*i]);
    let steepest = bound.max_by(|a, b| inwards(*a).total_cmp(&inwards(*b)))?;
    (inwards(steepest) > GRADIENT_TOLERANCE).then_some(steepest)
}

/// Goes to `target`, or as far as the first bound, which then holds its unknown. True if it got there.
fn move_towards(target: &[f64], bounds: &[[f64; 2]], x: &mut [f64], free: &mut [bool]) -> bool {
    let part = |i: usize| {
        let bound = target[i].clamp(bounds[i][0], bounds[i][1]);
        if bound == target[i] {
            1.0
        } else {
            (bound - x[i]) / (target[i] - x[i])
        }
    };
    let unknowns: Vec<usize> = (0..x.len()).filter(|i| free[*i]).collect();
    let parts: Vec<f64> = unknowns.iter().map(|i| part(*i)).collect();
    let step = parts.iter().copied().fold(1.0, f64::min);
    for (i, part) in unknowns.into_iter().zip(parts) {
        free[i] = part > step || step == 1.0;
        x[i] = if free[i] {
            x[i] + step * (target[i] - x[i])
        } else {
            target[i].clamp(bounds[i][0], bounds[i][1])
        };
    }
    step == 1.0
}

/// The best values of the free unknowns, the others staying; none if their columns depend on each other.
fn solve(rows: &[Row], x: &[f64], free: &[bool]) -> Option<Vec<f64>> {
    let unknowns: Vec<usize> = (0..x.len()).filter(|i| free[*i]).collect();
    let mut rest: Vec<f64> = rows.iter().map(|(a, b)| b - held(a, x, free)).collect();
    let column = |i: &usize| rows.iter().map(|(a, _)| a[*i]).collect::<Vec<f64>>();
    let mut columns: Vec<Vec<f64>> = unknowns.iter().map(column).collect();
    let count = unknowns.len();
    let mut upper = vec![vec![0.0; count]; count];
    let mut projected = vec![0.0; count];
    for k in 0..count {
        let original = length(&column(&unknowns[k]));
        let size = length(&columns[k]);
        if size <= RANK_TOLERANCE * original || original == 0.0 {
            return None;
        }
        let unit: Vec<f64> = columns[k].iter().map(|a| a / size).collect();
        upper[k][k] = size;
        for j in k + 1..count {
            upper[k][j] = take_away(&unit, &mut columns[j]);
        }
        projected[k] = take_away(&unit, &mut rest);
    }
    let mut solution = x.to_vec();
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count)
            .map(|j| upper[k][j] * solution[unknowns[j]])
            .sum();
        solution[unknowns[k]] = (projected[k] - known) / upper[k][k];
    }
    Some(solution)
}

/// The part of a row that unknowns which are not free make up.
fn held(a: &[f64], x: &[f64], free: &[bool]) -> f64 {
    let parts = a.iter().zip(x).zip(free);
    parts
        .filter(|(_, free)| !**free)
        .map(|((a, x), _)| a * x)
        .sum()
}

/// Removes from `vector` its part along `unit`, and tells it.
fn take_away(unit: &[f64], vector: &mut [f64]) -> f64 {
    let part = dot(unit, vector);
    for (v, u) in vector.iter_mut().zip(unit) {
        *v -= part * u;
    }
    part
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UNIT: [f64; 2] = [0.0, 1.0];

    fn unique(rows: &[Row], bounds: &[[f64; 2]]) -> Vec<f64> {
        let solved = bounded(rows, bounds);
        assert!(solved.is_unique, "{rows:?}");
        solved.x
    }

    #[test]
    fn inside_the_bounds_equations_are_solved() {
        let rows = [(vec![1.0, 1.0], 1.0), (vec![1.0, -1.0], 0.5)];
        let x = unique(&rows, &[UNIT; 2]);
        assert!(
            (x[0] - 0.75).abs() < 1e-15 && (x[1] - 0.25).abs() < 1e-15,
            "{x:?}"
        );
    }

    #[test]
    fn a_bound_holds_what_wants_to_leave() {
        // x + y = 3 and x − y = 0: both want 1.5.
        let rows = [(vec![1.0, 1.0], 3.0), (vec![1.0, -1.0], 0.0)];
        assert_eq!(unique(&rows, &[UNIT; 2]), [1.0, 1.0]);
        assert_eq!(unique(&[(vec![1.0], -2.0)], &[UNIT]), [0.0]);
    }

    #[test]
    fn many_solutions_are_told() {
        let is_unique = |rows: &[Row]| bounded(rows, &[UNIT; 2]).is_unique;
        assert!(!is_unique(&[(vec![1.0, 2.0], 1.0)]));
        assert!(!is_unique(&[(vec![0.0, 1.0], 1.0)]));
        assert!(!is_unique(&[]));
        // Only at its bounds can an unreachable sum be nearest, so that this is one solution.
        assert_eq!(unique(&[(vec![1.0, 2.0], 9.0)], &[UNIT; 2]), [1.0, 1.0]);
    }

    proptest! {
        /// Planted answers inside the bounds are found; the error of a solution is that of rounding times the condition.
        #[test]
        fn planted_answers_are_found(
            matrix in proptest::array::uniform3(proptest::array::uniform3(-1.0..1.0_f64)),
            answer in proptest::array::uniform3(0.1..0.9_f64),
        ) {
            let row = |a: &[f64; 3]| (a.to_vec(), dot(a, &answer));
            let rows: Vec<Row> = matrix.iter().map(row).collect();
            let [[a, b, c], [d, e, f], [g, h, i]] = matrix;
            let determinant: f64 = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
            prop_assume!(determinant.abs() > 0.05);
            let x = unique(&rows, &[UNIT; 3]);
            for (x, answer) in x.iter().zip(answer) {
                prop_assert!((x - answer).abs() < 1e-10, "{:?}", x);
            }
        }

        /// At the solution no step inwards from a bound, and none of what is free, lowers the sum (Karush, Kuhn and Tucker).
        #[test]
        fn nothing_near_is_better(
            rows in proptest::collection::vec((proptest::collection::vec(-1.0..1.0_f64, 3), -3.0..3.0_f64), 5),
        ) {
            let bounds = [UNIT; 3];
            let x = unique(&rows, &bounds);
            let slope = gradient(&rows, &x);
            for i in 0..3 {
                prop_assert!((0.0..=1.0).contains(&x[i]));
                prop_assert!(slope[i] < 1e-9 || x[i] == 1.0, "{:?} {:?}", x, slope);
                prop_assert!(slope[i] > -1e-9 || x[i] == 0.0, "{:?} {:?}", x, slope);
            }
        }
    }
}
