//! Classes of bodies that contacts tell apart, and examples of each for errors and time scales.

use crate::Bodies;
use crate::contact::pairs::Candidate;
use crate::domain::Image;
use crate::shape::{Convex, Shape};

/// What contacts must know of a shape to choose their kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A ball whose moments of inertia are equal.
    EvenSphere,
    /// A ball whose moments of inertia are not.
    UnevenSphere,
    /// With a superellipsoid among its parts.
    Smooth,
    /// Any other.
    Edged,
}

/// Bodies of one material and one kind.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Class {
    pub(super) material: usize,
    pub(super) kind: Kind,
    /// Bodies that differ in nothing that time scales depend on.
    alike: Vec<Alike>,
    bodies: usize,
}

/// Bodies of the same size, mass and inertia.
#[derive(Debug, Clone, PartialEq)]
struct Alike {
    numbers: [u64; 5],
    /// Storage indices of up to two of them.
    examples: Vec<usize>,
}

/// Above this many sizes in a class, time scales are looked at for the lightest and the heaviest only.
const SIZES_LOOKED_AT: usize = 24;

/// All classes, and the class of each body by its storage index.
pub(super) fn classes_of(bodies: &Bodies) -> (Vec<Class>, Vec<usize>) {
    let kinds: Vec<Kind> = bodies.shapes().iter().map(|shape| kind_of_shape(shape)).collect();
    let mut classes: Vec<Class> = Vec::new();
    let mut known = std::collections::HashMap::new();
    let class_of_bodies = (0..bodies.len()).map(|index| {
        let kind = match kinds[bodies.shape_index(index)] {
            Kind::EvenSphere if !bodies.is_isotropic(index) => Kind::UnevenSphere,
            kind => kind,
        };
        let material = bodies.material(index);
        let found = classes.iter().position(|class| class.material == material && class.kind == kind);
        let place = found.unwrap_or_else(|| {
            classes.push(Class { material, kind, alike: Vec::new(), bodies: 0 });
            classes.len() - 1
        });
        let inertia = bodies.inertia(index);
        let numbers = [bodies.mass(index), bodies.state.motion[index].radius, inertia.x, inertia.y, inertia.z].map(f64::to_bits);
        let class = &mut classes[place];
        class.bodies += 1;
        let group = *known.entry((place, numbers)).or_insert_with(|| {
            class.alike.push(Alike { numbers, examples: Vec::new() });
            class.alike.len() - 1
        });
        let examples = &mut class.alike[group].examples;
        if examples.len() < 2 {
            examples.push(index);
        }
        place
    });
    let class_of_bodies = class_of_bodies.collect();
    for class in &mut classes {
        // Bits of numbers above zero are in the order of the numbers.
        class.alike.sort_by_key(|alike| alike.numbers);
        if class.alike.len() > SIZES_LOOKED_AT {
            let heaviest = class.alike.pop();
            class.alike.truncate(SIZES_LOOKED_AT - 1);
            class.alike.extend(heaviest);
        }
    }
    (classes, class_of_bodies)
}

impl Class {
    /// Whether two of its bodies, or one and its own image, can meet.
    pub(super) fn meets_itself(&self, is_periodic: bool) -> bool {
        self.bodies > 1 || is_periodic
    }

    /// A body of each size.
    fn sizes(&self) -> impl Iterator<Item = usize> {
        self.alike.iter().filter_map(|alike| alike.examples.first().copied())
    }

    /// Pairs of a body of this class and one of another, or of this one again, for each two sizes, as far as there are two such bodies; the lower id first.
    pub(super) fn pairs_with<'a>(&'a self, other: &'a Class, bodies: &'a Bodies, laws: usize) -> impl Iterator<Item = Candidate> + 'a {
        let is_same = std::ptr::eq(self, other);
        let pair = move |one: usize, other: usize| match bodies.id(one) <= bodies.id(other) {
            true => Candidate::of_bodies(one, other, laws, Image::SAME),
            false => Candidate::of_bodies(other, one, laws, Image::SAME),
        };
        let (mine, others) = (self.alike.iter().enumerate(), &other.alike);
        mine.flat_map(move |(place, alike)| {
            let skipped = if is_same { place } else { 0 };
            others.iter().enumerate().skip(skipped).filter_map(move |(other_place, other)| {
                let one = *alike.examples.first()?;
                let is_same_size = is_same && place == other_place;
                if is_same_size && other.examples.len() < 2 && self.bodies > 1 {
                    return None;
                }
                // One body alone in its class meets its own image.
                let partner = if is_same_size { other.examples.last() } else { other.examples.first() };
                Some(pair(one, *partner?))
            })
        })
    }

    /// A body of each size at a wall.
    pub(super) fn at_wall(&self, wall: usize, laws: usize) -> impl Iterator<Item = Candidate> {
        self.sizes().map(move |body| Candidate::at_wall(body, wall, laws))
    }
}

fn kind_of_shape(shape: &Shape) -> Kind {
    if shape.as_sphere().is_some() {
        return Kind::EvenSphere;
    }
    let is_smooth = shape.parts().iter().any(|part| matches!(part.convex, Convex::Superellipsoid(_)));
    if is_smooth { Kind::Smooth } else { Kind::Edged }
}
