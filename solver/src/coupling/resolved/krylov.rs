//! Krylov methods for operators that are only known by what they do: GMRES (Saad and Schultz 1986), preconditioned from the right, and conjugate gradients.

use crate::fluid::operators::dot;

/// What a solver found.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// The solution.
    pub solution: Vec<f64>,
    /// Applications of the operator.
    pub iterations: usize,
    /// Norm of the residual over that of the right side.
    pub residual: f64,
}

fn add_scaled(onto: &mut [f64], factor: f64, vector: &[f64]) {
    for (value, other) in onto.iter_mut().zip(vector) {
        *value += factor * other;
    }
}

/// Solves $A M y = b$ without restart and returns $M y$: at most `most` applications, until the residual is `tolerance` of the right side.
pub fn gmres(
    operator: impl Fn(&[f64]) -> Vec<f64>,
    precondition: impl Fn(&[f64]) -> Vec<f64>,
    right: &[f64],
    tolerance: f64,
    most: usize,
) -> Solved {
    let size = dot(right, right).sqrt();
    if size == 0.0 {
        return Solved { solution: vec![0.0; right.len()], iterations: 0, residual: 0.0 };
    }
    let mut basis = vec![right.iter().map(|value| value / size).collect::<Vec<f64>>()];
    let mut triangle = Triangle { columns: Vec::new(), turns: Vec::new(), right: vec![size] };
    while triangle.columns.len() < most && triangle.residual() > tolerance * size {
        let mut next = operator(&precondition(&basis[triangle.columns.len()]));
        let mut column = Vec::with_capacity(basis.len() + 1);
        for vector in &basis {
            let along = dot(&next, vector);
            add_scaled(&mut next, -along, vector);
            column.push(along);
        }
        let length = dot(&next, &next).sqrt();
        triangle.push(column, length);
        if length == 0.0 {
            break;
        }
        basis.push(next.iter().map(|value| value / length).collect());
    }
    let mut combined = vec![0.0; right.len()];
    for (vector, factor) in basis.iter().zip(triangle.solve()) {
        add_scaled(&mut combined, factor, vector);
    }
    Solved { solution: precondition(&combined), iterations: triangle.columns.len(), residual: triangle.residual() / size }
}

/// Solves $A x = b$ for symmetric positive definite operators and preconditioners: at most `most` applications, until the residual is `tolerance` of the right side.
pub fn conjugate_gradients(
    operator: impl Fn(&[f64]) -> Vec<f64>,
    precondition: impl Fn(&[f64]) -> Vec<f64>,
    right: &[f64],
    tolerance: f64,
    most: usize,
) -> Solved {
    let size = dot(right, right).sqrt();
    let mut solved = Solved { solution: vec![0.0; right.len()], iterations: 0, residual: if size > 0.0 { 1.0 } else { 0.0 } };
    let mut residual = right.to_vec();
    let mut direction = vec![0.0; right.len()];
    let mut last = f64::INFINITY;
    while solved.iterations < most && solved.residual > tolerance {
        let steepest = precondition(&residual);
        let product = dot(&residual, &steepest);
        direction.iter_mut().zip(&steepest).for_each(|(along, steepest)| *along = steepest + product / last * *along);
        last = product;
        let response = operator(&direction);
        let length = product / dot(&direction, &response);
        add_scaled(&mut solved.solution, length, &direction);
        add_scaled(&mut residual, -length, &response);
        solved.iterations += 1;
        solved.residual = dot(&residual, &residual).sqrt() / size;
    }
    solved
}

/// The least-squares problem of GMRES, kept triangular by Givens rotations.
struct Triangle {
    columns: Vec<Vec<f64>>,
    turns: Vec<(f64, f64)>,
    right: Vec<f64>,
}

impl Triangle {
    fn residual(&self) -> f64 {
        self.right.last().map_or(0.0, |value| value.abs())
    }

    fn push(&mut self, mut column: Vec<f64>, below: f64) {
        let last = column.len() - 1;
        for (row, (cosine, sine)) in self.turns.iter().enumerate() {
            let (upper, lower) = (column[row], column[row + 1]);
            column[row] = cosine * upper + sine * lower;
            column[row + 1] = cosine * lower - sine * upper;
        }
        let length = column[last].hypot(below);
        let (cosine, sine) = if length > 0.0 { (column[last] / length, below / length) } else { (1.0, 0.0) };
        column[last] = length;
        let value = self.right[last];
        self.right[last] = cosine * value;
        self.right.push(-sine * value);
        self.turns.push((cosine, sine));
        self.columns.push(column);
    }

    fn solve(&self) -> Vec<f64> {
        let mut solution = vec![0.0; self.columns.len()];
        for row in (0..self.columns.len()).rev() {
            let later: f64 = (row + 1..self.columns.len()).map(|column| self.columns[column][row] * solution[column]).sum();
            solution[row] = (self.right[row] - later) / self.columns[row][row];
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Not symmetric, with a wide spread of sizes.
    fn operator(vector: &[f64]) -> Vec<f64> {
        let length = vector.len();
        (0..length)
            .map(|row| (row + 1) as f64 * vector[row] + 0.7 * vector[(row + 1) % length] - 0.2 * vector[(row + 7) % length])
            .collect()
    }

    #[test]
    fn gmres_solves_what_is_not_symmetric() {
        let wanted: Vec<f64> = (0..60).map(|row| (row as f64 * 0.7).sin()).collect();
        let right = operator(&wanted);
        for scale in [1.0, 1e-30] {
            let right: Vec<f64> = right.iter().map(|value| value * scale).collect();
            let scaled = |residual: &[f64]| residual.iter().enumerate().map(|(row, value)| value / (row + 1) as f64).collect::<Vec<f64>>();
            let solved = gmres(operator, scaled, &right, 1e-13, 60);
            assert!(solved.iterations < 30);
            assert!(solved.residual < 1e-13);
            for (got, wanted) in solved.solution.iter().zip(&wanted) {
                // The residual, of a right side of norm 200, over the least singular value.
                assert!((got - wanted * scale).abs() < 5e-11 * scale);
            }
        }
    }

    #[test]
    fn conjugate_gradients_solve_what_is_symmetric() {
        let symmetric = |vector: &[f64]| {
            let last = vector.len() - 1;
            let beside = |row: usize| if row > 0 { vector[row - 1] } else { 0.0 } + if row < last { vector[row + 1] } else { 0.0 };
            (0..=last).map(|row| (row + 2) as f64 * vector[row] - 0.9 * beside(row)).collect::<Vec<f64>>()
        };
        let wanted: Vec<f64> = (0..200).map(|row| (row as f64 * 0.7).cos()).collect();
        let scaled = |residual: &[f64]| residual.iter().enumerate().map(|(row, value)| value / (row + 2) as f64).collect::<Vec<f64>>();
        let solved = conjugate_gradients(symmetric, scaled, &symmetric(&wanted), 1e-14, 60);
        assert!(solved.iterations < 40 && solved.residual <= 1e-14);
        assert!(solved.solution.iter().zip(&wanted).all(|(got, wanted)| (got - wanted).abs() < 1e-12));
    }

    #[test]
    fn nothing_asked_gives_nothing() {
        let nothing = Solved { solution: vec![0.0; 8], iterations: 0, residual: 0.0 };
        assert_eq!(gmres(operator, <[f64]>::to_vec, &[0.0; 8], 1e-12, 10), nothing);
        assert_eq!(conjugate_gradients(operator, <[f64]>::to_vec, &[0.0; 8], 1e-12, 10), nothing);
    }
}
