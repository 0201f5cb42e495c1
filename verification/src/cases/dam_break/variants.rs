//! The setups: what each column is, what is swept, how many random fillings it has.

use super::setting::{Column, Friction, Gate, Grains};
use crate::case::Tier;
use crate::variant::Variant;

/// Length of R's smallest column in diameters: 25 mm.
const SIZE_ONE: f64 = 25.0 / 3.0;
/// R's width of half a metre in diameters.
const WIDTH_OF_R: f64 = 500.0 / 3.0;
/// Width of slices in diameters where nothing else is said.
const SLICE: f64 = 10.0;
/// Aspect ratio at which friction, gate and width are varied.
const TWO: f64 = 2.0;
/// That of the quick tier: cheap, for a low column falls for a short time only.
pub(super) const LOW: f64 = 0.4;
/// R's aspect ratio.
pub(super) const OF_R: f64 = 7.3;
/// Fillings at the quick and the standard tier.
const FEW: u64 = 3;
const SEVERAL: u64 = 5;
const MANY: u64 = 20;
/// Columns of more grains have few fillings.
const LARGE: u32 = 4000;

/// One setup.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Setting {
    /// Five diameters long.
    Short,
    /// Thirteen diameters long: some 1200 grains.
    Long,
    /// The same, many times over.
    LongOften,
    /// Spheres, as long as R's size 1.
    Sweep,
    Icosahedra,
    /// A slice of R's size 1.
    SliceOfR,
    Width,
    /// Against a column of half the size.
    Size,
    GrainFriction,
    WallFriction,
    Rolling,
    Stiffness,
    LiftedGate,
    ViscousFriction,
    /// R's own columns.
    SizesOfR,
    Lube,
    StaronHinch,
}

use Setting::{
    GrainFriction, Icosahedra, LiftedGate, Long, LongOften, Lube, Rolling, Short, Size, SizesOfR, SliceOfR, StaronHinch, Stiffness, Sweep,
    ViscousFriction, WallFriction, Width,
};

impl Variant for Setting {
    fn all() -> Vec<Setting> {
        vec![
            Short,
            Long,
            LongOften,
            Sweep,
            Icosahedra,
            SliceOfR,
            Width,
            Size,
            GrainFriction,
            WallFriction,
            Rolling,
            Stiffness,
            LiftedGate,
            ViscousFriction,
            SizesOfR,
            Lube,
            StaronHinch,
        ]
    }

    fn label(&self) -> String {
        match self {
            Short => "spheres, 5 diameters long and 10 wide",
            Long => "spheres, 13 diameters long and 16 wide",
            LongOften => "spheres, 13 diameters long and 16 wide, 20 fillings",
            Sweep => "spheres, 8.3 diameters long",
            Icosahedra => "icosahedra, 8.3 diameters long",
            SliceOfR => "icosahedra, R's size 1 in a slice 20 diameters wide",
            Width => "spheres, a = 2, width of the slice",
            Size => "spheres, a = 2, size of the column",
            GrainFriction => "spheres, a = 2, friction of grains",
            WallFriction => "spheres, a = 2, friction of floor and wall",
            Rolling => "spheres, a = 2, rolling friction",
            Stiffness => "spheres, a = 1, stiffness over the softened one",
            LiftedGate => "spheres, a = 2, gate lifted",
            ViscousFriction => "spheres, a = 2, viscous friction as R",
            SizesOfR => "icosahedra, R's sizes, width and stiffness",
            Lube => "law of Lube et al. 2005",
            StaronHinch => "law of Staron and Hinch 2005",
        }
        .into()
    }

    fn knob_name(&self) -> &'static str {
        match self {
            Short | Long | LongOften | Sweep | Icosahedra | SliceOfR | Lube | StaronHinch => "aspect_ratio",
            Width => "width_in_diameters",
            Size => "length_in_diameters",
            GrainFriction | WallFriction => "friction",
            Rolling => "rolling_friction",
            Stiffness => "stiffening",
            LiftedGate => "speed_over_root_gH",
            ViscousFriction => "damping_rate_per_s",
            SizesOfR => "size",
        }
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        let standard = |values: &[f64]| if tier == Tier::Quick { Vec::new() } else { values.to_vec() };
        match self {
            Short => vec![1.0],
            Long => vec![LOW],
            LongOften => standard(&[LOW]),
            Sweep => standard(&[0.5, 1.0, 2.0, 4.0, OF_R, 10.0]),
            Icosahedra => standard(&[0.5, 1.0, 2.0]),
            SliceOfR => standard(&[OF_R]),
            Width => standard(&[5.0, 10.0, 20.0]),
            Size => standard(&[10.0, 50.0 / 3.0]),
            GrainFriction | WallFriction => standard(&[0.1, 0.2, 0.4, 0.8]),
            Rolling => standard(&[0.01, 0.05, 0.2, 0.4]),
            Stiffness => standard(&[0.25, 1.0, 4.0, 16.0]),
            LiftedGate => standard(&[0.5, 1.0, 2.0, 4.0]),
            ViscousFriction => standard(&[100.0, 1000.0, 10_000.0]),
            SizesOfR if tier == Tier::Paper => vec![1.0, 2.0, 3.0, 4.0, 5.0],
            SizesOfR => Vec::new(),
            Lube | StaronHinch => standard(&[0.5, 1.0, 2.0, 4.0, OF_R, 10.0]),
        }
    }
}

impl Setting {
    /// The column of a value of the knob; none for a law.
    pub(super) fn column(self, knob: f64) -> Option<Column> {
        let two = Column::of_spheres(SIZE_ONE, TWO, SLICE);
        Some(match self {
            Short => Column::of_spheres(5.0, knob, 10.0),
            Long | LongOften => Column::of_spheres(13.0, knob, 16.0),
            Sweep => Column::of_spheres(SIZE_ONE, knob, SLICE),
            Icosahedra => Column { grains: Grains::Icosahedra, ..Column::of_spheres(SIZE_ONE, knob, SLICE) },
            SliceOfR => Column { grains: Grains::Icosahedra, ..Column::of_spheres(SIZE_ONE, knob, 20.0) },
            Width => Column { width: knob, ..two },
            Size => Column { length: knob, width: 1.2 * knob, ..two },
            GrainFriction => Column { friction: knob, ..two },
            WallFriction => Column { wall_friction: knob, ..two },
            Rolling => Column { rolling: knob, ..two },
            Stiffness => Column { stiffening: knob, ..Column::of_spheres(SIZE_ONE, 1.0, SLICE) },
            LiftedGate => Column { gate: Gate::Lifted(knob * two.speed_scale()), ..two },
            ViscousFriction => Column { law: Friction::Viscous(knob), ..two },
            SizesOfR => {
                Column { grains: Grains::Icosahedra, stiffening: f64::INFINITY, ..Column::of_spheres(knob * SIZE_ONE, OF_R, WIDTH_OF_R) }
            }
            Lube | StaronHinch => return None,
        })
    }

    /// What the column is compared with besides laws: half the size, or stiffer grains.
    pub(super) fn partner(self, column: &Column) -> Option<Column> {
        match self {
            Size => Some(Column { length: 0.5 * column.length, width: 0.5 * column.width, ..*column }),
            Stiffness => Some(Column { stiffening: 4.0 * column.stiffening, ..*column }),
            _ => None,
        }
    }

    /// The law by the key of its source.
    pub(super) fn law(self) -> Option<&'static str> {
        match self {
            Lube => Some("lube"),
            StaronHinch => Some("staron_hinch"),
            _ => None,
        }
    }

    /// Random fillings behind each number. Slices and columns of R's are as large as many small ones, and have one.
    pub(super) fn fillings(self, column: &Column) -> u64 {
        match self {
            Short | Long => FEW,
            LongOften => MANY,
            SliceOfR | SizesOfR => 1,
            _ if column.number_of_grains() > LARGE => FEW,
            _ => SEVERAL,
        }
    }
}
