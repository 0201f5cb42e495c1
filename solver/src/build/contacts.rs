//! Contact stages of a scene: candidate pairs sorted by tangential law and by the kinds of their shapes.

use std::sync::Arc;

use super::shapes::detected_parts;
use crate::boundary::Plane;
use crate::broad_phase::{LARGEST_NUMBER_OF_BODIES, all_pairs};
use crate::contact::detect::{OneSided, Points};
use crate::contact::law::{self, Frictionless, LinearHistory, LinearSpringDashpot, ViscousCoulomb};
use crate::contact::shaped::{DetectedPart, Resolution, ShapedContacts};
use crate::contact::spheres::SphereContacts;
use crate::contact::stage::{Candidate, ContactStage, Laws, Partner};
use crate::scene::{
    BoundaryGeometry, ContactPoints, NormalLaw, Pair, Scene, SceneError, SceneErrorKind, SuperellipsoidContact, TangentialLaw,
};
use crate::shape::{Convex, Shape};
use crate::{Bodies, Vector};

impl Scene {
    /// One stage per kind of tangential law and of shapes, with the candidate pairs between whose materials such a law stands.
    pub(super) fn contact_stages(&self, bodies: &Bodies) -> Result<Vec<Box<dyn ContactStage>>, SceneError> {
        let mut stages: Vec<Box<dyn ContactStage>> = Vec::new();
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
        self.add_stages_of_law(bodies, frictionless, &mut stages)?;
        self.add_stages_of_law(bodies, viscous, &mut stages)?;
        self.add_stages_of_law(bodies, history, &mut stages)?;
        Ok(stages)
    }

    fn add_stages_of_law<Tangential: law::TangentialLaw>(
        &self,
        bodies: &Bodies,
        tangential: impl Fn(&Pair) -> Option<Tangential>,
        stages: &mut Vec<Box<dyn ContactStage>>,
    ) -> Result<(), SceneError> {
        let count = self.materials.len();
        let mut laws = Vec::new();
        let mut laws_between = vec![None; count * count];
        for pair in &self.pairs {
            let Some(tangential) = tangential(pair) else { continue };
            let NormalLaw::LinearSpringDashpot(normal) = &pair.normal else { continue };
            let normal = LinearSpringDashpot::new(normal.stiffness, normal.restitution, normal.end_of_contact);
            let [one, other] = [self.material_index(&pair.materials[0]), self.material_index(&pair.materials[1])];
            laws_between[one * count + other] = Some(laws.len());
            laws_between[other * count + one] = Some(laws.len());
            laws.push(Laws { normal, tangential });
        }
        let laws_of = |one: usize, other: usize| laws_between[one * count + other];
        let is_simple =
            |index: usize| bodies.shape(index).as_sphere().is_some() && (bodies.is_isotropic(index) || !Tangential::NEEDS_ROTATION);
        let (spheres, shaped): (Vec<_>, Vec<_>) =
            self.candidates(bodies, laws_of)?.into_iter().partition(|candidate| candidate.bodies().all(is_simple));
        if !spheres.is_empty() {
            stages.push(Box::new(SphereContacts::new(bodies, laws.clone(), self.walls(), spheres)));
        }
        self.refuse_mixed_superellipsoids(bodies, &shaped)?;
        if !shaped.is_empty() {
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
        let wall = |geometry: &BoundaryGeometry| {
            let BoundaryGeometry::Plane(plane) = geometry;
            Plane { point: plane.point.into(), normal: Vector::from(plane.normal).normalize() }
        };
        self.boundaries.iter().map(|boundary| wall(&boundary.geometry)).collect()
    }
}
