//! Spheres squeezed between two plates and let go: do they move as their springs and dashpots say, contact by contact?

use reports::card::{Equation, Headline, Parameter, Picture, PictureItem, Plot};
use reports::row::ReferenceKind;
use solver::scene::{Boundary, BoundaryGeometry, InitialOverlap, PlaneGeometry, Scene, Step};
use solver::{Simulation, Vector};

use super::soft_spheres::{MATERIAL, body, contact_duration, linear, places, scene, sphere, sphere_mass, vanishing};
use crate::case::{Case, Curve, Description, Failure, Measurement, Setup, Tier};
use crate::claim::{Bound, Claim, Expected, Statistic, Subject};
use crate::exact::linear_contact::LinearContact;
use crate::exact::sphere_column::SphereColumn as Exact;
use crate::study::add_work;
use crate::variant::Variant;

/// The case.
pub struct SphereColumn;

const RADIUS: f64 = 0.5e-3;
/// Densities in kg/m^3 of the lower and the upper sphere, in turn.
const DENSITIES: [f64; 2] = [2e4, 1e4];
const STIFFNESS: f64 = 5e4;
const GRAVITY: f64 = 9.81;
/// Distance of the plates over the height of the column.
const GAP: f64 = 0.9;
/// Runs of each measurement, with steps that differ by up to a tenth: contacts begin at all phases of a step.
const PHASES: u32 = 200;
/// Looks at a run.
const LOOKS: u32 = 8;

const PLACE: &str = "largest error of a height / initial overlap";
const SPEED: &str = "largest error of a velocity / largest velocity";

/// One setup: so many spheres of a restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Column {
    spheres: usize,
    restitution: f64,
}

impl Variant for Column {
    fn all() -> Vec<Column> {
        let column = |spheres, restitution| Column { spheres, restitution };
        vec![column(2, 1.0), column(2, 0.9), column(2, 0.5), column(6, 1.0), column(6, 0.8)]
    }

    fn label(&self) -> String {
        let name = if self.spheres == 2 { "two spheres (MFiX DEM03)" } else { "column of six" };
        format!("{name}, restitution {}", self.restitution)
    }

    fn knob_name(&self) -> &'static str {
        "steps_per_contact"
    }

    fn knobs(&self, tier: Tier) -> Vec<f64> {
        match tier {
            Tier::Quick => vec![20.0, 40.0, 80.0],
            Tier::Standard | Tier::Paper => vec![20.0, 40.0, 80.0, 160.0, 320.0],
        }
    }
}

impl Column {
    fn mass(index: usize) -> f64 {
        sphere_mass(DENSITIES[index % 2], RADIUS)
    }

    /// Duration in s of the shortest contact, between two spheres.
    fn contact(&self) -> f64 {
        let [heavy, light] = [Self::mass(0), Self::mass(1)];
        contact_duration(heavy * light / (heavy + light), STIFFNESS)
    }

    /// Time in s in which contacts open and close several times; the squeezed spheres leave the plates and come back.
    fn end_time(&self) -> f64 {
        12.0 * self.contact()
    }

    /// Height in m of the upper plate.
    fn height(&self) -> f64 {
        GAP * 2.0 * RADIUS * self.spheres as f64
    }

    /// Heights in m at the start: evenly spread, so that plates are pressed half as much as neighbours.
    fn start(&self) -> Vec<f64> {
        let spacing = self.height() / self.spheres as f64;
        (0..self.spheres).map(|index| (index as f64 + 0.5) * spacing).collect()
    }

    /// Overlap in m of two neighbours at the start.
    fn overlap(&self) -> f64 {
        2.0 * RADIUS * (1.0 - GAP)
    }

    fn exact(&self) -> Exact {
        Exact {
            radii: vec![RADIUS; self.spheres],
            masses: (0..self.spheres).map(Self::mass).collect(),
            height: self.height(),
            stiffness: STIFFNESS,
            damping_ratio: LinearContact::until_zero_overlap(self.restitution).damping_ratio,
            gravity: GRAVITY,
        }
    }

    fn scene(&self, steps_per_contact: f64) -> Scene {
        let mut scene = scene("squeezed column", DENSITIES[0], linear(STIFFNESS, self.restitution), None);
        scene.scene.gravity = Some([0.0, 0.0, -GRAVITY]);
        scene.shapes = vec![sphere("ball", RADIUS)];
        let at = |(index, height): (usize, f64)| {
            let mass = Some(Self::mass(index));
            solver::scene::Body { mass, ..body("ball", Vector::z() * height, Vector::zeros()) }
        };
        scene.bodies = self.start().into_iter().enumerate().map(at).collect();
        let plate = |name: &str, height: f64, side: f64| {
            let geometry = PlaneGeometry { point: [0.0, 0.0, height], normal: [0.0, 0.0, side] };
            Boundary::new(name, MATERIAL, BoundaryGeometry::Plane(geometry))
        };
        scene.boundaries = vec![plate("lower plate", 0.0, 1.0), plate("upper plate", self.height(), -1.0)];
        scene.numerics.initial_overlap = InitialOverlap::Allow;
        scene.numerics.step = Step::Seconds(self.contact() / steps_per_contact);
        scene.scene.end_time = self.end_time();
        scene
    }

    /// Heights and velocities by the solver and exactly, at some times of a run.
    fn measure<const UNKNOWNS: usize>(&self, knob: f64) -> Result<Measurement, Failure> {
        let exact = self.exact();
        let motion = exact.motion::<UNKNOWNS>(&self.start(), 1.01 * self.end_time());
        let mut measurement = Measurement::default();
        let (mut height_errors, mut velocity_errors) = (Vec::new(), Vec::new());
        for phase in 0..PHASES {
            let mut simulation = self.scene(knob * (1.0 + 0.1 * f64::from(phase) / f64::from(PHASES))).build()?;
            let (mut height_error, mut velocity_error, mut fastest) = (0.0_f64, 0.0_f64, 0.0_f64);
            for look in 1..=LOOKS {
                simulation.run_until(self.end_time() * f64::from(look) / f64::from(LOOKS))?;
                let state = motion.at(simulation.time());
                for (index, (height, velocity)) in heights_and_velocities(&mut simulation).into_iter().enumerate() {
                    height_error = height_error.max((height - state[index]).abs());
                    velocity_error = velocity_error.max((velocity - state[self.spheres + index]).abs());
                    fastest = fastest.max(state[self.spheres + index].abs());
                }
            }
            height_errors.push(height_error / self.overlap());
            velocity_errors.push(velocity_error / fastest);
            add_work(&mut measurement.work, simulation.ledger().total_work());
            measurement.runs += 1;
        }
        let source = "linear springs and dashpots, from change to change of contacts by extrapolation of order 20";
        let quantity = |name, errors| vanishing(name, "1", errors, self.floor(knob), ReferenceKind::Exact, source);
        measurement.quantities = vec![quantity(PLACE, height_errors), quantity(SPEED, velocity_errors)];
        if knob == 40.0 {
            measurement.curves = vec![self.curve(&motion)];
        }
        Ok(measurement)
    }

    /// The exact motion of the first two spheres.
    fn curve<const UNKNOWNS: usize>(&self, motion: &crate::exact::sphere_column::Motion<'_, UNKNOWNS>) -> Curve {
        let row = |point: u32| {
            let time = self.end_time() * f64::from(point) / 400.0;
            let state = motion.at(time);
            vec![time, state[0], state[1]]
        };
        Curve { file: self.curve_file(), columns: vec!["time", "lowest", "second"], rows: (0..=400).map(row).collect() }
    }

    fn curve_file(&self) -> String {
        format!("heights_of_{}_at_{}.csv", self.spheres, self.restitution)
    }

    /// A place is rounded at every step.
    fn floor(&self, knob: f64) -> f64 {
        let steps = knob * self.end_time() / self.contact();
        f64::EPSILON * self.height() / self.overlap() * steps
    }

    /// Error by design: that of a leapfrog oscillation, (angle of a step)^2 / 24 a radian, over the angle that the fastest contact turns in the run.
    fn design_error(&self, knob: f64) -> f64 {
        let angle = std::f64::consts::PI / knob;
        angle * angle / 24.0 * std::f64::consts::PI * self.end_time() / self.contact()
    }
}

/// By id.
fn heights_and_velocities(simulation: &mut Simulation) -> Vec<(f64, f64)> {
    let heights: Vec<f64> = places(simulation).into_iter().map(|place| place.z).collect();
    let now = simulation.now();
    now.bodies().by_id().map(|index| now.velocity(index).z).zip(heights).map(|(velocity, height)| (height, velocity)).collect()
}

impl Case for SphereColumn {
    fn evaluate(&self, setup: &Setup, knob: f64, _random_seed: u64) -> Result<Measurement, Failure> {
        let column = Column::of(setup)?;
        if column.spheres == 2 { column.measure::<4>(knob) } else { column.measure::<12>(knob) }
    }

    fn claims(&self, tier: Tier) -> Vec<Claim> {
        let mut claims = Column::claims(tier, |column, knob| {
            let bound = || Bound::new(4.0, column.design_error(knob), "phase error of leapfrog over the run, in its fastest contact");
            [PLACE, SPEED].map(|quantity| column.claim_at(knob, quantity, Statistic::Median, bound(), Expected::Holds)).to_vec()
        });
        for column in Column::all() {
            let knobs = column.knobs(tier);
            claims.push(Claim {
                setup: column.label(),
                quantity: PLACE,
                statistic: Statistic::Median,
                subject: Subject::OrderAtLeast { order: 2.0, range: [knobs[0], knobs[knobs.len() - 1]] },
                bound: Bound::new(3.0, 0.1, "scatter of the edges of contacts, which fall at any phase of a step"),
                expected: Expected::Holds,
            });
        }
        claims
    }

    fn scene(&self, setup: &Setup, knob: f64) -> Option<Scene> {
        Column::of(setup).ok().map(|column| column.scene(knob))
    }

    fn description(&self) -> Description {
        let labels = Column::labels(|_| true);
        Description {
            id: "sphere_column",
            title: "Squeezed columns of spheres",
            question: "Do spheres squeezed between two plates move as springs, dashpots and weight say, through every opening and closing of a contact?",
            model: vec![
                "Two spheres of unlike density between plates that stand nearer than they are thick: the test DEM03 of MFiX. Three contacts act on two bodies at once; let go, the spheres spring apart, leave each other and the plates, and meet again. A column of six has seven contacts that open and close in an order of its own.",
                "The reference solves the same equations event by event, to rounding. Steps vary by a tenth between 200 runs, so that contacts begin at every phase of a step.",
            ],
            equations: vec![Equation {
                latex:
                    r"m_i \ddot y_i = F_i - F_{i+1} - m_i g,\qquad F_c = k\,\delta_c + 2\zeta\sqrt{k m_c}\,\dot\delta_c\ \ (\delta_c > 0)"
                        .into(),
                meaning: "Bodies on a line; each contact damps with its own reduced mass (R eq. 3.18-3.19).".into(),
            }],
            parameters: [
                ("diameter", "1 mm", "MFiX DEM03"),
                ("densities", "2·10⁴ and 10⁴ kg/m³", "in turn from below"),
                ("stiffness", "5·10⁴ N/m", "of spheres and plates alike"),
                ("plates", "0.9 of the height of the column apart", "1.8 mm for two spheres"),
                ("run", "12 durations of the shortest contact", ""),
            ]
            .map(|(name, value, remark)| Parameter { name: name.into(), value: value.into(), remark: remark.into() })
            .to_vec(),
            reference: "The differential equations of the coded model, from change to change of contacts, by extrapolation of order 20: to rounding.",
            picture: picture(),
            plots: vec![
                Plot::Curves {
                    title: "Two spheres, restitution 0.9".into(),
                    file: format!("sphere_column/{}", Column::all()[1].curve_file()),
                    x_label: "time in s".into(),
                    y_label: "height in m".into(),
                    columns: vec![["lowest".into(), "lower sphere".into()], ["second".into(), "upper sphere".into()]],
                    log_x: false,
                    log_y: false,
                    caption: String::new(),
                },
                Plot::Convergence {
                    title: "Error of heights".into(),
                    quantity: PLACE.into(),
                    setups: labels.clone(),
                    statistics: vec!["median".into(), "worst".into()],
                    orders: vec![2.0],
                    knob_is_resolution: true,
                    knob_label: "steps per contact".into(),
                },
                Plot::ErrorAgainstCost {
                    title: "Error of heights against run time".into(),
                    quantity: PLACE.into(),
                    setups: labels.clone(),
                    statistic: "median".into(),
                    targets: vec![0.1, 0.01, 0.001],
                },
            ],
            headline: Headline {
                setup: labels[1].clone(),
                quantity: PLACE.into(),
                statistic: "median".into(),
                knob: 40.0,
                order_quantity: Some(format!("observed order of {PLACE}")),
            },
            sources: vec!["MFiX 21.3, test DEM03: two stacked, compressed particles (parameters)", "R (Rakotonirina 2016), eq. 3.18-3.27"],
            answers: vec!["A body with two damped contacts at once: each predicts the share of the other, and second order is kept."],
            remarks: vec![
                "The weight is small against the springs, as in the test of MFiX: the overlap at the start is a thousand times that at rest.",
            ],
            knob: Column::knob(),
            setups: Column::setups(),
            sample: "step",
            budget_cpu_s: [5.0, 60.0, 60.0],
        }
    }
}

fn picture() -> Picture {
    let plate = |height: f64, side: f64| PictureItem::Wall { from: [-2.0, height], to: [2.0, height], solid_side: [0.0, side] };
    let disc = |height: f64| PictureItem::Disc { center: [0.0, height], radius: 1.0, ghost: false };
    Picture {
        caption: "Two spheres between plates that are nearer than the spheres are thick.".into(),
        items: vec![plate(0.0, -1.0), plate(3.6, 1.0), disc(0.9), disc(2.7)],
    }
}
