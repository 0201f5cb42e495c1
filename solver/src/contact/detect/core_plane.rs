//! A rounded core and a flat wall: every corner below the wall is a contact point. Exact, with or without a crust.

use super::core_pair::{PlacedCore, Points};
use super::feature::{each_corner, rim_directions};
use crate::Vector;
use crate::boundary::Plane;
use crate::contact::Touch;
use crate::distance::Core;

/// Points of a rim that can touch a flat wall: the lowest, the highest and those between.
const RIM_POINTS: usize = 4;

/// Adds the contact points of a rounded core and a flat wall to a list.
pub fn core_plane(core: &PlacedCore<'_>, plane: &Plane, points: Points, touches: &mut Vec<Touch>) {
    let height_of_centre = plane.height(&core.pose.position);
    let rounded = core.rounded;
    if height_of_centre >= rounded.core.reach() + rounded.radius {
        return;
    }
    let downwards = core.pose.rotation.tr_mul(&-plane.normal);
    let start = touches.len();
    let touch = |corner: Vector| {
        // Heights are told from the body's own frame, so that turning the world does not change them by more than rounding.
        let overlap = rounded.radius + corner.dot(&downwards) - height_of_centre;
        (overlap > 0.0).then(|| {
            let from_centre = core.pose.rotation * corner + plane.normal * (0.5 * overlap - rounded.radius);
            let arm_of_first = core.pose.position - core.centre_of_body + from_centre;
            Touch { overlap, normal: -plane.normal, arm_of_first, arm_of_second: Vector::zeros(), is_deep: false }
        })
    };
    match &rounded.core {
        Core::Cylinder { radius, half_length } => {
            for direction in rim_directions::<RIM_POINTS>(&downwards) {
                for z in [-half_length, *half_length] {
                    touches.extend(touch(Vector::new(radius * direction[0], radius * direction[1], z)));
                }
            }
        }
        other => each_corner(other, &downwards, |corner| touches.extend(touch(corner))),
    }
    if points == Points::Deepest {
        keep_deepest(touches, start);
    }
}

/// Keeps the deepest of the contact points from a place on; the first of equal ones.
fn keep_deepest(touches: &mut Vec<Touch>, start: usize) {
    let deeper = |best: Touch, touch: &Touch| if touch.overlap > best.overlap { *touch } else { best };
    if let Some((first, others)) = touches[start..].split_first() {
        let deepest = others.iter().fold(*first, deeper);
        touches.truncate(start);
        touches.push(deepest);
    }
}
