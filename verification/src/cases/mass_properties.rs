//! Counting cells, as source R does to find volume and inertia of composite bodies: does it converge, how fast, and at what cost?

use std::f64::consts::{PI, SQRT_2};

use nalgebra::SymmetricEigen;
use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::{ErrorKind, Reference, ReferenceKind};
use solver::shape::mass::cell_counting::CellGrid;
use solver::shape::{Convex, Cylinder, MassMethod, MassProperties, Part, Sphere, composites, mass_of_union};
use solver::{Orientation, Vector};

use crate::case::{Case, Description, Failure, Knob, Measurement, Quantity, Setup, Tier, setups};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};

/// The case.
pub struct CountedMass;

/// Cylinder of R's table 3.1, and the sphere of the same radius.
const RADIUS: f64 = 4e-3;
const LENGTH: f64 = 5.3e-3;
/// Crosses: arms of this radius and length.
const ARM_RADIUS: f64 = 0.5e-3;
const ARM_LENGTH: f64 = 4e-3;
/// Lobes: circumscribed diameter and length, of the sizes of R section 4.2.4.
const LOBE_DIAMETER: f64 = 1.6e-3;
const LOBE_LENGTH: f64 = 4e-3;
/// Mass in kg and moments of inertia in kg m^2, about a diameter and about the axis, of the cylinder as R's table 3.1 prints them.
const PRINTED_MASS: f64 = 3.1e-4;
const PRINTED_INERTIA: [f64; 2] = [1.966e-9, 2.480e-9];
const PRINTED_VOLUME: f64 = 2.66407e-7;
/// Half a unit of the last printed digit, relative.
const PRINTED_ROUNDING: [f64; 3] = [5e-13 / PRINTED_VOLUME, 5e-13 / PRINTED_INERTIA[0], 5e-13 / PRINTED_INERTIA[1]];
/// Boxes that are counted, each moved by other parts of a cell.
const SHIFTS: usize = 16;
/// Low-discrepancy steps in three dimensions: powers of the root of x^4 = x + 1.
const STRIDES: [f64; 3] = [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];

const VOLUME: &str = "volume";
const VOLUME_IN_TIGHT_BOX: &str = "volume in the tight box";
const INERTIA: &str = "largest error of a principal moment";
const EXACT: &str = "exact methods, against numbers from elsewhere";
const EXACT_VOLUMES: &str = "volume over closed form, all bodies";
const PRINTED: [&str; 3] = ["volume of the cylinder", "its moment about a diameter", "its moment about the axis"];

/// A body, its volume by a formula of its own, and the sizes that its error by chance depends on.
struct Body {
    name: &'static str,
    parts: Vec<Part>,
    /// In m^3.
    volume: f64,
    surface: Surface,
}

/// What of a body's surface cells of a box can meet.
enum Surface {
    /// Curved everywhere: its area in m^2.
    Curved(f64),
    /// So many bars of equal section along the axes: perimeter of the section in m (without faces that run along the axes), length in m.
    Bars(usize, f64, f64),
}

fn upright_cylinder(x: f64) -> Part {
    let convex = Convex::Cylinder(Cylinder { radius: RADIUS, length: LENGTH });
    Part { convex, position: Vector::x() * x, orientation: Orientation::identity() }
}

/// All bodies; the closed forms of their volumes are written here once more, apart from the solver's.
fn bodies() -> Result<Vec<Body>, Failure> {
    let round = |radius: f64| 2.0 * PI * radius;
    let (three, four) = (0.5 * LOBE_DIAMETER / (1.0 + 2.0 / 3.0_f64.sqrt()), 0.5 * LOBE_DIAMETER / (1.0 + SQRT_2));
    let arm = PI * ARM_RADIUS.powi(2) * ARM_LENGTH;
    let ball = Part { convex: Convex::Sphere(Sphere { radius: RADIUS }), position: Vector::zeros(), orientation: Orientation::identity() };
    let trilobe = composites::trilobe(LOBE_DIAMETER, LOBE_LENGTH);
    let trilobe = trilobe.map_err(|error| Failure::NothingMeasured(format!("the trilobe {error}")))?;
    let body = |name, parts, volume, surface| Body { name, parts, volume, surface };
    Ok(vec![
        body("sphere", vec![ball], 4.0 / 3.0 * PI * RADIUS.powi(3), Surface::Curved(4.0 * PI * RADIUS.powi(2))),
        body("cylinder", vec![upright_cylinder(0.0)], PI * RADIUS.powi(2) * LENGTH, Surface::Bars(1, round(RADIUS), LENGTH)),
        body(
            "two overlapping cylinders",
            vec![upright_cylinder(-0.5 * RADIUS), upright_cylinder(0.5 * RADIUS)],
            (4.0 / 3.0 * PI + 0.75_f64.sqrt()) * RADIUS.powi(2) * LENGTH,
            Surface::Bars(1, 4.0 / 3.0 * round(RADIUS), LENGTH),
        ),
        body(
            "2-D cross",
            composites::cross_in_plane(ARM_RADIUS, ARM_LENGTH),
            2.0 * arm - 16.0 / 3.0 * ARM_RADIUS.powi(3),
            Surface::Bars(2, round(ARM_RADIUS), ARM_LENGTH),
        ),
        body(
            "3-D cross",
            composites::cross_in_space(ARM_RADIUS, ARM_LENGTH),
            3.0 * arm - 8.0 * SQRT_2 * ARM_RADIUS.powi(3),
            Surface::Bars(3, round(ARM_RADIUS), ARM_LENGTH),
        ),
        body(
            "trilobe",
            trilobe,
            (2.5 * PI + 3.0_f64.sqrt()) * three.powi(2) * LOBE_LENGTH,
            Surface::Bars(1, 2.5 * round(three), LOBE_LENGTH),
        ),
        body(
            "quadralobe",
            composites::quadralobe(LOBE_DIAMETER, LOBE_LENGTH),
            (3.0 * PI + 4.0) * four.powi(2) * LOBE_LENGTH,
            Surface::Bars(1, 3.0 * round(four), LOBE_LENGTH),
        ),
    ])
}

impl Body {
    /// Mass properties by the solver's exact methods.
    fn exact(&self) -> Result<MassProperties, Failure> {
        let (exact, method) = mass_of_union(&self.parts, &|_, _| true);
        let counted = matches!(method, MassMethod::CellCounting(_));
        if counted { Err(Failure::NothingMeasured(format!("there is no exact method for the {}", self.name))) } else { Ok(exact) }
    }

    /// The parts, turned so that no face and no axis lies along a direction of the cells.
    fn turned(&self) -> Vec<Part> {
        let turn = Orientation::from_euler_angles(0.7, -1.1, 2.0);
        let turned =
            |part: &Part| Part { convex: part.convex.clone(), position: turn * part.position, orientation: turn * part.orientation };
        self.parts.iter().map(turned).collect()
    }

    /// Relative error of the volume by chance, for cells of such edges. Of the cells at the surface, `S / h^2`, each errs by a part of itself that
    /// is uniform between minus and plus a half. Along the axes all cells of a row err alike, and only those around a section, `P / h`, differ.
    fn error_by_chance(&self, turned: bool, cell: &Vector) -> f64 {
        let edge = cell.product().cbrt();
        let error = match self.surface {
            Surface::Curved(area) => edge.powi(2) * (area / 12.0).sqrt(),
            Surface::Bars(bars, perimeter, length) if turned => edge.powi(2) * (bars as f64 * perimeter * length / 12.0).sqrt(),
            Surface::Bars(bars, perimeter, length) => {
                // A single bar lies along z, several along x, y, z.
                let across = (cell.x * if bars == 1 { cell.y } else { cell.z }).sqrt();
                (bars as f64).sqrt() * length * across.powf(1.5) * (perimeter / 12.0).sqrt()
            }
        };
        error / self.volume
    }

    /// How many cells at the surface err alike because the body and a box around its middle have the same symmetry: its root is by how much the
    /// error is larger than by chance. A cube has 48 symmetries, a square 8.
    fn cells_alike(&self) -> f64 {
        match self.surface {
            Surface::Curved(_) => 48.0,
            Surface::Bars(bars, ..) => 8.0 * bars as f64,
        }
    }
}

/// One setup: a body, and whether it is turned.
#[derive(Debug, Clone, Copy)]
struct Variant {
    body: usize,
    turned: bool,
}

/// Names of the bodies, in their order.
const NAMES: [&str; 7] = ["sphere", "cylinder", "two overlapping cylinders", "2-D cross", "3-D cross", "trilobe", "quadralobe"];
/// The bodies that are counted turned as well.
const TURNED: [usize; 4] = [1, 4, 5, 6];

fn variants() -> Vec<Variant> {
    let upright = (0..NAMES.len()).map(|body| Variant { body, turned: false });
    upright.chain(TURNED.map(|body| Variant { body, turned: true })).collect()
}

impl Variant {
    fn label(&self) -> String {
        format!("{}, {}", NAMES[self.body], if self.turned { "turned" } else { "along the axes" })
    }

    fn parts(&self, body: &Body) -> Vec<Part> {
        if self.turned { body.turned() } else { body.parts.clone() }
    }

    /// Order of the error by chance.
    fn order(&self) -> f64 {
        if self.turned || self.body == 0 { 2.0 } else { 1.5 }
    }
}

/// By which parts of a cell a box is moved.
fn shift(sample: usize, random_seed: u64) -> Vector {
    let count = (sample as u64 + random_seed * SHIFTS as u64) as f64 + 0.5;
    Vector::from(STRIDES.map(|stride| (stride * count).fract()))
}

/// Principal moments for unit density in m^5, smallest first.
fn principal_moments(mass: &MassProperties) -> Vec<f64> {
    let mut moments: Vec<f64> = SymmetricEigen::new(mass.inertia()).eigenvalues.iter().copied().collect();
    moments.sort_by(f64::total_cmp);
    moments
}

/// Largest relative error of a principal moment.
fn inertia_error(found: &MassProperties, exact: &MassProperties) -> f64 {
    let errors = principal_moments(found).into_iter().zip(principal_moments(exact)).map(|(found, exact)| (found / exact - 1.0).abs());
    errors.fold(0.0, f64::max)
}

/// Relative rounding error of the exact methods.
const EXACT_ROUNDING: f64 = 16.0 * f64::EPSILON;

fn count(variant: Variant, cells: usize, random_seed: u64) -> Result<Measurement, Failure> {
    let body = bodies()?.swap_remove(variant.body);
    let exact = body.exact()?;
    let parts = variant.parts(&body);
    let tight = CellGrid::around(&parts, cells);
    let shifted: Vec<CellGrid> = (0..SHIFTS).map(|sample| tight.shifted(&shift(sample, random_seed))).collect();
    let found: Vec<MassProperties> = shifted.iter().map(|grid| grid.mass_of_parts(&parts)).collect();
    let quantity = |name, unit, samples, expected, error_kind| Quantity {
        name,
        unit,
        samples,
        expected,
        reference: Reference {
            kind: ReferenceKind::Exact,
            uncertainty: EXACT_ROUNDING,
            source: "closed form, or exact outline of the union".into(),
        },
        error_kind,
        floor: EXACT_ROUNDING,
    };
    let volumes = found.iter().map(|mass| mass.volume).collect();
    let errors = found.iter().map(|mass| inertia_error(mass, &exact)).collect();
    let cells_tested = shifted.iter().chain([&tight]).map(CellGrid::number_of_cells).sum();
    Ok(Measurement {
        quantities: vec![
            quantity(VOLUME, "m^3", volumes, body.volume, ErrorKind::Relative),
            quantity(INERTIA, "1", errors, 0.0, ErrorKind::Absolute),
            quantity(VOLUME_IN_TIGHT_BOX, "m^3", vec![tight.mass_of_parts(&parts).volume], body.volume, ErrorKind::Relative),
        ],
        work: [("cells".to_string(), cells_tested)].into(),
        runs: SHIFTS as u64 + 1,
        curves: Vec::new(),
    })
}

/// The exact methods against closed forms of their own and against the cylinder of R's table 3.1, here in five slices.
fn check_exact() -> Result<Measurement, Failure> {
    let ratio = |body: &Body| Ok(body.exact()?.volume / body.volume);
    let volumes = bodies()?.iter().map(ratio).collect::<Result<Vec<f64>, Failure>>()?;
    let (cylinder, _) = mass_of_union(&composites::sliced_cylinder(RADIUS, LENGTH, 5), &|_, _| true);
    let inertia = cylinder.inertia() * (PRINTED_MASS / cylinder.volume);
    let quantity = |name, unit, samples, expected, kind, uncertainty, source: &str| Quantity {
        name,
        unit,
        samples,
        expected,
        reference: Reference { kind, uncertainty, source: source.into() },
        error_kind: ErrorKind::Relative,
        floor: uncertainty,
    };
    let source = "closed forms by Steinmetz and by sectors of discs";
    let mut quantities = vec![quantity(EXACT_VOLUMES, "1", volumes, 1.0, ReferenceKind::Exact, EXACT_ROUNDING, source)];
    let found = [cylinder.volume, inertia[(0, 0)], inertia[(2, 2)]];
    let expected = [PRINTED_VOLUME, PRINTED_INERTIA[0], PRINTED_INERTIA[1]];
    for index in 0..3 {
        let unit = if index == 0 { "m^3" } else { "kg m^2" };
        let rounding = PRINTED_ROUNDING[index];
        let samples = vec![found[index]];
        quantities.push(quantity(PRINTED[index], unit, samples, expected[index], ReferenceKind::Computed, rounding, "R table 3.1"));
    }
    Ok(Measurement { quantities, runs: 1, ..Measurement::default() })
}

/// What is claimed of counting: orders over the range of a tier, and errors at 100 cells and at R's 500.
fn claims_of(variant: Variant, body: &Body, exact: &MassProperties, tier: Tier) -> Vec<Claim> {
    let knobs = resolutions(tier);
    let range = [knobs[0], knobs[knobs.len() - 1]];
    let claim = |quantity, statistic, subject, bound| Claim {
        setup: variant.label(),
        quantity,
        statistic,
        subject,
        bound,
        expected: Expected::Holds,
    };
    let order = Subject::OrderAtLeast { order: variant.order(), range };
    let spread = || Bound::new(3.0, spread_of_order(&knobs), "the standard error of an order fitted to medians that scatter");
    let mut claims = vec![claim(VOLUME, Statistic::Median, order, spread()), claim(INERTIA, Statistic::Median, order, spread())];
    let one_cell = CellGrid::around(&variant.parts(body), 1).size();
    for cells in [100.0, 500.0].into_iter().filter(|cells| knobs.contains(cells)) {
        let cell = one_cell / cells;
        let chance = body.error_by_chance(variant.turned, &cell);
        let by_chance = "(surface cells / 12)^1/2 cells, each wrong by chance";
        claims.push(claim(VOLUME, Statistic::Median, Subject::ErrorAt(cells), Bound::new(3.0, chance, by_chance)));
        claims.push(claim(VOLUME, Statistic::Worst, Subject::ErrorAt(cells), Bound::new(6.0, chance, by_chance)));
        let points = cell.amax().powi(2) / 6.0 * exact.volume / principal_moments(exact)[0];
        let moment = Bound::new(
            3.0,
            2.0 * chance + points,
            "twice that of the volume, as the surface lies outside, and h^2/6 for cells taken as points",
        );
        claims.push(claim(INERTIA, Statistic::Median, Subject::ErrorAt(cells), moment));
        let alike = Bound::new(
            3.0,
            chance * body.cells_alike().sqrt(),
            "that by chance times the root of the number of cells that err alike by symmetry",
        );
        claims.push(claim(VOLUME_IN_TIGHT_BOX, Statistic::Single, Subject::ErrorAt(cells), alike));
    }
    claims
}

/// Cells per direction. R's choice, 500, belongs to the standard tier.
fn resolutions(tier: Tier) -> Vec<f64> {
    let all = [16.0, 25.0, 40.0, 63.0, 100.0, 160.0, 250.0, 500.0];
    all[..if tier == Tier::Quick { 5 } else { all.len() }].to_vec()
}

/// Standard error of the order that is fitted through medians at these resolutions, each of which scatters by [`SCATTER`] of itself.
fn spread_of_order(knobs: &[f64]) -> f64 {
    let mean = knobs.iter().map(|knob| knob.ln()).sum::<f64>() / knobs.len() as f64;
    SCATTER / knobs.iter().map(|knob| (knob.ln() - mean).powi(2)).sum::<f64>().sqrt()
}

/// Standard error of the median of [`SHIFTS`] magnitudes of a normal variable, relative to that median, 0.6745 standard deviations:
/// `1 / (2 f sqrt(SHIFTS))` with the density `f = 0.6356` there.
const SCATTER: f64 = 1.0 / (2.0 * 0.6356 * 4.0) / 0.6745;

impl Case for CountedMass {
    fn evaluate(&self, setup: &Setup, knob: f64, random_seed: u64) -> Result<Measurement, Failure> {
        match variants().get(setup.index) {
            Some(variant) => count(*variant, knob as usize, random_seed),
            None => check_exact(),
        }
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let exact = |quantity, statistic, floor, floor_is: &str| Claim {
            setup: EXACT.into(),
            quantity,
            statistic,
            subject: Subject::ErrorAt(1.0),
            bound: Bound::new(2.0, floor, floor_is),
            expected: Expected::Holds,
        };
        let mut claims = vec![exact(EXACT_VOLUMES, Statistic::Worst, EXACT_ROUNDING, "rounding")];
        for (quantity, rounding) in PRINTED.into_iter().zip(PRINTED_ROUNDING) {
            claims.push(exact(quantity, Statistic::Single, rounding, "half a unit of the last printed digit"));
        }
        let Ok(bodies) = bodies() else { return claims };
        for variant in variants() {
            let body = &bodies[variant.body];
            claims.extend(body.exact().into_iter().flat_map(|exact| claims_of(variant, body, &exact, tier)));
        }
        claims
    }

    fn description(&self) -> Description {
        let labels: Vec<String> = variants().iter().map(Variant::label).collect();
        Description {
            id: "mass_properties",
            title: "Mass properties by counting cells",
            question: "Does counting cells find volume and inertia of composite bodies, how fast does it converge, and what does it cost?",
            model: vec![
                "Bodies glued from overlapping convex parts have no simple volume. Source R puts a box around such a body, cuts it into equal cells, and counts a cell as a whole if its centre lies in any part; volume, centre and inertia are sums over counted cells. R does so with at least 500 cells per direction.",
                "Here the same is done for a sphere, a cylinder, two overlapping cylinders (the bodies of R's figure 3.3), the two crosses and the two lobed bodies of R, whose volume and inertia are also known exactly. Each box is counted as tight as R's, and moved by parts of a cell; some bodies are turned as well.",
                "Which cells at the surface count is as good as chance. Along the axes whole rows of cells err alike, and the error falls with the power 3/2 of the number of cells; for spheres and turned bodies with the second power. A box around the middle of a symmetric body errs more than a moved one, because all symmetric cells err alike.",
            ],
            equations: vec![
                Equation { latex: r"V = \sum_i v_i,\qquad X_g = \frac1V\sum_i X_i v_i".into(), meaning: "Sums over the cells whose centre lies inside (R section 2.3, eq. 3.11).".into() },
                Equation { latex: r"J_{kl} = \rho\sum_i f_{kl}(X_i)\,v_i".into(), meaning: "Inertia (R eq. 3.12, which lacks the density: errata). Cells count as points: each lacks its own h²/6.".into() },
                Equation { latex: r"\frac{\Delta V}{V}\approx\frac{h^2}{V}\sqrt{\frac{S}{12}}\quad\text{or}\quad\frac{L\,h^{3/2}}{V}\sqrt{\frac{P}{12}}".into(), meaning: "Error by chance: all cells of the surface S err on their own, or whole rows around the perimeter P of a section of length L.".into() },
            ],
            parameters: [
                ("sphere, cylinders", "radius 4 mm, length 5.3 mm", "the cylinder of R's table 3.1; the two overlap by half a diameter"),
                ("crosses", "arms of radius 0.5 mm, length 4 mm", "they cross in their middle"),
                ("lobed bodies", "diameter 1.6 mm, length 4 mm", "lobes touch; R section 4.2.4"),
                ("boxes", "16", "each moved by other parts of a cell"),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "Closed forms of the volumes (Steinmetz's bodies, sectors of discs) written apart from the solver; inertia by the solver's exact methods, which its tests hold against quadrature and which agree here with R's printed cylinder.",
            picture: picture(),
            plots: plots(&labels),
            headline: Headline {
                setup: labels[0].clone(),
                quantity: VOLUME.into(),
                statistic: Statistic::Median.name().into(),
                knob: 100.0,
                order_quantity: Some(format!("observed order of {VOLUME}")),
            },
            sources: vec![
                "R (Rakotonirina 2016), section 2.3 of chapter 3, eq. 3.11 and 3.12, figures 3.2, 3.3 and 3.12, tables 3.1 and 3.2, figure 4.3",
                "D. G. Kendall, On the number of lattice points inside a random oval, Quart. J. Math. 19 (1948) 1: why a moved box in the plane errs with the power 3/2",
            ],
            answers: vec![
                "Stability test S19: volume and inertia of all shapes against quadrature.",
                "R's figure 3.3: the error falls, but far from monotonically.",
                "Errata of R: eq. 3.12 lacks the density.",
            ],
            remarks: vec![
                "The solver counts only where it knows no exact way: parts that do not overlap, parallel prisms (lobes, slices) and crossing cylinders are exact.",
                "R's sliced cylinder (table 3.1) is off by 2.3e-5 in volume: a counting error of this kind.",
                "R's table 3.2 gives 54 spheres inside a cylinder a larger moment of inertia, 3.281e-9 kg m², than the whole cylinder has, 1.966e-9 kg m²: it cannot be right.",
            ],
            knob: Knob { name: |_| "cells_per_direction", values: |tier, setup| if setup.label == EXACT { vec![1.0] } else { resolutions(tier) } },
            setups: setups(labels.into_iter().chain([EXACT.to_string()])),
            sample: "box placement",
            budget_cpu_s: [5.0, 600.0, 600.0],
        }
    }
}

fn plots(labels: &[String]) -> Vec<Plot> {
    let convergence = |title: &str, quantity: &str, statistics: &[Statistic], setups: &[String]| Plot::Convergence {
        title: title.into(),
        quantity: quantity.into(),
        setups: setups.to_vec(),
        statistics: statistics.iter().map(|statistic| statistic.name().to_string()).collect(),
        orders: vec![1.5, 2.0],
        knob_is_resolution: true,
        knob_label: "cells per direction".into(),
    };
    let both = [Statistic::Median, Statistic::Worst];
    vec![
        convergence("Volume in the tight box (R figure 3.3)", VOLUME_IN_TIGHT_BOX, &[Statistic::Single], &labels[..3]),
        convergence("Volume in moved boxes", VOLUME, &both, labels),
        convergence("Inertia in moved boxes", INERTIA, &both, labels),
        Plot::ErrorAgainstCost {
            title: "Volume error against run time".into(),
            quantity: VOLUME.into(),
            setups: labels.to_vec(),
            statistic: Statistic::Median.name().into(),
            targets: vec![0.01, 0.001, 0.0001],
        },
    ]
}

/// A disc in a box of cells; those whose centre lies inside are drawn.
fn picture() -> Picture {
    let cells = 12;
    let edge = 2.0 / f64::from(cells);
    let place = |index: i32| -1.0 + (f64::from(index) + 0.5) * edge;
    let square = |x: f64, y: f64| {
        let half = 0.45 * edge;
        vec![[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]]
    };
    let mut items = vec![PictureItem::Disc { center: [0.0, 0.0], radius: 1.0, ghost: true }];
    for (row, column) in (0..cells).flat_map(|row| (0..cells).map(move |column| (row, column))) {
        let (x, y) = (place(column), place(row));
        if x * x + y * y <= 1.0 {
            items.push(PictureItem::Polygon { points: square(x, y), ghost: false });
        }
    }
    for (from, to) in [([-1.0, -1.0], [1.0, -1.0]), ([1.0, -1.0], [1.0, 1.0]), ([1.0, 1.0], [-1.0, 1.0]), ([-1.0, 1.0], [-1.0, -1.0])] {
        items.push(PictureItem::Dashed { from, to });
    }
    Picture { caption: "A section through a box around a body: cells whose centre lies inside count as a whole.".into(), items }
}
