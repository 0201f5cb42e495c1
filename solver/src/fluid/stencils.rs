//! Differences of second order on fields with a border (R section 7.3.1); one value for each unknown.

use super::border::Border;

/// A velocity in m/s, border included.
pub type Velocity = [Vec<f64>; 3];

/// Divergence of a velocity in 1/s, cell by cell.
pub fn divergence(border: &Border, velocity: &Velocity) -> Vec<f64> {
    let (strides, spacing) = (border.strides(), border.grid().spacing());
    border.evaluate(None, |at| {
        (0..3).map(|direction| velocity[direction][at + strides[direction]] - velocity[direction][at]).sum::<f64>() / spacing
    })
}

/// Gradient along a direction of a pressure in Pa, in Pa/m, on faces.
pub fn gradient(border: &Border, pressure: &[f64], direction: usize) -> Vec<f64> {
    let (stride, spacing) = (border.strides()[direction], border.grid().spacing());
    border.evaluate(Some(direction), |at| (pressure[at] - pressure[at - stride]) / spacing)
}

/// Laplacian of a component of the velocity, in 1/(m s).
pub fn laplacian(border: &Border, component: usize, field: &[f64]) -> Vec<f64> {
    let (strides, square) = (border.strides(), border.grid().spacing().powi(2));
    border.evaluate(Some(component), |at| {
        strides.iter().map(|stride| field[at + stride] - 2.0 * field[at] + field[at - stride]).sum::<f64>() / square
    })
}

/// Rate $\nabla \cdot (u u_a)$ at which the flow carries component $a$ away, in m/s^2.
///
/// Central fluxes between faces. If the velocity has no divergence they neither make nor lose energy (Harlow and Welch 1965, Morinishi et al. 1998).
pub fn advection(border: &Border, velocity: &Velocity, component: usize) -> Vec<f64> {
    let (strides, spacing) = (border.strides(), border.grid().spacing());
    let carried = &velocity[component];
    let across = strides[component];
    let sum = |at: usize| {
        let mut sum = 0.0;
        for (carrier, stride) in velocity.iter().zip(strides) {
            let flux = |at: usize| (carrier[at] + carrier[at - across]) * (carried[at] + carried[at - stride]);
            sum += flux(at + stride) - flux(at);
        }
        0.25 * sum / spacing
    };
    border.evaluate(Some(component), sum)
}

/// Largest sum over the directions of the speeds across a cell in 1/s: times a time step, the Courant number.
pub fn crossing_rate(border: &Border, velocity: &Velocity) -> f64 {
    let strides = border.strides();
    let at_cell = |at: usize| {
        (0..3).map(|direction| velocity[direction][at].abs().max(velocity[direction][at + strides[direction]].abs())).sum::<f64>()
    };
    let largest = border
        .evaluate(None, at_cell)
        .into_iter()
        .fold(0.0, |largest, speed| if speed > largest || speed.is_nan() { speed } else { largest });
    largest / border.grid().spacing()
}
