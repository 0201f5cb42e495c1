//! Symplectic splitting of the free turn into elementary rotations about the body axes, in the order 1-2-3-2-1.
//!
//! The kinetic energy is a sum of three terms $L_k^2 / (2 I_k)$ in the body frame. Each alone turns the body about its axis $k$ at the
//! constant rate $L_k / I_k$; the symmetric product of the three is of second order, keeps the angular momentum in the world frame
//! *exactly* (it is not touched) and the energy without drift. The order 1-2-3-2-1 is part of the definition: others have other errors.
//! Sources: Miller et al. 2002 (NO_SQUISH), Dullweber, Leimkuhler and McLachlan 1997.

use nalgebra::Quaternion;

use super::RotationIntegrator;
use crate::{Orientation, Vector};

/// Second order, 1-2-3-2-1.
pub struct Splitting;

/// Fourth order: three symmetric second-order steps with the weights of Suzuki and Yoshida.
pub struct SplittingFourthOrder;

impl RotationIntegrator for Splitting {
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64) {
        split_turn(orientation, angular_momentum, inertia, step);
        // Rounding lets the norm of a quaternion wander as a random walk; one Newton step a turn keeps it at one.
        orientation.renormalize_fast();
    }

    fn name(&self) -> &'static str {
        "symplectic splitting 1-2-3-2-1"
    }
}

impl RotationIntegrator for SplittingFourthOrder {
    fn turn(&self, orientation: &mut Orientation, angular_momentum: &mut Vector, inertia: &Vector, step: f64) {
        let outer = 1.0 / (2.0 - 2.0_f64.cbrt());
        for weight in [outer, 1.0 - 2.0 * outer, outer] {
            split_turn(orientation, angular_momentum, inertia, weight * step);
        }
        orientation.renormalize_fast();
    }

    fn name(&self) -> &'static str {
        "symplectic splitting 1-2-3-2-1, fourth order"
    }
}

fn split_turn(orientation: &mut Orientation, angular_momentum: &Vector, inertia: &Vector, step: f64) {
    let mut momentum = orientation.inverse() * angular_momentum;
    let mut quaternion = *orientation.quaternion();
    for (axis, part) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
        turn_about(axis, part * step, inertia, &mut momentum, &mut quaternion);
    }
    *orientation = Orientation::new_unchecked(quaternion);
}

/// Turns the body about one of its axes at the rate that its momentum along that axis gives.
fn turn_about(axis: usize, time: f64, inertia: &Vector, momentum: &mut Vector, quaternion: &mut Quaternion<f64>) {
    let angle = time * momentum[axis] / inertia[axis];
    let (half_sine, half_cosine) = (0.5 * angle).sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    // Seen from the body, the momentum turns the other way.
    let (sine, cosine) = (2.0 * half_sine * half_cosine, 1.0 - 2.0 * half_sine * half_sine);
    let (along_next, along_last) = (momentum[next], momentum[last]);
    momentum[next] = cosine * along_next + sine * along_last;
    momentum[last] = cosine * along_last - sine * along_next;
    let mut turn = Quaternion::new(half_cosine, 0.0, 0.0, 0.0);
    turn.coords[axis] = half_sine;
    *quaternion *= turn;
}
