//! The setups: which pairs are asked for their distance, in which poses, and how.

use super::kinds::Kind;
use super::poses::{TOUCHES, Touch};
use crate::case::Tier;

/// How a pair is asked for its distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mode {
    /// From no guess.
    Cold,
    /// From what a look a step before has left.
    Warm,
    /// By the search for corners alone.
    SearchAlone,
    /// By parry.
    Parry,
    /// With a crust of a fraction of the inner radius, against the sharp shapes.
    Crust(Crust),
    /// Touching in a special way.
    Touch(Touch),
    /// Far from the origin.
    FarAway,
}

/// How room for a crust is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crust {
    /// By moving all faces inwards.
    Even,
    /// By shrinking the shape.
    Ratio,
}

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    pub kinds: [Kind; 2],
    pub mode: Mode,
    /// Random pairs, or random turns of each touch.
    pub pairs: usize,
    /// How often each pair is asked once more, for the cost.
    pub repeats: usize,
}

const FEW: usize = 250;
const MANY: usize = 1_000_000;
/// Of superellipsoids, which take longer; those with each other are asked in `vertex_refinement`.
const MANY_SMOOTH: usize = 100_000;
const REPEATS: usize = 12;
const TURNS: usize = 20;

/// All setups, in the order of pages.
fn variants() -> Vec<Variant> {
    use Kind::{Coin, Cube, Cylinder, Ellipsoid, Icosahedron, Pebble, Rod, Sphere, Spherocylinder, Tetrahedron};
    let random = |mode, kinds: &[[Kind; 2]]| -> Vec<Variant> {
        kinds.iter().map(|kinds| Variant { kinds: *kinds, mode, pairs: FEW, repeats: REPEATS }).collect()
    };
    let once = |mode, kinds: &[[Kind; 2]]| random(mode, kinds).into_iter().map(|variant| Variant { repeats: 0, ..variant });
    let mut all = random(
        Mode::Cold,
        &[
            [Cube, Cube],
            [Cylinder, Cylinder],
            [Rod, Rod],
            [Coin, Coin],
            [Rod, Coin],
            [Cube, Cylinder],
            [Icosahedron, Icosahedron],
            [Tetrahedron, Cylinder],
            [Spherocylinder, Cube],
            [Spherocylinder, Spherocylinder],
            [Sphere, Cylinder],
            [Sphere, Icosahedron],
            [Cube, Pebble],
            [Cylinder, Pebble],
            [Spherocylinder, Pebble],
            [Icosahedron, Ellipsoid],
        ],
    );
    all.extend(random(Mode::Warm, &[[Cube, Cube], [Cylinder, Cylinder], [Cube, Cylinder], [Icosahedron, Icosahedron]]));
    all.extend(random(Mode::SearchAlone, &[[Cylinder, Cylinder]]));
    all.extend(random(Mode::Parry, &[[Cube, Cube], [Cylinder, Cylinder]]));
    all.extend(once(Mode::Crust(Crust::Even), &[[Cube, Cube], [Cylinder, Cylinder], [Rod, Rod]]));
    all.extend(once(Mode::Crust(Crust::Ratio), &[[Cube, Cube], [Cylinder, Cylinder], [Rod, Rod]]));
    all.extend(once(Mode::FarAway, &[[Cube, Cube], [Cylinder, Cylinder], [Spherocylinder, Icosahedron]]));
    all.extend(TOUCHES.map(|touch| Variant { kinds: [touch.first, touch.second], mode: Mode::Touch(touch), pairs: TURNS, repeats: 0 }));
    for (place, first) in Kind::ALL.into_iter().enumerate() {
        all.extend(Kind::ALL[place..].iter().map(|second| {
            let pairs = if first.is_superellipsoid() || second.is_superellipsoid() { MANY_SMOOTH } else { MANY };
            Variant { kinds: [first, *second], mode: Mode::Cold, pairs, repeats: 0 }
        }));
    }
    all
}

impl crate::variant::Variant for Variant {
    fn all() -> Vec<Variant> {
        variants()
    }

    fn label(&self) -> String {
        let pair = format!("{} and {}", self.kinds[0].name(), self.kinds[1].name());
        let how = match self.mode {
            Mode::Cold if self.pairs == MANY => "a million pairs, worst of each thousand",
            Mode::Cold if self.pairs == MANY_SMOOTH => "a hundred thousand pairs, worst of each thousand",
            Mode::Cold => "cold",
            Mode::Warm => "warm",
            Mode::SearchAlone => "search alone, no polish",
            Mode::Parry => "by parry",
            Mode::Crust(Crust::Even) => "even crust (default)",
            Mode::Crust(Crust::Ratio) => "shrunk by a ratio (source)",
            Mode::FarAway => "far from the origin",
            Mode::Touch(touch) => return format!("touch: {}", touch.name),
        };
        format!("{pair}, {how}")
    }

    fn knob_name(&self) -> &'static str {
        match self.mode {
            Mode::Crust(_) => "crust_over_inner_radius",
            Mode::FarAway => "offset_over_size",
            _ => "size_m",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match self.mode {
            Mode::Crust(_) => vec![0.2, 0.1, 0.05, 0.02],
            Mode::FarAway => vec![1.0, 1e3, 1e6],
            _ if self.pairs < MANY_SMOOTH => vec![1e-6, 1e-3, 1.0, 1e3],
            _ if tier == Tier::Quick => Vec::new(),
            _ => vec![1.0],
        }
    }
}
