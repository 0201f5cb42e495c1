//! Contact stages of a scene: candidate pairs sorted by tangential law and by the kinds of their shapes.

use std::sync::Arc;

use super::shapes::detected_parts;
use crate::boundary::Plane;
use crate::broad_phase::{LARGEST_NUMBER_OF_BODIES, all_pairs};
use crate::contact::detect::{OneSided, Points};
use crate::contact::law::rolling::{ConstantTorque, SpringTorque};
use crate::contact::law::{
    self, Frictionless, Hertz, LinearHistory, LinearSpringDashpot, Mindlin, NoRolling, RollingLaw, ViscousCoulomb, ViscousSpring, hertz,
};
use crate::contact::shaped::{DetectedPart, Resolution, ShapedContacts};
use crate::contact::spheres::SphereContacts;
use crate::contact::stage::{Candidate, ContactStage, Laws, Partner};
use crate::scene::{
    self, BoundaryGeometry, ContactPoints, NormalLaw, Pair, Scene, SceneError, SceneErrorKind, SuperellipsoidContact, TangentialLaw,
};
use crate::shape::{Convex, Shape};
use crate::{Bodies, Vector};

impl Scene {
    /// One stage per kind of tangential law and of shapes, with the candidate pairs between whose materials such a law stands.
    pub(super) fn contact_stages(&self, bodies: &Bodies) -> Result<Vec<Box<dyn ContactStage>>, SceneError> {
        let mut stages: Vec<Box<dyn ContactStage>> = Vec::new();
        let linear = |pair: &Pair| match &pair.normal {
            NormalLaw::LinearSpringDashpot(law) => Some(LinearSpringDashpot::new(law.stiffness, law.restitution, law.end_of_contact)),
            NormalLaw::Hertz(_) | NormalLaw::Impulse(_) => None,
        };
        let frictionless = |pair: &Pair| pair.tangential.is_none().then_some(Frictionless);
        let viscous = |pair: &Pair| match &pair.tangential {
            Some(TangentialLaw::ViscousCoulomb(law)) => Some(ViscousCoulomb { friction: law.friction, damping_rate: law.damping_rate }),
            _ => None,
        };
        let history = |pair: &Pair| match &pair.tangential {
            Some(TangentialLaw::LinearHistory(law)) => {
                Some(LinearHistory { friction: law.friction, stiffness: law.stiffness, damping_ratio: law.damping_ratio })
            }
            _ => None,
        };
        let speed_at_start = self.speed_to_expect(bodies);
        let hertz = |pair: &Pair| match &pair.normal {
            NormalLaw::Hertz(law) => {
                Some(Hertz::new(sides_of(law), law.restitution, law.reference_speed.or(speed_at_start).unwrap_or(f64::NAN)))
            }
            NormalLaw::LinearSpringDashpot(_) | NormalLaw::Impulse(_) => None,
        };
        self.refuse_unknown_speeds(speed_at_start)?;
        self.add_stages_of_laws(bodies, |pair| Some((linear(pair)?, frictionless(pair)?, NoRolling)), &mut stages)?;
        self.add_rolling_stages(bodies, |pair| Some((linear(pair)?, viscous(pair)?)), &mut stages)?;
        self.add_rolling_stages(bodies, |pair| Some((linear(pair)?, history(pair)?)), &mut stages)?;
        self.add_rolling_stages(bodies, |pair| Some((linear(pair)?, viscous_spring(pair)?)), &mut stages)?;
        self.add_stages_of_laws(bodies, |pair| Some((hertz(pair)?, frictionless(pair)?, NoRolling)), &mut stages)?;
        self.add_rolling_stages(bodies, |pair| Some((hertz(pair)?, mindlin(pair)?)), &mut stages)?;
        Ok(stages)
    }

    /// The stages of a normal and a tangential law: without resistance to rolling, and with each kind of it.
    fn add_rolling_stages<Normal: law::NormalLaw, Tangential: law::TangentialLaw>(
        &self,
        bodies: &Bodies,
        laws: impl Fn(&Pair) -> Option<(Normal, Tangential)>,
        stages: &mut Vec<Box<dyn ContactStage>>,
    ) -> Result<(), SceneError> {
        let constant = |pair: &Pair| match &pair.rolling {
            Some(scene::RollingLaw::ConstantTorque(law)) => Some(ConstantTorque { friction: law.friction }),
            _ => None,
        };
        let spring = |pair: &Pair| match &pair.rolling {
            Some(scene::RollingLaw::SpringTorque(law)) => {
                Some(SpringTorque { friction: law.friction, stiffness: law.stiffness, damping_ratio: law.damping_ratio })
            }
            _ => None,
        };
        let free = |pair: &Pair| pair.rolling.is_none().then_some(NoRolling);
        self.add_stages_of_laws(bodies, |pair| Some(join(laws(pair)?, free(pair)?)), stages)?;
        self.add_stages_of_laws(bodies, |pair| Some(join(laws(pair)?, constant(pair)?)), stages)?;
        self.add_stages_of_laws(bodies, |pair| Some(join(laws(pair)?, spring(pair)?)), stages)
    }

    /// The largest relative speed in m/s that bodies can have as long as none is accelerated: nothing is known if gravity does, or if none moves.
    fn speed_to_expect(&self, bodies: &Bodies) -> Option<f64> {
        let largest = (0..bodies.len()).map(|index| bodies.half_step_velocity(index).norm()).fold(0.0, f64::max);
        (self.scene.gravity.is_none() && largest > 0.0).then_some(2.0 * largest)
    }

    fn refuse_unknown_speeds(&self, known: Option<f64>) -> Result<(), SceneError> {
        let is_unknown = |pair: &Pair| matches!(&pair.normal, NormalLaw::Hertz(law) if law.reference_speed.or(known).is_none());
        let Some(index) = self.pairs.iter().position(is_unknown) else { return Ok(()) };
        let message = "missing: with gravity, or with nothing in motion at the start, no impact speed is known to choose and check the step for; \
                       give the largest in m/s";
        Err(SceneError::new(SceneErrorKind::Combination, format!("pair[{index}].normal.hertz.reference_speed"), message))
    }

    /// The stages of one kind of laws, for spheres and for other shapes.
    fn add_stages_of_laws<Normal: law::NormalLaw, Tangential: law::TangentialLaw, Rolling: RollingLaw>(
        &self,
        bodies: &Bodies,
        laws_of_pair: impl Fn(&Pair) -> Option<(Normal, Tangential, Rolling)>,
        stages: &mut Vec<Box<dyn ContactStage>>,
    ) -> Result<(), SceneError> {
        let count = self.materials.len();
        let mut laws = Vec::new();
        let mut pairs_of_laws = Vec::new();
        let mut laws_between = vec![None; count * count];
        for (index, pair) in self.pairs.iter().enumerate() {
            let Some((normal, tangential, rolling)) = laws_of_pair(pair) else { continue };
            let [one, other] = [self.material_index(&pair.materials[0]), self.material_index(&pair.materials[1])];
            laws_between[one * count + other] = Some(laws.len());
            laws_between[other * count + one] = Some(laws.len());
            laws.push(Laws { normal, tangential, rolling });
            pairs_of_laws.push(index);
        }
        if laws.is_empty() {
            return Ok(());
        }
        let laws_of = |one: usize, other: usize| laws_between[one * count + other];
        let turns = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;
        let is_simple = |index: usize| bodies.shape(index).as_sphere().is_some() && (bodies.is_isotropic(index) || !turns);
        let (spheres, shaped): (Vec<_>, Vec<_>) =
            self.candidates(bodies, laws_of)?.into_iter().partition(|candidate| candidate.bodies().all(is_simple));
        if !spheres.is_empty() {
            stages.push(Box::new(SphereContacts::new(bodies, laws.clone(), self.walls(), spheres)));
        }
        self.refuse_mixed_superellipsoids(bodies, &shaped)?;
        if let Some(candidate) = shaped.first() {
            let for_shapes = |laws: &Laws<Tangential, Normal, Rolling>| {
                let normal = laws.normal.without_curvature().filter(|_| !Rolling::NEEDS_ROTATION)?;
                Some(Laws { normal, tangential: laws.tangential.clone(), rolling: NoRolling })
            };
            let laws = laws.iter().map(for_shapes).collect::<Option<Vec<_>>>();
            let laws = laws.ok_or_else(|| self.needs_spheres(bodies, candidate, pairs_of_laws[candidate.laws]))?;
            let parts = self.parts_of_bodies(bodies)?;
            stages.push(Box::new(ShapedContacts::new(laws, self.walls(), parts, self.resolution(), shaped)));
        }
        Ok(())
    }

    /// Superellipsoids have a common normal with each other and with balls; with edges there is none yet.
    fn refuse_mixed_superellipsoids(&self, bodies: &Bodies, candidates: &[Candidate]) -> Result<(), SceneError> {
        let is = |index: usize, wanted: fn(&Convex) -> bool| bodies.shape(index).parts().iter().any(|part| wanted(&part.convex));
        let is_smooth = |index: usize| is(index, |convex| matches!(convex, Convex::Superellipsoid(_)));
        let has_edges = |index: usize| is(index, |convex| !matches!(convex, Convex::Superellipsoid(_) | Convex::Sphere(_)));
        for candidate in candidates {
            let Partner::Body(second) = candidate.second else { continue };
            let first = candidate.first;
            if is_smooth(first) && has_edges(second) || has_edges(first) && is_smooth(second) {
                let message = format!(
                    "{}: a superellipsoid touches superellipsoids, spheres and walls in this version, no other shape; give a box or a cylinder \
                     as a superellipsoid with small exponents",
                    self.name_of(bodies, candidate)
                );
                return Err(SceneError::new(SceneErrorKind::Unsupported, self.key_of_body(bodies.id(first)), message));
            }
        }
        Ok(())
    }

    /// Why a law that lives on the radius of curvature of spheres cannot act between a candidate pair.
    fn needs_spheres(&self, bodies: &Bodies, candidate: &Candidate, pair: usize) -> SceneError {
        let key = if self.pairs[pair].rolling.is_some() { "rolling" } else { "normal.hertz" };
        let message = format!(
            "needs spheres, whose moments of inertia are equal, or such a sphere and a wall: {} have no radius of curvature at their contact",
            self.name_of(bodies, candidate)
        );
        SceneError::new(SceneErrorKind::Unsupported, format!("pair[{pair}].{key}"), message)
    }

    fn resolution(&self) -> Resolution {
        let settings = &self.numerics.shaped_contact;
        let points = match settings.points {
            ContactPoints::All => Points::All,
            ContactPoints::Deepest => Points::Deepest,
        };
        let one_sided = match settings.superellipsoids {
            SuperellipsoidContact::VerticesOfBothSides => OneSided::Ignored,
            SuperellipsoidContact::Continuous | SuperellipsoidContact::Vertices => OneSided::Resolved,
        };
        Resolution { sharing: settings.sharing, damped_mass: settings.damped_mass, points, one_sided }
    }

    /// Parts of every body as detection sees them; bodies of one shape share them.
    pub(super) fn parts_of_bodies(&self, bodies: &Bodies) -> Result<Vec<Arc<[DetectedPart]>>, SceneError> {
        let mut known: Vec<(Arc<Shape>, Arc<[DetectedPart]>)> = Vec::new();
        let mut parts_of = |index: usize| -> Result<Arc<[DetectedPart]>, SceneError> {
            let shape = bodies.shared_shape(index);
            if let Some((_, parts)) = known.iter().find(|(other, _)| Arc::ptr_eq(other, shape)) {
                return Ok(parts.clone());
            }
            let parts: Arc<[DetectedPart]> = detected_parts(shape, &self.numerics.shaped_contact)?.into();
            known.push((shape.clone(), parts.clone()));
            Ok(parts)
        };
        (0..bodies.len()).map(&mut parts_of).collect()
    }

    pub(super) fn candidates(
        &self,
        bodies: &Bodies,
        laws_of: impl Fn(usize, usize) -> Option<usize>,
    ) -> Result<Vec<Candidate>, SceneError> {
        let mut candidates = Vec::new();
        let bodies_interact = self.materials.iter().enumerate().any(|(one, _)| (0..=one).any(|other| laws_of(one, other).is_some()));
        if bodies_interact && bodies.len() > LARGEST_NUMBER_OF_BODIES {
            let message = format!(
                "{} bodies that touch are too many for this version, which tests every pair: at most {LARGEST_NUMBER_OF_BODIES}",
                bodies.len()
            );
            return Err(SceneError::new(SceneErrorKind::Unsupported, "body", message));
        }
        for (first, second) in all_pairs(bodies, |one, other| laws_of(one, other).is_some()) {
            let laws = laws_of(bodies.material(first), bodies.material(second));
            candidates.extend(laws.map(|laws| Candidate { first, second: Partner::Body(second), laws }));
        }
        for first in 0..bodies.len() {
            for (wall, boundary) in self.boundaries.iter().enumerate() {
                let laws = laws_of(bodies.material(first), self.material_index(&boundary.material));
                candidates.extend(laws.map(|laws| Candidate { first, second: Partner::Wall(wall), laws }));
            }
        }
        Ok(candidates)
    }

    pub(super) fn walls(&self) -> Vec<Plane> {
        let wall = |boundary: &scene::Boundary| match &boundary.geometry {
            BoundaryGeometry::Plane(plane) => Some(Plane { point: plane.point.into(), normal: Vector::from(plane.normal).normalize() }),
            // Refused before: see `refuse_unsupported_boundaries`.
            _ => None,
        };
        self.boundaries.iter().filter_map(wall).collect()
    }
}

fn join<Normal, Tangential, Rolling>((normal, tangential): (Normal, Tangential), rolling: Rolling) -> (Normal, Tangential, Rolling) {
    (normal, tangential, rolling)
}

/// The sides of a contact that are elastic.
fn sides_of(law: &scene::Hertz) -> Vec<hertz::Elasticity> {
    std::iter::once(law.first).chain(law.second).collect()
}

fn viscous_spring(pair: &Pair) -> Option<ViscousSpring> {
    let (Some(TangentialLaw::ViscousSpring(law)), NormalLaw::LinearSpringDashpot(normal)) = (&pair.tangential, &pair.normal) else {
        return None;
    };
    let damping_ratio = law::linear_spring_dashpot::damping_ratio(normal.restitution, normal.end_of_contact);
    Some(ViscousSpring { friction: law.friction, stiffness: law.stiffness, normal_stiffness: normal.stiffness, damping_ratio })
}

fn mindlin(pair: &Pair) -> Option<Mindlin> {
    let (Some(TangentialLaw::Mindlin(law)), NormalLaw::Hertz(normal)) = (&pair.tangential, &pair.normal) else { return None };
    let effective_shear_modulus = hertz::effective_shear_modulus(&sides_of(normal));
    Some(Mindlin { friction: law.friction, effective_shear_modulus, damping_ratio: law.damping_ratio })
}
