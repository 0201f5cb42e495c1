//! Values between the values of a grid, from polynomials of the first or second degree in each direction.

use crate::Vector;
use crate::fluid::grid::Grid;

/// The degree of an interpolation in each direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Degree {
    /// The two values around (multilinear, R section 7.3.4).
    Linear,
    /// Those and the next one outwards: the stencil reaches away from the body (Q2 of R section 7.3.4).
    QuadraticOutward,
}

/// One value of a field and its weight.
pub type Weighted = (u32, f64);

/// Adds the values that make up a component of the velocity at a point, times a factor. `outward` tells in which octant the stencil may reach further.
pub fn add_stencil(
    grid: &Grid,
    component: usize,
    point: &Vector,
    outward: &Vector,
    degree: Degree,
    factor: f64,
    stencil: &mut Vec<Weighted>,
) {
    let place = grid.in_cells(Some(component), point);
    let along = |direction: usize| {
        let floor = place[direction].floor();
        match degree {
            Degree::Linear => (floor as isize, linear(place[direction] - floor)),
            Degree::QuadraticOutward => {
                let first = if outward[direction] >= 0.0 { floor } else { floor - 1.0 };
                (first as isize, quadratic(place[direction] - first))
            }
        }
    };
    let [(i, of_i), (j, of_j), (k, of_k)] = [along(0), along(1), along(2)];
    for (step_k, weight_k) in of_k.iter().enumerate() {
        for (step_j, weight_j) in of_j.iter().enumerate() {
            for (step_i, weight_i) in of_i.iter().enumerate() {
                let weight = factor * weight_i * weight_j * weight_k;
                if weight != 0.0 {
                    stencil.push((grid.index_around([i + step_i as isize, j + step_j as isize, k + step_k as isize]) as u32, weight));
                }
            }
        }
    }
}

fn linear(place: f64) -> [f64; 3] {
    [1.0 - place, place, 0.0]
}

/// Lagrange's polynomials on 0, 1, 2.
fn quadratic(place: f64) -> [f64; 3] {
    [0.5 * (place - 1.0) * (place - 2.0), place * (2.0 - place), 0.5 * place * (place - 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fluid::grid::FaceField;

    fn grid() -> Grid {
        Grid::new([12, 12, 12], 0.25, Vector::new(-1.0, 0.5, 0.0)).expect("enough cells")
    }

    const POINT: [f64; 3] = [0.47, 2.11, 1.36];

    fn stencil(component: usize, outward: [f64; 3], degree: Degree) -> Vec<Weighted> {
        let mut stencil = Vec::new();
        add_stencil(&grid(), component, &Vector::from(POINT), &Vector::from(outward), degree, 1.0, &mut stencil);
        stencil
    }

    fn interpolated(field: &FaceField, component: usize, stencil: &[Weighted]) -> f64 {
        stencil.iter().map(|(index, weight)| weight * field.component[component][*index as usize]).sum()
    }

    #[test]
    fn polynomials_of_their_degree_are_met_exactly() {
        let linear = |place: &Vector| (1.0 + 0.3 * place.x) * (2.0 - place.y) * (0.4 + place.z);
        let quadratic = |place: &Vector| linear(place) * (1.0 - 0.2 * place.x) * (0.5 + 0.7 * place.y) * (place.z - 0.3);
        let point = Vector::from(POINT);
        for component in 0..3 {
            for outward in [[1.0, 1.0, 1.0], [-1.0, 0.3, -0.2], [0.0, -0.9, 0.1]] {
                let field = FaceField::from_fn(&grid(), |_, place| linear(&place));
                let got = interpolated(&field, component, &stencil(component, outward, Degree::Linear));
                assert!((got - linear(&point)).abs() < 1e-13, "{got}");
                let field = FaceField::from_fn(&grid(), |_, place| quadratic(&place));
                let got = interpolated(&field, component, &stencil(component, outward, Degree::QuadraticOutward));
                assert!((got - quadratic(&point)).abs() < 1e-13, "{got}");
            }
        }
    }

    #[test]
    fn a_quadratic_stencil_reaches_outwards_alone() {
        let grid = grid();
        for outward in [[1.0, 1.0, 1.0], [-1.0, 0.3, -0.2]] {
            for (index, _) in stencil(0, outward, Degree::QuadraticOutward) {
                let place = grid.position(Some(0), grid.cell(index as usize).map(|number| number as isize));
                for direction in 0..3 {
                    let reach = (place[direction] - POINT[direction]) / grid.spacing() * if outward[direction] < 0.0 { -1.0 } else { 1.0 };
                    assert!(reach > -1.0 && reach <= 2.0, "{reach}");
                }
            }
        }
    }
}
