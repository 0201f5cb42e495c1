//! Pockets of cells closed in by forced faces: their pressure is free, so forces that only change it do nothing.

use std::collections::HashMap;

use crate::fluid::grid::Grid;

/// Forces that no velocity feels, as an orthogonal complement to project on.
///
/// Cells are joined through faces whose velocity is not forced. Every component of them but the largest is a pocket, and the forces on its rim that equal the
/// gradient of its indicator are balanced by a constant pressure in it.
#[derive(Debug, Clone, Default)]
pub struct Pockets {
    /// For each pocket, the forces on its rim with their sign.
    rims: Vec<Vec<(u32, f64)>>,
    /// Inverse of the products of rims with each other.
    inverse: Option<nalgebra::Cholesky<f64, nalgebra::Dyn>>,
}

impl Pockets {
    /// Finds the pockets. `force_on` tells the number of the force on each face of each component, if there is one.
    pub fn new(grid: &Grid, force_on: &[Vec<Option<u32>>; 3]) -> Pockets {
        let component = components(grid, force_on);
        let mut size: HashMap<u32, u32> = HashMap::new();
        for root in &component {
            *size.entry(*root).or_default() += 1;
        }
        // The largest, and of equal ones the first, so that the choice does not depend on the order of a hash map.
        let largest = size.iter().max_by_key(|(root, size)| (**size, std::cmp::Reverse(**root))).map(|(root, _)| *root);
        let mut number: HashMap<u32, usize> = HashMap::new();
        let mut rims: Vec<Vec<(u32, f64)>> = Vec::new();
        for (direction, forces) in force_on.iter().enumerate() {
            for (index, force) in forces.iter().enumerate() {
                let Some(force) = force else { continue };
                let before = grid.neighbour(grid.cell(index), direction, -1);
                if component[index] == component[before] {
                    continue;
                }
                for (root, sign) in [(component[index], 1.0), (component[before], -1.0)] {
                    if Some(root) != largest {
                        let pocket = *number.entry(root).or_insert(rims.len());
                        if pocket == rims.len() {
                            rims.push(Vec::new());
                        }
                        rims[pocket].push((*force, sign));
                    }
                }
            }
        }
        let inverse = nalgebra::Cholesky::new(products(&rims));
        Pockets { rims, inverse }
    }

    /// Number of pockets.
    pub fn len(&self) -> usize {
        self.rims.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rims.is_empty()
    }

    /// Takes from forces the part that pockets' pressures balance.
    pub fn project(&self, forces: &mut [f64]) {
        let Some(inverse) = self.inverse.as_ref().filter(|_| !self.is_empty()) else { return };
        let along = self.rims.iter().map(|rim| rim.iter().map(|(force, sign)| sign * forces[*force as usize]).sum::<f64>());
        let pressures = inverse.solve(&nalgebra::DVector::from_iterator(self.len(), along));
        for (rim, pressure) in self.rims.iter().zip(&pressures) {
            for (force, sign) in rim {
                forces[*force as usize] -= sign * pressure;
            }
        }
    }
}

/// A name for each cell that it shares with all cells joined to it.
fn components(grid: &Grid, force_on: &[Vec<Option<u32>>; 3]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..grid.len() as u32).collect();
    for (direction, forces) in force_on.iter().enumerate() {
        for (index, force) in forces.iter().enumerate() {
            if force.is_none() {
                let before = grid.neighbour(grid.cell(index), direction, -1);
                let (one, other) = (root(&mut parent, index as u32), root(&mut parent, before as u32));
                parent[one.max(other) as usize] = one.min(other);
            }
        }
    }
    (0..grid.len() as u32).map(|index| root(&mut parent, index)).collect()
}

fn root(parent: &mut [u32], mut index: u32) -> u32 {
    while parent[index as usize] != index {
        parent[index as usize] = parent[parent[index as usize] as usize];
        index = parent[index as usize];
    }
    index
}

fn products(rims: &[Vec<(u32, f64)>]) -> nalgebra::DMatrix<f64> {
    let mut of_force: HashMap<u32, Vec<(usize, f64)>> = HashMap::new();
    for (pocket, rim) in rims.iter().enumerate() {
        for (force, sign) in rim {
            of_force.entry(*force).or_default().push((pocket, *sign));
        }
    }
    let mut products = nalgebra::DMatrix::zeros(rims.len(), rims.len());
    // Whole numbers: their sum does not depend on the order.
    for shared in of_force.values() {
        for (one, sign) in shared {
            for (other, other_sign) in shared {
                products[(*one, *other)] += sign * other_sign;
            }
        }
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vector;
    use crate::fluid::grid::FaceField;
    use crate::fluid::periodic::PeriodicBox;

    /// Forces on all faces of some blocks of cells, given by their lower and upper corners.
    fn walled(grid: &Grid, blocks: &[[[usize; 3]; 2]]) -> [Vec<Option<u32>>; 3] {
        let holder = |cell: [usize; 3]| blocks.iter().position(|[lower, upper]| (0..3).all(|a| (lower[a]..upper[a]).contains(&cell[a])));
        let mut count = 0;
        std::array::from_fn(|direction| {
            let is_wall = |index: usize| {
                let before = grid.cell(grid.neighbour(grid.cell(index), direction, -1));
                holder(grid.cell(index)) != holder(before)
            };
            let mut numbered = |index: usize| {
                is_wall(index).then(|| {
                    count += 1;
                    count - 1
                })
            };
            (0..grid.len()).map(&mut numbered).collect()
        })
    }

    fn count(force_on: &[Vec<Option<u32>>; 3]) -> usize {
        force_on.iter().flatten().flatten().count()
    }

    #[test]
    fn no_flow_feels_what_is_projected_away_and_nothing_else_is() {
        let grid = Grid::new([8, 9, 10], 0.5, Vector::zeros()).expect("enough cells");
        // Two blocks side by side share walls, a third lies across the sides of the box.
        let blocks = [[[1, 1, 1], [3, 4, 3]], [[3, 1, 1], [5, 4, 2]], [[6, 6, 8], [8, 9, 10]]];
        let force_on = walled(&grid, &blocks);
        let pockets = Pockets::new(&grid, &force_on);
        assert_eq!(pockets.len(), 3);
        let forces: Vec<f64> = (0..count(&force_on)).map(|number| (1.3 * number as f64).sin()).collect();
        let mut projected = forces.clone();
        pockets.project(&mut projected);
        let taken: Vec<f64> = forces.iter().zip(&projected).map(|(all, kept)| all - kept).collect();
        let mut again = projected.clone();
        pockets.project(&mut again);
        assert!(again.iter().zip(&projected).all(|(again, once)| (again - once).abs() < 1e-13), "a second projection changes something");
        let respond = |forces: &[f64]| {
            let mut field = FaceField::zeros(&grid);
            for (direction, numbers) in force_on.iter().enumerate() {
                for (index, number) in numbers.iter().enumerate() {
                    field.component[direction][index] = number.map_or(0.0, |number| forces[number as usize]);
                }
            }
            PeriodicBox::new(grid).solve_stokes(&mut field, 1.0, 0.0, Vector::zeros());
            field.component.iter().flatten().fold(0.0, |largest: f64, value| largest.max(value.abs()))
        };
        assert!(taken.iter().any(|force| force.abs() > 0.1));
        assert!(respond(&taken) < 1e-13 && respond(&projected) > 1e-2, "{} {}", respond(&taken), respond(&projected));
    }

    #[test]
    fn an_open_wall_holds_no_pocket() {
        let grid = Grid::new([8, 9, 10], 0.5, Vector::zeros()).expect("enough cells");
        let mut force_on = walled(&grid, &[[[1, 1, 1], [4, 4, 4]]]);
        force_on[0][grid.index([1, 2, 2])] = None;
        assert!(Pockets::new(&grid, &force_on).is_empty());
    }
}
