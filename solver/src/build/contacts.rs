//! Contact stages of a scene: one for each kind of laws and of shapes that can meet.

use std::sync::Arc;

use super::SceneWall;
use super::classes::{Class, Kind};
use super::shapes::detected_parts;
use super::stages::{Meeting, Meets, StageBuilder};
use crate::boundary::{Side, Wall};
use crate::contact::detect::{OneSided, Points};
use crate::contact::law::rolling::{ConstantTorque, SpringTorque};
use crate::contact::law::{
    self, Frictionless, Hertz, LinearHistory, LinearSpringDashpot, Mindlin, NoRolling, RollingLaw, ViscousCoulomb, ViscousSpring, hertz,
};
use crate::contact::pairs::Candidate;
use crate::contact::shaped::{DetectedPart, Resolution, ShapedContacts, Surroundings};
use crate::contact::sphere_walls::SphereWalls;
use crate::contact::spheres::SphereContacts;
use crate::contact::stage::Laws;
use crate::domain::{Domain, Shifts};
use crate::scene::{self, ContactPoints, NormalLaw, Pair, Scene, SceneError, SceneErrorKind, SuperellipsoidContact, TangentialLaw};
use crate::shape::Shape;
use crate::{Bodies, Vector};

impl Scene {
    /// One stage per kind of laws and of shapes, as far as there are bodies that touch by them.
    pub(super) fn contact_stages(&self, bodies: &Bodies, walls: &[SceneWall]) -> Result<StageBuilder, SceneError> {
        let mut stages = StageBuilder::new(self, bodies, walls);
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
        stages: &mut StageBuilder,
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
        builder: &mut StageBuilder,
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
        let laws_of = |one: usize, other: usize| laws_between[one * count + other];
        let turns = Tangential::NEEDS_ROTATION || Rolling::NEEDS_ROTATION;
        let is_simple = |class: &Class| class.kind == Kind::EvenSphere || class.kind == Kind::UnevenSphere && !turns;
        let meetings = builder.meetings(laws_of);
        let (spheres, shaped): (Vec<_>, Vec<_>) =
            meetings.into_iter().partition(|meeting| meeting.classes().all(|class| is_simple(&builder.classes[class])));
        let (at_walls, spheres): (Vec<_>, Vec<_>) = spheres.into_iter().partition(|meeting| builder.is_at_other_wall(meeting));
        let planes = builder.planes();
        let of_spheres = || SphereContacts::new(laws.clone(), planes.clone(), self.shifts());
        if !spheres.is_empty() {
            builder.add(Box::new(of_spheres()), &spheres);
        }
        if !at_walls.is_empty() {
            builder.add(Box::new(SphereWalls::new(laws.clone(), builder.walls.clone(), of_spheres())), &at_walls);
        }
        if let Some(meeting) = shaped.first() {
            self.refuse_walls_of_shapes(builder, &shaped)?;
            let for_shapes = |laws: &Laws<Tangential, Normal, Rolling>| {
                let normal = laws.normal.without_curvature().filter(|_| !Rolling::NEEDS_ROTATION)?;
                Some(Laws { normal, tangential: laws.tangential.clone(), rolling: NoRolling })
            };
            let laws = laws.iter().map(for_shapes).collect::<Option<Vec<_>>>();
            let laws = laws.ok_or_else(|| self.needs_spheres(bodies, builder.example(bodies, meeting), pairs_of_laws[meeting.laws]))?;
            let surroundings = Surroundings {
                walls: builder.walls.clone(),
                shifts: self.shifts(),
                parts: self.parts_of_shapes(bodies)?,
                resolution: self.resolution(),
            };
            builder.add(Box::new(ShapedContacts::new(laws, surroundings)), &shaped);
        }
        Ok(())
    }

    /// Superellipsoids know planes alone, and shaped bodies no tube with open ends. A superellipsoid has no crust and neither has a plate or the face of a
    /// mesh, so that each of their contacts would be one of sets that overlap, for which the depth is sought anew at every look; in a
    /// vessel it may touch at several places, of which the ascent that [`core_vessel`](crate::contact::detect::core_vessel) makes for it finds one.
    fn refuse_walls_of_shapes(&self, builder: &StageBuilder, meetings: &[Meeting]) -> Result<(), SceneError> {
        for meeting in meetings {
            let Meets::Wall(index) = meeting.second else { continue };
            let message = match &builder.walls[index].wall {
                Wall::Plane(_) => continue,
                _ if builder.classes[meeting.first].kind == Kind::Smooth => {
                    "superellipsoids touch no walls but planes and boxes in this version"
                }
                Wall::Cylinder(wall) if wall.side == Side::Inside && wall.half_length.is_finite() => {
                    "a tube with ends is touched by spheres alone in this version; without a length it is touched by other shapes too"
                }
                _ => continue,
            };
            let message = format!("`{}`: {message}", self.boundary_of_wall(index).name);
            return Err(SceneError::new(SceneErrorKind::Unsupported, self.key_of_wall(index, "geometry"), message));
        }
        Ok(())
    }

    /// Why a law that lives on the radius of curvature of spheres cannot act between a candidate pair.
    fn needs_spheres(&self, bodies: &Bodies, example: Option<Candidate>, pair: usize) -> SceneError {
        let key = if self.pairs[pair].rolling.is_some() { "rolling" } else { "normal.hertz" };
        let message = format!(
            "needs spheres, whose moments of inertia are equal, or such a sphere and a wall: {} have no radius of curvature at their contact",
            example.map_or_else(String::new, |example| self.name_of(bodies, &example))
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

    /// Parts of every shape as detection sees them.
    pub(super) fn parts_of_shapes(&self, bodies: &Bodies) -> Result<Vec<Arc<[DetectedPart]>>, SceneError> {
        let parts_of = |shape: &Arc<Shape>| Ok(detected_parts(shape, &self.numerics.shaped_contact)?.into());
        bodies.shapes().iter().map(parts_of).collect()
    }

    /// Displacements of the images of the periodic box.
    fn shifts(&self) -> Shifts {
        Shifts::of(self.periodic_domain().as_ref())
    }

    /// The box, if it repeats in any direction.
    pub(super) fn periodic_domain(&self) -> Option<Domain> {
        let domain = self.domain.as_ref().filter(|domain| domain.is_periodic())?;
        let lower = Vector::from(domain.lower);
        Some(Domain { lower, lengths: Vector::from(domain.upper) - lower, periodic: domain.periodic })
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
