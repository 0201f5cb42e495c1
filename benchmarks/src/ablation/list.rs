//! The list: what a scene leaves out, and the same scene with it forced on.

use solver::scene::{
    BoundaryGeometry, ConstantTorque, ContactEdges, Domain, Geometry, MeshGeometry, Pair, RodGeometry, RollingLaw, Rotation, Scene,
    SearchMethod, TangentialLaw, ViscousCoulomb,
};

use super::answer::Agreement;
use super::crystal::{self, OVERLAP, RADIUS, SPEED, SPIN, STEP, STIFFNESS};

/// One thing that a scene leaves out.
pub struct Ablation {
    /// What is forced on, and in which scene.
    pub name: &'static str,
    /// Why the scene does not need it.
    pub reason: &'static str,
    /// The scene as it is resolved.
    pub left_out: Scene,
    /// The same with what it does not need.
    pub forced: Scene,
    /// How alike the ends of both are.
    pub agreement: Agreement,
}

/// Steps after which ends are compared.
pub const STEPS: u64 = 100;

/// All of them, with so many balls along each edge of the crystal.
pub fn ablations(per_edge: usize) -> Vec<Ablation> {
    let mut all = motion(per_edge);
    all.extend(neighbours(per_edge));
    all.extend(laws(per_edge));
    all.extend(shapes_and_walls(per_edge));
    all
}

/// Takes a scene and changes it.
fn changed(scene: &Scene, change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = scene.clone();
    change(&mut scene);
    scene
}

fn bitwise(name: &'static str, reason: &'static str, left_out: Scene, change: impl FnOnce(&mut Scene)) -> Ablation {
    let forced = changed(&left_out, change);
    Ablation { name, reason, left_out, forced, agreement: Agreement::Bits }
}

/// Rounding of a distance in the crystal, pushed through the spring at every step.
fn rounding(per_edge: usize) -> Agreement {
    let [_, far] = crystal::ends(per_edge);
    let floor = STEPS as f64 * STIFFNESS / crystal::mass() * STEP * f64::EPSILON * far / SPEED;
    Agreement::Floor { floor, factor: 4.0, reason: "rounding of a place through the spring at every step" }
}

fn motion(per_edge: usize) -> Vec<Ablation> {
    let smooth = crystal::scene(per_edge, None);
    let turn = |scene: &mut Scene| scene.output.sphere_orientation = true;
    let tumbling = changed(&smooth, |scene| {
        scene.pairs.clear();
        let geometry = Geometry::Spherocylinder(RodGeometry { radius: RADIUS, length: 2.0 * RADIUS });
        scene.shapes[0].geometry = geometry;
    });
    // Terms of the splitting that precession has not: (angle in a step)^2 of the spin, one after another.
    let angle = 3.0_f64.sqrt() * SPIN * STEP;
    vec![
        bitwise("turning of frictionless balls", "no force turns them, nothing looks", smooth, turn),
        bitwise(
            "orientation of rolling balls",
            "a ball looks the same from all sides",
            crystal::scene(per_edge, Some(crystal::history())),
            turn,
        ),
        Ablation {
            name: "rods turned by splitting",
            reason: "an axis of symmetry: precession and spin are exact",
            forced: changed(&tumbling, |scene| scene.numerics.rotation = Rotation::SplittingWithoutShortcut),
            left_out: tumbling,
            agreement: Agreement::Floor {
                floor: angle * angle * angle * STEPS as f64,
                factor: 1.0,
                reason: "(angle in a step)^2 of the angle turned",
            },
        },
    ]
}

fn neighbours(per_edge: usize) -> Vec<Ablation> {
    let rolling =
        || changed(&crystal::scene(per_edge, Some(crystal::history())), |scene| scene.numerics.neighbours.method = SearchMethod::List);
    let [lower, upper] = crystal::ends(per_edge);
    vec![
        bitwise("a list at every step", "no ball has moved by half a skin", rolling(), |scene| {
            scene.numerics.neighbours.skin = Some(1e-15 * RADIUS);
        }),
        bitwise("all pairs tested at every step", "a list knows which are near", rolling(), |scene| {
            scene.numerics.neighbours.method = SearchMethod::AllPairs;
        }),
        bitwise("periodic sides round a closed box", "nothing leaves", rolling(), |scene| {
            let far = 2.0 * (upper - lower);
            scene.domain = Some(Domain { lower: [lower - far; 3], upper: [upper + far; 3], periodic: [true; 3] });
        }),
    ]
}

fn laws(per_edge: usize) -> Vec<Ablation> {
    let smooth = || crystal::scene(per_edge, None);
    let rolling = || crystal::scene(per_edge, Some(crystal::history()));
    // Another law adds its zeros at other places of a sum.
    let agreement = rounding(per_edge);
    let with_laws = |scene: Scene, change: &dyn Fn(&mut Pair)| changed(&scene, |scene| scene.pairs.iter_mut().for_each(change));
    let no_friction = TangentialLaw::ViscousCoulomb(ViscousCoulomb { friction: 0.0, damping_rate: 0.0 });
    let no_rolling = RollingLaw::ConstantTorque(ConstantTorque { friction: 0.0 });
    let with_edges = |edges| changed(&rolling(), |scene| scene.numerics.contact_edges = edges);
    vec![
        bitwise("gravity of zero", "the scene has none", smooth(), |scene| scene.scene.gravity = Some([0.0; 3])),
        Ablation {
            name: "friction of zero",
            reason: "the scene has none",
            left_out: smooth(),
            forced: with_laws(smooth(), &|pair| pair.tangential = Some(no_friction.clone())),
            agreement,
        },
        Ablation {
            name: "resistance to rolling of zero",
            reason: "the scene has none",
            left_out: rolling(),
            forced: with_laws(rolling(), &|pair| pair.rolling = Some(no_rolling.clone())),
            agreement,
        },
        Ablation {
            name: "memory of viscous contacts",
            reason: "the force depends on the velocity alone",
            left_out: at_smooth_walls(crystal::scene(per_edge, Some(crystal::viscous()))),
            forced: at_smooth_walls(crystal::scene(per_edge, Some(crystal::viscous_with_memory()))),
            agreement: Agreement::Floor {
                // The effective mass in the dashpot has the square of the lever arm, which is shorter than the radius by half the overlap.
                floor: 0.5 * 5.0 / 7.0 * OVERLAP / RADIUS,
                factor: 1.0,
                reason: "the dashpot with memory knows the lever arm, which is shorter by the overlap",
            },
        },
        Ablation {
            name: "weights of first and last steps",
            reason: "no contact begins or ends",
            left_out: with_edges(ContactEdges::Sampled),
            forced: with_edges(ContactEdges::Resolved),
            agreement,
        },
    ]
}

/// The dashpot of a wall is that of the whole mass of a ball, so one ratio of damping cannot be that of both.
fn at_smooth_walls(mut scene: Scene) -> Scene {
    scene.pairs[1].tangential = None;
    scene
}

fn shapes_and_walls(per_edge: usize) -> Vec<Ablation> {
    let rolling = || crystal::scene(per_edge, Some(crystal::history()));
    let agreement = rounding(per_edge);
    let ablation = |name, reason, forced| Ablation { name, reason, left_out: rolling(), forced, agreement };
    // One digit of one moment of inertia makes them bodies like any other.
    let uneven = |scene: &mut Scene| {
        let moment = 0.4 * crystal::mass() * RADIUS * RADIUS;
        scene.bodies.iter_mut().for_each(|body| body.principal_inertia = Some([moment, moment, moment * (1.0 + 2.0 * f64::EPSILON)]));
    };
    vec![
        Ablation {
            name: "balls as bodies of any shape",
            reason: "two balls have a closed form",
            left_out: rolling(),
            forced: changed(&rolling(), uneven),
            agreement: Agreement::Floor {
                floor: 0.5 * 3.0_f64.sqrt() * SPIN * STEP,
                factor: 1.0,
                reason: "springs of balls are stretched along the plane of the middle of a step, others along that of its end: half the angle of a step",
            },
        },
        ablation(
            "walls as plates",
            "no edge is near",
            changed(&rolling(), |scene| scene.boundaries = crystal::walls(per_edge, crystal::plate)),
        ),
        ablation(
            "walls as triangles",
            "no edge is near",
            changed(&rolling(), |scene| scene.boundaries = crystal::walls(per_edge, triangles)),
        ),
    ]
}

/// Two triangles, which meet along a diagonal under the crystal.
fn triangles(axis: usize, at: f64, _inwards: f64) -> BoundaryGeometry {
    let vertices = crystal::square(axis, at).to_vec();
    BoundaryGeometry::Mesh(MeshGeometry { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], smooth_below: 0.35 })
}

#[cfg(test)]
mod tests {
    use super::super::answer::difference;
    use super::*;

    /// What has no line in a ledger.
    const NOT_IN_LEDGERS: [&str; 2] = ["periodic sides round a closed box", "weights of first and last steps"];

    fn end_of(scene: &Scene, steps: u64) -> solver::Simulation {
        let mut simulation = scene.build().expect("the scene builds");
        (0..steps).for_each(|_| simulation.step());
        simulation
    }

    #[test]
    fn what_is_left_out_does_not_change_the_answer() {
        let mut faults = Vec::new();
        for Ablation { name, left_out, forced, agreement, .. } in ablations(6) {
            let (one, other) = (end_of(&left_out, STEPS), end_of(&forced, STEPS));
            let (found, bound) = (difference(&one, &other), agreement.bound());
            if found.is_nan() || found > bound {
                faults.push(format!("{name}: {found:e} above {bound:e}"));
            }
            assert!(one.ledger() != other.ledger() || NOT_IN_LEDGERS.contains(&name), "{name}: nothing is forced on");
        }
        assert!(faults.is_empty(), "{faults:#?}");
    }

    /// Two runs that do differ are told apart, and so are numbers that are none.
    #[test]
    fn a_difference_is_seen() {
        let scene = crystal::scene(3, None);
        let (one, other) = (end_of(&scene, STEPS), end_of(&scene, STEPS + 1));
        assert_eq!(difference(&one, &one), 0.0);
        assert!(difference(&one, &other) > 1e-6);
        let nudged = changed(&scene, |scene| scene.bodies[13].velocity[0] *= 1.0 + 2.0 * f64::EPSILON);
        assert!(difference(&end_of(&scene, 0), &end_of(&nudged, 0)) > 0.0);
    }
}
